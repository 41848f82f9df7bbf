/* SPDX-License-Identifier: MIT */
/* Memory that is always there: where there is none, the program ends. */
#ifndef FUZZY51_MEMORY_H
#define FUZZY51_MEMORY_H

#include <stddef.h>
#include <stdio.h>

/* COUNT elements of SIZE bytes, all 0. To be freed. */
void *memory_get(size_t count, size_t size);

/* ARRAY (NULL: none yet) with room for COUNT elements of SIZE bytes; what is new is not set. */
void *memory_resize(void *array, size_t count, size_t size);

/* The first LENGTH characters of TEXT, or all if it is shorter. To be freed. */
char *memory_copy(const char *text, size_t length);

/* A stream for writing; once it is closed, its LENGTH characters are in TEXT. To be freed. */
FILE *memory_open(char **text, size_t *length);

#endif
