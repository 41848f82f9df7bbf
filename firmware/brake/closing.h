/* SPDX-License-Identifier: MIT */
/* Readings -> closing speed, and which reading to believe. Portable, integers, no division.
 *
 * Two estimators run side by side: the plain difference of the last two believed readings over the
 * true time between them, and alpha-beta with 3/4 and 1/4. One gate serves both: a reading more
 * than CLOSING_GATE_MM from where the target should be is set aside once, and believed when the
 * next one agrees with it. (What each is good for: `make bench` measures it in the loop.) */
#ifndef FUZZY51_CLOSING_H
#define FUZZY51_CLOSING_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

#define CLOSING_GATE_MM 350U

/* Faster than 36 m/s nothing comes or goes: a second reading further off is no second reading. */
#define CLOSING_REACH_MM_PER_CS 360U

/* Readings are 5..CLOSING_ELAPSED_MAX_CS apart; after a longer silence a target starts anew. */
#define CLOSING_ELAPSED_MIN_CS 5U
#define CLOSING_ELAPSED_MAX_CS 31U

/* Speeds in mm/s, each as two magnitudes of which one is 0: up to 36 m/s do not fit 16 bits with a
 * sign. */
struct closing_speed {
    uint16_t closing_mmps;
    uint16_t opening_mmps;
};
extern __data struct closing_speed closing_difference; /* plain difference */
extern __data struct closing_speed closing_smooth;     /* alpha-beta */

/* The time that closing_difference is taken over, 1/100 s. */
extern uint8_t closing_span_cs;

/* Readings believed of this target, 0..3 (3: or more). */
extern uint8_t closing_samples;

/* Forgets the target; speeds are 0 until two readings came. */
void closing_restart(void);

/* A reading is on its way, elapsed_cs (1/100 s; less than CLOSING_ELAPSED_MIN_CS counts as that)
 * after the last call or restart. Once for each, whether it comes or not. Up to 440 mc. */
void closing_expect(uint8_t elapsed_cs);

/* The reading came, 0..RANGE_MAX_MM. False: it is set aside and the speeds stay as they are. True,
 * and closing_samples is 3: the speeds are still those of the reading before, and each estimator is
 * owed its call below. Up to 250 mc. */
bool closing_update(uint16_t dist_mm);

/* Takes that reading into one estimator: once each, before the next closing_expect; the brake asks
 * one of them before it acts and the other one after it. Up to 130 mc each. */
void closing_take_difference(void);
void closing_take_smooth(void);

#endif
