/* SPDX-License-Identifier: MIT */
/* Look-up in the controller's table, plain or packed. The table comes from the header lut_table.h,
 * which fistab writes; only lut.c defines LUT_DATA and so contains it. Indices are not checked. The
 * times are as tests/lut measures them, without the call, which takes 9 mc. */
#ifndef FUZZY51_LUT_H
#define FUZZY51_LUT_H

#include <stdint.h>
#include "cc51.h"
#include "crc16.h"
#include "lut_table.h"

/* What an index counts: the cells of an input, or its nodes, which are one more. */
#if LUT_IS_NODES
#define LUT_IN1_VALUES LUT_IN1_NODES
#define LUT_IN2_VALUES LUT_IN2_NODES
#else
#define LUT_IN1_VALUES LUT_IN1_CELLS
#define LUT_IN2_VALUES LUT_IN2_CELLS
#endif

#if LUT_INPUTS == 3

/* A table of three inputs: returns the cell of output 1 or of output 2 at the indices of inputs 1,
 * 2 and 3. 60 mc. */
/*@ requires first < LUT_IN1_CELLS && second < LUT_IN2_CELLS && third < LUT_IN3_CELLS;
    assigns \nothing;
    ensures tried: \result <= LUT_LEVELS; */
uint8_t lut_at3(uint8_t first, uint8_t second, uint8_t third);
#if LUT_OUTPUTS == 2
/*@ requires first < LUT_IN1_CELLS && second < LUT_IN2_CELLS && third < LUT_IN3_CELLS;
    assigns \nothing;
    ensures tried: \result <= LUT_LEVELS; */
uint8_t lut2_at3(uint8_t first, uint8_t second, uint8_t third);
#endif

#elif LUT_INPUTS == 2

/* A table of two inputs: returns the cell in the row of input 1 and the column of input 2. Plain:
 * 24 mc, 25 with 256 columns. Packed: 110 mc for every cell within one, 117 where a table has more
 * than 256 blocks. */
/*@ requires row < LUT_IN1_VALUES && col < LUT_IN2_VALUES;
    assigns \nothing;
    ensures tried: \result <= LUT_LEVELS; */
uint8_t lut_at(uint8_t row, uint8_t col);

#else

/* A table of one input: returns its cell `row`; `col` is not used, give 0. */
/*@ requires row < LUT_IN1_VALUES;
    assigns \nothing;
    ensures tried: \result <= LUT_LEVELS; */
uint8_t lut_at(uint8_t row, uint8_t col);

#endif

#if LUT_IS_NODES && LUT_INPUTS == 2
/* A table of nodes, between its nodes: interpolates along input 2, then along input 1, and rounds
 * down at each of the three steps. So the result is never above the exact one, and at most two
 * levels below. Positions are in 1/256 of a cell from the low end of the input. An offset from the
 * low end becomes a position by
 *     mul_hi_u16(offset << s, LUT_POSITION(LUT_INx_CELLS, span << s))
 * where span is the length of the input in the same unit, and s is any shift for which offset << s
 * and the factor fit 16 bits. */
/*@ requires row_q8 < LUT_IN1_CELLS * 256 && col_q8 < LUT_IN2_CELLS * 256;
    assigns \nothing;
    ensures \result <= LUT_LEVELS; */
uint8_t lut_between(uint16_t row_q8, uint16_t col_q8);

#define LUT_POSITION(cells, span) ((uint16_t)((cells) * 16777216UL / (span)))
#endif

#define LUT_CRC16_START CRC16_START

/* Adds `count` stored bytes from byte `offset` on to the check sum `crc` (crc16.h) and returns the
 * new sum. Slice by slice over all LUT_BYTES, from LUT_CRC16_START on, it becomes LUT_CRC16. Takes
 * 37 + 43 * count mc; in slices, so that the watchdog can be fed in between. The brake checks all
 * its code (hal_code_test) and does without: LUT_NO_CRC16. */
/*@ requires 1 <= count && offset + count <= LUT_BYTES;
    assigns \nothing; */
uint16_t lut_crc16(uint16_t crc, uint16_t offset, uint8_t count);

#endif
