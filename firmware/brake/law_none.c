/* SPDX-License-Identifier: MIT */
/* No controller: what happens to a car without one. The image is built with BRAKE_STOP_MM and
 * FAULT_PCT of 0, so neither STOP nor FAULT brakes. */
#include "law.h"

uint8_t law_step(uint8_t target, uint16_t dist_mm)
{
    (void)dist_mm;
    (void)target;
    return 0;
}

uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    (void)dist_mm;
    (void)speed;
    return 0;
}
