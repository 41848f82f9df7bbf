/* SPDX-License-Identifier: MIT */
/* proves: fmcw.c lane.c safe.c radar.c
 * long: yes
 * simplify: ground
 *
 * The radar: beats, lane, safe distance and decision, each function from any state that can be.
 *
 * theorem radar_holds: it does not let go of a target in the lane before V_R <= 0, and of nothing at the first frame that asks for less
 * theorem radar_over_fault: nor does it after FAULT, if it braked or held before
 * theorem radar_silence: while the link is lost the brake never falls, and is FAULT_PCT or more
 */
#include "bits.h"
#include "fixed.h"
#include "frame.h"
#include "fmcw.c"
#include "lane.c"
#include "safe.c"
#include "radar.c"
