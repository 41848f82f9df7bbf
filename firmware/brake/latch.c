/* SPDX-License-Identifier: MIT */
/* STOP. */
#include "latch.h"
#include "target.h"

uint8_t latch_state;

static uint8_t clear_readings;     /* in a row */
static uint8_t elsewhere_readings; /* of a target that began beyond LATCH_NEAR_MM */

enum column {
    WITHIN,
    WITHIN_TRACKED,
    NEAR,
    OPENING,
    BEYOND,
    BEYOND_TRACKED,
    PASSED,
    CLEAR,
    ROAD,
    FAULT,
    COLUMNS,
};

#define O LATCH_OPEN
#define T LATCH_TRIAL
#define D LATCH_DOUBTED
#define H LATCH_HELD
#define G LATCH_OPENING

/* The table of latch.h. */
static const uint8_t __code NEXT[LATCH_STATES][COLUMNS] = {
    {T, H, O, O, O, O, O, O, O, O}, /* OPEN */
    {H, H, H, O, D, O, O, D, O, T}, /* TRIAL */
    {H, H, H, O, O, O, O, O, O, D}, /* DOUBTED */
    {H, H, H, G, H, H, O, H, O, H}, /* HELD */
    {H, H, H, O, H, H, O, G, O, G}, /* OPENING */
};

void latch_init(void)
{
    latch_state = LATCH_OPEN;
    clear_readings = 0;
    elsewhere_readings = 0;
}

void latch_override(void)
{
    latch_state = LATCH_OPEN;
}

/* An echo beyond LATCH_NEAR_MM. */
static uint8_t far_column(bool is_of_target)
{
    if (is_of_target) {
        if (elsewhere_readings != 0 || target_worth != TARGET_TRACKED) {
            elsewhere_readings++;
            if (elsewhere_readings >= LATCH_PASSED_READINGS) {
                elsewhere_readings = LATCH_PASSED_READINGS;
                return PASSED;
            }
        }
        if (target_worth == TARGET_TRACKED) {
            if (closing_smooth.opening_mmps > LATCH_OPENING_MMPS) {
                return OPENING;
            }
            return BEYOND_TRACKED;
        }
    }
    return BEYOND;
}

static uint8_t column_of(bool is_of_target)
{
    if (range_reading.kind == RANGE_NO_TARGET) {
        clear_readings++;
        if (clear_readings >= LATCH_ROAD_READINGS) {
            clear_readings = LATCH_ROAD_READINGS;
            return ROAD;
        }
        return CLEAR;
    }
    clear_readings = 0;
    if (range_reading.kind != RANGE_ECHO) {
        return FAULT;
    }
    if (range_reading.dist_mm > LATCH_NEAR_MM) {
        return far_column(is_of_target);
    }
    elsewhere_readings = 0;
    if (range_reading.dist_mm > BRAKE_STOP_MM) {
        return NEAR;
    }
    if (is_of_target && target_worth == TARGET_TRACKED) {
        return WITHIN_TRACKED;
    }
    return WITHIN;
}

void latch_take(bool is_of_target)
{
    uint8_t column = column_of(is_of_target);

    if (latch_state >= LATCH_STATES) { /* a bit has turned over: the safe side */
        latch_state = LATCH_HELD;
    }
    latch_state = NEXT[latch_state][column];
}
