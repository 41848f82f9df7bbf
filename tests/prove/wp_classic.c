/* SPDX-License-Identifier: MIT */
/* controller: brake
 * proves: law_classic.c
 *
 * The brake's law law_classic: what it says is 0 to 100 %. */
#include "bits.h"
#include "fixed.h"
#include "target.h"
#include "law_classic.c"
