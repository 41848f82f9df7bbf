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

/* What a law says: percent, 0..100, and the cell that it looked into last. */
struct law_answer {
    uint8_t brake_pct;
    uint8_t row, col;
};
extern __data struct law_answer law_answer; /* of the last law_step */

/* Whatever it remembers of the target before: nothing. */
/*@ assigns \nothing; */
void law_restart(void);

/* One control step, for a target of that worth (target.h; not TARGET_NONE) at
 * 0..LAW_FAR_MM + BRAKE_SLACK_FAR_MM that closes with CLOSING_LAW. A law with a table brakes from
 * the second reading of a target on: one alone may be a stray echo or something that only passes
 * (but see law_tuned.h). */
/*@ requires worth != TARGET_NONE && target_is_worth(worth) && closing_is_valid;
    assigns law_answer;
    ensures t5_cell: law_answer.row < LUT_IN1_CELLS && law_answer.col < LUT_IN2_CELLS;
    ensures t5_cell: law_answer.brake_pct <= 100; */
void law_step(uint8_t worth, uint16_t dist_mm);

/* What a target at 0..LAW_FAR_MM with that speed would be braked for, now and without a past. */
/*@ requires \valid_read(speed) && (speed->closing_mmps == 0 || speed->opening_mmps == 0);
    assigns \nothing;
    ensures \result <= 100; */
uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed);

#endif
