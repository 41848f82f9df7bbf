/* SPDX-License-Identifier: MIT */
/* Loops that count with constants, in all the forms that SDCC gives them. The functions
 * work_exact_... have one path, which takes what bound says. */
#include "input.h"

static unsigned char __xdata bytes[40];

static void work_exact_up(void)
{
    unsigned char i;

    for (i = 0; i < 40; i++) {
        bytes[i] = i;
    }
}

static void work_exact_down(void)
{
    unsigned char i;

    for (i = 200; i != 0; i--) {
        out.u8[0] = i;
    }
}

static void work_exact_signed(void)
{
    signed char i;

    for (i = -5; i < 60; i += 3) {
        out.u8[0] = (unsigned char)i;
    }
}

static void work_words(void)
{
    unsigned int i;

    for (i = 0; i < 1000; i++) {
        out.u16[0] = i;
    }
}

static void work_exact_nested(void)
{
    unsigned char i, k;

    for (i = 0; i < 7; i++) {
        for (k = 9; k != 0; k--) {
            out.u8[1] = i;
        }
    }
}

static void work_left_early(void)
{
    int i;

    for (i = 0; i < 40; i++) {
        if (bytes[i] == in.u8[0]) {
            out.s16[0] = i;
            break;
        }
    }
}

static unsigned char twice(unsigned char n)
{
    return (unsigned char)(n + n);
}

static void work_calls(void)
{
    unsigned char i;

    for (i = 0; i < 25; i++) {
        bytes[i] = twice(in.u8[1]) / in.u8[2];
    }
}

void main(void)
{
    for (;;) {
        work_exact_up();
        work_exact_down();
        work_exact_signed();
        work_words();
        work_exact_nested();
        work_left_early();
        work_calls();
    }
}
