/* SPDX-License-Identifier: MIT */
/* The TF-Luna on RXD: its frames come by interrupt, timer 0 tells when one is missing, and what TXD
 * sends goes by the same interrupt. It takes the place of echo.c and uart.c. A control step takes
 * longer than a byte on the line, so bytes wait in a ring. The PWM's interrupt has priority over
 * this one. There are no commands: the line is the sensor's. */
#include "sfr.h"
#include "range.h"

/* Timer 0's high byte counts 256 machine cycles: the 10 ms from one reading to the next, and the
 * 15 ms after which one is missing. */
#define UNITS_PER_CS ((uint8_t)((CYCLES_PER_S / 100U + 128U) / 256U))
#define LATE_UNITS   (UNITS_PER_CS + UNITS_PER_CS / 2U)
#if CLK_HZ > 12000000
#error SENSOR=tfluna takes CLK_HZ of at most 12 MHz: timer 0 must not come round in 25 ms
#endif

static volatile __bit is_sent;

void tfluna_interrupt(void) __interrupt(4)
{
    if (RI) {
        RI = 0;
        if ((uint8_t)(range_came - range_taken) != RANGE_RING_BYTES) {
            RANGE_NEXT = SBUF;
            range_came++;
        }
    }
    if (TI) {
        TI = 0;
        is_sent = 1;
    }
}

static uint8_t late_at; /* a reading is missing when timer 0 comes there */

void sensor_init(void)
{
    pin_trigger = 0;
    TMOD = (TMOD & 0xF0) | T0_M0; /* 16 bits, free running */
    TR0 = 1;
    PT1 = 1;
    ES = 1;
}

void hal_trigger(void)
{
    range_restart();
}

uint8_t hal_range(void)
{
    if (!range_take()) {
        return HAL_RANGE_NOT_RISEN;
    }
    late_at = TH0 + LATE_UNITS;
    return HAL_RANGE_DONE;
}

uint16_t hal_range_raw(void)
{
    return range_raw();
}

bool hal_range_is_busy(void)
{
    return !RXD;
}

bool hal_range_is_late(void)
{
    if ((uint8_t)(TH0 - late_at) >= 128U) { /* it is yet to come */
        return false;
    }
    late_at += UNITS_PER_CS;
    return true;
}

char hal_uart_get(void)
{
    return 0;
}

bool hal_uart_ready(void)
{
    return is_sent;
}

void hal_uart_put(char c)
{
    is_sent = 0;
    SBUF = (uint8_t)c;
}
