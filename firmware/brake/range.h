/* SPDX-License-Identifier: MIT */
/* Echo ticks -> distance, and what a measurement is worth. Portable. */
#ifndef FUZZY51_RANGE_H
#define FUZZY51_RANGE_H

#include <stdint.h>
#include "cc51.h"

/* Speed of sound: 343.2 m/s at 20 C; 0.6 m/s more each degree. */
#ifndef SOUND_MMPS
#define SOUND_MMPS 343200UL
#endif

/* HC-SR04 class: nothing nearer than 2 cm, and a pulse of 36 ms or more when no echo came. */
#define RANGE_MIN_MM 20U
#define RANGE_MAX_MM 6000U

/* The time from one reading to the next, and how many of them come in a time. */
#ifndef RANGE_PERIOD_MS
#define RANGE_PERIOD_MS 60U
#endif
#if RANGE_PERIOD_MS < 50 || RANGE_PERIOD_MS > 310 || RANGE_PERIOD_MS % 10 != 0
#error STEP_MS must be 50 to 310, in steps of 10
#endif
#define RANGE_PERIOD_CS         (RANGE_PERIOD_MS / 10U)
#define RANGE_READINGS(time_cs) (((time_cs) + RANGE_PERIOD_CS / 2U) / RANGE_PERIOD_CS)

/* A distance, a clear road, or one of the faults; never a distance that means something else. */
enum range_kind {
    RANGE_ECHO,
    RANGE_NO_TARGET,
    RANGE_NOT_RISEN,  /* the sensor never answered */
    RANGE_NOT_FALLEN, /* its answer never ended */
    RANGE_DEAD_ZONE,  /* shorter than it can measure */
};

/* What the last measurement said; brake.c has it. */
struct range_reading {
    uint8_t kind;     /* enum range_kind */
    uint16_t dist_mm; /* if that is RANGE_ECHO */
};
extern __data struct range_reading range_reading;

/* The distance for a way there and back of 0..65535 ticks (machine cycles, 12 / CLK_HZ): in mm, at
 * most 1 mm off the exact quotient, never falling when ticks rise. At most 75 mc. */
/*@ assigns \nothing; */
uint16_t range_mm(uint16_t ticks);

/* What a finished echo of this distance says: RANGE_ECHO, _NO_TARGET or _DEAD_ZONE. */
/*@ assigns \nothing;
    ensures \result == (dist_mm > RANGE_MAX_MM ? RANGE_NO_TARGET :
                        dist_mm < RANGE_MIN_MM ? RANGE_DEAD_ZONE : RANGE_ECHO); */
inline uint8_t range_kind(uint16_t dist_mm)
{
    uint8_t kind = RANGE_ECHO;

    if (dist_mm > RANGE_MAX_MM) {
        kind = RANGE_NO_TARGET;
    } else if (dist_mm < RANGE_MIN_MM) {
        kind = RANGE_DEAD_ZONE;
    }
    return kind;
}

#endif
