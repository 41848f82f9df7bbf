/* SPDX-License-Identifier: MIT */
/* functions: set_outputs,follow_init,follow_read,follow_lose
 *
 * The follower's frames and its fault.
 *
 * theorem follow_silence: while the link is lost the throttle is closed, and the brake never falls and is FAULT_PCT or more
 */
#include "bits.h"
#include "follow.c"
