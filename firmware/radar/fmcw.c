/* SPDX-License-Identifier: MIT */
/* From beat frequencies to range and closing speed, by one 16-bit multiplication each. */
#include "fmcw.h"
#include "fixed.h"

/* c T / (8 B) is 0.0499654 cm/Hz. For a sum in units of 16 Hz it is 52392.5 / 65536. */
#define RANGE_SHIFT 4
#define RANGE_Q16   52392U

/* c / (4 f0) is 0.0350407 tenths of km/h for each Hz. For a difference in units of 2 Hz it is
 * 36743 / 65536 / 8. */
#define SPEED_SHIFT 1
#define SPEED_Q19   36743U

/* The fastest car that drives backwards towards us. */
#define BACKWARDS_DKMH 100U

bool fmcw_pair_is_possible(int32_t up_hz, int32_t down_hz)
{
    int32_t sum_hz = up_hz + down_hz;
    int32_t diff_hz = down_hz - up_hz;

    return sum_hz >= 0 && sum_hz < FMCW_SUM_END_HZ && diff_hz > -FMCW_DIFF_END_HZ &&
           diff_hz < FMCW_DIFF_END_HZ;
}

uint16_t fmcw_range_cm(int32_t up_hz, int32_t down_hz)
{
    uint32_t sum_hz = (uint32_t)(up_hz + down_hz);

    return mul_hi_u16((uint16_t)(sum_hz >> RANGE_SHIFT), RANGE_Q16);
}

/* The closing speed's magnitude. */
/*@ requires diff_hz < FMCW_DIFF_END_HZ;
    assigns \nothing;
    ensures \result == (diff_hz / 2 * SPEED_Q19 / 65536 + 4) / 8;
    ensures \result <= 4593;
    ensures diff_hz == 0 ==> \result == 0; */
static uint16_t dkmh_from_hz(uint32_t diff_hz)
{
    return (uint16_t)((mul_hi_u16((uint16_t)(diff_hz >> SPEED_SHIFT), SPEED_Q19) + 4) >> 3);
}

int16_t fmcw_closing_dkmh(int32_t up_hz, int32_t down_hz)
{
    int32_t diff_hz = down_hz - up_hz;

    if (diff_hz < 0) {
        return (int16_t)-(int16_t)dkmh_from_hz((uint32_t)-diff_hz);
    }
    return (int16_t)dkmh_from_hz((uint32_t)diff_hz);
}

bool fmcw_sign_is_open(int32_t up_hz, int32_t down_hz, uint16_t own_dkmh)
{
    int32_t diff_hz = up_hz + down_hz; /* with -up_hz in place of up_hz */

    if (diff_hz >= FMCW_DIFF_END_HZ || up_hz >= down_hz) {
        return false;
    }
    return dkmh_from_hz((uint32_t)diff_hz) <= (uint16_t)(own_dkmh + BACKWARDS_DKMH);
}
