/* SPDX-License-Identifier: MIT */
/* SDCC's integer arithmetic that is no single instruction. */
#include "input.h"

#include <stdlib.h>

static char text[20];

static void work_divide(void)
{
    out.u8[0] = in.u8[0] / in.u8[1];
    out.u8[1] = in.u8[0] % in.u8[1];
    out.u16[0] = in.u16[0] / in.u16[1];
    out.u16[1] = in.u16[0] % in.u16[1];
    out.s16[0] = in.s16[0] / in.s16[1];
    out.s16[1] = in.s16[0] % in.s16[1];
}

static void work_divide_long(void)
{
    out.u32[0] = in.u32[0] / in.u32[1];
    out.s32[0] = in.s32[0] / in.s32[1];
}

static void work_modulo_long(void)
{
    out.u32[1] = in.u32[0] % in.u32[1];
    out.s32[1] = in.s32[0] % in.s32[1];
}

static void work_multiply(void)
{
    out.u16[0] = in.u16[0] * in.u16[1];
    out.u32[0] = in.u32[0] * in.u32[1];
    out.s32[0] = in.s32[0] * in.s32[1];
}

static void work_digits(void)
{
    __itoa(in.s16[0], text, 10);
    __ultoa(in.u32[0], text, 16);
}

static void work_random(void)
{
    out.s16[0] = rand();
}

void main(void)
{
    for (;;) {
        work_divide();
        work_divide_long();
        work_modulo_long();
        work_multiply();
        work_digits();
        work_random();
    }
}
