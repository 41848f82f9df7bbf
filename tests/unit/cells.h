/* SPDX-License-Identifier: MIT */
/* Every distance and every speed against the quotient that its cell is, for the table of this test.
 */
#ifndef FUZZY51_CELLS_H
#define FUZZY51_CELLS_H

#include "cell.h"
#include "lut_table.h"

#if LUT_IN2_MIN_MILLI != 0
#error check_cells takes speeds from 0 on
#endif

/* Going up: each cell is as long as CELLS divides the span. */
static void check_cells(void)
{
    uint16_t x;
    uint8_t cell = 0;

    for (x = 0; x < 9000; x++) {
        if (x > LUT_IN1_MIN_MILLI && cell < LUT_IN1_CELLS - 1 &&
            (uint32_t)(x - LUT_IN1_MIN_MILLI) * LUT_IN1_CELLS >= (cell + 1U) * LUT_IN1_SPAN_MILLI) {
            cell++;
        }
        if (cell_row(x) != cell) {
            TEST_ASSERT_EQUAL_UINT16_MESSAGE(0, x, "not in its row: the distance in mm");
        }
    }
    cell = 0;
    for (x = 0; x < 40000U; x++) {
        if (cell < LUT_IN2_CELLS - 1 &&
            (uint32_t)x * LUT_IN2_CELLS >= (cell + 1U) * LUT_IN2_SPAN_MILLI) {
            cell++;
        }
        if (cell_col(x, 0) != cell) {
            TEST_ASSERT_EQUAL_UINT16_MESSAGE(0, x, "not in its column: the speed in mm/s");
        }
    }
}

#endif
