/* The safe distance of the radar system, S_F = v (t_r + t_b) + v^2 / (2 j_af) + L - v^2 / (2 j_al):
 * reaction 1.5 s, brake 1.0 s, follower's deceleration j_af 2.5 m/s2, lead's j_al 6.5 m/s2, L 5 m.
 * 59 / 70 / 100 / 200 km/h: 79.0 / 100.1 / 169.4 / 523.8 m. */
#ifndef FUZZY51_SAFE_H
#define FUZZY51_SAFE_H

#include <stdint.h>

#define SAFE_SPEED_MAX_DKMH 2500U

/* S_F in cm, to 2 cm, at most 65535, for an own speed of 0..SAFE_SPEED_MAX_DKMH tenths of km/h. */
uint16_t safe_distance_cm(uint16_t own_dkmh);

#endif
