/* SPDX-License-Identifier: MIT */
/* Cells of the brake's table. An axis has a span, in mm or mm/s, and a number of cells; x is the
 * distance from its low end. The cell is floor(x * cells / span). For each axis one of three
 * methods is chosen, the fastest that is exact for every x below the span:
 *   by bytes         if a cell is a whole number of mm, up to 510: two `mul ab`
 *   by reciprocal    if fistab found an exact factor of 16 bits: 50 mc more
 *   by subtraction   on any other axis: about 300 mc more */
#include "cell.h"
#include <stdbool.h>
#include "fixed.h"

#ifndef __SDCC_mcs51
/* As in fixed.c: a copy to call, for compilers that do not inline. */
extern inline uint8_t cell_of_narrow(uint16_t x, uint8_t shift, uint8_t factor, uint8_t width);
extern inline uint8_t cell_of_wide(uint16_t x, uint8_t shift, uint8_t factor, uint16_t width);
extern inline uint8_t cell_by_subtraction(uint16_t x, uint16_t span, uint8_t cells_less_1);
#endif

/* --- by bytes --------------------------------------------------------------------------------- */

/* x >> SHIFT fits a byte for each x below the span; not below 3, so that x << (8 - SHIFT) does. */
#define SHIFT(span)                                                                                \
    ((span) > 32768UL   ? 8                                                                        \
     : (span) > 16384UL ? 7                                                                        \
     : (span) > 8192UL  ? 6                                                                        \
     : (span) > 4096UL  ? 5                                                                        \
     : (span) > 2048UL  ? 4                                                                        \
                        : 3)
#define WIDTH(span, cells) ((span) / (cells))

/* The byte x >> SHIFT times FACTOR / 256 is the cell of x or one less. */
#define FACTOR(span, cells) ((256UL << SHIFT(span)) / WIDTH(span, cells))

/* Whether that holds: cells are whole, and what the shift and the factor lose is less than a cell.
 */
#define GOES_BY_BYTES(span, cells)                                                                 \
    ((span) % (cells) == 0 && WIDTH(span, cells) <= 510 &&                                         \
     (1UL << SHIFT(span)) + (256UL << SHIFT(span)) % WIDTH(span, cells) < WIDTH(span, cells))
#define IS_NARROW(span, cells) (WIDTH(span, cells) <= 128)

/* What GOES_BY_BYTES says, for all x below the span. */
/*@ predicate goes_by_bytes(integer x, integer shift, integer factor, integer width) =
        3 <= shift <= 8 && 0 < width <= 510 && 0 <= x < 256 << shift &&
        factor == (256 << shift) / width && (1 << shift) + (256 << shift) % width < width; */

/* Cells of up to 128 mm: what is left of x, less than two cells, fits a byte. */
/*@ requires goes_by_bytes(x, shift, factor, width) && width <= 128;
    assigns \nothing;
    ensures tried: \result == x / width; */
inline uint8_t cell_of_narrow(uint16_t x, uint8_t shift, uint8_t factor, uint8_t width)
{
    /*@ assert tried: (uint8_t)(x >> 8) << (8 - shift) <= 255; */
    uint8_t cell = (uint8_t)((uint8_t)(x >> 8) << (8 - shift) | (uint8_t)x >> shift);

    cell = (uint8_t)(mul_u8(cell, factor) >> 8);
    if ((uint8_t)(x - mul_u8(cell, width)) >= width) {
        cell++;
    }
    return cell;
}

/* Cells of up to 510 mm: the width is the sum of two bytes. */
/*@ requires goes_by_bytes(x, shift, factor, width);
    assigns \nothing;
    ensures tried: \result == x / width; */
inline uint8_t cell_of_wide(uint16_t x, uint8_t shift, uint8_t factor, uint16_t width)
{
    uint8_t cell = (uint8_t)(mul_u8((uint8_t)(x >> shift), factor) >> 8);

    x = (uint16_t)(x - mul_u8(cell, (uint8_t)(width / 2)));
    x = (uint16_t)(x - mul_u8(cell, (uint8_t)((width + 1) / 2)));
    if (x >= width) {
        cell++;
    }
    return cell;
}

#define CELL_BY_BYTES(x, span, cells)                                                              \
    (IS_NARROW(span, cells) ? cell_of_narrow(x, SHIFT(span), (uint8_t)FACTOR(span, cells),         \
                                             (uint8_t)WIDTH(span, cells))                          \
                            : cell_of_wide(x, SHIFT(span), (uint8_t)FACTOR(span, cells),           \
                                           (uint16_t)WIDTH(span, cells)))

/* --- by subtraction --------------------------------------------------------------------------- */

/* Long division of x * cells by the span. x * cells / 256 is below the span, so the quotient has
 * eight bits. cells is given less 1, because 256 cells do not fit a byte. */
/*@ requires x < span;
    assigns \nothing; */
inline uint8_t cell_by_subtraction(uint16_t x, uint16_t span, uint8_t cells_less_1)
{
    uint16_t low = mul_u8((uint8_t)x, cells_less_1);
    uint16_t rest = mul_u8((uint8_t)(x >> 8), cells_less_1);
    uint8_t bits, left;

    /* The upper 16 bits of the product go to `rest`, the low eight to `bits`. */
    rest += x >> 8;
    rest += low >> 8;
    bits = (uint8_t)((uint8_t)low + (uint8_t)x);
    if (bits < (uint8_t)x) {
        rest++;
    }
    /*@ loop invariant left <= 8;
        loop assigns left, rest, bits;
        loop variant left; */
    for (left = 8; left != 0; left--) { /* rounds: 8 */
        bool is_beyond = rest >= 0x8000U;

        rest = (uint16_t)(rest << 1);
        if (bits & 0x80U) {
            rest |= 1;
        }
        bits = (uint8_t)(bits << 1);
        if (is_beyond || rest >= span) {
            rest -= span;
            bits |= 1;
        }
    }
    return bits;
}

/* --- the axes --------------------------------------------------------------------------------- */

#if GOES_BY_BYTES(LUT_IN1_SPAN_MILLI, LUT_IN1_CELLS)
#define ROW_OF(x) CELL_BY_BYTES(x, LUT_IN1_SPAN_MILLI, LUT_IN1_CELLS)
#elif defined(LUT_IN1_MUL)
#define ROW_OF(x) (uint8_t)(mul_hi_u16(x, (uint16_t)LUT_IN1_MUL) >> LUT_IN1_SHIFT)
#else
#define ROW_OF(x) cell_by_subtraction(x, (uint16_t)LUT_IN1_SPAN_MILLI, CELL_ROWS_LAST)
#endif

#if GOES_BY_BYTES(LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS)
#define COL_OF(x) CELL_BY_BYTES(x, LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS)
#elif defined(LUT_IN2_MUL)
#define COL_OF(x) (uint8_t)(mul_hi_u16(x, (uint16_t)LUT_IN2_MUL) >> LUT_IN2_SHIFT)
#else
#define COL_OF(x) cell_by_subtraction(x, (uint16_t)LUT_IN2_SPAN_MILLI, CELL_COLS_LAST)
#endif

uint8_t cell_row(uint16_t dist_mm)
{
    uint16_t x = dist_mm - (uint16_t)LUT_IN1_MIN_MILLI;

    if (x >= (uint16_t)LUT_IN1_SPAN_MILLI) {
#if LUT_IN1_MIN_MILLI > 0
        /* Below the low end the difference has wrapped. */
        if (dist_mm < (uint16_t)LUT_IN1_MIN_MILLI) {
            return 0;
        }
#endif
        return CELL_ROWS_LAST;
    }
    return ROW_OF(x);
}

uint8_t cell_col(uint16_t closing_mmps, uint16_t opening_mmps)
{
#if LUT_IN2_MIN_MILLI > 0
    (void)opening_mmps;
    if (closing_mmps <= (uint16_t)LUT_IN2_MIN_MILLI) {
        return 0;
    }
    closing_mmps -= (uint16_t)LUT_IN2_MIN_MILLI;
#elif LUT_IN2_MIN_MILLI < 0
    if (opening_mmps >= (uint16_t)-LUT_IN2_MIN_MILLI) {
        return 0;
    }
    /* From here on opening_mmps is what it lies above the low end. */
    opening_mmps = (uint16_t)-LUT_IN2_MIN_MILLI - opening_mmps;
    if (opening_mmps >= (uint16_t)LUT_IN2_SPAN_MILLI ||
        closing_mmps >= (uint16_t)LUT_IN2_SPAN_MILLI - opening_mmps) {
        return CELL_COLS_LAST;
    }
    closing_mmps += opening_mmps;
#else
    (void)opening_mmps; /* then closing_mmps is 0 */
#endif
    if (closing_mmps >= (uint16_t)LUT_IN2_SPAN_MILLI) {
        return CELL_COLS_LAST;
    }
    return COL_OF(closing_mmps);
}

#if LUT_LEVELS < 100

/* 100 / LUT_LEVELS in 1/256. */
#define PCT_Q8 ((25600U + LUT_LEVELS / 2U) / LUT_LEVELS)

uint8_t cell_pct(uint8_t row, uint8_t col)
{
    uint8_t level = lut_at(row, col);
    uint16_t pct_q8 = mul_u8(level, (uint8_t)PCT_Q8);

    pct_q8 += (uint16_t)mul_u8(level, (uint8_t)(PCT_Q8 >> 8)) << 8;
    return (uint8_t)((pct_q8 + 128U) >> 8);
}

#endif
