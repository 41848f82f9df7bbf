/* SPDX-License-Identifier: MIT */
/* proves: follow.c
 *
 * The follower's decision, from any state that can be.
 *
 * theorem follow_silence: while the link is lost the throttle is closed, and the brake never falls and is FAULT_PCT or more
 * theorem follow_near: a link that is lost near the robot ahead brakes fully
 * theorem follow_two_frames: a single frame never releases the brake, opens the throttle or asks for a lane
 * theorem follow_yields: who wants to change lanes brakes fully while the next lane is taken
 */
#include "bits.h"
#include "follow.c"
