/* SPDX-License-Identifier: MIT */
/* One measurement of the brake as main.c takes it, for the tests of the brake under each law: the
 * trigger, the wait for the echo, the reading, and what follows once the pins are set. */
#ifndef FUZZY51_STEP_H
#define FUZZY51_STEP_H

#include "brake.h"

#define STEP_ECHO_CS 3U /* from the trigger to the reading */

static bool step_held; /* the override, all along */

static inline void step_wait(uint8_t time_cs)
{
    while (time_cs-- != 0) {
        brake_tick(step_held);
    }
}

/* elapsed_cs: from the trigger before to this one. */
static inline void step(uint8_t kind, uint16_t dist_mm, uint8_t elapsed_cs)
{
    brake_expect(elapsed_cs);
    brake_step(kind, dist_mm);
    brake_finish();
}

/* The same, and the time passes: a period from trigger to trigger. */
static inline void step_in_time(uint8_t kind, uint16_t dist_mm)
{
    brake_expect(RANGE_PERIOD_CS);
    step_wait(STEP_ECHO_CS);
    brake_step(kind, dist_mm);
    brake_finish();
    step_wait(RANGE_PERIOD_CS - STEP_ECHO_CS);
}

#endif
