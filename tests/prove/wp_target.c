/* SPDX-License-Identifier: MIT */
/* controller: brake
 *
 * proves: range.c closing.c target.c
 *
 * The brake's targets and their speeds: each function keeps its contract, from any state that can be. */
#include "bits.h"
#include "range.c"
#include "fixed.c"
#include "closing.c"
#include "target.c"
