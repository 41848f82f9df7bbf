/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: brake_far
 *
 * The brake's decision behind the TF-Luna, and that of brake_far: with the smooth estimator, and a demand that rises
 * no faster than BRAKE_RISE_PCT a reading. */
#define SENSOR_tfluna
#define ESTIMATOR_smooth
#define BRAKE_RISE_PCT 3U
#include "wp_brake.c"
