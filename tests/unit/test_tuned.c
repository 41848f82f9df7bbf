/* SPDX-License-Identifier: MIT */
/* The tuned law in the brake, with its own table: first sight, look-up, ease. */
#define ESTIMATOR_smooth
#include <stddef.h>
#include "unity.h"
#include "lut.c" /* first: it takes the table's data */
#undef LUT_DATA
#include "cell.c"
#include "law_tuned.c"
#include "brake.c" /* with the estimator of this law */
#include "target.c"
#include "range.h"
#include "step.h"
#include "cells.h"
#include "warned.h"

/* The cell by its definition; check_cells holds cell.c against the same. */
static uint8_t row_of(uint16_t dist_mm)
{
    return (uint8_t)((uint32_t)(dist_mm - LUT_IN1_MIN_MILLI) * LUT_IN1_CELLS / LUT_IN1_SPAN_MILLI);
}

static uint8_t col_of(uint16_t closing_mmps)
{
    return (uint8_t)((uint32_t)closing_mmps * LUT_IN2_CELLS / LUT_IN2_SPAN_MILLI);
}

static void look(uint8_t kind, uint16_t dist_mm)
{
    step_in_time(kind, dist_mm);
}

void setUp(void)
{
    brake_init(BRAKE_FAULT_NONE);
    ease_restart();
}

void tearDown(void)
{
}

static void test_every_distance_and_speed_lies_in_its_cell(void)
{
    check_cells();
}

/* --- first sight ------------------------------------------------------------------------------ */

/* In the tuned table 6.4 m/s at 4.6 m is full brake; one reading gets at most LAW_TUNED_FIRST_PCT.
 */
static void test_a_fast_target_is_braked_at_first_sight(void)
{
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 4600);
    TEST_ASSERT_EQUAL_UINT8(LAW_TUNED_FIRST_PCT, brake.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(row_of(4600), law_answer.row);
    TEST_ASSERT_EQUAL_UINT8(col_of(6400), law_answer.col); /* 400 mm in 1/16 s */
}

static void test_first_sight_never_exceeds_its_limit(void)
{
    uint16_t mm;
    uint8_t before = 0;

    for (mm = LAW_FAR_MM; mm >= LAW_FAR_MM - LAW_TUNED_FIRST_MM; mm--) {
        brake_init(BRAKE_FAULT_NONE);
        look(RANGE_NO_TARGET, 0);
        look(RANGE_ECHO, mm);
        TEST_ASSERT_TRUE(brake.brake_pct >= before && brake.brake_pct <= LAW_TUNED_FIRST_PCT);
        before = brake.brake_pct;
    }
    TEST_ASSERT_EQUAL_UINT8(LAW_TUNED_FIRST_PCT, before);
}

/* Without a clear road just before, or further inside, one reading proves no speed. */
static void test_otherwise_the_first_reading_does_not_brake(void)
{
    look(RANGE_ECHO, 4600);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);

    brake_init(BRAKE_FAULT_NONE);
    look(RANGE_NO_TARGET, 0);
    look(RANGE_NOT_RISEN, 0);
    look(RANGE_ECHO, 4600);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);

    brake_init(BRAKE_FAULT_NONE);
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, LAW_FAR_MM - LAW_TUNED_FIRST_MM - 1);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
}

/* Near ones neither; the second reading does: w of ease.h is 212/256 at 1376 mm. */
static void test_a_near_target_is_braked_from_the_second_reading_on(void)
{
    uint16_t mm;

    for (mm = 1001; mm < EASE_NEAR_MM; mm += 7) {
        brake_init(BRAKE_FAULT_NONE);
        look(RANGE_NO_TARGET, 0);
        look(RANGE_ECHO, mm);
        TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
        TEST_ASSERT_FALSE(brake.warn);
    }
    brake_init(BRAKE_FAULT_NONE);
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 1376);
    look(RANGE_ECHO, 1376);
    TEST_ASSERT_UINT8_WITHIN(1, (uint8_t)(lut_at(row_of(1376), 0) * 212U >> 8), brake.brake_pct);
}

/* One reading ago there was a stray echo, two ago the road was clear: 400 mm in 1/8 s, and not
 * limited, as two echoes came. */
static void test_a_stray_echo_before_it_takes_little_of_first_sight(void)
{
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 3500);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    look(RANGE_ECHO, 4600);
    TEST_ASSERT_EQUAL_UINT8(row_of(4600), law_answer.row);
    TEST_ASSERT_EQUAL_UINT8(col_of(3200), law_answer.col);
    TEST_ASSERT_EQUAL_UINT8(lut_at(row_of(4600), col_of(3200)), brake.brake_pct);
    look(RANGE_ECHO, 4600 - 384);
    TEST_ASSERT_UINT8_WITHIN(1, col_of(6400), law_answer.col);
}

static void test_the_second_reading_takes_over(void)
{
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 4600);
    look(RANGE_ECHO, 4540); /* 1 m/s: it was a slow one that came into sight late */
    TEST_ASSERT_UINT8_WITHIN(1, col_of(1000), law_answer.col);
    TEST_ASSERT_EQUAL_UINT8(lut_at(law_answer.row, law_answer.col), brake.brake_pct);
    TEST_ASSERT_TRUE(brake.brake_pct < 40);
}

/* The brake of first sight is held until the second clear reading. */
static void test_a_passing_object_is_forgotten_after_two_clear_readings(void)
{
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 4600);
    look(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(LAW_TUNED_FIRST_PCT, brake.brake_pct);
    look(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
}

/* One missing echo between the first two readings does not cost the second one its speed. */
static void test_a_speed_survives_one_missing_echo(void)
{
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 4900);
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 4180); /* 6 m/s */
    TEST_ASSERT_UINT8_WITHIN(1, col_of(6000), law_answer.col);
    TEST_ASSERT_TRUE(brake.brake_pct >= 95);
}

/* The road was clear, a stray echo came, and the next echo was missing; then the car is 868 mm
 * inside the table. It has come in from 5 m in 0.12 to 0.18 s. */
static void test_a_stray_echo_and_a_missing_one_cost_no_third_reading(void)
{
    /* Well before the car: the car is behind it, and another target. 868 mm in 1/8 s. */
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 2734);
    look(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    look(RANGE_ECHO, 5000 - 868);
    TEST_ASSERT_EQUAL_UINT8(col_of(8 * 868), law_answer.col);
    TEST_ASSERT_EQUAL_UINT8(lut_at(row_of(5000 - 868), col_of(8 * 868)), brake.brake_pct);

    /* Near it: the two echoes seem to be one target of 1 m/s; but before, it came faster: 944 mm
     * in 1/6 s. */
    brake_init(BRAKE_FAULT_NONE);
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 4181);
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 5000 - 944);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW_LATE, target_worth);
    TEST_ASSERT_EQUAL_UINT8(col_of(6 * 944), law_answer.col);
    TEST_ASSERT_EQUAL_UINT8(lut_at(row_of(5000 - 944), col_of(6 * 944)), brake.brake_pct);
}

/* So long after, a target so far inside may as well have cut in. */
static void test_what_is_far_inside_the_table_has_not_come_from_its_end(void)
{
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 1500);
    look(RANGE_ECHO, LAW_FAR_MM - LAW_TUNED_LATE_MM);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);

    brake_init(BRAKE_FAULT_NONE);
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 1500);
    look(RANGE_ECHO, LAW_FAR_MM - LAW_TUNED_LATE_MM - 1);
    TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED_LATE, target_worth);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
}

/* --- look-up and ease ------------------------------------------------------------------------- */

static void test_a_fast_approach_gets_the_table_and_no_ease(void)
{
    uint16_t mm;

    for (mm = 4900; mm > 1100; mm -= 200) { /* 3.3 m/s */
        look(RANGE_ECHO, mm);
        if (target_worth == TARGET_TRACKED) {
            TEST_ASSERT_EQUAL_UINT8(lut_at(law_answer.row, law_answer.col), brake.brake_pct);
            TEST_ASSERT_UINT8_WITHIN(2, col_of(3333), law_answer.col);
        }
    }
}

static void test_a_constant_gap_gets_a_seventh_then_is_held(void)
{
    uint8_t i;

    for (i = 0; i < 3; i++) {
        look(RANGE_ECHO, 2500);
    }
    TEST_ASSERT_UINT8_WITHIN(1, (uint8_t)(lut_at(row_of(2500), 0) / 7), brake.brake_pct);
    for (i = 0; i < EASE_STILL_READINGS + EASE_HOLD_PCT; i++) {
        look(RANGE_ECHO, 2500);
    }
    TEST_ASSERT_EQUAL_UINT8(EASE_HOLD_PCT, brake.brake_pct);
    look(RANGE_ECHO, 2540);
    look(RANGE_ECHO, 2600);
    look(RANGE_ECHO, 2680);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
}

static void test_stop_needs_none_of_it(void)
{
    look(RANGE_ECHO, 1000);
    TEST_ASSERT_TRUE(brake.stop);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
}

static void test_warning_comes_800_ms_before_hard_braking_or_with_the_second_reading(void)
{
    assert_warned_in_time(30, 300); /* 0.5 to 5 m/s */
}

/* --- the table -------------------------------------------------------------------------------- */

static void test_table_falls_with_distance_and_rises_with_speed(void)
{
    uint8_t row, col;

    for (row = 0; row < LUT_IN1_CELLS; row++) {
        for (col = 0; col < LUT_IN2_CELLS; col++) {
            uint8_t pct = lut_at(row, col);

            if (pct > 100 || (row > 0 && lut_at((uint8_t)(row - 1), col) < pct) ||
                (col > 0 && lut_at(row, (uint8_t)(col - 1)) > pct)) {
                TEST_ASSERT_EQUAL_UINT16_MESSAGE(0, row * 100U + col, "not monotone at this cell");
            }
        }
    }
    TEST_ASSERT_EQUAL_UINT8(100, lut_at(0, LUT_IN2_CELLS - 1));
    TEST_ASSERT_TRUE(lut_at(LUT_IN1_CELLS - 1, 0) <= 6);
}

static void test_restart_lets_go_of_the_hold(void)
{
    uint8_t i;

    law_step(TARGET_NEW, 3000);
    for (i = 0; i < 100; i++) {
        law_step(TARGET_TRACKED, 3000);
    }
    TEST_ASSERT_EQUAL_UINT8(EASE_HOLD_PCT, law_answer.brake_pct);
    law_restart();
    law_step(TARGET_TRACKED, 3000);
    TEST_ASSERT_TRUE(law_answer.brake_pct < EASE_HOLD_PCT);
    for (i = 0; i < 100; i++) {
        law_step(TARGET_TRACKED, 3000);
    }
    law_step(TARGET_NEW, 3000); /* another one */
    TEST_ASSERT_TRUE(law_answer.brake_pct < EASE_HOLD_PCT);
}

/* 80 mm in 1/16 s: 1.28 m/s. */
static void test_first_sight_at_the_edge_brakes_as_the_cell_says(void)
{
    look(RANGE_NO_TARGET, 0);
    look(RANGE_ECHO, 4920);
    TEST_ASSERT_EQUAL_UINT8(lut_at(row_of(4920), col_of(1280)), brake.brake_pct);
    TEST_ASSERT_TRUE(brake.brake_pct != 0 && brake.brake_pct < LAW_TUNED_FIRST_PCT);
}

/* --- bits that turn over ---------------------------------------------------------------------- */

static bool each_bit_shows(uint8_t (*sum_of)(void), uint8_t *byte)
{
    uint8_t mask;

    for (mask = 1; mask != 0; mask = (uint8_t)(mask << 1)) {
        uint8_t sum = sum_of();

        *byte ^= mask;
        if (sum_of() == sum) {
            return false;
        }
        *byte ^= mask;
    }
    return true;
}

/* Each byte shows, even where another one has all bits set. */
static void test_the_sum_shows_each_byte_beside_one_of_all_ones(void)
{
    uint8_t sum;

    brake.brake_pct = 0xFF;
    sum = brake_sum();
    brake.stop = !brake.stop;
    TEST_ASSERT_TRUE(brake_sum() != sum);
    brake.stop = !brake.stop;
    brake.overridden = !brake.overridden;
    TEST_ASSERT_TRUE(brake_sum() != sum);
    brake.overridden = !brake.overridden;
    TEST_ASSERT_TRUE(each_bit_shows(brake_sum, &demand_pct));
    TEST_ASSERT_TRUE(each_bit_shows(brake_sum, (uint8_t *)&override_cs));
    TEST_ASSERT_TRUE(each_bit_shows(brake_sum, (uint8_t *)&override_cs + 1));
    TEST_ASSERT_TRUE(each_bit_shows(brake_sum, &latch_state));
    TEST_ASSERT_TRUE(each_bit_shows(brake_sum, &fault_state));
    TEST_ASSERT_TRUE(each_bit_shows(brake_sum, &target_worth));
    TEST_ASSERT_TRUE(each_bit_shows(brake_sum, &closing_span_cs));
    target_worth = 0xFF;
    TEST_ASSERT_TRUE(each_bit_shows(target_sum, &since_cs));
    TEST_ASSERT_TRUE(each_bit_shows(target_sum, &since_aside_cs));
    TEST_ASSERT_TRUE(each_bit_shows(target_sum, &stuck_readings));
    TEST_ASSERT_TRUE(each_bit_shows(target_sum, &clears));
    TEST_ASSERT_TRUE(each_bit_shows(target_sum, (uint8_t *)&aside_mm));
    TEST_ASSERT_TRUE(each_bit_shows(target_sum, (uint8_t *)&aside_mm + 1));
}

/* Up to 100 %, and no more than there is. */
static void test_begun_anew_the_demand_is_kept_if_it_can_be(void)
{
    demand_pct = 100;
    brake_begin_anew();
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
    TEST_ASSERT_FALSE(brake.stop);
    demand_pct = 101;
    brake_begin_anew();
    TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
}

/* A STOP on trial is one, and none is none. */
static void test_begun_anew_the_latch_has_one_vote(void)
{
    brake.stop = true;
    latch_state = LATCH_TRIAL;
    brake_begin_anew();
    TEST_ASSERT_TRUE(brake.stop);
    brake_init(BRAKE_FAULT_NONE);
    brake.stop = true;
    brake_begin_anew();
    TEST_ASSERT_FALSE(brake.stop);
}

static void test_begun_anew_a_lasting_fault_is_one(void)
{
    brake_init(BRAKE_FAULT_RAM);
    brake_begin_anew();
    TEST_ASSERT_EQUAL_UINT8(FAULT_LASTING, fault_state);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_distance_and_speed_lies_in_its_cell);
    RUN_TEST(test_a_fast_target_is_braked_at_first_sight);
    RUN_TEST(test_first_sight_never_exceeds_its_limit);
    RUN_TEST(test_otherwise_the_first_reading_does_not_brake);
    RUN_TEST(test_a_near_target_is_braked_from_the_second_reading_on);
    RUN_TEST(test_the_second_reading_takes_over);
    RUN_TEST(test_a_passing_object_is_forgotten_after_two_clear_readings);
    RUN_TEST(test_a_stray_echo_before_it_takes_little_of_first_sight);
    RUN_TEST(test_a_speed_survives_one_missing_echo);
    RUN_TEST(test_a_stray_echo_and_a_missing_one_cost_no_third_reading);
    RUN_TEST(test_what_is_far_inside_the_table_has_not_come_from_its_end);
    RUN_TEST(test_a_fast_approach_gets_the_table_and_no_ease);
    RUN_TEST(test_a_constant_gap_gets_a_seventh_then_is_held);
    RUN_TEST(test_stop_needs_none_of_it);
    RUN_TEST(test_warning_comes_800_ms_before_hard_braking_or_with_the_second_reading);
    RUN_TEST(test_table_falls_with_distance_and_rises_with_speed);
    RUN_TEST(test_restart_lets_go_of_the_hold);
    RUN_TEST(test_first_sight_at_the_edge_brakes_as_the_cell_says);
    RUN_TEST(test_the_sum_shows_each_byte_beside_one_of_all_ones);
    RUN_TEST(test_begun_anew_the_demand_is_kept_if_it_can_be);
    RUN_TEST(test_begun_anew_the_latch_has_one_vote);
    RUN_TEST(test_begun_anew_a_lasting_fault_is_one);
    return UNITY_END();
}
