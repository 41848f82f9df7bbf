/* SPDX-License-Identifier: MIT */
/* controller: brake
 * proves: law_none.c
 *
 * The brake's law law_none: what it says is 0 to 100 %. */
#include "bits.h"
#include "fixed.h"
#include "target.h"
#include "law_none.c"
