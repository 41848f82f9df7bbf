/* SPDX-License-Identifier: MIT */
/* The warning of an approach at constant speed, for the tests of the brake under each law. */
#ifndef FUZZY51_WARNED_H
#define FUZZY51_WARNED_H

#include "brake.h"
#include "range.h"
#include "step.h"

#define WARNED_HARD_PCT 63U /* 5 m/s2 of a brake of 8: hard, as UN R152 calls it */
#define WARNED_READINGS 14U /* 0.84 s: 0.8, and the lamp's tick and a longer echo */

/* A target that comes nearer by step_mm a reading and does not slow down, seen first at first_mm:
 * is it warned of once, WARNED_READINGS before hard braking or, where the sensor sees less far,
 * with the second reading, the first one that tells a speed? */
static bool is_warned_in_time(uint16_t first_mm, uint16_t step_mm)
{
    uint16_t mm;
    uint8_t reading = 0, warned_at = 0, i;

    brake_init(BRAKE_FAULT_NONE);
    step(RANGE_NO_TARGET, 0, 6);
    for (mm = first_mm; mm > step_mm; mm = (uint16_t)(mm - step_mm)) {
        for (i = 0; i < 6; i++) {
            brake_tick(false);
        }
        step(RANGE_ECHO, mm, 6);
        reading++;
        if (brake.warn && warned_at == 0) {
            warned_at = reading;
        }
        if (brake.warn != (warned_at != 0)) {
            return false;
        }
        if (brake.brake_pct >= WARNED_HARD_PCT) {
            return warned_at == 2 ||
                   (warned_at > 2 && reading - warned_at >= (uint8_t)WARNED_READINGS);
        }
    }
    return false;
}

/* Any phase of the sensor: its first reading is anywhere in the first step within 5 m. */
static void assert_warned_in_time(uint16_t from_mm, uint16_t to_mm)
{
    uint16_t step_mm, late_mm;

    for (step_mm = from_mm; step_mm <= to_mm; step_mm += 15) {
        for (late_mm = 0; late_mm < step_mm; late_mm += step_mm / 4U) {
            TEST_ASSERT_TRUE_MESSAGE(is_warned_in_time((uint16_t)(5000 - late_mm), step_mm),
                                     "too late");
        }
    }
}

#endif
