/* SPDX-License-Identifier: MIT */
/* The table as published. */
#include "law.h"
#include "cell.h"
#include "target.h"

/* How many cells further or slower the target must seem before the brake follows: for at most one
 * step of more than 2 points a second at 2 cm of noise. */
#if defined(ESTIMATOR_smooth)
#define SLACK_ROWS 1U
#define SLACK_COLS 0U
#else
#define SLACK_ROWS 2U
#define SLACK_COLS 2U
#endif

/* Holds from the start on: nothing but the two functions below changes them. */
static uint8_t held_row, held_col;

__data struct law_answer law_answer;

/*@ predicate law_is_valid = held_row < LUT_IN1_CELLS && held_col < LUT_IN2_CELLS; */

/*@ assigns held_row, held_col;
    ensures law_is_valid && held_row == CELL_ROWS_LAST && held_col == 0; */
void law_restart(void)
{
    held_row = CELL_ROWS_LAST;
    held_col = 0;
}

/* Nearer and faster cells are taken at once; further and slower ones only from the slack on, so
 * that a noisy sensor at a constant gap does not make the brake chatter. */
/*@ requires law_is_valid;
    assigns held_row, held_col;
    ensures law_is_valid && law_answer.row == held_row && law_answer.col == held_col;
    ensures worth < TARGET_NEW ==> law_answer.brake_pct == 0; */
void law_step(uint8_t worth, uint16_t dist_mm)
{
    uint8_t row = cell_row(dist_mm),
            col = cell_col(CLOSING_LAW.closing_mmps, CLOSING_LAW.opening_mmps);

    if (worth != TARGET_TRACKED) { /* nothing to be held at */
        law_restart();
    }
    if (row <= held_row) {
        held_row = row;
    } else if ((uint8_t)(row - held_row) > SLACK_ROWS) {
        held_row = (uint8_t)(row - SLACK_ROWS);
    }
    if (col >= held_col) {
        held_col = col;
    } else if ((uint8_t)(held_col - col) > SLACK_COLS) {
        held_col = (uint8_t)(col + SLACK_COLS);
    }
    law_answer.row = held_row;
    law_answer.col = held_col;
    law_answer.brake_pct = worth < TARGET_NEW ? 0 : cell_pct(held_row, held_col);
}

uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    return cell_pct(cell_row(dist_mm), cell_col(speed->closing_mmps, speed->opening_mmps));
}
