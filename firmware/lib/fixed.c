/* Products of 16-bit numbers from four 8-bit ones. */
#include "fixed.h"

#ifndef __SDCC_mcs51
/* Elsewhere a compiler may want a copy to call; SDCC, told so, would never inline it again. */
extern inline uint16_t mul_u8(uint8_t a, uint8_t b);
extern inline uint16_t mul_hi_bytes(uint8_t a_high, uint8_t a_low, uint8_t b_high, uint8_t b_low);
#endif

uint16_t mul_hi_u16(uint16_t a, uint16_t b)
{
    return mul_hi_bytes((uint8_t)(a >> 8), (uint8_t)a, (uint8_t)(b >> 8), (uint8_t)b);
}
