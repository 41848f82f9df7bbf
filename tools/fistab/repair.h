/* SPDX-License-Identifier: MIT */
/* The nearest table of integers that obeys a law of monotony: of all tables that rise or fall along
 * the named inputs, the one with the least sum of squared distances to the unrounded surface. */
#ifndef FUZZY51_REPAIR_H
#define FUZZY51_REPAIR_H

#include <stddef.h>

#include "law.h"
#include "table.h"

enum { REPAIR_INPUTS_MAX = 4 };

/* Writes the nearest monotone table to `cells`. `surface` and `cells` are row-major, the first
 * input slowest; `dims[k]` (>= 1) is the number of cells along input k, `inputs`
 * is 1..REPAIR_INPUTS_MAX. `direction[k]` is +1 (rises with input k), -1 (falls) or 0 (free). The
 * surface is finite and in levels; the cells lie in 0..levels_max. Where two tables are equally
 * near, the one with the larger cells is taken, as rounding half up does. Exact but for the last
 * bits of a surface value (2^-41 of a level for 10,000 cells). Returns 0, or -1 when memory is
 * short. */
int repair_monotone(const double *surface, const size_t *dims, int inputs, const int *direction,
                    int levels_max, int *cells);

/* The number of neighbour pairs in `cells` that break the law; 0 proves it, as the law is
 * transitive. `first`, if not NULL, gets the index of the first cell of such a pair. */
size_t repair_violations(const int *cells, const size_t *dims, int inputs, const int *direction,
                         size_t *first);

struct repair_report {
    size_t broken_before, broken_after;   /* neighbour pairs that break the law */
    size_t changed;                       /* cells */
    int largest;                          /* change of one cell */
    double squares_before, squares_after; /* sum of squared distances to the surface */
};

/* Repairs the integers of one output in place. Returns 0, or -1 when memory is short. */
int repair_output(struct table *table, size_t output, const struct law *law,
                  struct repair_report *report);

#endif
