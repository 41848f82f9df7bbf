/* SPDX-License-Identifier: MIT */
/* The brake's decision: readings in, duty and signals out. Portable; time comes as an argument.
 *
 *   RELEASED  no target, or beyond the table: 0 %
 *   CONTROL   what the law of this image says (law.h): the table, from a target's second reading on
 *   STOP      a reading of BRAKE_STOP_MM or less: 100 % and the stop line, at once and latched
 *   FAULT     no reading to believe for BRAKE_SILENCE_CS, a watchdog reset or a failed self-test
 */
#ifndef FUZZY51_BRAKE_H
#define FUZZY51_BRAKE_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"
#include "closing.h"

/* Which estimator feeds the table: ESTIMATOR_difference (default) or ESTIMATOR_smooth; the other
 * one can wait until the brake has acted. The release of STOP and the warning always ask the smooth
 * one. And how many cells further or slower the target must seem before the brake follows: for at
 * most one step of more than 2 points a second at 2 cm of noise. */
#if defined(ESTIMATOR_smooth)
#define BRAKE_SPEED      closing_smooth
#define BRAKE_TAKE_FIRST closing_take_smooth
#define BRAKE_TAKE_LATER closing_take_difference
#define BRAKE_SLACK_ROWS 1U
#define BRAKE_SLACK_COLS 0U
#else
#define BRAKE_SPEED      closing_difference
#define BRAKE_TAKE_FIRST closing_take_difference
#define BRAKE_TAKE_LATER closing_take_smooth
#define BRAKE_SLACK_ROWS 2U
#define BRAKE_SLACK_COLS 2U
#endif

/* A target that was within the table leaves it so far beyond its end. */
#define BRAKE_SLACK_FAR_MM 80U

/* The brake in FAULT, a board's choice: a car without a driver must come to rest. With 0 the driver
 * has the brake. */
#ifndef FAULT_PCT
#define FAULT_PCT 60
#endif

/* Stop at this distance (0: never); let go beyond the second one, opening faster than this twice in
 * a row, or after the override was held that long. */
#ifndef BRAKE_STOP_MM
#define BRAKE_STOP_MM 1000U
#endif
#define BRAKE_RELEASE_MM   1300U
#define BRAKE_RELEASE_MMPS 200U
#define BRAKE_OVERRIDE_CS  100U

/* Silent for more than 180 ms, three sensor periods, the controller is in FAULT until so many
 * readings in a row were good. */
#define BRAKE_SILENCE_CS    18U
#define BRAKE_GOOD_READINGS 3U

/* A target last seen nearer than this does not vanish: so many "no target" in a row are taken for a
 * missing echo (1.2 s), one for a target further off. */
#define BRAKE_NEAR_MM       4000U
#define BRAKE_LOST_READINGS 20U

/* The same reading again is a stuck one where the target moved at the first speed and cannot have
 * come to rest by the first of the two readings: one that does moved, on the mean over the time t
 * before it, at a t / 2 and up to sqrt(2 a 1 mm) more, for the millimetre that a reading hides.
 * With 10 m/s2, the most that wheels hold, that and the readings' rounding are 0.46 m/s over 60 ms,
 * 0.76 over 120, 1.06 over 180: less than the second speed for each 1/100 s of t. */
#define BRAKE_STUCK_MMPS        800U
#define BRAKE_STUCK_MMPS_PER_CS 80U

/* Warn when the target, at its present speed, would be braked for this hard in one second (0.8 s
 * and the time a reading takes), and closes faster than this; until it was not so for half a
 * second. */
#define BRAKE_WARN_PCT      60U
#define BRAKE_WARN_MMPS     300U
#define BRAKE_CALM_READINGS 8U

enum brake_state { BRAKE_RELEASED, BRAKE_CONTROL, BRAKE_STOP, BRAKE_FAULT };

/* The order of docs/brake.md. From BRAKE_FAULT_TABLE on they last until the next start. */
enum brake_fault {
    BRAKE_FAULT_NONE,
    BRAKE_FAULT_NOT_RISEN,  /* no echo pulse at all */
    BRAKE_FAULT_NOT_FALLEN, /* the echo pulse never ends */
    BRAKE_FAULT_DEAD_ZONE,  /* nearer than the sensor can measure */
    BRAKE_FAULT_JUMP,       /* nothing can move so fast */
    BRAKE_FAULT_STUCK,      /* the same reading while the target moves */
    BRAKE_FAULT_LOST,       /* a near target vanished */
    BRAKE_FAULT_WATCHDOG,   /* this start was a watchdog reset */
    BRAKE_FAULT_TABLE,      /* self-test: check sum of the table */
    BRAKE_FAULT_RAM,        /* self-test: pattern in RAM */
    BRAKE_FAULT_STACK,      /* self-test: the stack reached the end of RAM */
    BRAKE_FAULT_IDLE,       /* self-test: the sensor's line is high at rest */
};

struct brake_output {
    uint8_t brake_pct; /* 0..100 */
    bool stop;         /* the stop line */
    bool warn;
    uint8_t state;    /* enum brake_state */
    uint8_t fault;    /* enum brake_fault: why FAULT, or what is wrong with the last reading */
    uint8_t row, col; /* of the last look-up */
    bool overridden;  /* the driver has the brake */
};
extern struct brake_output brake;

/* Starts RELEASED, or in FAULT if `fault` is not BRAKE_FAULT_NONE. */
void brake_init(uint8_t fault);

/* Goes to FAULT for one of the lasting faults, unless one is there. */
void brake_fail(uint8_t fault);

/* Must this reading (of kind RANGE_ECHO) stop the car? It needs neither estimator nor table, so ask
 * it first. About 15 mc; inline. */
inline bool brake_must_stop(uint16_t dist_mm)
{
    return dist_mm <= BRAKE_STOP_MM && !brake.overridden;
}

/* One measurement is three calls. brake_expect when it is under way: elapsed_cs is the time from
 * the last trigger to this one, 5..31 hundredths of a second. brake_step when it is there, with its
 * range_kind and, if that is RANGE_ECHO, its distance: only this one is between an echo and the
 * duty. At most 510 mc and 1,010 mc, as tools/bound finds them: the packed table, the tuned law. */
void brake_expect(uint8_t elapsed_cs);
void brake_step(uint8_t kind, uint16_t dist_mm);

/* brake_finish once its outcome is at the pins: the warning, the release of STOP, the other
 * estimator. Bring the pins up to date again. At most 590 mc. */
void brake_finish(void);

/* Every 1/100 s. */
void brake_tick(bool override_held);

#endif
