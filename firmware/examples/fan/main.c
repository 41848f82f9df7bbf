/* SPDX-License-Identifier: MIT */
/* A fan: temperature comes in at P0, in half degrees Celsius, and relative humidity at P1, in
 * percent. The fan's speed goes out at P2, in percent. The table has 9 x 9 nodes; between them the
 * chip interpolates. */
#include "fixed.h"
#include "lut.h"

__sfr __at(0x80) P0;
__sfr __at(0x90) P1;
__sfr __at(0xA0) P2;

/* The range of each input, in the unit of its reading: 10..42 degrees, 20..84 percent. */
#define TEMP_LOW_HALF_C   (LUT_IN1_MIN_MILLI / 500)
#define TEMP_SPAN_HALF_C  (LUT_IN1_SPAN_MILLI / 500)
#define HUMIDITY_LOW_PCT  (LUT_IN2_MIN_MILLI / 1000)
#define HUMIDITY_SPAN_PCT (LUT_IN2_SPAN_MILLI / 1000)

/* Where a reading lies in the table, in 1/256 of a cell. A reading out of range counts as the
 * nearest one that is within. */
static uint16_t position_q8(uint8_t reading, uint8_t low, uint8_t span, uint16_t factor)
{
    uint8_t offset = 0;

    if (reading > low) {
        offset = (uint8_t)(reading - low);
    }
    if (offset >= span) {
        offset = (uint8_t)(span - 1);
    }
    return mul_hi_u16((uint16_t)offset << 8, factor);
}

void main(void)
{
    for (;;) {
        uint16_t temp_q8 = position_q8(P0, TEMP_LOW_HALF_C, TEMP_SPAN_HALF_C,
                                       LUT_POSITION(LUT_IN1_CELLS, TEMP_SPAN_HALF_C << 8));
        uint16_t humidity_q8 = position_q8(P1, HUMIDITY_LOW_PCT, HUMIDITY_SPAN_PCT,
                                           LUT_POSITION(LUT_IN2_CELLS, HUMIDITY_SPAN_PCT << 8));

        P2 = lut_between(temp_q8, humidity_q8);
    }
}
