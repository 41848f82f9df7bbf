/* SPDX-License-Identifier: MIT */
/* The whole product of two 16-bit numbers. Apart from fixed.c because not every image has room. */
#include "fixed.h"

uint32_t mul_u16(uint16_t a, uint16_t b)
{
    uint16_t low = mul_u8((uint8_t)a, (uint8_t)b);
    uint8_t cross =
        (uint8_t)(mul_u8((uint8_t)(a >> 8), (uint8_t)b) + mul_u8((uint8_t)a, (uint8_t)(b >> 8)));

    /* The upper half of the product has all its carries. In the lower half only the upper byte
     * still lacks the two cross products, of which nothing but its own eight bits count. */
    low = (uint16_t)(low + ((uint16_t)cross << 8));
    return (uint32_t)mul_hi_u16(a, b) << 16 | low;
}
