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

/* The cell that x, below SPAN, lies in. Cells of whole mm or mm/s: the byte x >> SHIFT times
 * 256 * 2^SHIFT / width gives its number or one less, and the rest, below twice the width, tells
 * which: of narrow cells a byte. Other cells: the reciprocal, which takes 50 mc more. */
#define SHIFT(span)                                                                                \
    ((span) > 32768UL   ? 8                                                                        \
     : (span) > 16384UL ? 7                                                                        \
     : (span) > 8192UL  ? 6                                                                        \
     : (span) > 4096UL  ? 5                                                                        \
     : (span) > 2048UL  ? 4                                                                        \
                        : 3)
#define WIDTH(span, cells) ((span) / (cells))
#define FITS(span, cells)                                                                          \
    ((span) % (cells) == 0 && WIDTH(span, cells) <= 510 &&                                         \
     (1UL << SHIFT(span)) + (256UL << SHIFT(span)) % WIDTH(span, cells) < WIDTH(span, cells))
#define IS_NARROW(span, cells) (WIDTH(span, cells) <= 128)
#define ONE_LESS(byte, span, cells)                                                                \
    (uint8_t)(mul_u8(byte, (uint8_t)((256UL << SHIFT(span)) / WIDTH(span, cells))) >> 8)
#define CELL_NARROW(cell, x, span, cells)                                                          \
    do {                                                                                           \
        cell = (uint8_t)((uint8_t)((x) >> 8) << (8 - SHIFT(span)) | (uint8_t)(x) >> SHIFT(span));  \
        cell = ONE_LESS(cell, span, cells);                                                        \
        if ((uint8_t)((x) - mul_u8(cell, (uint8_t)WIDTH(span, cells))) >= WIDTH(span, cells)) {    \
            cell++;                                                                                \
        }                                                                                          \
    } while (0)
#define CELL_WIDE(cell, x, span, cells)                                                            \
    do {                                                                                           \
        cell = ONE_LESS((uint8_t)((x) >> SHIFT(span)), span, cells);                               \
        x = (uint16_t)(x - mul_u8(cell, (uint8_t)(WIDTH(span, cells) / 2)));                       \
        x = (uint16_t)(x - mul_u8(cell, (uint8_t)((WIDTH(span, cells) + 1) / 2)));                 \
        if ((x) >= WIDTH(span, cells)) {                                                           \
            cell++;                                                                                \
        }                                                                                          \
    } while (0)

uint8_t cell_row(uint16_t dist_mm)
{
    uint16_t x = dist_mm - (uint16_t)LUT_IN1_MIN_MILLI;
    uint8_t row;

    if (x >= (uint16_t)LUT_IN1_SPAN_MILLI) {
        return dist_mm < (uint16_t)LUT_IN1_MIN_MILLI ? 0 : LUT_IN1_CELLS - 1;
    }
#if FITS(LUT_IN1_SPAN_MILLI, LUT_IN1_CELLS) && IS_NARROW(LUT_IN1_SPAN_MILLI, LUT_IN1_CELLS)
    CELL_NARROW(row, x, LUT_IN1_SPAN_MILLI, LUT_IN1_CELLS);
#elif FITS(LUT_IN1_SPAN_MILLI, LUT_IN1_CELLS)
    CELL_WIDE(row, x, LUT_IN1_SPAN_MILLI, LUT_IN1_CELLS);
#else
    row = (uint8_t)(mul_hi_u16(x, (uint16_t)LUT_IN1_MUL) >> LUT_IN1_SHIFT);
#endif
    return row;
}

uint8_t cell_col(uint16_t closing_mmps, uint16_t opening_mmps)
{
    uint8_t col;

#if LUT_IN2_MIN_MILLI > 0
    if (closing_mmps <= (uint16_t)LUT_IN2_MIN_MILLI) {
        return 0;
    }
    closing_mmps -= (uint16_t)LUT_IN2_MIN_MILLI;
#elif LUT_IN2_MIN_MILLI < 0
    if (opening_mmps >= (uint16_t)-LUT_IN2_MIN_MILLI) {
        return 0;
    }
    if (closing_mmps > (uint16_t)LUT_IN2_SPAN_MILLI) {
        return LUT_IN2_CELLS - 1;
    }
    closing_mmps += (uint16_t)-LUT_IN2_MIN_MILLI - opening_mmps;
#endif
    (void)opening_mmps;
    if (closing_mmps >= (uint16_t)LUT_IN2_SPAN_MILLI) {
        return LUT_IN2_CELLS - 1;
    }
#if FITS(LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS) && IS_NARROW(LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS)
    CELL_NARROW(col, closing_mmps, LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS);
#elif FITS(LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS)
    CELL_WIDE(col, closing_mmps, LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS);
#else
    col = (uint8_t)(mul_hi_u16(closing_mmps, (uint16_t)LUT_IN2_MUL) >> LUT_IN2_SHIFT);
#endif
    return col;
}
