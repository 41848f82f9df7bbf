/* SPDX-License-Identifier: MIT */
/* A controller that measures nothing and misbehaves in one way, chosen by a macro, to see what
 * drive makes of it. Otherwise: brake released, a trigger pulse every 60 ms. */
#include <8052.h>
#include <stdint.h>

__sfr __at(0xA6) WDTRST;

#define PWM     P1_0
#define STOP    P1_1
#define TRIGGER P1_2

static volatile uint16_t ms10;

void tick(void) __interrupt(1) __using(1)
{
    TH0 = (uint8_t)((65536 - 10000) >> 8);
    TL0 = (uint8_t)(65536 - 10000);
    ms10++;
}

static uint16_t now(void)
{
    uint16_t time;

    ET0 = 0;
    time = ms10;
    ET0 = 1;
    return time;
}

static void feed(void)
{
    WDTRST = 0x1E;
    WDTRST = 0xE1;
}

static void wait_until(uint16_t time)
{
    while ((uint16_t)(now() - time) > 0x8000) {
#ifdef ECHO_BYTES
        if (RI && TI) {
            RI = TI = 0;
            SBUF = SBUF + 1;
        }
#endif
        feed();
    }
}

void main(void)
{
    uint16_t next = 1;
    uint8_t round = 0, i;

    TMOD = 0x01;
    TR0 = 1;
    ET0 = 1;
    EA = 1;
    SCON = 0x52;
    T2CON = 0x34;
    RCAP2H = 0xFF;
    RCAP2L = 0xD9;
#ifdef SILENT
    while (now() != 0xFFFF) {
        feed();
    }
#endif
    wait_until(next);
    PWM = 0;
    STOP = 0;
    TRIGGER = 0;
    for (;;) {
        for (TRIGGER = 1, i = 0; i < 10; i++)
            ;
        TRIGGER = 0;
        round++;
#ifdef HANG
        if (round == 10) {
            for (;;)
                ;
        }
#endif
#ifdef POWER_DOWN
        if (round == 10) {
            PCON |= 2;
        }
#endif
#ifdef HURRY
        if (round == 10) { /* far earlier than ever before */
            next -= 4;
        }
#endif
        next += 6;
        wait_until(next);
    }
}
