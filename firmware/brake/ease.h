/* SPDX-License-Identifier: MIT */
/* Eases the brake of a target that hardly closes, so that a car can follow one, and holds a car
 * that stands. A car has no speedometer here; all of this comes from the gap.
 *
 *   weight  0 at EASE_OPENING_MMPS opening, 1 at EASE_SPAN_MMPS more; the brake is the weight times
 *           the table's. So a constant gap leaves a seventh: enough to shut a throttle that is cut
 *           while the brake is on, and a light hold in itself.
 *
 *   near    From EASE_NEAR_MM to half a metre nearer the weight rises to 1, unless the gap opens.
 *
 *   hold    Brake on, and a gap as constant as the noise lets one see, for EASE_STILL_READINGS in a
 *           row: a rolling car would have slowed down and opened the gap by then. So this one
 *           stands, or the one ahead slows down as much, where braking is right as well. From then
 *           on the least brake rises by 1 % each 60 ms up to EASE_HOLD_PCT. It ends when the gap
 *           opens by EASE_OPENING_MMPS, three times the smooth estimator's noise, or the target
 *           goes.
 *
 * It assumes a throttle that is cut while the brake is on, and the smooth estimator. State: the
 * readings counted so far and the hold. Portable. */
#ifndef FUZZY51_EASE_H
#define FUZZY51_EASE_H

#include <stdint.h>
#include "cc51.h"
#include "closing.h"

#define EASE_OPENING_MMPS   150U
#define EASE_SPAN_MMPS      1024U /* a power of two; see EASE_SHIFT */
#define EASE_SHIFT          2U    /* 1024 >> 2 is 256, which means 1 */
#define EASE_NEAR_MM        1800U
#define EASE_STILL_MMPS     100U
#define EASE_STILL_READINGS RANGE_READINGS(192U)
#define EASE_HOLD_PCT       30U
#define EASE_HOLD_READINGS  RANGE_READINGS_MIN(1U, 6U) /* for 1 % more */

/* A target that was not there before. */
/*@ assigns \nothing; */
void ease_restart(void);

/* What is left of table_pct (0..100) for a target at dist_mm with closing_smooth. Once a reading.
 */
/*@ requires table_pct <= 100 && closing_is_valid;
    assigns \nothing;
    ensures \result <= 100;
    ensures closing_smooth.opening_mmps >= EASE_OPENING_MMPS ==> \result == 0;
    ensures closing_smooth.closing_mmps >= EASE_SPAN_MMPS - EASE_OPENING_MMPS ==>
                \result >= table_pct; */
uint8_t ease_pct(uint8_t table_pct, uint16_t dist_mm);

#endif
