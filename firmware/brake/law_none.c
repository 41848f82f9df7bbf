/* SPDX-License-Identifier: MIT */
/* No controller: what happens to a car without one. The image is built with BRAKE_STOP_MM and
 * FAULT_PCT of 0, so neither STOP nor FAULT brakes. */
#include "law.h"

__data struct law_answer law_answer;

void law_restart(void)
{
}

/*@ ensures law_answer.brake_pct == 0; */
void law_step(uint8_t worth, uint16_t dist_mm)
{
    (void)worth;
    (void)dist_mm;
    law_answer.brake_pct = 0;
    law_answer.row = 0;
    law_answer.col = 0;
}

/*@ ensures \result == 0; */
uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    (void)dist_mm;
    (void)speed;
    return 0;
}
