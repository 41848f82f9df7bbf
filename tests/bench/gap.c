/* SPDX-License-Identifier: MIT */
/* Gaps of 0..120 m, own speeds of 0..40 m/s, a lead that stands, drives or brakes. */
#include "frames.h"
#include "step.h"

#define GAPS   13U
#define SPEEDS 17U

const uint16_t __code bench_steps = GAPS * SPEEDS * SPEEDS;

static void put(uint8_t at, uint16_t value)
{
    frame_body[at] = (uint8_t)(value >> 8);
    frame_body[(uint8_t)(at + 1)] = (uint8_t)value;
}

void bench_payload(uint16_t n)
{
    put(0, n % GAPS * 1000U);
    n /= GAPS;
    put(2, n % SPEEDS * 249U);
    n /= SPEEDS;
    put(4, n * 249U);
    put(6, n & 1 ? 0xFDA8 /* -6 m/s2 */ : 0);
    frame_body[8] = 225; /* the highest set speed */
}
