/* Echo ticks -> distance. */
#include "range.h"
#include "fixed.h"

/* mm for one tick, there and back halved, times 2^18: one product gives quarters of a millimetre. */
#define MM_PER_TICK_2E18 ((SOUND_MMPS * 6ULL * 262144ULL + CLK_HZ / 2U) / CLK_HZ)

#if CLK_HZ * 65535 <= SOUND_MMPS * 6 * 262144
#error CLK_HZ too low for SOUND_MMPS: the factor of range_mm must fit 16 bits
#endif

uint16_t range_mm(uint16_t ticks)
{
    return (uint16_t)((uint16_t)(mul_hi_u16(ticks, (uint16_t)MM_PER_TICK_2E18) + 2U) >> 2);
}

uint8_t range_kind(uint16_t dist_mm)
{
    if (dist_mm < RANGE_MIN_MM) {
        return RANGE_DEAD_ZONE;
    }
    return dist_mm > RANGE_MAX_MM ? RANGE_NO_TARGET : RANGE_ECHO;
}
