/* SPDX-License-Identifier: MIT */
/* Echo ticks -> distance. */
#include "range.h"
#include "fixed.h"

#ifndef __SDCC_mcs51
extern inline uint8_t range_kind(uint16_t dist_mm);
#endif

/* mm for one tick, there and back halved, times 2^16. */
#define MM_PER_TICK_2E16 ((SOUND_MMPS * 6ULL * 65536ULL + CLK_HZ / 2U) / CLK_HZ)

#if CLK_HZ * 65535 <= SOUND_MMPS * 6 * 65536
#error CLK_HZ too low for SOUND_MMPS: the factor of range_mm must fit 16 bits
#endif

/* mul_hi_u16 with a factor that the compiler knows, and rounded. */
/*@ ensures \result == (ticks * MM_PER_TICK_2E16 + 32768) / 65536; */
uint16_t range_mm(uint16_t ticks)
{
    uint16_t sum = mul_u8((uint8_t)ticks, (uint8_t)MM_PER_TICK_2E16), mm;

    sum >>= 8;
    sum += 128U;
    sum += mul_u8((uint8_t)(ticks >> 8), (uint8_t)MM_PER_TICK_2E16);
    mm = (uint8_t)(sum >> 8);
    sum = (uint8_t)sum;
    /*@ assert mm * 256 + sum == (uint8_t)ticks * (uint8_t)MM_PER_TICK_2E16 / 256 + 128 +
            (uint8_t)(ticks >> 8) * (uint8_t)MM_PER_TICK_2E16; */
    sum += mul_u8((uint8_t)ticks, (uint8_t)(MM_PER_TICK_2E16 >> 8));
    mm += (uint8_t)(sum >> 8);
    /*@ assert ticks == (uint8_t)(ticks >> 8) * 256 + (uint8_t)ticks; */
    mm += mul_u8((uint8_t)(ticks >> 8), (uint8_t)(MM_PER_TICK_2E16 >> 8));
    return mm;
}
