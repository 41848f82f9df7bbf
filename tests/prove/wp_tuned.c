/* SPDX-License-Identifier: MIT */
/* controller: brake
 * table: tuned
 * proves: ease.c law_tuned.c
 *
 * The tuned law, from any state that can be.
 *
 * theorem first_is_gentle: the first reading of a target that entered brakes with LAW_TUNED_FIRST_PCT at most
 * theorem t5_cell: the law looks into a cell of its table, and what it says is 0 to 100 %
 */
#define ESTIMATOR_smooth
#include "bits.h"
#include "fixed.h"
#include "target.h"
#include "ease.c"
#include "law_tuned.c"
