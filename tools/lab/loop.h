/* SPDX-License-Identifier: MIT */
/* The closed loop without the simulator: a controller on the host in drive's own world. The
 * schedule of firmware/brake/main.c and the latencies of the chip are modelled, the controller and
 * the world are the real ones; tests/tools/test_lab.sh holds it against s51. */
#ifndef FUZZY51_LOOP_H
#define FUZZY51_LOOP_H

#include "expect.h"
#include "image.h"
#include "scenario.h"

/* Runs the scenario; OUTCOME gets the world's measures and nothing of telemetry or the warning. The
 * plant's longest step is STEP_US. */
void loop_run(const struct image *image, const struct scenario *scenario, uint64_t seed,
              int step_us, struct outcome *outcome);

/* What the controller was told last. */
struct loop_reading {
    long count; /* of readings so far */
    uint8_t kind;
    uint16_t dist_mm;
};

/* Every 10 ms: the world's columns (RIG_COLUMN_NAMES), and the last reading. */
typedef void loop_watch(void *user, double t_s, const double *values,
                        const struct loop_reading *reading);

/* The same, and WATCH looks on. */
void loop_run_watched(const struct image *image, const struct scenario *scenario, uint64_t seed,
                      int step_us, struct outcome *outcome, loop_watch *watch, void *user);

#endif
