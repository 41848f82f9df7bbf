/* Range and closing speed from the two beat frequencies of an FMCW radar with a triangular sweep.
 *
 * With f0 = 77 GHz, B = 150 MHz from peak to peak, T = 2 ms a triangle and c = 299,792,458 m/s:
 *     range    R = c T (f+ + f-) / (8 B)        1,000.69 Hz a metre
 *     closing  V = c (f- - f+) / (4 f0)         513.7 Hz a metre a second, on each of the two
 * f+ is the beat of the up sweep, f- that of the down sweep. Both are signed: f+ is negative when
 * R < 0.513 s * V, that is close and fast, just where it counts (5 m and 20 m/s: -5,270 Hz). A
 * mixer without I and Q shows |f+| and so 10.3 m and 9.7 m/s. */
#ifndef FUZZY51_FMCW_H
#define FUZZY51_FMCW_H

#include <stdbool.h>
#include <stdint.h>

#define FMCW_SUM_END_HZ  0x100000L /* 524 m */
#define FMCW_DIFF_END_HZ 0x20000L  /* 459 km/h */

/* Whether the pair can be: 0 <= f+ + f- < FMCW_SUM_END_HZ and |f- - f+| < FMCW_DIFF_END_HZ. */
bool fmcw_pair_is_possible(int32_t up_hz, int32_t down_hz);

/* Range, 0..52392 cm, of a pair that is possible; 2.3 cm too small at most, never
 * too large. */
uint16_t fmcw_range_cm(int32_t up_hz, int32_t down_hz);

/* Closing speed in tenths of a km/h, -4593..4593, of a pair that is possible; to 0.1 km/h; positive
 * when approaching. */
int16_t fmcw_closing_dkmh(int32_t up_hz, int32_t down_hz);

/* Whether f+ of a front end without a sign may as well be negative: then the closing speed would be
 * c (f- + f+) / (4 f0), and that is possible if it is at most own_dkmh + 100, as nobody drives
 * towards us faster than backwards at walking pace. Such a pair says two things and must be
 * refused. Only for possible pairs of two non-negative beats. */
bool fmcw_sign_is_open(int32_t up_hz, int32_t down_hz, uint16_t own_dkmh);

#endif
