/* SPDX-License-Identifier: MIT */
/* Memory that this process and those that it forks see alike. */
#ifndef FUZZY51_SHARED_H
#define FUZZY51_SHARED_H

#include <stddef.h>

/* SIZE bytes, all 0. What is never touched takes no memory. It stays until the program ends, and
 * the program ends where there is none. */
void *shared_get(size_t size);

#endif
