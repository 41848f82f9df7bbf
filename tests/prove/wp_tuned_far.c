/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: brake_far
 *
 * The law of brake_far, with its table. */
#define SENSOR_tfluna
#include "wp_tuned.c"
