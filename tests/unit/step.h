/* SPDX-License-Identifier: MIT */
/* A whole control step of the brake, for the tests of the brake under each law. */
#ifndef FUZZY51_STEP_H
#define FUZZY51_STEP_H

#include "brake.h"

static void step(uint8_t kind, uint16_t dist_mm, uint8_t elapsed_cs)
{
    brake_expect(elapsed_cs);
    brake_step(kind, dist_mm);
    brake_finish();
}

#endif
