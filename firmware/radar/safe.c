/* The safe distance: a line and a square, by reciprocals. */
#include "safe.h"
#include "fixed.h"

#define STANDING_CM 500U

uint16_t safe_distance_cm(uint16_t own_dkmh)
{
    /* 2.5 s in cm for each tenth of km/h is 125/18 = 7 - 1/18; 3641 / 65536 is 1/18. */
    uint16_t thinking_cm =
        (uint16_t)((uint16_t)(own_dkmh * 7U) - mul_hi_u16(own_dkmh, 3641U) + STANDING_CM);
    /* (1/5 - 1/13) / 12.96 cm for each square is 1.215575 / 128, and 0.215575 is 14128 / 65536. */
    uint16_t square = (uint16_t)(mul_u16(own_dkmh, own_dkmh) >> 7);
    uint16_t braking_cm = (uint16_t)(square + mul_hi_u16(square, 14128U));
    uint32_t sum_cm = (uint32_t)braking_cm + thinking_cm;

    return sum_cm > UINT16_MAX ? UINT16_MAX : (uint16_t)sum_cm;
}
