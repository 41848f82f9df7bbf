/* SPDX-License-Identifier: MIT */
/* CORDIC in vectoring mode. */
#include "cordic.h"
#include <stdbool.h>
#include "cc51.h"
#include "fixed.h"

#define HALF_ALONG   (CORDIC_ALONG_MAX / 2)
#define HALF_ACROSS  (CORDIC_ACROSS_MAX / 2)
#define STEPS        13
#define ENLARGED_MAX 4

/* atan(2^-i) in 65,536ths of a turn. */
static const uint16_t
    __code step_angle[STEPS] = {8192, 4836, 2555, 1297, 651, 326, 163, 81, 41, 20, 10, 5, 3};

struct cordic_polar cordic_polar;

void cordic_to_polar(int16_t across, int16_t along)
{
    bool mirrored = across < 0;
    uint16_t x = (uint16_t)along; /* 47,700 at most */
    int16_t y = (int16_t)magnitude_i16(across);
    int16_t angle = 0;
    uint8_t enlarged = 0;
    uint8_t step;

    /* Enlarge a near point first, or its steps would get lost below the last bit. */
    /*@ loop invariant enlarged <= ENLARGED_MAX && 0 <= x <= CORDIC_ALONG_MAX;
        loop invariant 0 <= y <= CORDIC_ACROSS_MAX;
        loop assigns x, y, enlarged;
        loop variant ENLARGED_MAX - enlarged; */
    while (enlarged < ENLARGED_MAX && x < HALF_ALONG && y < HALF_ACROSS) { /* rounds: 4 */
        x = (uint16_t)(x << 1);
        y = (int16_t)(y << 1);
        enlarged++;
    }
    /*@ loop invariant step <= STEPS;
        loop assigns step, x, y, angle;
        loop variant STEPS - step; */
    for (step = 0; step < STEPS; step++) {       /* rounds: 13 */
        uint16_t x_part = (uint16_t)(x >> step); /* rounds: 12 */

        if (y >= 0) {
            x = (uint16_t)(x + (y >> step)); /* rounds: 12 */
            y = (int16_t)(y - x_part);
            angle = (int16_t)(angle + step_angle[step]);
        } else {
            x = (uint16_t)(x + (magnitude_i16(y) >> step)); /* rounds: 12 */
            y = (int16_t)(y + x_part);
            angle = (int16_t)(angle - step_angle[step]);
        }
    }
    cordic_polar.length = (uint16_t)(x >> enlarged); /* rounds: 4 */
    cordic_polar.angle = (int16_t)(mirrored ? 0U - (uint16_t)angle : (uint16_t)angle);
}
