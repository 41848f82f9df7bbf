/* SPDX-License-Identifier: MIT */
/* The control law: how hard to brake for a target that is there. An image links one of
 *
 *   law_fuzzy    the table, as published
 *   law_tuned    a table with more gain on the closing speed, first sight, and ease.h
 *   law_classic  full brake within the safe distance
 *   law_first    full brake at first sight: the most that this sensor allows
 *   law_none     never
 *
 * Readings, STOP, faults and signals are the same around each of them, so images differ by their
 * law alone. Portable, integers, no division. */
#ifndef FUZZY51_LAW_H
#define FUZZY51_LAW_H

#include <stdint.h>
#include "cc51.h"
#include "closing.h"
#include "axes.h"

/* The end of the table is every law's reach. */
#define LAW_FAR_MM ((uint16_t)(LUT_IN1_MIN_MILLI + LUT_IN1_SPAN_MILLI))

/* What is known of a target at a reading. */
enum law_target {
    LAW_TRACKED, /* it was there at the last good reading */
    LAW_NEW,     /* it was not, but this is its second reading or a later one */
    LAW_GLIMPSE, /* its first reading: it may only pass, so no table brakes for it yet */
    LAW_ENTERED, /* the same, and LAW_ENTER_CS ago a reading saw a clear road */
};
#define LAW_ENTER_CS 6U

/* One control step: percent, 0..100, for a target `dist_mm` away (enum law_target) that closes with
 * BRAKE_SPEED. A law with a table says in brake.row and brake.col where it looked, and brakes from
 * the second reading of a target on: one alone may be a stray echo or something that only passes
 * (but see law_tuned.h). */
uint8_t law_step(uint8_t target, uint16_t dist_mm);

/* What a target at 0..LAW_FAR_MM with that speed would be braked for, now and without a past. */
uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed);

#endif
