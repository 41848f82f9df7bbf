/* The controller's table, plain or packed, behind one function. Its data comes from the header that
 * fistab writes (lut_table.h); only lut.c defines LUT_DATA and so holds it. Indices are not
 * checked. */
#ifndef FUZZY51_LUT_H
#define FUZZY51_LUT_H

#include <stdint.h>
#include "cc51.h"
#include "crc16.h"
#include "lut_table.h"

#if LUT_INPUTS == 3

/* The cell of output 1, and of output 2, at these indices of inputs 1, 2 and 3. 60 mc. */
uint8_t lut_at3(uint8_t first, uint8_t second, uint8_t third);
uint8_t lut2_at3(uint8_t first, uint8_t second, uint8_t third);

#else

/* The cell at `row` (input 1, 0..LUT_IN1_CELLS-1) and `col` (input 2, 0..LUT_IN2_CELLS-1; 0 for a
 * table of one input). Plain 24 mc (25 with 256 columns); packed 110 mc,
 * the same for every cell within one, and 117 where a table has more than 256 blocks. The call, 9
 * mc, is not counted. All as tests/lut measures it. */
uint8_t lut_at(uint8_t row, uint8_t col);

#endif

#if LUT_IS_NODES && LUT_INPUTS == 2
/* A table of nodes between its nodes: bilinear, along input 2 first, rounded down at each of the
 * three steps, so up to two levels below the true plane and never above it. Both positions are in
 * 1/256 of a cell from the low end of their input, 0..LUT_INx_CELLS * 256 - 1; a span of n units
 * becomes one by
 *     mul_hi_u16(offset << s, LUT_POSITION(LUT_INx_CELLS, n << s))
 * with any s for which offset << s and the factor fit 16 bits. */
uint8_t lut_between(uint16_t row_q8, uint16_t col_q8);

#define LUT_POSITION(cells, span) ((uint16_t)((cells) * 16777216UL / (span)))
#endif

#define LUT_CRC16_START CRC16_START

/* CRC-16/CCITT-FALSE over `count` (1..255) stored bytes from byte `offset` on (both inside
 * LUT_BYTES), going on from `crc`. Slice by slice from LUT_CRC16_START over all LUT_BYTES it ends
 * at LUT_CRC16. 37 + 43 * count mc, so that a watchdog can be fed between slices. */
uint16_t lut_crc16(uint16_t crc, uint16_t offset, uint8_t count);

#endif
