/* SPDX-License-Identifier: MIT */
/* Each cell of the table, and each threshold between cells. */
#include "frames.h"
#include "step.h"

#define GAPS     41U
#define CLOSINGS 9U

const uint16_t __code bench_steps = GAPS * CLOSINGS * 2U;

static void put(uint8_t at, uint16_t value)
{
    frame_body[at] = (uint8_t)(value >> 8);
    frame_body[(uint8_t)(at + 1)] = (uint8_t)value;
}

void bench_payload(uint16_t n)
{
    frame_body[6] = (uint8_t)(n & 1);
    n >>= 1;
    put(0, n % GAPS * 250U + (n % GAPS == 3U ? 200U : 0)); /* 950 mm is a threshold, too */
    n /= GAPS;
    put(2, n * 500U > 2000U ? n * 500U - 2000U : 0);
    put(4, n * 500U > 2000U ? 0 : 2000U - n * 500U);
    put(7, 1000);
}
