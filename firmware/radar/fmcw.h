/* SPDX-License-Identifier: MIT */
/* Range and closing speed from the two beat frequencies of an FMCW radar with a triangular sweep.
 *
 * With the carrier f0 = 77 GHz, the sweep B = 150 MHz from peak to peak, the triangle's period
 * T = 2 ms and c = 299,792,458 m/s:
 *     range    R = c T (f+ + f-) / (8 B)        1,000.69 Hz for each metre
 *     closing  V = c (f- - f+) / (4 f0)         513.7 Hz for each m/s, on each of the two beats
 * f+ is the beat of the up sweep, f- the beat of the down sweep. Both have a sign: f+ is negative
 * when R < 0.513 s * V, that is when a target is near and fast, just where it matters (5 m and
 * 20 m/s: -5,270 Hz). A mixer without I and Q shows |f+| instead; from that one would compute 10.3
 * m and 9.7 m/s.
 *
 * In all functions up_hz is f+ and down_hz is f-, in Hz, as 24-bit numbers with sign. */
#ifndef FUZZY51_FMCW_H
#define FUZZY51_FMCW_H

#include <stdbool.h>
#include <stdint.h>

#define FMCW_BEAT_END_HZ 0x800000L /* the beats are in -FMCW_BEAT_END_HZ..FMCW_BEAT_END_HZ - 1 */
#define FMCW_SUM_END_HZ  0x100000L /* 524 m */
#define FMCW_DIFF_END_HZ 0x20000L  /* 459 km/h */

/*@ predicate fmcw_are_beats(integer up_hz, integer down_hz) =
        -FMCW_BEAT_END_HZ <= up_hz < FMCW_BEAT_END_HZ &&
        -FMCW_BEAT_END_HZ <= down_hz < FMCW_BEAT_END_HZ;
    predicate fmcw_is_possible(integer up_hz, integer down_hz) =
        0 <= up_hz + down_hz < FMCW_SUM_END_HZ &&
        -FMCW_DIFF_END_HZ < down_hz - up_hz < FMCW_DIFF_END_HZ; */

/* Returns whether a target can make this pair: its sum and its difference are in range. The other
 * functions take possible pairs only. */
/*@ requires fmcw_are_beats(up_hz, down_hz);
    assigns \nothing;
    ensures \result <==> fmcw_is_possible(up_hz, down_hz); */
bool fmcw_pair_is_possible(int32_t up_hz, int32_t down_hz);

/* Returns the range in cm, 0..52392: at most 2.3 cm too small, never too large. */
/*@ requires fmcw_are_beats(up_hz, down_hz) && fmcw_is_possible(up_hz, down_hz);
    assigns \nothing;
    ensures \result == ((up_hz + down_hz) / 16 * 52392) / 65536; */
uint16_t fmcw_range_cm(int32_t up_hz, int32_t down_hz);

/* Returns the closing speed in tenths of a km/h, -4593..4593, right to 0.1 km/h; positive when the
 * target comes nearer. */
/*@ requires fmcw_are_beats(up_hz, down_hz) && fmcw_is_possible(up_hz, down_hz);
    assigns \nothing;
    ensures -4593 <= \result <= 4593;
    ensures \result > 0 ==> down_hz > up_hz;
    ensures \result < 0 ==> down_hz < up_hz; */
int16_t fmcw_closing_dkmh(int32_t up_hz, int32_t down_hz);

/* For a front end without sign: returns whether f+ can be negative as well. Then the closing speed
 * would be c (f- + f+) / (4 f0). It is taken for possible up to own_dkmh + 100 (own_dkmh: own
 * speed, tenths of a km/h, 0..2500), because nobody drives towards us faster than walking pace
 * backwards. Such a pair has two meanings and must be refused. Both beats must be 0 or positive. */
/*@ requires fmcw_are_beats(up_hz, down_hz) && fmcw_is_possible(up_hz, down_hz);
    requires up_hz >= 0 && down_hz >= 0 && own_dkmh <= 2500;
    assigns \nothing;
    ensures up_hz >= down_hz || up_hz + down_hz >= FMCW_DIFF_END_HZ ==> !\result; */
bool fmcw_sign_is_open(int32_t up_hz, int32_t down_hz, uint16_t own_dkmh);

#endif
