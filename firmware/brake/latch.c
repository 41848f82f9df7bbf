/* SPDX-License-Identifier: MIT */
/* STOP. */
#include "latch.h"
#include "target.h"

uint8_t latch_state, latch_twin;

static uint8_t clear_readings;     /* in a row */
static uint8_t elsewhere_readings; /* of a target that began beyond LATCH_NEAR_MM */
#if RANGE_IS_FAST
static __idata uint8_t opening_readings; /* in a row, up to LATCH_OPENING_READINGS */
static __idata uint8_t early_readings;   /* so many more do not end TRIAL or DOUBTED */
#endif

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

/* What the latch counts, for the contracts here and in brake.c; whether the tracked target opens;
 * and what holds from latch_init on. */
#if RANGE_IS_FAST
#define LATCH_COUNTS clear_readings, elsewhere_readings, opening_readings, early_readings
/*@ predicate latch_opens = opening_readings == LATCH_OPENING_READINGS;
    predicate latch_counts_opening = opening_readings <= LATCH_OPENING_READINGS; */
#else
#define LATCH_COUNTS clear_readings, elsewhere_readings
/*@ predicate latch_opens = closing_smooth.opening_mmps > LATCH_OPENING_MMPS;
    predicate latch_counts_opening = \true; */
#endif
/*@ predicate latch_is_valid =
        latch_is_whole && latch_state < LATCH_STATES &&
        clear_readings <= LATCH_ROAD_READINGS && elsewhere_readings <= LATCH_PASSED_READINGS &&
        latch_counts_opening;
    predicate latch_sees_beyond =
        range_reading.kind == RANGE_ECHO && range_reading.dist_mm > LATCH_NEAR_MM;
    predicate latch_sees_opening(bool is_of_target) =
        latch_sees_beyond && is_of_target && target_worth == TARGET_TRACKED && latch_opens;
    predicate latch_sees_passed(bool is_of_target) =
        latch_sees_beyond && is_of_target && elsewhere_readings == LATCH_PASSED_READINGS;
    predicate latch_sees_road = clear_readings == LATCH_ROAD_READINGS; */

/* What one reading makes of STOP: what keeps it, all that ends it, and what must end it. */
/*@ predicate latch_moves{Before, Now}(bool is_of_target) =
        \let was = \at(latch_state, Before); \let is = \at(latch_state, Now);
        \let kind = \at(range_reading.kind, Now);
        is < LATCH_STATES &&
        \at(clear_readings, Now) == (kind == RANGE_NO_TARGET
            ? \min(\at(clear_readings, Before) + 1, LATCH_ROAD_READINGS) : 0) &&
        (kind == RANGE_ECHO && \at(range_reading.dist_mm, Now) <= BRAKE_STOP_MM ==>
            is != LATCH_OPEN) &&
        (kind > RANGE_NO_TARGET && was < LATCH_STATES ==> is == was) &&
        (!is_of_target && was != LATCH_OPEN && was != LATCH_DOUBTED && !latch_sees_road{Now} ==>
            is != LATCH_OPEN) &&
        (was != LATCH_OPEN && is == LATCH_OPEN ==>
            latch_sees_road{Now} || latch_sees_passed{Now}(is_of_target) ||
            (latch_sees_opening{Now}(is_of_target) && was != LATCH_HELD) ||
            (was == LATCH_TRIAL && latch_sees_beyond{Now} && is_of_target &&
                \at(target_worth, Now) == TARGET_TRACKED) ||
            (was == LATCH_DOUBTED && (latch_sees_beyond{Now} || kind == RANGE_NO_TARGET))) &&
        (latch_sees_road{Now} || latch_sees_passed{Now}(is_of_target) ==> is == LATCH_OPEN) &&
        (latch_sees_opening{Now}(is_of_target) ==> is == LATCH_OPEN ||
            (is == LATCH_OPENING && (was == LATCH_HELD || was >= LATCH_STATES))); */

/*@ assigns LATCH_COUNTS;
    ensures latch_is_valid && clear_readings == 0; */
void latch_init(void)
{
    latch_state = LATCH_OPEN;
    latch_twin = (uint8_t)~LATCH_OPEN;
    clear_readings = 0;
    elsewhere_readings = 0;
#if RANGE_IS_FAST
    opening_readings = 0;
    early_readings = 0;
#endif
}

/*@ assigns latch_state, latch_twin;
    ensures latch_state == next;
    ensures \old(latch_is_whole) ==> latch_is_whole; */
static void enter(uint8_t next)
{
    latch_twin = (uint8_t)(latch_twin + latch_state - next);
    latch_state = next;
}

void latch_hold(void)
{
    enter(LATCH_HELD);
}

void latch_override(void)
{
    enter(LATCH_OPEN);
}

#if RANGE_IS_FAST
/* Whether the tracked target opens, and did in the last readings. */
/*@ requires latch_is_valid;
    assigns opening_readings;
    ensures latch_is_valid;
    ensures \result <==> latch_opens;
    ensures opening_readings == (closing_smooth.opening_mmps > LATCH_OPENING_MMPS
                ? \min(\old(opening_readings) + 1, LATCH_OPENING_READINGS) : 0); */
static bool is_opening(void)
{
    if (closing_smooth.opening_mmps <= LATCH_OPENING_MMPS) {
        opening_readings = 0;
        return false;
    }
    if (opening_readings < LATCH_OPENING_READINGS) {
        opening_readings++;
    }
    return opening_readings >= LATCH_OPENING_READINGS;
}
#else
#define is_opening() (closing_smooth.opening_mmps > LATCH_OPENING_MMPS)
#endif

/* An echo beyond LATCH_NEAR_MM. */
/*@ requires latch_is_valid && latch_sees_beyond;
    assigns LATCH_COUNTS;
    ensures clear_readings == \old(clear_readings);
    ensures latch_is_valid;
    ensures \result == PASSED || \result == OPENING || \result == BEYOND_TRACKED ||
            \result == BEYOND;
    ensures \result == PASSED <==> latch_sees_passed(is_of_target);
    ensures \result == OPENING ==> latch_sees_opening(is_of_target);
    ensures latch_sees_opening(is_of_target) ==> \result == OPENING || \result == PASSED;
    ensures \result == BEYOND_TRACKED ==> is_of_target && target_worth == TARGET_TRACKED; */
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
            if (is_opening()) {
                return OPENING;
            }
            return BEYOND_TRACKED;
        }
    }
    return BEYOND;
}

/*@ requires latch_is_valid;
    assigns LATCH_COUNTS;
    ensures latch_is_valid;
    ensures clear_readings == (range_reading.kind == RANGE_NO_TARGET
                ? \min(\old(clear_readings) + 1, LATCH_ROAD_READINGS) : 0);
    ensures \result < COLUMNS;
    ensures \result == ROAD <==> latch_sees_road;
    ensures \result == CLEAR <==> range_reading.kind == RANGE_NO_TARGET && !latch_sees_road;
    ensures \result == FAULT <==>
                range_reading.kind != RANGE_NO_TARGET && range_reading.kind != RANGE_ECHO;
    ensures \result == WITHIN || \result == WITHIN_TRACKED <==>
                range_reading.kind == RANGE_ECHO && range_reading.dist_mm <= BRAKE_STOP_MM;
    ensures OPENING <= \result <= PASSED <==> latch_sees_beyond;
    ensures \result == PASSED <==> latch_sees_passed(is_of_target);
    ensures \result == OPENING ==> latch_sees_opening(is_of_target);
    ensures latch_sees_opening(is_of_target) ==> \result == OPENING || \result == PASSED;
    ensures \result == BEYOND_TRACKED ==> is_of_target && target_worth == TARGET_TRACKED; */
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
#if RANGE_IS_FAST
    opening_readings = 0;
#endif
    if (range_reading.dist_mm > BRAKE_STOP_MM) {
        return NEAR;
    }
    if (is_of_target && target_worth == TARGET_TRACKED) {
        return WITHIN_TRACKED;
    }
    return WITHIN;
}

#if RANGE_IS_FAST
/* Whether TRIAL or DOUBTED began less than LATCH_DOUBT_READINGS ago, and this reading is none of a
 * tracked target: it may still be of the stray echo, or miss what is there for a moment. */
/*@ requires latch_state < LATCH_STATES && column < COLUMNS;
    assigns early_readings;
    ensures \result ==> latch_state == LATCH_TRIAL || latch_state == LATCH_DOUBTED;
    ensures \result ==> column == BEYOND || column == CLEAR ||
                (latch_state == LATCH_TRIAL && (column == WITHIN || column == NEAR)); */
static bool is_too_early(uint8_t column)
{
    if (early_readings != 0) {
        early_readings--;
        if ((latch_state == LATCH_TRIAL || latch_state == LATCH_DOUBTED) &&
            (column == BEYOND || column == CLEAR)) {
            return true;
        }
        if (latch_state == LATCH_TRIAL && (column == WITHIN || column == NEAR)) {
            return true;
        }
    }
    if (NEXT[latch_state][column] != latch_state) {
        early_readings = LATCH_DOUBT_READINGS - 1U;
    }
    return false;
}
#endif

/*@ requires latch_is_valid;
    assigns LATCH_COUNTS;
    ensures latch_is_valid && latch_moves{Pre, Post}(is_of_target); */
void latch_take(bool is_of_target)
{
    uint8_t column = column_of(is_of_target);

    if (!LATCH_IS_WHOLE()) { /* a bit has turned over, which stays visible */
        return;
    }
#if RANGE_IS_FAST
    if (is_too_early(column)) {
        return;
    }
#endif
    enter(NEXT[latch_state][column]);
}

uint8_t latch_sum(void)
{
#if RANGE_IS_FAST
    return latch_state ^ clear_readings ^ elsewhere_readings ^ opening_readings ^ early_readings;
#else
    return latch_state ^ clear_readings ^ elsewhere_readings;
#endif
}
