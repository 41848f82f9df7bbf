/* SPDX-License-Identifier: MIT */
/* A dimmer: a light sensor's byte comes in at P1, a lamp's byte goes out at P2. */
#include "lut.h"

__sfr __at(0x90) P1;
__sfr __at(0xA0) P2;

void main(void)
{
    for (;;) {
        P2 = lut_at(P1, 0); /* a table of one input has one column */
    }
}
