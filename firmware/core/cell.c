/* Cells of the table. */
#include "cell.h"
#include "fixed.h"

#if !defined(LUT_IN1_MUL) || !defined(LUT_IN2_MUL)
#error an axis of the table is too long: at most 65.535 m or m/s from end to end
#endif
#if LUT_IN1_MIN_MILLI < 0 || LUT_IN1_MIN_MILLI + LUT_IN1_SPAN_MILLI > 65535
#error the distance axis of the table must lie within 0..65.535 m
#endif
#if LUT_LEVELS != 100
#error the brake needs a table of 0..100 percent
#endif

uint8_t cell_row(uint16_t dist_mm)
{
    uint16_t x = dist_mm - (uint16_t)LUT_IN1_MIN_MILLI;

    if (dist_mm <= (uint16_t)LUT_IN1_MIN_MILLI) {
        return 0;
    }
    if (x >= (uint16_t)LUT_IN1_SPAN_MILLI) {
        return LUT_IN1_CELLS - 1;
    }
    return (uint8_t)(mul_hi_u16(x, (uint16_t)LUT_IN1_MUL) >> LUT_IN1_SHIFT);
}

uint8_t cell_col(const struct closing_speed __data *speed)
{
    uint16_t x = speed->closing_mmps;

#if LUT_IN2_MIN_MILLI > 0
    if (x <= (uint16_t)LUT_IN2_MIN_MILLI) {
        return 0;
    }
    x -= (uint16_t)LUT_IN2_MIN_MILLI;
#elif LUT_IN2_MIN_MILLI < 0
    if (speed->opening_mmps >= (uint16_t)-LUT_IN2_MIN_MILLI) {
        return 0;
    }
    if (x > (uint16_t)LUT_IN2_SPAN_MILLI) {
        return LUT_IN2_CELLS - 1;
    }
    x += (uint16_t)-LUT_IN2_MIN_MILLI - speed->opening_mmps;
#endif
    if (x >= (uint16_t)LUT_IN2_SPAN_MILLI) {
        return LUT_IN2_CELLS - 1;
    }
    return (uint8_t)(mul_hi_u16(x, (uint16_t)LUT_IN2_MUL) >> LUT_IN2_SHIFT);
}
