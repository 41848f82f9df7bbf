/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: brake_far
 * defined: by eva_brake_far
 *
 * The main loop of brake_far, from reset on, whatever the machine and the TF-Luna deliver. */
#define SENSOR_tfluna
#define ESTIMATOR_smooth
#define BRAKE_RISE_PCT 3U
#include "wp_main.c"
