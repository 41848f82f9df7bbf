/* SPDX-License-Identifier: MIT */
/* The polar form of a point, by CORDIC: 13 steps of shifts and sums turn it onto the axis. */
#ifndef FUZZY51_CORDIC_H
#define FUZZY51_CORDIC_H

#include <stdint.h>

/* Coordinates are in any unit; the length has the same. */
#define CORDIC_ACROSS_MAX 20480
#define CORDIC_ALONG_MAX  20480

/* The steps make the length longer by this factor, the product of sqrt(1 + 4^-i) for i = 0..12. */
#define CORDIC_GAIN 1.646760

struct cordic_polar {
    uint16_t length; /* CORDIC_GAIN * sqrt(across^2 + along^2) */
    int16_t angle;   /* atan2(across, along) in 65,536ths of a turn */
};

/* The result of the last cordic_to_polar(). */
extern struct cordic_polar cordic_polar;

/* Sets cordic_polar for the point `along` the axis (0..CORDIC_ALONG_MAX) and `across` it
 * (-CORDIC_ACROSS_MAX..CORDIC_ACROSS_MAX). The angle is 0 along the axis and positive towards
 * positive `across`. The mirror image of a point has exactly the opposite angle. The length is
 * right to 9 units. The angle is right to 10 units (0.055 degrees) if the point is at least 300
 * units from the origin; nearer than that it is any angle up to the sum of all steps, 18180. About
 * 2,600 mc. */
/*@ requires -CORDIC_ACROSS_MAX <= across <= CORDIC_ACROSS_MAX;
    requires 0 <= along <= CORDIC_ALONG_MAX;
    assigns cordic_polar;
    ensures tried: cordic_polar.length <= 47700;
    ensures tried: -18180 <= cordic_polar.angle <= 18180; */
void cordic_to_polar(int16_t across, int16_t along);

#endif
