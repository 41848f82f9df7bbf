/* SPDX-License-Identifier: MIT */
/* Places of -20..20 m and 0.5..30 m, headings all around: first steps of
 * the check, then of a drive. */
#include "frames.h"
#include "park.h"
#include "step.h"

#define XS       15U
#define YS       13U
#define HEADINGS 12U

const uint16_t __code bench_steps = XS * YS * HEADINGS;

static void put(uint8_t at, uint16_t value)
{
    frame_body[at] = (uint8_t)(value >> 8);
    frame_body[(uint8_t)(at + 1)] = (uint8_t)value;
}

void bench_payload(uint16_t n)
{
#ifdef __SDCC_mcs51 /* line.c has the payloads alone */
    if (park.state == PARK_DEAD_ZONE) {
        park_init(); /* a start again */
    }
#endif
    put(0, (uint16_t)(n % XS * 1463U - 10240U));
    n /= XS;
    put(2, (uint16_t)(n % YS * 1259U + 256U));
    n /= YS;
    put(4, n * 5461U);
}
