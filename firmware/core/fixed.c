/* Products of 16-bit numbers from four 8-bit ones. */
#include "fixed.h"

#ifndef __SDCC_mcs51
/* Elsewhere a compiler may want a copy to call; SDCC, told so, would never inline it again. */
extern inline uint16_t mul_u8(uint8_t a, uint8_t b);
#endif

uint16_t mul_hi_u16(uint16_t a, uint16_t b)
{
    uint8_t a_high = (uint8_t)(a >> 8), a_low = (uint8_t)a;
    uint8_t b_high = (uint8_t)(b >> 8), b_low = (uint8_t)b;
    uint16_t sum, result;

    /* No sum here can overflow: 255 * 255 + 255 + 255 is 65535. */
    sum = mul_u8(a_low, b_low);
    sum >>= 8;
    sum += mul_u8(a_high, b_low);
    result = (uint8_t)(sum >> 8);
    sum = (uint8_t)sum;
    sum += mul_u8(a_low, b_high);
    result += (uint8_t)(sum >> 8);
    result += mul_u8(a_high, b_high);
    return result;
}

uint32_t mul_u16(uint16_t a, uint16_t b)
{
    uint16_t low = mul_u8((uint8_t)a, (uint8_t)b);
    uint8_t cross =
        (uint8_t)(mul_u8((uint8_t)(a >> 8), (uint8_t)b) + mul_u8((uint8_t)a, (uint8_t)(b >> 8)));

    /* The upper half carries every carry; of the lower half's upper byte only its own bits matter.
     */
    low = (uint16_t)(low + (uint16_t)(cross << 8));
    return (uint32_t)mul_hi_u16(a, b) << 16 | low;
}
