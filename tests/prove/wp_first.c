/* SPDX-License-Identifier: MIT */
/* controller: brake
 * proves: law_first.c
 *
 * The brake's law law_first: what it says is 0 to 100 %. */
#include "bits.h"
#include "fixed.h"
#include "target.h"
#include "law_first.c"
