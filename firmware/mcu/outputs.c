/* SPDX-License-Identifier: MIT */
/* The pins of both brakes, read back. */
#include "sfr.h"

#define WRONG_TICKS 3U /* in a row: a bit that flips is right again sooner */

bool hal_outputs_follow(bool stop)
{
    static __idata uint8_t wrong_ticks;

    wrong_ticks++;
    if (!pwm_is_wrong && pin_stop == stop) {
        wrong_ticks = 0;
    }
    return wrong_ticks < WRONG_TICKS;
}
