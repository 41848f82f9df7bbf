/* SPDX-License-Identifier: MIT */
/* Whether a radar target drives in the own lane, also in a bend, without an arc cosine.
 *
 * The own car drives on the centre of its lane, a circle of radius r0. A target at range s and
 * azimuth az (positive towards the centre of the bend) is in the lane of width d if, by the law of
 * cosines,
 *     |y - s^2 / (2 r0) + d^2 / (8 r0)| <= d / 2     with y = s sin(az).
 * The unit of an angle whose name ends in turn16 is 1/65,536 of a turn. */
#ifndef FUZZY51_LANE_H
#define FUZZY51_LANE_H

#include <stdbool.h>
#include <stdint.h>

#define LANE_WIDTH_CM           375
#define LANE_RANGE_MAX_CM       30000U
#define LANE_AZIMUTH_MAX_TURN16 8192 /* 45 degrees */

/* Returns sin(angle) * 65536, right to 5, for an angle of 0..LANE_AZIMUTH_MAX_TURN16. */
/*@ requires angle_turn16 <= LANE_AZIMUTH_MAX_TURN16;
    assigns \nothing;
    ensures \result <= 46341; */
uint16_t lane_sine_q16(uint16_t angle_turn16);

/* Returns whether the target is in the own lane.
 *     range_cm        any; beyond LANE_RANGE_MAX_CM the answer is false
 *     azimuth_turn16  -LANE_AZIMUTH_MAX_TURN16..LANE_AZIMUTH_MAX_TURN16
 *     curvature_upm   1 / r0 in millionths of 1/m, -32767..32767: radius 30.5 m or more;
 *                     0: straight
 * Azimuth and curvature are positive to the same side. Right to 3 cm; but a target more than 38
 * degrees of the bend away is never in the own lane. */
/*@ requires -LANE_AZIMUTH_MAX_TURN16 <= azimuth_turn16 <= LANE_AZIMUTH_MAX_TURN16;
    requires curvature_upm > -32768;
    assigns \nothing;
    ensures range_cm > LANE_RANGE_MAX_CM ==> !\result; */
bool lane_is_own(uint16_t range_cm, int16_t azimuth_turn16, int16_t curvature_upm);

#endif
