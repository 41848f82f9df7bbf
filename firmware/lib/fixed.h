/* Products that the 8051 makes with its own `mul ab`. A plain `a * b` of wider types calls SDCC's
 * __mulint or __mullong (up to 143 mc, and not safe in an interrupt), and its int has 16 bits. */
#ifndef FUZZY51_FIXED_H
#define FUZZY51_FIXED_H

#include <stdint.h>

/* a * b, every bit of it. 4 mc and the moves; always inline. */
inline uint16_t mul_u8(uint8_t a, uint8_t b)
{
    /* SDCC takes the product of two bytes that lands in 16 unsigned bits as one `mul ab`. */
    return (uint16_t)(a * b);
}

/* (a * b) >> 16, from the bytes of a and b: the part of a that b / 65536 says, rounded down. Four
 * `mul ab`, about 50 mc, whatever the values; always inline. */
inline uint16_t mul_hi_bytes(uint8_t a_high, uint8_t a_low, uint8_t b_high, uint8_t b_low)
{
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

/* The same as a call, 72 mc with return. Not for an interrupt that main's code shares it with. */
uint16_t mul_hi_u16(uint16_t a, uint16_t b);

/* a * b, every bit of it. About 120 mc; not for an interrupt that main's code shares it with. */
uint32_t mul_u16(uint16_t a, uint16_t b);

#endif
