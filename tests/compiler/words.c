/* SPDX-License-Identifier: MIT */
/* Numbers of two bytes, on both sides. */
#include "steps.h"

uint16_t take_u16(void)
{
    uint8_t high = take();

    return (uint16_t)((uint16_t)high << 8 | take());
}

void put_u16(uint16_t number)
{
    put((uint8_t)(number >> 8));
    put((uint8_t)number);
}
