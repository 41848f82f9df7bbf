/* SPDX-License-Identifier: MIT */
/* proves: cordic.c plan.c park.c
 * long: yes
 *
 * The parking decision, from any state that can be.
 *
 * theorem lasts: who has arrived, or was in the dead zone, stands until the next start
 * theorem ends_at_the_line: at Y <= 0 the car stands until the next start
 */
#include "bits.h"
#include "fixed.h"
#include "cordic.c"
#include "plan.c"
#include "park.c"
