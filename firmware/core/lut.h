/* The controller's table, plain or packed, behind one function. Its data comes from the header that
 * fistab writes (lut_table.h); only lut.c defines LUT_DATA and so holds it. */
#ifndef FUZZY51_LUT_H
#define FUZZY51_LUT_H

#include <stdint.h>
#include "cc51.h"
#include "crc16.h"
#include "lut_table.h"

/* The cell at `row` (input 1, 0..LUT_IN1_CELLS-1) and `col` (input 2, 0..LUT_IN2_CELLS-1; 0 for a
 * table of one input). The indices are not checked. Plain 24 mc (25 with 256 columns); packed 111 mc,
 * the same for every cell within one, and 118 where a table has more than 256 blocks. The call, 9 mc,
 * is not counted. All as tests/lut measures it. */
uint8_t lut_at(uint8_t row, uint8_t col);

#define LUT_CRC16_START CRC16_START

/* CRC-16/CCITT-FALSE over `count` (1..255) stored bytes from byte `offset` on (both inside
 * LUT_BYTES), going on from `crc`. Slice by slice from LUT_CRC16_START over all LUT_BYTES it ends
 * at LUT_CRC16. 37 + 43 * count mc, so that a watchdog can be fed between slices. */
uint16_t lut_crc16(uint16_t crc, uint16_t offset, uint8_t count);

#endif
