/* SPDX-License-Identifier: MIT */
/* What one lamp can tell. */
#include "lamp.h"

#define FLICKER_CS 10U
#define BLINK_CS   25U
#define PAUSE_CS   100U

static uint8_t shown, blinks_left, phase_cs;
static bool is_lit;

/*@ assigns shown, blinks_left, phase_cs, is_lit;
    ensures shown == pattern;
    ensures pattern > LAMP_ON && \old(shown) != pattern ==> \result; */
bool lamp_tick(uint8_t pattern)
{
    if (pattern != shown) {
        shown = pattern;
        is_lit = false;
        phase_cs = 1;
        blinks_left = pattern;
    }
    if (pattern <= LAMP_ON) {
        return pattern == LAMP_ON;
    }
    if (--phase_cs == 0) {
        is_lit = !is_lit;
        phase_cs = pattern == LAMP_FLICKER ? FLICKER_CS : BLINK_CS;
        if (!is_lit && pattern != LAMP_FLICKER && --blinks_left == 0) {
            blinks_left = pattern;
            phase_cs = PAUSE_CS;
        }
    }
    return is_lit;
}
