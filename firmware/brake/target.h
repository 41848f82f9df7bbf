/* SPDX-License-Identifier: MIT */
/* The target: which of two hypotheses does an echo confirm? Portable.
 *
 * It tracks one target and keeps, beside it, one echo that did not fit it. Each has a window, from
 * its last place and the time since: what wheels can do; narrowed once the speed is known.
 *
 *   an echo within                    then
 *   the tracked target's window       believed: its next reading; the one aside is forgotten
 *   the window of the one aside       believed: its second reading; the one aside becomes the
 *                                     target
 *   both, and the target has one      believed: of the one whose last place is nearer to the echo
 *     reading
 *   neither, and there is no target   believed: the first reading of one
 *   neither                           not believed (BRAKE_FAULT_JUMP): it becomes the one aside
 *
 *   the target was                    clear readings that end it   meanwhile
 *   a glimpse, or entered             2                            believed
 *   new, or tracked beyond 4 m        4                            believed
 *   tracked nearer than 4 m           20                           not believed (BRAKE_FAULT_LOST)
 *
 * The same reading again, to 1 mm, is not believed (BRAKE_FAULT_STUCK) while the target cannot have
 * come to rest: it moved, at the last reading, as fast as TARGET_STUCK says by the difference and
 * as TARGET_STUCK_SMOOTH says by the smooth estimator. It lasts until another reading comes, and
 * TARGET_REST_READINGS at most: by then FAULT has brought the car to rest. */
#ifndef FUZZY51_TARGET_H
#define FUZZY51_TARGET_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"
#include "closing.h"
#include "fault.h"
#include "range.h"

/* What a target's last reading is worth. */
enum target_worth {
    TARGET_NONE,
    TARGET_GLIMPSE, /* its first one: it may only pass */
    TARGET_ENTERED, /* the same, and the reading before it saw a clear road */
    /* Its first one, too, but behind a glimpse that may have been a stray echo: the road was clear
     * before that, or between the two. */
    TARGET_ENTERED_LATE,
    TARGET_NEW, /* its second one */
    /* Its second one, too, but it had entered and then a reading saw a clear road: the one before
     * may have been a stray echo, and its speed may be wrong. */
    TARGET_NEW_LATE,
    TARGET_TRACKED, /* the third or a later one */
};

/* What wheels can do, at the most: 36 m/s nearer, 12 m/s away. */
#define TARGET_NEARER_MM_PER_CS 360U
#define TARGET_AWAY_MM_PER_CS   120U

/* And where the speed is known: so far from where the target should be. */
#define TARGET_GATE_MM        160U
#define TARGET_GATE_MM_PER_CS 16U /* and so much more for the time since */

/* An echo that may be of either of two is likely to be of the later one so near to it. */
#define TARGET_LIKELY_MM 720U

/* An echo so far behind a glimpse is TARGET_ENTERED_LATE. */
#define TARGET_BEHIND_MM 150U

/* After a longer silence whatever comes is another target. */
#define TARGET_SILENCE_MAX_CS CLOSING_SPAN_MAX_CS

/* Clear readings that end a target: see above. With 30 % of the echoes missing, 24 of 500
 * approaches end in contact under the published table, and as many with 3 or 5 for
 * TARGET_FAR_CLEARS (`lab trouble`). */
#define TARGET_NEAR_MM        4096U /* a multiple of 256 */
#define TARGET_GLIMPSE_CLEARS RANGE_READINGS_MIN(2U, 12U)
#define TARGET_FAR_CLEARS     RANGE_READINGS_MIN(4U, 24U)
#define TARGET_NEAR_CLEARS    RANGE_READINGS(120U)

/* A target moved, on the mean over the time t before its last reading, at v. With 10 m/s2, the
 * most that wheels hold, it moved at v - a t / 2 by then, and has come to rest within the step of a
 * coarse sensor, 10 mm, if that is less than sqrt(2 a 10 mm) = 0.45 m/s. The two readings' rounding
 * makes v uncertain by 10 mm / t. All that is less than 0.65 m/s and 0.05 for each 1/100 s of t. */
#define TARGET_STUCK        3U /* 256 mm/s, and 64 mm/s for each 1/100 s, rounded down to 256 */
#define TARGET_STUCK_SMOOTH 4U
/* A sensor that measures every 10 ms sees a slow target at the same place twice. There the same
 * reading is not believed once the target, moving as above, should have come so far, in 2.56 mm,
 * since the reading changed: 123 mm, four times what noise of 2 cm can hide. */
#define TARGET_STUCK_WAY 48U
/* Two readings that tell of so much, 8 m/s, are likelier a stray echo and one of a target. */
#define TARGET_STUCK_NEW_MAX 32U
#define TARGET_REST_READINGS (RANGE_READINGS(300U) < 250U ? RANGE_READINGS(300U) : 250U)

/*@ predicate target_is_worth(integer worth) = TARGET_NONE <= worth <= TARGET_TRACKED; */
extern uint8_t target_worth; /* enum target_worth; the place is closing_place_mm */

/*@ assigns target_worth, closing_place_mm, closing_difference, closing_smooth;
    ensures target_worth == TARGET_NONE; */
void target_init(void);

/* A measurement is under way: elapsed_cs is the time from the last trigger to this one. Once each,
 * whatever comes of it. Up to 600 mc. */
/*@ assigns target_worth, closing_foreseen_mm, closing_difference, closing_smooth;
    ensures target_worth == \old(target_worth) || target_worth == TARGET_NONE; */
void target_expect(uint8_t elapsed_cs);

/* It came: an echo, 0..RANGE_MAX_MM, or a clear road. BRAKE_FAULT_NONE if it is believed,
 * else why not (fault.h). After an echo that is believed the speeds of closing.h are up to date,
 * but for the one estimator that closing.h lets wait. Up to 350 mc. */
/*@ assigns target_worth, closing_place_mm, closing_span_cs, closing_difference, closing_smooth;
    ensures \result == BRAKE_FAULT_NONE || \result == BRAKE_FAULT_STUCK ||
            \result == BRAKE_FAULT_JUMP;
    ensures \result == BRAKE_FAULT_NONE ==> target_worth != TARGET_NONE; */
uint8_t target_echo(uint16_t dist_mm);
/*@ assigns target_worth, closing_difference, closing_smooth;
    ensures \result == BRAKE_FAULT_NONE || \result == BRAKE_FAULT_LOST;
    ensures target_worth == \old(target_worth) || target_worth == TARGET_NONE;
    ensures \result == BRAKE_FAULT_LOST ==> target_worth == \old(target_worth); */
uint8_t target_clear(void);

/* This part of brake_sum. */
/*@ assigns \nothing; */
uint8_t target_sum(void);

#endif
