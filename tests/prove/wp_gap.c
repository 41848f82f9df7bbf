/* SPDX-License-Identifier: MIT */
/* functions: gap_read,gap_lose
 *
 * The gap controller's frames and its fault.
 *
 * theorem gap_silence: while the link is lost the throttle is closed, and the brake never falls and is FAULT_PCT or more
 */
#include "bits.h"
#include "gap.c"
