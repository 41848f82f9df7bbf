/* SPDX-License-Identifier: MIT */
/* controller: radar
 *
 * Lamp, self-test, frames and link: each function keeps its contract.
 *
 * theorem crc_protects: a frame whose check sum is wrong is never taken for good
 * theorem count_protects: a frame that repeats the count of the last good one is never taken for good
 * theorem number_protects: a frame whose measurement does not follow that of the last good one is never taken for good
 * theorem up_needs_three: a link comes up only with the third good frame in a row
 * theorem silence_is_lost: a link that is up is lost after LINK_SILENCE_MS without a good frame
 * theorem bad_is_no_life: a bad frame does not lengthen the time until the link is lost
 */
#include "bits.h"
#include "lamp.c"
#include "selftest.c"
#include "frame.c"
#include "link.c"
