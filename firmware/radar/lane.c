/* SPDX-License-Identifier: MIT */
/* The lane gate: a table of sines and four 16-bit multiplications. */
#include "lane.h"
#include "cc51.h"
#include "fixed.h"

/* sin(i * 360 / 256 degrees) * 65536, i = 0..32: to 45 degrees. */
#define SINES 33
static const uint16_t __code sine_q16[SINES] = {
    0,     1608,  3216,  4821,  6424,  8022,  9616,  11204, 12785, 14359, 15924,
    17479, 19024, 20557, 22078, 23586, 25080, 26558, 28020, 29466, 30893, 32303,
    33692, 35062, 36410, 37736, 39040, 40320, 41576, 42806, 44011, 45190, 46341,
};

uint16_t lane_sine_q16(uint16_t angle_turn16)
{
    uint8_t at = (uint8_t)(angle_turn16 >> 8);
    uint16_t sine;

    if (at >= SINES - 1) {
        return sine_q16[SINES - 1];
    }
    sine = sine_q16[at];
    return sine + mul_hi_u16((uint16_t)(sine_q16[(uint8_t)(at + 1)] - sine),
                             (uint16_t)((uint16_t)angle_turn16 << 8));
}

bool lane_is_own(uint16_t range_cm, int16_t azimuth_turn16, int16_t curvature_upm)
{
    uint16_t curvature = magnitude_i16(curvature_upm);
    uint32_t arc;
    int16_t offset_cm;

    if (range_cm > LANE_RANGE_MAX_CM) {
        return false;
    }
    /* range_cm * curvature is s / r0 in 1e-8 radians. Divided by 2^10 it fits 16 bits up to 0.67
     * radians, which is 38 degrees. */
    arc = mul_u16(range_cm, curvature) >> 10;
    if (arc > UINT16_MAX) {
        return false;
    }

    offset_cm = (int16_t)mul_hi_u16(range_cm, lane_sine_q16(magnitude_i16(azimuth_turn16)));
    if ((azimuth_turn16 < 0) != (curvature_upm < 0)) {
        offset_cm = (int16_t)-offset_cm;
    }
    /* s^2 / (2 r0): the factor is 1e-8 * 2^10 = 0.67109 / 65536, and 0.67109 is 43980.5 / 65536. */
    offset_cm -= (int16_t)(mul_hi_u16(range_cm, mul_hi_u16((uint16_t)arc, 43980U)) >> 1);
    /* d^2 / (8 r0): d^2 / 8 is 17578 cm2, and 17578 * 1e-8 is 11.5 / 65536. In the tightest bend it
     * is 6 cm. */
    offset_cm += (int16_t)mul_hi_u16(curvature, 12U);
    return (uint16_t)(offset_cm + LANE_WIDTH_CM / 2) <= LANE_WIDTH_CM / 2 * 2U;
}
