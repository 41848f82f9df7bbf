/* SPDX-License-Identifier: MIT */
/* The brake's decision: readings in, duty and signals out. Portable; time comes as an argument. It
 * combines what the state machines of target.h, latch.h, fault.h and warning.h find with the law of
 * this image (law.h), and has itself no more than this:
 *
 *   the reading is                            the demand is
 *   believed, an echo within the law's reach  the law's
 *   believed, an echo beyond it               0
 *   believed, clear, and ends the target      0
 *   any other                                 held
 *   missing, and the target closes at         held, or the law's for where it is foreseen, where
 *   BRAKE_APPROACH_MMPS or more               that is more
 *   in FAULT, any                             held, or the law's where that is more
 *   the first in FAULT                        at least FAULT_PCT; 0 where that is 0
 *
 *   override held for 1 s, less than 30 s     0 %
 *   else STOP                                 100 % and the STOP pin
 *   else                                      the demand */
#ifndef FUZZY51_BRAKE_H
#define FUZZY51_BRAKE_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"
#include "fault.h"
#include "latch.h"

/* A target that was within the law's reach leaves it so far beyond its end. */
#define BRAKE_SLACK_FAR_MM 80U

/* A target that closes so fast is braked for where it must be by now, when its echo is missing. */
#define BRAKE_APPROACH_MMPS 1024U /* a multiple of 256 */

/* For a sensor that measures every 10 ms, an image's choice: what the law wants counts at once up
 * to BRAKE_SUDDEN_PCT, and above that it rises by BRAKE_RISE_PCT a reading. On a brake of 8 m/s2
 * with a lag of 0.2 s, 60 and 3 keep the jerk below 25 m/s3: that is 62.5 % above what the brake
 * does by then, which itself rises by 3.1 % in 10 ms. STOP and FAULT are sudden. */
#if defined(BRAKE_RISE_PCT) && !RANGE_IS_FAST
#error BRAKE_RISE_PCT is for a sensor that measures every 10 ms
#endif
#define BRAKE_SUDDEN_PCT 60U

/* The brake in FAULT, a board's choice: a car without a driver must come to rest. With 0 the driver
 * has the brake. */
#ifndef FAULT_PCT
#define FAULT_PCT 60
#endif

/* The driver has the brake once the override was held so long, until it was held to the end. From
 * then on it may be stuck, and does nothing until it is released. */
#define BRAKE_OVERRIDE_CS     100U
#define BRAKE_OVERRIDE_END_CS 3072U /* a multiple of 256 */

/* RELEASED: no target within the law's reach. CONTROL: what the law says. STOP: latch.h. FAULT:
 * fault.h. */
enum brake_state { BRAKE_RELEASED, BRAKE_CONTROL, BRAKE_STOP, BRAKE_FAULT };

/* What the pins and the telemetry show; written here and read elsewhere. */
struct brake_output {
    uint8_t brake_pct; /* 0..100 */
    bool stop;         /* the STOP pin */
    bool warn;
    uint8_t state;   /* enum brake_state */
    bool overridden; /* the driver has the brake */
};
extern struct brake_output brake;

/* Starts RELEASED, or in FAULT if `fault` is not BRAKE_FAULT_NONE. */
/*@ requires fault <= BRAKE_FAULT_IDLE;
    ensures !brake.overridden && !brake.stop;
    ensures fault != BRAKE_FAULT_NONE ==>
                brake.state == BRAKE_FAULT && brake.brake_pct == FAULT_PCT;
    ensures fault_state == (fault == BRAKE_FAULT_NONE   ? FAULT_GOOD :
                            fault >= BRAKE_FAULT_TABLE ? FAULT_LASTING : FAULT_ON); */
void brake_init(uint8_t fault);

/* Goes to FAULT for one of the lasting faults, unless one is there. BRAKE_FAULT_OUTPUT is STOP,
 * too, as either pin still brakes; not where FAULT_PCT is 0. */
/*@ requires fault_lasts(fault);
    ensures fault_state == FAULT_LASTING;
    ensures brake.state == BRAKE_FAULT;
    ensures !brake.overridden ==> brake.brake_pct >= FAULT_PCT;
    ensures t11_pwm: fault == BRAKE_FAULT_OUTPUT && FAULT_PCT > 0 && !brake.overridden ==>
                brake.stop && brake.brake_pct == 100; */
void brake_fail(uint8_t fault);

/* A check sum of what the decision keeps in RAM from one call of these functions to the next. A bit
 * that turns over there changes it, and nothing else does. Up to 200 mc. */
/*@ assigns \nothing; */
uint8_t brake_sum(void);

/* What the decision keeps in RAM has changed by itself, so nothing of it can be trusted: begins
 * anew, in FAULT, which ends with three good readings unless it was to last. The brake is at least
 * FAULT_PCT, and what it was if that can be. STOP goes on if two of three things say that it was
 * on. Up to 500 mc. */
/*@ ensures fault_state == (\old(fault_state) == FAULT_LASTING ? FAULT_LASTING : FAULT_ON);
    ensures fault_code == BRAKE_FAULT_STATE;
    ensures brake.state == BRAKE_FAULT && !brake.overridden;
    ensures t10_anew: brake.brake_pct <= 100 && brake.brake_pct >= FAULT_PCT; */
void brake_begin_anew(void);

/* Must this reading (of kind RANGE_ECHO) stop the car? It needs neither estimator nor table, so ask
 * it first. About 15 mc; inline. */
/*@ assigns \nothing;
    ensures \result <==> dist_mm <= BRAKE_STOP_MM && !brake.overridden; */
inline bool brake_must_stop(uint16_t dist_mm)
{
    return dist_mm <= BRAKE_STOP_MM && !brake.overridden;
}

/* One measurement is three calls, in this order. brake_expect when it is under way: elapsed_cs is
 * the time from the last trigger to this one, 1/100 s. brake_step when it is there, with its
 * range_kind and, if that is RANGE_ECHO, its distance: only this one is between an echo and the
 * duty. brake_finish once its outcome is at the pins: the other estimator, the end of STOP, the
 * warning; bring the pins up to date again. `make` proves what each takes: build/BOARD/APP.bound.
 */
void brake_expect(uint8_t elapsed_cs);
/*@ requires kind <= RANGE_DEAD_ZONE;
    ensures range_reading.kind == kind && range_reading.dist_mm == dist_mm;
    ensures t1_echo: kind == RANGE_ECHO && dist_mm <= BRAKE_STOP_MM && !brake.overridden ==>
                brake.stop && brake.brake_pct == 100;
    ensures t5_duty: brake.brake_pct <= 100; */
void brake_step(uint8_t kind, uint16_t dist_mm);
void brake_finish(void);

/* Every 1/100 s. Bring the pins up to date. */
/*@ ensures t5_duty: brake.brake_pct <= 100;
    ensures t8_override: !override_held ==> !brake.overridden; */
void brake_tick(bool override_held);

#endif
