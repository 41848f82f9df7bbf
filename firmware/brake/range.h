/* SPDX-License-Identifier: MIT */
/* What a reading of the range sensor is, whichever sensor the image has. Portable. */
#ifndef FUZZY51_RANGE_H
#define FUZZY51_RANGE_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

/* The image's sensor (make SENSOR=...); the host's tests have the HC-SR04. */
#if defined(SENSOR_tfluna)
#include "tfluna.h"
#else
#include "hcsr04.h"
#endif

/* The time from one reading to the next, and how many of them come in a time. */
#define RANGE_PERIOD_CS         (RANGE_PERIOD_MS / 10U)
#define RANGE_READINGS(time_cs) (((time_cs) + RANGE_PERIOD_CS / 2U) / RANGE_PERIOD_CS)

/* As many readings as come in a time, but at least so many. */
#define RANGE_READINGS_MIN(least, time_cs)                                                         \
    (RANGE_READINGS(time_cs) < (least) ? (least) : RANGE_READINGS(time_cs))

/* A distance, a clear road, or one of the faults; never a distance that means something else. */
enum range_kind {
    RANGE_ECHO,
    RANGE_NO_TARGET,
    RANGE_NOT_RISEN,  /* the sensor never answered; the TF-Luna: it is silent */
    RANGE_NOT_FALLEN, /* its answer never ended; the TF-Luna: other light blinds it */
    RANGE_DEAD_ZONE,  /* nearer than it can measure */
};

/* What the last measurement said; brake.c has it. */
struct range_reading {
    uint8_t kind;     /* enum range_kind */
    uint16_t dist_mm; /* if that is RANGE_ECHO */
};
extern __data struct range_reading range_reading;

#if RANGE_IS_TRIGGERED

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

#else

/* The bytes that came from the sensor: the interrupt writes the one to RANGE_NEXT and adds one to
 * range_came. It drops a byte that has no room: a frame of nine bytes leaves seven, 7 ms. */
#define RANGE_RING_BYTES 16U
extern volatile __idata uint8_t range_ring[RANGE_RING_BYTES];
extern volatile uint8_t range_came;
#define RANGE_NEXT       range_ring[range_came & (RANGE_RING_BYTES - 1U)]

/* How many of them range_take has taken. */
extern uint8_t range_taken;

/* Looks at one more of them. True: it ended a good frame, of which range_raw and range_kind tell
 * until the next call. Ask at least as often as bytes come. Up to 190 mc; 40 for the byte that ends
 * a frame. */
bool range_take(void);

/* Drops what came so far. */
void range_restart(void);

/* The distance in the frame, mm; 64 m and more count as 65535. */
/*@ assigns \nothing; */
uint16_t range_raw(void);
#define range_mm(raw)    (raw)

/* What the frame says, if that is its distance. The manual calls a distance unreliable
 * when the strength is below 100, which is so when nothing is there to send light back, and when it
 * is 65535, which is so in bright light. A strong answer from less than 20 cm is the dead zone. */
/*@ assigns \nothing;
    ensures \result == RANGE_ECHO ==> RANGE_MIN_MM <= dist_mm <= RANGE_MAX_MM;
    ensures dist_mm < RANGE_MIN_MM ==> \result != RANGE_ECHO;
    ensures \result <= RANGE_DEAD_ZONE; */
uint8_t range_kind(uint16_t dist_mm);

#endif

#endif
