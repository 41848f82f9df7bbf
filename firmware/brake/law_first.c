/* SPDX-License-Identifier: MIT */
/* Full brake as soon as anything is within reach: no controller with this sensor can brake earlier
 * or harder, so this is the physical limit that others are measured against. */
#include "law.h"

uint8_t law_step(uint8_t target, uint16_t dist_mm)
{
    (void)dist_mm;
    (void)target;
    return 100;
}

uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    (void)dist_mm;
    (void)speed;
    return 100;
}
