/* SPDX-License-Identifier: MIT */
/* The drive without a fault, to which each drive with one is compared. */
#ifndef FUZZY51_FLIP_FAIR_H
#define FUZZY51_FLIP_FAIR_H

#include "judge.h"
#include "mcs52.h"
#include "run.h"

#include <stdbool.h>
#include <stdint.h>

enum { FAIR_ROWS = 2000, FAIR_INPUTS = 2000, FAIR_BOOTS = 200 };

/* The world changed a pin. */
struct fair_input {
    uint64_t cycle;
    uint8_t port, bit;
    bool level;
};

struct fair {
    struct judge_row rows[FAIR_ROWS];
    double speeds_mps[FAIR_ROWS];
    struct mcs52 *chips[FAIR_ROWS]; /* at the end of each row */
    int row_count;
    struct mcs52 *boots[FAIR_BOOTS]; /* every 10 ms from power up to the first trigger */
    int boot_count;
    struct fair_input inputs[FAIR_INPUTS];
    int input_count;
    int64_t boot_ns; /* from power up to the first trigger */
    bool impact, fault;
    double min_gap_m;
};

/* Runs the drive once. FAULT_AT: where RAM says that the controller is in FAULT; -1: not known. */
void fair_record(struct fair *fair, struct run *run, const struct run_setup *setup, long fault_at);

/* The last chip that was kept until CYCLE. */
struct mcs52 *fair_start_before(const struct fair *fair, uint64_t cycle);

/* What the judge wants to know of the present moment; the own car's speed. */
struct judge_row fair_row_of(const struct world_class *class, const struct world *world,
                             double *speed_mps);

/* The controller is in FAULT. */
bool fair_is_in_fault(struct loop *loop, long fault_at);

/* The car is where it is without the fault at the end of row AT, so its sensor will hear the same.
 */
bool fair_is_same_world(const struct fair *fair, const struct judge_row *row, double speed_mps,
                        int at);

/* Both chips would go on alike. EXCUSED: addresses of RAM that do not count, -1: none. */
bool fair_is_same_chip(struct mcs52 *chip, const struct mcs52 *fair_chip, const long excused[2]);

#endif
