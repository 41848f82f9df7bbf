/* SPDX-License-Identifier: MIT */
/* Timer 0 measures the echo in machine cycles. The echo pin (INT0) gates the timer, and the end of
 * the echo sets the flag IE0, without an interrupt. So the count is exact to one cycle whatever the
 * program does meanwhile. */
#include "sfr.h"

/* The sensor needs a pulse of 10 us; each turn of the delay takes 2 cycles. */
#define TRIGGER_TURNS ((uint8_t)(CYCLES_PER_S * 12U / 1000000U / 2U + 1U))

static __bit was_high; /* the echo of the last measurement had not ended at the trigger */

void sensor_init(void)
{
    pin_trigger = 0;
    TMOD = (TMOD & 0xF0) | T0_GATE | T0_M0; /* 16 bits, counts while the echo is high */
    IT0 = 1;
}

void hal_trigger(void)
{
    uint8_t turns = TRIGGER_TURNS;

    TR0 = 0;
    TL0 = 0;
    TH0 = 0;
    pin_trigger = 1;
    do {
    } while (--turns != 0); /* rounds: 7 */
    pin_trigger = 0;
    was_high = pin_echo;
    IE0 = 0;
    TR0 = 1;
}

uint8_t hal_range(void)
{
    if (was_high) {
        return HAL_RANGE_NOT_FALLEN;
    }
    if (IE0) {
        TR0 = 0;
        return HAL_RANGE_DONE;
    }
    return pin_echo ? HAL_RANGE_NOT_FALLEN : HAL_RANGE_NOT_RISEN;
}

uint16_t hal_range_raw(void)
{
    return (uint16_t)TH0 << 8 | TL0;
}

bool hal_range_is_busy(void)
{
    return pin_echo;
}
