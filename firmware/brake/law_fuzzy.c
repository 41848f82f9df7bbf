/* SPDX-License-Identifier: MIT */
/* The table as published. */
#include <stdbool.h>
#include "brake.h"
#include "cell.h"
#include "law.h"
#include "lut.h"

/* Nearer and faster cells are taken at once; further and slower ones only from BRAKE_SLACK_x cells
 * on, so that a noisy sensor at a constant gap does not make the brake chatter. */
uint8_t law_step(uint8_t target, uint16_t dist_mm)
{
    uint8_t row, col;

    if (target != LAW_TRACKED) { /* nothing to be held at */
        brake.row = CELL_ROWS_LAST;
        brake.col = 0;
    }
    row = cell_row(dist_mm);
    if (row <= brake.row) {
        brake.row = row;
    } else if ((uint8_t)(row - brake.row) > BRAKE_SLACK_ROWS) {
        brake.row = (uint8_t)(row - BRAKE_SLACK_ROWS);
    }
    col = cell_col(BRAKE_SPEED.closing_mmps, BRAKE_SPEED.opening_mmps);
    if (col >= brake.col) {
        brake.col = col;
    } else if ((uint8_t)(brake.col - col) > BRAKE_SLACK_COLS) {
        brake.col = (uint8_t)(col + BRAKE_SLACK_COLS);
    }
    return target >= LAW_GLIMPSE ? 0 : cell_pct(brake.row, brake.col);
}

uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    return cell_pct(cell_row(dist_mm), cell_col(speed->closing_mmps, speed->opening_mmps));
}
