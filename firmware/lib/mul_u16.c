/* The whole product of 16-bit numbers, apart from fixed.c: not every image has room for it. */
#include "fixed.h"

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
