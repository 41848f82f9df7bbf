/* SPDX-License-Identifier: MIT */
/* Full brake as soon as anything is within reach: no controller with this sensor can brake earlier
 * or harder, so this is the physical limit that others are measured against. */
#include "law.h"

__data struct law_answer law_answer;

void law_restart(void)
{
}

/*@ ensures law_answer.brake_pct == 100; */
void law_step(uint8_t worth, uint16_t dist_mm)
{
    (void)worth;
    (void)dist_mm;
    law_answer.brake_pct = 100;
    law_answer.row = 0;
    law_answer.col = 0;
}

/*@ ensures \result == 100; */
uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    (void)dist_mm;
    (void)speed;
    return 100;
}
