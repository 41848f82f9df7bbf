/* SPDX-License-Identifier: MIT */
/* proves: cordic.c plan.c park.c
 *
 * The parking decision, from any state that can be.
 */
#include "bits.h"
#include "fixed.h"
#include "cordic.c"
#include "plan.c"
#include "park.c"
