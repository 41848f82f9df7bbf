/* SPDX-License-Identifier: MIT */
/* Look-up in the table, and the table's check sum. */
#define LUT_DATA
#include "lut.h"
#include "fixed.h"

#if LUT_INPUTS > 3 || LUT_OUTPUTS > 2 || (LUT_PACKED && (LUT_INPUTS > 2 || LUT_OUTPUTS > 1))
#error "at most three inputs and two outputs; packed: two inputs and one output"
#endif

#if LUT_PACKED

/* tools/fistab/pack.h describes the parts of the table and how they make a cell. Nearly every index
 * is a variable of one byte: then SDCC reads the part by one `movc` from a fixed address. With an
 * expression instead, which is an int, it would not. */
#define CHANGES(block) (lut_out1 + 0)[block]
#define RUNS(block)    (lut_out1 + LUT_RUNS_AT)[block]
#define PAGES(strip)   (lut_out1 + LUT_PAGES_AT)[strip]
#define STARTS(run)    (lut_out1 + LUT_STARTS_AT)[run]
#define BASES(run)     (lut_out1 + LUT_BASES_AT)[run]
#define SHAPES(place)  (lut_out1 + LUT_SHAPES_AT)[place]

/* Bits 0..i set; and the number of ones in four bits. */
static const uint8_t __code bits_up_to[8] = {1, 3, 7, 15, 31, 63, 127, 255};
static const uint8_t __code ones[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

#if LUT_RUNS_AT > 256
typedef uint16_t block_index;
#else
typedef uint8_t block_index;
#endif

uint8_t lut_at(uint8_t row, uint8_t col)
{
    uint8_t strip = (uint8_t)(col / (uint8_t)LUT_STRIP_CELLS);
    block_index block;
    uint8_t run_low;
    uint16_t run;

#if LUT_FIRST_ROW > 0
    if (row < LUT_FIRST_ROW) {
        row = LUT_FIRST_ROW;
    }
    row -= LUT_FIRST_ROW;
#endif
    block = (uint8_t)(row >> 3);
    block += (block_index)(strip * (uint8_t)LUT_BLOCKS);

    /* From here on `row` holds the block's change bits up to the row: a one for each new run. */
    row = bits_up_to[(uint8_t)(row & 7)];
    row &= CHANGES(block);
    run_low = RUNS(block);
    run_low += ones[(uint8_t)(row >> 4)];
    run_low += ones[(uint8_t)(row & 15)];
    run = (uint16_t)((uint16_t)PAGES(strip) << 8 | run_low);
    col += STARTS(run);
    return (uint8_t)(BASES(run) + SHAPES(col));
}

#elif LUT_INPUTS == 1

uint8_t lut_at(uint8_t row, uint8_t col)
{
    (void)col;
    return lut_out1[row];
}

#elif LUT_INPUTS == 3

uint8_t lut_at3(uint8_t first, uint8_t second, uint8_t third)
{
    return lut_out1[first][second][third];
}

#if LUT_OUTPUTS == 2
uint8_t lut2_at3(uint8_t first, uint8_t second, uint8_t third)
{
    return lut_out2[first][second][third];
}
#endif

#else

uint8_t lut_at(uint8_t row, uint8_t col)
{
    /* SDCC indexes rows of bytes by one `mul ab`; row * CELLS + col would take 15 mc more. */
    return lut_out1[row][col];
}

#endif

#if LUT_IS_NODES && LUT_INPUTS == 2
/* The value at part_q8 / 256 of the way from `low` to `high`, rounded down. */
/*@ assigns \nothing;
    ensures tried: \min(low, high) <= \result <= \max(low, high); */
static uint8_t between(uint8_t low, uint8_t high, uint8_t part_q8)
{
    if (high >= low) {
        return (uint8_t)(low + (uint8_t)(mul_u8((uint8_t)(high - low), part_q8) >> 8));
    }
    return (uint8_t)(low - (uint8_t)((mul_u8((uint8_t)(low - high), part_q8) + 255U) >> 8));
}

uint8_t lut_between(uint16_t row_q8, uint16_t col_q8)
{
    uint8_t row = (uint8_t)(row_q8 >> 8), col = (uint8_t)(col_q8 >> 8);
    uint8_t part_q8 = (uint8_t)col_q8;
    uint8_t near = between(lut_at(row, col), lut_at(row, (uint8_t)(col + 1)), part_q8);

    row++;
    return between(near, between(lut_at(row, col), lut_at(row, (uint8_t)(col + 1)), part_q8),
                   (uint8_t)row_q8);
}
#endif

#ifndef LUT_NO_CRC16
uint16_t lut_crc16(uint16_t crc, uint16_t offset, uint8_t count)
{
    const uint8_t __code *byte = (const uint8_t __code *)lut_out1 + offset;
    uint8_t high = (uint8_t)(crc >> 8), low = (uint8_t)crc;

#if LUT_OUTPUTS == 2
    if (offset >= sizeof lut_out1) {
        byte = (const uint8_t __code *)lut_out2 + (uint16_t)(offset - sizeof lut_out1);
    }
#endif
#if LUT_OUTPUTS == 1
    /*@ loop invariant 1 <= count <= \at(count, Pre);
        loop invariant byte == (uint8_t *)lut_out1 + offset + (\at(count, Pre) - count);
        loop assigns high, low, byte, count;
        loop variant count; */
#endif
    do {
        CRC16_ADD(high, low, *byte);
        byte++;
#if LUT_OUTPUTS == 2
        offset++;
        if (offset == sizeof lut_out1) {
            byte = (const uint8_t __code *)lut_out2;
        }
#endif
    } while (--count != 0); /* rounds: 16, a slice of selftest.c */
    return (uint16_t)((uint16_t)high << 8 | low);
}
#endif
