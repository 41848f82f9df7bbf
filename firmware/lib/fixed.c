/* SPDX-License-Identifier: MIT */
/* Products of 16-bit numbers, made of products of bytes. */
#include "fixed.h"

#ifndef __SDCC_mcs51
/* Other compilers may need a copy of an inline function that can be called. SDCC must not see these
 * lines: with them it would call the copy and no longer inline it. */
extern inline uint16_t mul_u8(uint8_t a, uint8_t b);
extern inline uint16_t magnitude_i16(int16_t value);
extern inline uint16_t mul_hi_bytes(uint8_t a_high, uint8_t a_low, uint8_t b_high, uint8_t b_low);
#endif

uint16_t mul_hi_u16(uint16_t a, uint16_t b)
{
    /*@ assert a == (uint8_t)(a >> 8) * 256 + (uint8_t)a; */
    /*@ assert b == (uint8_t)(b >> 8) * 256 + (uint8_t)b; */
    return mul_hi_bytes((uint8_t)(a >> 8), (uint8_t)a, (uint8_t)(b >> 8), (uint8_t)b);
}
