/* SPDX-License-Identifier: MIT */
/* functions: park_init,limited,weight_at,blended,park_steer,park_read,park_decide,park_lose,park_must_stand
 *
 * The parking decision: each function keeps its contract.
 */
#include "bits.h"
#include "park.c"
