/* The polar form of a point, by CORDIC: turned onto the axis in 13 steps of shifts and sums. */
#ifndef FUZZY51_CORDIC_H
#define FUZZY51_CORDIC_H

#include <stdint.h>

#define CORDIC_ACROSS_MAX 20480
#define CORDIC_ALONG_MAX  20480

/* The length comes out longer by the product of sqrt(1 + 4^-i), i = 0..12. */
#define CORDIC_GAIN 1.646760

struct cordic_polar {
    uint16_t length; /* CORDIC_GAIN * sqrt(across^2 + along^2) */
    int16_t angle;   /* atan2(across, along) in 65,536ths of a turn, -16384..16384 */
};

/* The result of the last cordic_to_polar(). */
extern struct cordic_polar cordic_polar;

/* The polar form of the point `along` the axis (0..CORDIC_ALONG_MAX) and `across` it
 * (-CORDIC_ACROSS_MAX..CORDIC_ACROSS_MAX). The angle is 0 along the axis, positive towards positive
 * `across`, the mirror image's is exactly the opposite, and the origin's is any. The length is
 * right to 9; the angle to 9 (0.05 degrees) from 300 units off the origin on.
 * About 2,600 mc. */
void cordic_to_polar(int16_t across, int16_t along);

#endif
