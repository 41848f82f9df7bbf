/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: tuned
 *
 * As tried_brake.c, with the tuned law's table. */
#include "tried_brake.c"
