/* SPDX-License-Identifier: MIT */
/* Flies the plan: forks the drive at each instant; the copy of the process is the checkpoint, of
 * chip and world alike. Each copy has one fault and ends as soon as it is again where the drive
 * without a fault was at that time, or where another copy was that had the same fate so far. */
#ifndef FUZZY51_FLIP_FLY_H
#define FUZZY51_FLIP_FLY_H

#include "fair.h"
#include "meet.h"
#include "plan.h"

struct flight {
    struct run *run;
    const struct run_setup *setup;
    const struct hexfile *hex;
    const struct arguments *arguments;
    struct fair *fair;
    struct plan *plan;
    struct meet *meet;
    long running; /* processes */
};

/* Fills in what came of each case of the plan, which is in order of time. */
void fly(struct flight *flight);

#endif
