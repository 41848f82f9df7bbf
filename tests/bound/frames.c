/* SPDX-License-Identifier: MIT */
/* Frames on the stack: variable arguments, reentrant functions with locals, arrays. */
#include "input.h"

#include <stdarg.h>

static int sum(unsigned char count, ...)
{
    va_list list;
    int total = 0;

    va_start(list, count);
    while (count-- != 0) { /* rounds: 3 */
        total += va_arg(list, int);
    }
    va_end(list);
    return total;
}

static unsigned char mix(unsigned char a, unsigned char b, unsigned char c) __reentrant
{
    unsigned char parts[6], i, all = 0;

    for (i = 0; i < 6; i++) {
        parts[i] = a ^ (b + i);
    }
    for (i = 0; i < 6; i++) {
        all += parts[i] & c;
    }
    return all;
}

static void work_arguments(void)
{
    out.s16[0] = sum(3, in.s16[0], in.s16[1], 17) + sum(1, 4);
}

static void work_reentrant(void)
{
    out.u8[0] = mix(in.u8[0], mix(in.u8[1], 2, 3), in.u8[2]);
}

void main(void)
{
    for (;;) {
        work_arguments();
        work_reentrant();
    }
}
