/* SPDX-License-Identifier: MIT */
/* The TF-Luna lidar at 9600 baud: what is its own. range.h includes the header of the image's
 * sensor. Facts are from the maker's manual, SJ-PM-TF-Luna A05: sections 5.4 and 5.5, appendix I.
 */
#ifndef FUZZY51_TFLUNA_H
#define FUZZY51_TFLUNA_H

/* It measures by itself, 100 times a second, in steps of 1 cm. */
#define RANGE_IS_TRIGGERED 0
#ifdef RANGE_PERIOD_MS
#error STEP_MS is for SENSOR=hcsr04; the TF-Luna measures every 10 ms
#endif
#define RANGE_PERIOD_MS 10U

/* It sees from 0.2 to 8 m. */
#define RANGE_MIN_MM 200U
#define RANGE_MAX_MM 8000U

/* A frame is lost now and then. Five in a row mean that the sensor is silent: a fault. */
#define RANGE_WAIT_CS 5U

/* FAULT comes after 180 ms without a believed reading. */
#define RANGE_SILENCE_CS 18U

/* The least time from one reading to the next, and the least one for a speed: in 10 ms the step of
 * 1 cm is 1 m/s. */
#define RANGE_ELAPSED_MIN_CS 1U
#define RANGE_SPAN_MIN_CS    6U
#define RANGE_IS_FAST        1

/* The strength of the light that comes back. Below the first the distance means nothing; the second
 * one says that other light blinds the sensor. */
#define TFLUNA_STRENGTH_MIN   100U
#define TFLUNA_STRENGTH_BLIND 65535U

#endif
