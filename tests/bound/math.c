/* SPDX-License-Identifier: MIT */
/* SDCC's math.h. */
#include "input.h"

#include <math.h>

static void work_root(void)
{
    out.real[0] = sqrtf(in.real[0]);
}

static void work_exponential(void)
{
    out.real[0] = expf(in.real[0]);
}

static void work_logarithm(void)
{
    out.real[0] = logf(in.real[0]);
}

static void work_sine(void)
{
    out.real[0] = sinf(in.real[0]);
}

static void work_arc(void)
{
    out.real[0] = atan2f(in.real[0], in.real[1]);
}

void main(void)
{
    for (;;) {
        work_root();
        work_exponential();
        work_logarithm();
        work_sine();
        work_arc();
    }
}
