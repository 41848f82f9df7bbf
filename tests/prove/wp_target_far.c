/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: brake_far
 * proves: range_tfluna.c closing_tfluna.c target.c
 *
 * The TF-Luna's frames, whatever bytes come, and the brake's targets and their speeds behind it: each function keeps
 * its contract, from any state that can be. */
#define SENSOR_tfluna
#define ESTIMATOR_smooth
/* The interrupt changes range_came, which range_take reads once, and no byte that range_take reads. */
#define volatile
#include "wp_target.c"
