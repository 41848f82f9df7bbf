/* SPDX-License-Identifier: MIT */
/* proves: gap.c
 *
 * The gap controller's decision, from any state that can be.
 *
 * theorem gap_silence: while the link is lost the throttle is closed, and the brake never falls and is FAULT_PCT or more
 * theorem gap_emergency: EMERGENCY brakes fully, with the throttle closed
 * theorem gap_two_frames: a single frame never releases the brake, opens the throttle or ends EMERGENCY
 */
#define BITS_NEGATIVE
#include "bits.h"
#include "fixed.h"
#include "gap.c"
