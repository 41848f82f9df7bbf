/* SPDX-License-Identifier: MIT */
/* A car that drives backwards: the kinematics of its rear axle's midpoint,
 *     dX/dt = -v cos psi    dY/dt = -v sin psi    dpsi/dt = -(v / L) tan theta
 * with the heading psi against +x and the steering angle theta. */
#ifndef FUZZY51_TRUCK_H
#define FUZZY51_TRUCK_H

#include <stdbool.h>

struct truck {
    double x_m, y_m, heading_rad;
    double speed_mps, length_m; /* from axle to axle */
    double width_m, overhang_m; /* of its outline: beyond each axle */
};

/* A wall around a lot. */
struct lot {
    double west_m, east_m, south_m, north_m; /* x and y of its walls; INFINITY: none there */
};

/* Drives for DT_S at STEER_RAD, along the circle that this is; to Y = 0 at most. Returns how long
 * it took: less than DT_S when it came there. */
double truck_drive(struct truck *truck, double steer_rad, double dt_s);

/* One Euler step of DT_S at STEER_RAD, as in the study whose grid of starts this is compared with.
 * Returns true when the step comes to Y = 0; then the truck stands there. */
bool truck_step(struct truck *truck, double steer_rad, double dt_s);

/* The angle to the place's direction, -pi..pi. */
double truck_turn_rad(const struct truck *truck);

/* Whether its axle stands well, as in the study: X within 0.4 m, a tenth of the study's length, and
 * 2 degrees. */
bool truck_is_aligned(const struct truck *truck);

/* Whether its whole outline is within a place that is PLACE_M wide, and it stands the right way
 * round. */
bool truck_fits(const struct truck *truck, double place_m);

/* Whether its outline touches a wall. */
bool truck_touches(const struct truck *truck, const struct lot *lot);

#endif
