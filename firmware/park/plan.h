/* SPDX-License-Identifier: MIT */
/* The check before a start: drives the whole way from the present place in thought, and says
 * whether the car will stand within its place. The car has a dead zone: from starts near the place
 * or at its side the two laws do not bring it there, or lead out of the range of the frames.
 *
 * One step of the way is 0.25 m along the circle of the present steering angle, with the laws that
 * steer the real car. The way does not depend on the speed. */
#ifndef FUZZY51_PLAN_H
#define FUZZY51_PLAN_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"
#include "park.h"

/* The car and its place. */
#ifndef PARK_AXLES_MM
#define PARK_AXLES_MM 4000 /* from axle to axle */
#endif
#define PLAN_FRONT_MM 4900 /* from the rear axle to the front end */
#define PLAN_ROOM_MM  460  /* what an end of the car may be off; the place has 500 */

/* The way must keep 0.25 m away from the end of the frames' range. */
#define PLAN_X_MAX_512 (PARK_X_MAX_512 - 128)
#define PLAN_Y_MAX_512 (PARK_Y_MAX_512 - 128)

#define PLAN_STEPS_MAX 352U /* 88 m */

enum plan_result {
    PLAN_GOES_ON,
    PLAN_PARKS,
    PLAN_DEAD_ZONE, /* it ends beside the place, out of range, or nowhere within 88 m */
};

/* Returns the sine of an angle in 65,536ths of a turn, -32767..32767 for -1..1; right to 5. */
/*@ assigns \nothing;
    ensures -32767 <= \result <= 32767; */
int16_t plan_sine_q15(uint16_t angle_turn16);

/* Begins at the place where the car is, which is in `park`. */
/*@ requires park_is_valid;
    assigns \nothing; */
void plan_begin(void);

/* Drives one step. Leaves the place in `park` as it was, but not the distance and the angles. After
 * another result than PLAN_GOES_ON call plan_begin again first. About 5,000 mc. */
/*@ requires park_is_valid;
    assigns park.x, park.y, park.heading, park.dist_mm, park.weight, park.theta_far,
            park.theta_near, park.theta;
    ensures park_is_valid;
    ensures park.x == \old(park.x) && park.y == \old(park.y) &&
            park.heading == \old(park.heading) && park.state == \old(park.state) &&
            park.servo_us == \old(park.servo_us);
    ensures \result == PLAN_GOES_ON || \result == PLAN_PARKS || \result == PLAN_DEAD_ZONE; */
uint8_t plan_step(void);

#endif
