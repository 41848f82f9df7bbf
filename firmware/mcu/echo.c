/* SPDX-License-Identifier: MIT */
/* Timer 0 measures the echo in machine cycles. The echo pin (INT0) gates the timer, and the end of
 * the echo sets the flag IE0, without an interrupt. So the count is exact to one cycle whatever the
 * program does meanwhile. */
#include "sfr.h"

/* The sensor needs a pulse of 10 us; each turn of the delay takes 2 cycles. */
#define TRIGGER_TURNS ((uint8_t)(CYCLES_PER_S * 12U / 1000000U / 2U + 1U))

/* What timer 0 counts in its high byte; so many in a tick, which timer 1 makes. */
#define UNIT_MC        256U
#define UNITS_PER_TICK (CYCLES_PER_S / (1000U / HAL_TICK_MS) / UNIT_MC)

/* The ticks that begin between the trigger and the poll that sees the end of the echo, less the
 * echo as timer 0 has counted it. The trigger comes up to 5 ms after the begin of a tick, the
 * sensor's answer up to 5 ms after the trigger, the poll up to 4 ms after the echo: so this is -10
 * to 14 ms. */
#define LESS_UNITS (UNITS_PER_TICK * 12U / 10U)
#define MORE_UNITS (UNITS_PER_TICK * 20U / 10U)

static uint8_t triggered_at; /* as hal_ticks counts */

/* The echo of the last measurement had not ended at the trigger, or this one is implausible. */
static __bit is_wrong;

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
    is_wrong = pin_echo;
    triggered_at = hal_ticks();
    IE0 = 0;
    TR0 = 1;
}

uint8_t hal_range(void)
{
    if (is_wrong) {
        return HAL_RANGE_NOT_FALLEN;
    }
    if (IE0) {
        uint8_t more_units = (uint8_t)(hal_ticks() - triggered_at);

        TR0 = 0;
        more_units *= (uint8_t)UNITS_PER_TICK; /* modulo 256, as timer 0 counts */
        more_units -= TH0;
        if ((uint8_t)(more_units + LESS_UNITS) > LESS_UNITS + MORE_UNITS) {
            is_wrong = 1;
            return HAL_RANGE_NOT_FALLEN;
        }
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
