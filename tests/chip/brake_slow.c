/* SPDX-License-Identifier: MIT */
/* The brake controller, but its clock runs at half its speed beside timer 2. */
#include "hal.h"

static uint8_t slow_ticks(void);

#define hal_ticks slow_ticks
#include "../../firmware/brake/main.c"
#undef hal_ticks

static uint8_t slow_ticks(void)
{
    static uint8_t seen, counted;
    uint8_t ticks = hal_ticks();

    if ((uint8_t)(ticks - seen) >= 2U) {
        seen += 2U;
        counted++;
    }
    return counted;
}
