/* SPDX-License-Identifier: MIT */
/* STOP: full brake at 1 m or less, until it is sure that it may end. Portable.
 *
 * TRIAL is STOP for one reading that nothing has confirmed: it may be a stray echo. DOUBTED is
 * the same, contradicted once. HELD is confirmed. OPENING is HELD, and the target has opened once.
 * In every state but OPEN the STOP pin is high and the brake is 100 %.
 *
 *   state    override <= 1 m       <= 1.3 m opening beyond         passed clear   road fault
 *   OPEN     OPEN     TRIAL (HELD) OPEN     OPEN    OPEN           OPEN   OPEN    OPEN OPEN
 *   TRIAL    OPEN     HELD         HELD     OPEN    DOUBTED (OPEN) OPEN   DOUBTED OPEN TRIAL
 *   DOUBTED  OPEN     HELD         HELD     OPEN    OPEN           OPEN   OPEN    OPEN DOUBTED
 *   HELD     OPEN     HELD         HELD     OPENING HELD           OPEN   HELD    OPEN HELD
 *   OPENING  OPEN     HELD         HELD     OPEN    HELD           OPEN   OPENING OPEN OPENING
 *
 * The state in brackets holds for a tracked reading. The columns, of which the first that applies
 * decides:
 *   override  the driver has held it for a second
 *   <= 1 m, <= 1.3 m, beyond   the distance of an echo, whatever it is worth
 *   tracked   the reading is believed as the third or a later one of its target
 *   opening   tracked, beyond 1.3 m, opening at more than LATCH_OPENING_MMPS; of a sensor that
 *             measures every 10 ms, for LATCH_OPENING_READINGS in a row
 *   passed    another target than that of STOP is tracked beyond 1.3 m, for LATCH_PASSED_READINGS
 *   road      the last LATCH_ROAD_READINGS were clear, every one of them
 *   fault     no echo, and no clear road either
 *
 * A sensor that measures every 10 ms has LATCH_DOUBT_READINGS from the begin of TRIAL to the
 * reading that confirms or doubts it, and as many from the begin of DOUBTED to the one that ends
 * it. A tracked reading does so at once. */
#ifndef FUZZY51_LATCH_H
#define FUZZY51_LATCH_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"
#include "range.h"

#ifndef BRAKE_STOP_MM /* 0: never */
#define BRAKE_STOP_MM 1000U
#endif
#ifndef LATCH_NEAR_MM
#define LATCH_NEAR_MM 1300U
#endif
#if LATCH_NEAR_MM < BRAKE_STOP_MM || LATCH_NEAR_MM > RANGE_MAX_MM
#error RELEASE_MM must be STOP_MM to 6000
#endif
#define LATCH_OPENING_MMPS     200U
#define LATCH_OPENING_READINGS RANGE_READINGS_MIN(1U, 6U)
#define LATCH_DOUBT_READINGS   RANGE_READINGS_MIN(1U, 6U)
#define LATCH_PASSED_READINGS  RANGE_READINGS(100U)
#define LATCH_ROAD_READINGS    RANGE_READINGS(200U)

enum latch_state { LATCH_OPEN, LATCH_TRIAL, LATCH_DOUBTED, LATCH_HELD, LATCH_OPENING };
#define LATCH_STATES 5U
/* The twin is the state's complement, and follows each of its changes. Where a bit of either turns
 * over, that is no longer so, until latch_init. STOP is where both say it. */
extern uint8_t latch_state, latch_twin;
/*@ predicate latch_is_whole = latch_state + latch_twin == 0xFF;
    predicate latch_is_stop = latch_state != LATCH_OPEN && latch_twin != 0xFF - LATCH_OPEN; */
#define LATCH_IS_WHOLE() ((uint8_t)(latch_state + latch_twin) == 0xFFU)
#define LATCH_IS_STOP()  (latch_state != LATCH_OPEN && latch_twin != 0xFFU - LATCH_OPEN)

/*@ assigns latch_state, latch_twin;
    ensures latch_state == LATCH_OPEN && latch_is_whole; */
void latch_init(void);

/* range_reading came; is_of_target: it is one of the target of target.h. Up to 120 mc. */
/*@ assigns latch_state, latch_twin;
    ensures latch_state < LATCH_STATES;
    ensures t1_echo: range_reading.kind == RANGE_ECHO && range_reading.dist_mm <= BRAKE_STOP_MM
                ==> latch_state != LATCH_OPEN; */
void latch_take(bool is_of_target);

/* STOP goes on, whatever was before. */
/*@ assigns latch_state, latch_twin;
    ensures latch_state == LATCH_HELD;
    ensures \old(latch_is_whole) ==> latch_is_whole; */
void latch_hold(void);

/* The driver has the brake. */
/*@ assigns latch_state, latch_twin;
    ensures latch_state == LATCH_OPEN;
    ensures \old(latch_is_whole) ==> latch_is_whole; */
void latch_override(void);

/* This part of brake_sum. */
/*@ assigns \nothing; */
uint8_t latch_sum(void);

#endif
