/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: tuned
 *
 * As eva_brake.c, with the tuned law. */
#define ESTIMATOR_smooth
#include "eva_brake.c"
