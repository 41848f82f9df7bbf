/* SPDX-License-Identifier: MIT */
/* The safe distance of the radar system, S_F = v (t_r + t_b) + v^2 / (2 j_af) + L - v^2 / (2 j_al),
 * with the driver's reaction t_r = 1.5 s, the brake's delay t_b = 1.0 s, the own deceleration
 * j_af = 2.5 m/s2, that of the car ahead j_al = 6.5 m/s2, and L = 5 m. For own speeds v of 59, 70,
 * 100 and 200 km/h it is 79.0, 100.1, 169.4 and 523.8 m. */
#ifndef FUZZY51_SAFE_H
#define FUZZY51_SAFE_H

#include <stdint.h>

#define SAFE_SPEED_MAX_DKMH 2500U

/* Returns S_F in cm, right to 2.1 cm, limited to 65535. own_dkmh is the own speed in tenths of a
 * km/h, 0..SAFE_SPEED_MAX_DKMH. */
/*@ requires own_dkmh <= SAFE_SPEED_MAX_DKMH;
    assigns \nothing;
    ensures \result >= 500; */
uint16_t safe_distance_cm(uint16_t own_dkmh);

#endif
