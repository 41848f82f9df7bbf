/* SPDX-License-Identifier: MIT */
/* A target's places -> its closing speed. Portable, integers, no division.
 *
 * Two estimators run side by side: the plain difference of the last two places over the true time
 * between them, and alpha-beta with 3/4 and 1/4. Which echo is a place of the target, target.h
 * says. (What each is good for: `make bench` measures it in the loop.) */
#ifndef FUZZY51_CLOSING_H
#define FUZZY51_CLOSING_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"
#include "range.h"

/* Two places are so far apart in time, 1/100 s; less counts as the least, more as the most. */
#define CLOSING_SPAN_MIN_CS RANGE_SPAN_MIN_CS
#define CLOSING_SPAN_MAX_CS 31U

/* A place is at most so far from where alpha-beta sees the target. */
#define CLOSING_OFF_MAX_MM 700U

/* Speeds in mm/s, each as two magnitudes of which one is 0: up to 36 m/s do not fit 16 bits with a
 * sign. */
struct closing_speed {
    uint16_t closing_mmps;
    uint16_t opening_mmps;
};
extern __data struct closing_speed closing_difference; /* plain difference */
extern __data struct closing_speed closing_smooth;     /* alpha-beta */

/*@ predicate closing_is_valid =
        (closing_difference.closing_mmps == 0 || closing_difference.opening_mmps == 0) &&
        (closing_smooth.closing_mmps == 0 || closing_smooth.opening_mmps == 0); */
/* Which estimator feeds the law: ESTIMATOR_difference (default) or ESTIMATOR_smooth; the other one
 * can wait until the brake has acted. The release of STOP and the warning always ask the smooth
 * one. */
#if defined(ESTIMATOR_smooth)
#define CLOSING_LAW        closing_smooth
#define CLOSING_TAKE_FIRST closing_take_smooth
#define CLOSING_TAKE_LATER closing_take_difference
#else
#define CLOSING_LAW        closing_difference
#define CLOSING_TAKE_FIRST closing_take_difference
#define CLOSING_TAKE_LATER closing_take_smooth
#endif

/* The time that the difference was last taken over, 1/100 s. */
extern uint8_t closing_span_cs;

/* The target's last place, which target.c may exchange, and where alpha-beta foresees the next one;
 * that may be below 0, modulo 2^16. */
extern uint16_t closing_place_mm, closing_foreseen_mm;

/* No speed, until a target's second place. */
/*@ assigns closing_difference, closing_smooth;
    ensures closing_is_valid;
    ensures closing_difference.closing_mmps == 0 && closing_smooth.closing_mmps == 0;
    ensures closing_difference.opening_mmps == 0 && closing_smooth.opening_mmps == 0; */
void closing_restart(void);

/* The target's second place, span_cs (5..31; other times count as 31) after closing_place_mm: both
 * estimators begin with the difference. */
/*@ assigns closing_place_mm, closing_span_cs, closing_difference, closing_smooth;
    ensures closing_is_valid;
    ensures closing_place_mm == dist_mm && closing_span_cs == span_cs;
    ensures closing_difference == closing_smooth; */
void closing_take_second(uint16_t dist_mm, uint8_t span_cs);

/* A later one, within CLOSING_OFF_MAX_MM of where it was foreseen. Each estimator is owed its call
 * below. */
/*@ assigns closing_place_mm, closing_span_cs;
    ensures closing_place_mm == dist_mm; */
void closing_take(uint16_t dist_mm, uint8_t span_cs);

/* Takes the place of closing_take into one estimator: once each, before the next closing_expect.
 * Up to 250 mc each. */
/*@ requires closing_is_valid;
    assigns closing_difference, closing_span_cs;
    ensures closing_is_valid; */
void closing_take_difference(void);
/*@ requires closing_is_valid;
    assigns closing_smooth;
    ensures closing_is_valid; */
void closing_take_smooth(void);

/* The next place is due span_cs after the last one. From the second place on. Up to 250 mc. */
/*@ requires closing_is_valid;
    assigns closing_foreseen_mm; */
void closing_expect(uint8_t span_cs);

/* This part of brake_sum. */
/*@ assigns \nothing; */
uint8_t closing_sum(void);

#endif
