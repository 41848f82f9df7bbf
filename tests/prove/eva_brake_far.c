/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: brake_far
 *
 * As eva_brake.c, behind the TF-Luna, with the law for all that it sees. */
#define SENSOR_tfluna
#define ESTIMATOR_smooth
#define BRAKE_RISE_PCT 3U
#include "eva_brake.c"
