/* SPDX-License-Identifier: MIT */
/* Searches a system for points where no rule sets an output: by zones, so nothing slips through a
 * grid. */
#ifndef FUZZY51_GAPS_H
#define FUZZY51_GAPS_H

#include <stdbool.h>
#include <stddef.h>

#include "fis.h"
#include "zones.h"

/* A box of zones: for each input from zone FROM to zone TO, both included. */
struct box {
    size_t from[FIS_VARIABLES_MAX];
    size_t to[FIS_VARIABLES_MAX];
};

struct gaps {
    size_t places;   /* boxes without a rule; 0: there is a rule everywhere */
    bool is_thin;    /* the largest of them has no width along some input */
    struct box box;  /* the largest, grown as far as it goes */
    bool incomplete; /* too many combinations to look at all */
    bool no_memory;
};

/* Looks for gaps of output OUTPUT. ZONES has the zones of each input. A rule counts if
 * COUNTS[rule]. */
struct gaps gaps_find(const struct fis *fis, const struct zones *zones, const bool *counts);

#endif
