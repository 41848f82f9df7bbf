/* SPDX-License-Identifier: MIT */
/* From a distance and a speed to the cell of the brake's table, and from there to the brake force.
 *
 * The table has two inputs: the distance in m and the closing speed in m/s. Beyond the ends of an
 * axis its first or last cell counts. axes.h says what an axis can be. */
#ifndef FUZZY51_CELL_H
#define FUZZY51_CELL_H

#include <stdint.h>
#include "axes.h"
#include "lut.h"

#define CELL_ROWS_LAST ((uint8_t)(LUT_IN1_CELLS - 1))
#define CELL_COLS_LAST ((uint8_t)(LUT_IN2_CELLS - 1))

/* Returns the row of a distance, 0..LUT_IN1_CELLS - 1. For the published table at most 47 mc. */
/*@ assigns \nothing;
    ensures tried: \result < LUT_IN1_CELLS;
    ensures tried: dist_mm < LUT_IN1_MIN_MILLI ==> \result == 0;
    ensures tried: dist_mm >= LUT_IN1_MIN_MILLI + LUT_IN1_SPAN_MILLI ==>
                \result == LUT_IN1_CELLS - 1; */
uint8_t cell_row(uint16_t dist_mm);

/* Returns the column of a speed, 0..LUT_IN2_CELLS - 1. At least one of the two speeds must be 0.
 * For the published table at most 47 mc. */
/*@ requires closing_mmps == 0 || opening_mmps == 0;
    assigns \nothing;
    ensures tried: \result < LUT_IN2_CELLS; */
uint8_t cell_col(uint16_t closing_mmps, uint16_t opening_mmps);

/* Returns the brake force in the cell, 0..100 percent. A table with fewer than 100 levels is
 * scaled; that is right to 1 percent and takes about 50 mc. */
#if LUT_LEVELS == 100
#define cell_pct(row, col) lut_at(row, col)
#else
/*@ requires row < LUT_IN1_CELLS && col < LUT_IN2_CELLS;
    assigns \nothing;
    ensures \result <= 100; */
uint8_t cell_pct(uint8_t row, uint8_t col);
#endif

#endif
