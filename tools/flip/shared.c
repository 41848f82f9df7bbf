/* SPDX-License-Identifier: MIT */
#include "shared.h"

#include <stdlib.h>
#include <sys/mman.h>

void *shared_get(size_t size)
{
    void *memory =
        mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);

    if (memory == MAP_FAILED) {
        abort();
    }
    return memory;
}
