/* SPDX-License-Identifier: MIT */
/* functions: park_init,limited,weight_at,blended,park_steer,park_read,park_decide,park_lose,park_must_stand,check,plan_sine_q15,part,tangent,swap,of_step,move,is_in_place,plan_begin,plan_step
 *
 * The parking decision: each function keeps its contract.
 */
#include "bits.h"
#include "plan.c"
#include "park.c"
