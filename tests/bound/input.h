/* SPDX-License-Identifier: MIT */
/* What tests/tools/test_bound_runs.c fills before each call of a function work_... */
#ifndef FUZZY51_BOUND_INPUT_H
#define FUZZY51_BOUND_INPUT_H

struct input {
    unsigned char u8[4];
    unsigned int u16[2];
    int s16[2];
    unsigned long u32[2];
    long s32[2];
    float real[5]; /* in: two of them */
};
static volatile __xdata __at(0) struct input in;
static volatile __xdata __at(64) struct input out;

#endif
