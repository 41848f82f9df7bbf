/* SPDX-License-Identifier: MIT */
/* The canary: does with each timer what the firmware does with it. Timer 0 measures a pulse on
 * P3.2, timer 1 interrupts every 5,000 machine cycles and toggles P1.0, timer 2 is the baud rate of
 * the line that prints the pulse's length. Built by SDCC, run by `drive canary`. */
#include <8052.h>
#include <stdint.h>
#include "phase.h"

#define TICK_MC     5000U
#define BAUD_RELOAD (65536UL - 39U) /* 9,615 Bd at 12 MHz */

static uint16_t reload;

void tick(void) __interrupt(3)
{
    P1_0 = !P1_0;
    PHASE_ADVANCE("1", "_reload", "(_reload + 1)");
}

static void put(char c)
{
    SBUF = c;
    while (!TI)
        ;
    TI = 0;
}

static void put_decimal(uint16_t number)
{
    uint16_t unit = 10000;

    for (; unit > 0; unit /= 10) {
        put('0' + (char)(number / unit % 10));
    }
    put('\n');
}

void main(void)
{
    reload = PHASE_RELOAD(TICK_MC);
    TL1 = (uint8_t)PHASE_RELOAD(TICK_MC);
    TH1 = (uint8_t)(PHASE_RELOAD(TICK_MC) >> 8);
    TMOD = 0x19; /* timer 1: 16 bits; timer 0: 16 bits, runs while P3.2 is high */
    RCAP2L = (uint8_t)BAUD_RELOAD;
    RCAP2H = (uint8_t)(BAUD_RELOAD >> 8);
    T2CON = 0x34; /* the baud rate, both directions */
    SCON = 0x40;
    TR1 = 1;
    ET1 = 1;
    EA = 1;
    for (;;) {
        TR0 = 0;
        TH0 = TL0 = 0;
        TR0 = 1;
        while (!P3_2)
            ;
        while (P3_2)
            ;
        put_decimal((uint16_t)TH0 << 8 | TL0);
    }
}
