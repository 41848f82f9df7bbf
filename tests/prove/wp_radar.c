/* SPDX-License-Identifier: MIT */
/* functions: radar_init,wanted_state,is_sure,brake,radar_decide,radar_lose,radar_cuts_throttle
 *
 * The radar's decision. Range, speed, lane and safe distance are anything that their headers allow.
 *
 * theorem radar_holds: it does not let go of a target in the lane before V_R <= 0, and never at the first frame that asks for less
 * theorem radar_silence: while the link is lost the brake never falls, and is FAULT_PCT or more
 */
#include "bits.h"
#include "radar.c"
