/* Whether a radar target drives in the own lane, also in a bend, without an arc cosine.
 *
 * The own car is on the centre of its lane, a circle of radius r0; a target at range s and azimuth
 * az (positive towards the bend's centre) is in the lane of width d if, by the law of cosines,
 *     |y - s^2 / (2 r0) + d^2 / (8 r0)| <= d / 2     with y = s sin(az). */
#ifndef FUZZY51_LANE_H
#define FUZZY51_LANE_H

#include <stdbool.h>
#include <stdint.h>

#define LANE_WIDTH_CM           375
#define LANE_RANGE_MAX_CM       30000U
#define LANE_AZIMUTH_MAX_TURN16 8192 /* 45 degrees */

/* sin(angle) * 65536, for an angle of 0..8192 in 65,536ths of a turn; to 5. */
uint16_t lane_sine_q16(uint16_t angle);

/* range_cm any, beyond LANE_RANGE_MAX_CM never the own lane; azimuth in 65,536ths of a turn,
 * -8192..8192; curvature_upm = 1 / r0 in millionths of 1/m, -32767..32767 (radius 30.5 m and more;
 * 0: straight on). Azimuth and curvature are positive to the same side. To 3 cm, where a target
 * that is more than 38 degrees of the bend away is never in the own lane. */
bool lane_is_own(uint16_t range_cm, int16_t azimuth, int16_t curvature_upm);

#endif
