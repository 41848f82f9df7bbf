/* SPDX-License-Identifier: MIT */
/* The safe distance: a part that grows with the speed and one that grows with its square. */
#include "safe.h"
#include "fixed.h"

#define STANDING_CM 500U

uint16_t safe_distance_cm(uint16_t own_dkmh)
{
    /* In 2.5 s a tenth of km/h makes 125/18 = 7 - 1/18 cm; 3641 / 65536 is 1/18. */
    uint16_t thinking_cm =
        (uint16_t)((uint16_t)(own_dkmh * 7U) - mul_hi_u16(own_dkmh, 3641U) + STANDING_CM);
    /* The square's factor (1/5 - 1/13) / 12.96 is 1.215575 / 128; 0.215575 is 14128 / 65536. */
    uint16_t square = (uint16_t)(mul_u16(own_dkmh, own_dkmh) >> 7);
    uint16_t braking_cm = (uint16_t)(square + mul_hi_u16(square, 14128U));
    uint32_t sum_cm = (uint32_t)braking_cm + thinking_cm;

    return sum_cm > UINT16_MAX ? UINT16_MAX : (uint16_t)sum_cm;
}
