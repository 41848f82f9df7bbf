/* SPDX-License-Identifier: MIT */
/* The brake controller with another duty: it goes through 0..100 percent by ones and then in a
 * mixed order, and changes at any time of a period, never before the last one has lasted for two of
 * them. For the test of the PWM; UART, echo and control go on as they do. */
#include "hal.h"

#define PERCENTS    101U
#define MIXED_STEP  37U /* 101 is a prime number, so that all come by */
#define LEAST_TICKS 3U

volatile uint8_t duty_pct = 100; /* as hal_brake_set has just been told */
static uint8_t changes, since, rounds, noise = 1;

static void brake_set_not(uint8_t brake_pct)
{
    (void)brake_pct;
}

static void change(void)
{
    uint8_t pct = duty_pct + (changes < PERCENTS ? 1U : MIXED_STEP);

    if (pct >= PERCENTS) {
        pct -= PERCENTS;
    }
    hal_brake_set(pct);
    duty_pct = pct;
    if (changes != 255U) {
        changes++;
    }
    since = hal_ticks();
    /* Galois' shift register of 8 bits: up to 64 rounds more, which are more than a period. */
    noise = noise & 1 ? noise >> 1 ^ 0xB8 : noise >> 1;
    rounds = (noise & 63U) + 1U;
}

/* Comes by in every round of the main loop. */
static bool uart_ready(void)
{
    if ((uint8_t)(hal_ticks() - since) >= LEAST_TICKS && --rounds == 0) {
        change();
    }
    return hal_uart_ready();
}

#define hal_brake_set  brake_set_not
#define hal_uart_ready uart_ready
#include "../../firmware/brake/main.c"
