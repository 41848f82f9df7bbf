/* SPDX-License-Identifier: MIT */
/* controller: brake
 * proves: cell.c
 *
 * Cells of the brake's table. */
#include "bits.h"
#include "fixed.h"
#include "cell.c"
