/* SPDX-License-Identifier: MIT */
#include "memory.h"

#include <stdlib.h>
#include <string.h>

static void *or_end(void *memory)
{
    if (memory == NULL) {
        abort();
    }
    return memory;
}

void *memory_get(size_t count, size_t size)
{
    return or_end(calloc(count, size));
}

void *memory_resize(void *array, size_t count, size_t size)
{
    return or_end(reallocarray(array, count, size));
}

char *memory_copy(const char *text, size_t length)
{
    return or_end(strndup(text, length));
}

FILE *memory_open(char **text, size_t *length)
{
    return or_end(open_memstream(text, length));
}
