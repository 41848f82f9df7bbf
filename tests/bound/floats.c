/* SPDX-License-Identifier: MIT */
/* SDCC's floating point. */
#include "input.h"

static void work_add(void)
{
    out.real[0] = in.real[0] + in.real[1];
    out.real[1] = in.real[0] - in.real[1];
}

static void work_multiply(void)
{
    out.real[0] = in.real[0] * in.real[1];
}

static void work_divide(void)
{
    out.real[0] = in.real[0] / in.real[1];
}

static void work_compare(void)
{
    out.u8[0] = in.real[0] < in.real[1];
    out.u8[1] = in.real[0] == in.real[1];
}

static void work_to_integer(void)
{
    out.u8[0] = (unsigned char)in.real[0];
    out.u16[0] = (unsigned int)in.real[0];
    out.s16[0] = (int)in.real[0];
    out.u32[0] = (unsigned long)in.real[0];
    out.s32[0] = (long)in.real[0];
}

static void work_from_integer(void)
{
    out.real[0] = in.u8[0];
    out.real[1] = in.u16[0];
    out.real[2] = in.s16[0];
    out.real[3] = in.u32[0];
    out.real[4] = in.s32[0];
}

void main(void)
{
    for (;;) {
        work_add();
        work_multiply();
        work_divide();
        work_compare();
        work_to_integer();
        work_from_integer();
    }
}
