/* SPDX-License-Identifier: MIT */
/* Tables of a switch: SDCC makes jumps of few cases, and addresses of more. */
#include "input.h"

#define CASE(n, value)                                                                             \
    case n:                                                                                        \
        out.u8[1] = in.u8[(value) & 3] + (value);                                                  \
        break;
#define FOUR(n)   CASE(n, 3 * n) CASE(n + 1, n ^ 5) CASE(n + 2, 7) CASE(n + 3, n)
#define TWENTY(n) FOUR(n) FOUR(n + 4) FOUR(n + 8) FOUR(n + 12) FOUR(n + 16)

static void work_few(void)
{
    switch (in.u8[0] & 127) {
        FOUR(0)
        FOUR(4)
        FOUR(8)
    }
}

static void work_many(void)
{
    switch (in.u8[0] & 127) {
        TWENTY(3)
        TWENTY(23)
    }
}

static void work_most(void)
{
    switch (in.u8[0] & 127) {
        TWENTY(0)
        TWENTY(20)
        TWENTY(40)
        TWENTY(60)
        TWENTY(80)
        TWENTY(100)
    }
}

void main(void)
{
    for (;;) {
        work_few();
        work_many();
        work_most();
    }
}
