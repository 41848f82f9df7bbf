/* SPDX-License-Identifier: MIT */
/* Products made by the 8051's own `mul ab`. A plain `a * b` of wider types calls SDCC's __mulint or
 * __mullong, which take up to 143 mc and are not safe in an interrupt. */
#ifndef FUZZY51_FIXED_H
#define FUZZY51_FIXED_H

#include <stdint.h>

/* The whole product of two bytes. 4 mc and the moves; always inline.
 *
 * On the chip an int has 16 bits. There `a * b` of two bytes is a signed product, and 255 * 255 is
 * more than an int can hold: C does not define it. SDCC makes one `mul ab` of it and keeps all 16
 * bits, and of no other way to write it; the unit test tries all 65,536 pairs on the chip. For
 * every other compiler the product is unsigned. */
/*@ assigns \nothing;
    ensures \result == a * b;
    ensures \result <= 65025; */
inline uint16_t mul_u8(uint8_t a, uint8_t b)
{
#ifdef __SDCC_mcs51
    return (uint16_t)(a * b);
#else
    return (uint16_t)((uint32_t)a * b);
#endif
}

/* Without its sign: 0..32768. Always inline. */
/*@ assigns \nothing;
    ensures \result == \abs(value); */
inline uint16_t magnitude_i16(int16_t value)
{
    return value < 0 ? (uint16_t)(0U - (uint16_t)value) : (uint16_t)value;
}

/* The upper half of the product of two 16-bit numbers a and b, given by their bytes: a * b / 65536,
 * rounded down. So b is a fraction of 65536, and the result is that fraction of a. Four `mul ab`;
 * about 50 mc for all values; always inline. */
/*@ assigns \nothing;
    ensures \result == ((a_high * 256 + a_low) * (b_high * 256 + b_low)) / 65536; */
inline uint16_t mul_hi_bytes(uint8_t a_high, uint8_t a_low, uint8_t b_high, uint8_t b_low)
{
    uint16_t sum, result;

    /* No sum here can overflow: 255 * 255 + 255 + 255 is 65535. */
    sum = mul_u8(a_low, b_low);
    sum >>= 8;
    sum += mul_u8(a_high, b_low);
    result = (uint8_t)(sum >> 8);
    sum = (uint8_t)sum;
    /*@ assert result * 256 + sum == (a_low * b_low) / 256 + a_high * b_low; */
    sum += mul_u8(a_low, b_high);
    result += (uint8_t)(sum >> 8);
    /*@ assert result == ((a_low * b_low) / 256 + a_high * b_low + a_low * b_high) / 256; */
    /*@ assert result == (a_low * b_low + 256 * (a_high * b_low + a_low * b_high)) / 65536; */
    result += mul_u8(a_high, b_high);
    /*@ assert (a_high * 256 + a_low) * (b_high * 256 + b_low) ==
            a_low * b_low + 256 * (a_high * b_low + a_low * b_high) + 65536 * (a_high * b_high); */
    return result;
}

/* a * b / 65536, rounded down, as a function: 72 mc with call and return. An interrupt must not
 * call it, because SDCC keeps its arguments at fixed addresses. */
/*@ assigns \nothing;
    ensures \result == (a * b) / 65536;
    ensures \result <= a && \result <= b; */
uint16_t mul_hi_u16(uint16_t a, uint16_t b);

/* The whole product of two 16-bit numbers. About 120 mc; an interrupt must not call it. */
/*@ assigns \nothing;
    ensures tried: \result == a * b; */
uint32_t mul_u16(uint16_t a, uint16_t b);

#endif
