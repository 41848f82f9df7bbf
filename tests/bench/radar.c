/* SPDX-License-Identifier: MIT */
/* One target in ranges of 0..105 m, closing speeds of -10..70 km/h, own speeds, straight and in a
 * bend. */
#include "frames.h"
#include "step.h"

#define RANGES 15U
#define SPEEDS 17U
#define OWNS   6U

const uint16_t __code bench_steps = RANGES * SPEEDS * OWNS;

static void put(uint8_t at, uint16_t value)
{
    frame_body[at] = (uint8_t)(value >> 8);
    frame_body[(uint8_t)(at + 1)] = (uint8_t)value;
}

static void put_hz(uint8_t at, int32_t hz)
{
    frame_body[at] = (uint8_t)((uint32_t)hz >> 16);
    put((uint8_t)(at + 1), (uint16_t)hz);
}

void bench_payload(uint16_t n)
{
    int32_t range_hz = (int32_t)(n % RANGES) * 7505L + 1500;
    int32_t speed_hz;

    n /= RANGES;
    speed_hz = ((int32_t)(n % SPEEDS) - 2) * 713L;
    if (speed_hz < 0 && range_hz + speed_hz < 0) {
        speed_hz = 0;
    }
    put_hz(5, range_hz - speed_hz);
    put_hz(8, range_hz + speed_hz);
    n /= SPEEDS;
    put(11, n & 1 ? 519 : 0); /* azimuth: 2.85 degrees */
    put(0, n * 499U);
    put(2, n & 1 ? 1993 : 0);
    frame_body[4] = 0x11; /* one target; signed */
}
