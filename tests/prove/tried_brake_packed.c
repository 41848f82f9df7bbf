/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: brake_packed
 *
 * As tried_brake.c, with the published table as the boards of 8 KB have it. */
#include "tried_brake.c"
