/* SPDX-License-Identifier: MIT */
/* The HC-SR04 class of ultrasonic sensor: what is its own. range.h includes the header of the
 * image's sensor. */
#ifndef FUZZY51_HCSR04_H
#define FUZZY51_HCSR04_H

/* It measures when it is told to. */
#define RANGE_IS_TRIGGERED 1

/* Nothing nearer than 2 cm, and a pulse of 36 ms or more when no echo came. */
#define RANGE_MIN_MM 20U
#define RANGE_MAX_MM 6000U

/* The time from one reading to the next. */
#ifndef RANGE_PERIOD_MS
#define RANGE_PERIOD_MS 60U
#endif
#if RANGE_PERIOD_MS < 50 || RANGE_PERIOD_MS > 310 || RANGE_PERIOD_MS % 10 != 0
#error STEP_MS must be 50 to 310, in steps of 10
#endif

/* It answers in the time from one trigger to the next one, or there is none. */
#define RANGE_WAIT_CS RANGE_PERIOD_CS

/* FAULT comes after three periods without a believed reading. */
#define RANGE_SILENCE_CS (3U * RANGE_PERIOD_CS)

/* The least time from one reading to the next; two of them make a speed. */
#define RANGE_ELAPSED_MIN_CS 5U
#define RANGE_SPAN_MIN_CS    5U
#define RANGE_IS_FAST        0

/* Speed of sound: 343.2 m/s at 20 C; 0.6 m/s more each degree. */
#ifndef SOUND_MMPS
#define SOUND_MMPS 343200UL
#endif

#endif
