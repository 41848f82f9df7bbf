/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: tuned_packed
 *
 * As tried_brake.c, with the tuned law's table as the boards of 8 KB have it. */
#include "tried_brake.c"
