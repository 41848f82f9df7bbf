/* SPDX-License-Identifier: MIT */
/* controller: brake
 * proves: law_fuzzy.c
 *
 * The published law.
 *
 * theorem t5_cell: the law looks into a cell of its table, and what it says is 0 to 100 %
 */
#include "bits.h"
#include "target.h"
#include "cell.h"
#include "law_fuzzy.c"
