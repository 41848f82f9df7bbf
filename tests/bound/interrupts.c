/* SPDX-License-Identifier: MIT */
/* Two timers, one of the high level, and what they call; the work counts with a byte of theirs. */
#include "input.h"

#include <8052.h>

static volatile unsigned char ticks, beats;
static volatile unsigned int product;

static void beat(void) __reentrant
{
    beats++;
}

void slow(void) __interrupt(1)
{
    ticks++;
    product = (unsigned int)ticks * beats;
}

void quick(void) __interrupt(3) __using(1)
{
    beat();
}

static void wait(void)
{
    unsigned char i;

    for (i = 0; i < 30; i++) {
        out.u8[0] = i;
    }
}

void main(void)
{
    TMOD = 0x22;
    TH0 = 100;
    TH1 = 171;
    PT1 = 1;
    TR0 = TR1 = 1;
    IE = 0x8A;
    for (;;) {
        wait();
        out.u16[0] = product / in.u16[0];
    }
}
