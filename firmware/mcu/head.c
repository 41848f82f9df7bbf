/* SPDX-License-Identifier: MIT */
/* A sensor head on the UART: a trigger pulse goes out, frames come in by interrupt. A control step
 * takes longer than a byte on the line, so received bytes wait in a ring. The PWM's interrupt has
 * priority over this one. */
#include "sfr.h"
#include "hal_head.h"

/* The head needs a pulse of 10 us; each turn of the delay takes 2 cycles. */
#define TRIGGER_TURNS ((uint8_t)(CYCLES_PER_S * 12U / 1000000U / 2U + 1U))

static volatile __idata uint8_t ring[HAL_WAITING_MAX];
static volatile uint8_t came; /* bytes received so far; only the interrupt writes it */
static uint8_t taken;         /* bytes taken so far; only the main program writes it */
static volatile __bit is_sent;

void head_interrupt(void) __interrupt(4) __using(2)
{
    if (RI) {
        RI = 0;
        if ((uint8_t)(came - taken) != HAL_WAITING_MAX) {
            ring[came & (HAL_WAITING_MAX - 1U)] = SBUF;
            came++;
        }
    }
    if (TI) {
        TI = 0;
        is_sent = 1;
    }
}

void sensor_init(void)
{
    pin_trigger = 0;
    PT1 = 1;
    ES = 1;
}

void hal_trigger(void)
{
    uint8_t turns = TRIGGER_TURNS;

    pin_trigger = 1;
    do {
    } while (--turns != 0); /* rounds: 7 */
    pin_trigger = 0;
}

uint8_t hal_waiting(void)
{
    return (uint8_t)(came - taken);
}

uint8_t hal_take(void)
{
    uint8_t byte = ring[taken & (HAL_WAITING_MAX - 1U)];

    taken++;
    return byte;
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

void hal_cut_set(bool on)
{
    pin_cut = on;
}

void hal_lane_set(bool on)
{
    pin_lane = !on;
}
