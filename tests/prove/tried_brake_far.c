/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: brake_far
 *
 * As tried_brake.c, with the table of brake_far. */
#include "tried_brake.c"
