/* SPDX-License-Identifier: MIT */
/* The pins of both brakes, read back. */
#include "sfr.h"

static __idata uint8_t wrong_ticks;

uint8_t hal_outputs_wrong_ticks(bool stop)
{
    if (!pwm_is_wrong && pin_stop == stop) {
        wrong_ticks = 0;
    } else if (wrong_ticks != HAL_WRONG_TICKS) {
        wrong_ticks++;
    }
    return wrong_ticks;
}
