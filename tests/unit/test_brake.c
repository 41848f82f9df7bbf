/* SPDX-License-Identifier: MIT */
/* brake: the states, the latch, every kind of sensor trouble. Readings and ticks are arguments. */
#include <stddef.h>
#include "unity.h"
#include "sweep.h"
#include "brake.h"
#include "closing.h"
#include "latch.h"
#include "law.h"
#include "lut.h"
#include "range.h"
#include "target.h"
#include "step.h"
#include "warned.h"
#include "warning.h"

#define PERIOD_CS RANGE_PERIOD_CS

static uint8_t before_pct;
static uint16_t raw_mm; /* the last echo */

static void start(void)
{
    step_held = false;
    brake_init(BRAKE_FAULT_NONE);
}

void setUp(void)
{
    start();
}

void tearDown(void)
{
}

static void wait_cs(uint8_t time_cs)
{
    step_wait(time_cs);
}

static void measure(uint8_t kind, uint16_t dist_mm)
{
    before_pct = brake.brake_pct;
    step_in_time(kind, dist_mm);
}

static void echo(uint16_t dist_mm)
{
    raw_mm = dist_mm;
    measure(RANGE_ECHO, dist_mm);
}

static void echoes(uint16_t dist_mm, uint8_t count)
{
    while (count-- != 0) {
        echo(dist_mm);
    }
}

static void approach(uint16_t from_mm, uint16_t to_mm, uint16_t step_mm)
{
    while (from_mm > to_mm) {
        echo(from_mm);
        from_mm -= step_mm;
    }
    echo(to_mm);
}

/* --- RELEASED and CONTROL --------------------------------------------------------------------- */

static void test_starts_released(void)
{
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    TEST_ASSERT_FALSE(brake.stop);
    TEST_ASSERT_FALSE(brake.warn);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
}

static void test_no_target_stays_released_for_ever(void)
{
    uint8_t i;

    for (i = 0; i < 100; i++) {
        measure(RANGE_NO_TARGET, 0);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
        TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    }
}

static void test_each_distance_gets_its_row_and_from_the_second_reading_on_the_cell(void)
{
    uint16_t mm;

    for (mm = 20; mm <= 6000; mm++) {
        uint8_t row = mm <= 1000 ? 0 : mm < 5000 ? (uint8_t)((mm - 1000U) / 40U) : 99;
        uint8_t state = mm <= 1000 ? BRAKE_STOP : mm <= 5000 ? BRAKE_CONTROL : BRAKE_RELEASED;
        uint8_t first_pct = mm <= 1000 ? 100 : 0;
        uint8_t pct = mm <= 1000 ? 100 : mm <= 5000 ? lut_at(row, 0) : 0;

        brake_init(BRAKE_FAULT_NONE);
        step(RANGE_ECHO, mm, PERIOD_CS);
        if (brake.state != state || brake.brake_pct != first_pct || brake.stop != (mm <= 1000)) {
            SWEEP_FAIL(mm, "first reading: wrong at this distance in mm");
        }
        step(RANGE_ECHO, mm, PERIOD_CS);
        if (brake.state != state || brake.brake_pct != pct || brake.stop != (mm <= 1000) ||
            (mm <= 5000 && law_answer.row != row)) {
            TEST_ASSERT_EQUAL_UINT16_MESSAGE(0, mm,
                                             "wrong state, duty or row at this distance in mm");
        }
    }
}

static void test_what_passes_in_one_reading_is_not_braked_for(void)
{
    uint16_t mm;

    for (mm = 1001; mm <= 5000; mm += 31) {
        start();
        measure(RANGE_NO_TARGET, 0);
        echo(mm);
        TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
        TEST_ASSERT_FALSE(brake.warn);
        measure(RANGE_NO_TARGET, 0);
        TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
        measure(RANGE_NO_TARGET, 0);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
        TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
    }
}

/* Two readings are two wherever the first one was, and whatever came between. */
static void test_the_second_reading_brakes(void)
{
    uint8_t i;

    for (i = 0; i < 4; i++) {
        start();
        echo(i == 0 ? 5100 : 4900); /* beyond the table, or within */
        if (i == 2) {
            measure(RANGE_NO_TARGET, 0);
        } else if (i == 3) {
            measure(RANGE_NOT_RISEN, 0);
        }
        TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
        echo(4600);
        TEST_ASSERT_EQUAL_UINT8(lut_at(90, law_answer.col), brake.brake_pct);
        TEST_ASSERT_TRUE(brake.brake_pct != 0);
    }
}

/* 21 mm in 60 ms are 350 mm/s, one column. The closing speed's unit of 2 mm/s may cost a column's
 * edge. */
static void test_each_speed_gets_its_column(void)
{
    uint16_t step_mm;

    for (step_mm = 0; step_mm <= 2150; step_mm++) {
        uint16_t exact_mmps = (uint16_t)((uint32_t)step_mm * 50U / 3U);
        uint8_t col = exact_mmps >= 35000U ? 99 : (uint8_t)(exact_mmps / 350U);

        brake_init(BRAKE_FAULT_NONE);
        step(RANGE_ECHO, 5500, PERIOD_CS);
        step(RANGE_ECHO, (uint16_t)(5500U - step_mm), PERIOD_CS);
        if (step_mm < 500) {
            continue; /* beyond the table: no look-up */
        }
        if (law_answer.col != col && law_answer.col != (uint8_t)((exact_mmps - 2U) / 350U)) {
            TEST_ASSERT_EQUAL_UINT16_MESSAGE(col, law_answer.col, "column");
        }
        TEST_ASSERT_EQUAL_UINT8(lut_at(law_answer.row, law_answer.col), brake.brake_pct);
    }
}

static void test_opening_counts_as_no_closing(void)
{
    echo(2000);
    echo(2100);
    echo(2200);
    TEST_ASSERT_TRUE(closing_difference.opening_mmps > 1600);
    TEST_ASSERT_EQUAL_UINT8(0, law_answer.col);
}

static void test_brake_never_falls_while_the_gap_shrinks(void)
{
    uint8_t step_mm;

    for (step_mm = 30; step_mm <= 240; step_mm += 30) {
        uint16_t mm;

        start();
        for (mm = 5000; mm > step_mm; mm -= step_mm) {
            echo(mm);
            if (brake.brake_pct + 5U < before_pct) { /* the raw table has dents of up to 5 points */
                TEST_ASSERT_EQUAL_UINT8_MESSAGE(before_pct, brake.brake_pct, "brake fell");
            }
        }
        TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    }
}

static void test_noise_of_two_rows_and_columns_does_not_move_the_brake(void)
{
    uint8_t row, i;

    echo(3000);
    echo(3000);
    row = law_answer.row;
    for (i = 0; i < 20; i++) {
        echo(3000);
        echo(3025);
        TEST_ASSERT_EQUAL_UINT8(row, law_answer.row);
        TEST_ASSERT_TRUE(law_answer.col <= 2);
    }
    echoes(3130, 4);
    TEST_ASSERT_EQUAL_UINT8((3130 - 1000) / 40 - 2U, law_answer.row);
}

static void test_target_that_hovers_at_the_far_end_is_kept(void)
{
    echo(4990);
    echo(4990);
    echo(5000 + BRAKE_SLACK_FAR_MM);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
    echo(5001 + BRAKE_SLACK_FAR_MM);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    echo(5001);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
}

/* --- STOP ------------------------------------------------------------------------------------- */

static void test_first_reading_at_one_metre_stops_at_once(void)
{
    echo(1001);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
    start();
    TEST_ASSERT_TRUE(brake_must_stop(1000));
    TEST_ASSERT_FALSE(brake_must_stop(1001));
    echo(1000);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
    TEST_ASSERT_TRUE(brake.stop);
}

static void test_stop_holds_at_a_noisy_metre(void)
{
    static const uint16_t __code noisy_mm[] = {1000, 1012, 996, 1024, 1008, 990, 1019, 1003};
    uint8_t i;

    for (i = 0; i < 200; i++) {
        echo(noisy_mm[i & 7]);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    }
}

static void stop_at_900(void)
{
    approach(1400, 900, 25);
    echoes(900, 10);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
}

static void test_stop_lets_go_of_a_target_that_drives_off(void)
{
    uint16_t mm;

    stop_at_900();
    for (mm = 920; mm <= 1300; mm += 20) { /* 0.33 m/s */
        echo(mm);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    }
    echo(1320);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    echo(1340);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
    TEST_ASSERT_FALSE(brake.stop);
    TEST_ASSERT_EQUAL_UINT8(lut_at(law_answer.row, law_answer.col), brake.brake_pct);
}

static void test_stop_holds_a_target_that_opens_too_slowly(void)
{
    uint16_t mm;

    stop_at_900();
    for (mm = 900; mm <= 2000; mm += 11) { /* 0.18 m/s */
        echo(mm);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    }
}

static void test_two_opening_readings_must_follow_each_other(void)
{
    uint16_t mm;

    stop_at_900();
    for (mm = 920; mm <= 1300; mm += 20) {
        echo(mm);
    }
    echo(1320);
    echoes(1300, 6); /* the first of two, but then it stands again */
    echo(1302);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
}

static void test_override_held_a_second_lets_go_and_no_sooner(void)
{
    stop_at_900();
    step_held = true;
    wait_cs(BRAKE_OVERRIDE_CS - 7U);
    step(RANGE_ECHO, 901, PERIOD_CS); /* keeps the silence short */
    wait_cs(6);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
    step(RANGE_ECHO, 902, PERIOD_CS);
    wait_cs(1);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    TEST_ASSERT_FALSE(brake.stop);
    TEST_ASSERT_FALSE(brake_must_stop(500));
}

static void test_a_start_forgets_the_override(void)
{
    stop_at_900();
    step_held = true;
    wait_cs(BRAKE_OVERRIDE_CS);
    TEST_ASSERT_TRUE(brake.overridden);
    brake_init(BRAKE_FAULT_NONE);
    TEST_ASSERT_FALSE(brake.overridden);
}

static void test_override_works_only_while_held(void)
{
    uint8_t i;

    stop_at_900();
    step_held = true;
    for (i = 0; i < 20; i++) {
        echo((uint16_t)(900 + i));
    }
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);

    step_held = false;
    echo(920);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    TEST_ASSERT_TRUE(brake.stop);
}

static void test_an_override_held_for_30_s_is_stuck_until_it_is_released(void)
{
    uint16_t cs;

    stop_at_900();
    for (cs = 1; cs <= BRAKE_OVERRIDE_END_CS; cs++) {
        brake_tick(true);
        TEST_ASSERT_EQUAL(cs >= BRAKE_OVERRIDE_CS, brake.overridden);
    }
    for (cs = 0; cs < 300; cs++) { /* an 8-bit count would come round */
        brake_tick(true);
        TEST_ASSERT_FALSE(brake.overridden);
    }
    step_held = true;
    echo(900);
    TEST_ASSERT_TRUE(brake.stop);

    brake_tick(false);
    for (cs = 1; cs <= BRAKE_OVERRIDE_CS; cs++) {
        TEST_ASSERT_TRUE(brake.stop);
        brake_tick(true);
    }
    TEST_ASSERT_TRUE(brake.overridden);
    TEST_ASSERT_FALSE(brake.stop);
}

static void test_a_short_press_changes_nothing(void)
{
    uint8_t i;

    stop_at_900();
    for (i = 0; i < 10; i++) {
        step_held = true;
        wait_cs(9);
        step_held = false;
        echo((uint16_t)(901 + i));
        TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    }
}

/* --- one wild reading ------------------------------------------------------------------------- */

static void test_glitch_on_a_clear_road_stops_for_two_periods(void)
{
    measure(RANGE_NO_TARGET, 0);
    echo(500);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    TEST_ASSERT_FALSE(brake.stop);
}

static void test_glitch_below_a_tracked_target_stops_for_one_period(void)
{
    uint8_t pct;

    echoes(3000, 5);
    pct = brake.brake_pct;
    echo(400);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, fault_code);
    echo(3000);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
    TEST_ASSERT_EQUAL_UINT8(pct, brake.brake_pct);
}

static void test_glitch_before_the_first_echo_is_dropped_after_two_readings(void)
{
    echo(400);
    echo(4000);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
    echo(4000);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
}

static void test_glitch_away_from_a_braked_target_moves_nothing(void)
{
    uint8_t pct;

    approach(4000, 2500, 100);
    pct = brake.brake_pct;
    echo(5900);
    TEST_ASSERT_EQUAL_UINT8(pct, brake.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
    echo(2300);
    TEST_ASSERT_TRUE(brake.brake_pct >= pct);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
}

static void test_a_second_reading_within_the_metre_makes_stop_sure(void)
{
    echo(900);
    echo(890);
    measure(RANGE_NO_TARGET, 0);
    measure(RANGE_NO_TARGET, 0);
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_TRUE(brake.stop);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
}

static void test_a_tracked_approach_makes_stop_sure_at_once(void)
{
    approach(2000, 950, 150);
    measure(RANGE_NO_TARGET, 0);
    measure(RANGE_NO_TARGET, 0);
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_TRUE(brake.stop);
}

/* --- sensor trouble --------------------------------------------------------------------------- */

static const uint8_t
    __code missing_kinds[] = {RANGE_NOT_RISEN, RANGE_NOT_FALLEN, RANGE_DEAD_ZONE, RANGE_NO_TARGET};
static const uint8_t __code missing_faults[] = {BRAKE_FAULT_NOT_RISEN, BRAKE_FAULT_NOT_FALLEN,
                                                BRAKE_FAULT_DEAD_ZONE, BRAKE_FAULT_LOST};

static void test_a_missing_reading_never_lowers_the_brake(void)
{
    uint8_t kind, i, pct;
    uint16_t mm;

    for (kind = 0; kind < 4; kind++) {
        for (mm = 1100; mm <= 3900; mm += 400) {
            start();
            echoes(mm, 4);
            pct = brake.brake_pct;
            for (i = 0; i < 15; i++) {
                measure(missing_kinds[kind], 0);
                if (brake.brake_pct < pct) {
                    TEST_ASSERT_EQUAL_UINT16_MESSAGE(pct, mm, "brake fell at this distance in mm");
                }
                TEST_ASSERT_EQUAL_UINT8(missing_faults[kind], fault_code);
            }
            TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
        }
    }
}

static void test_fault_comes_between_180_and_190_ms_of_silence(void)
{
    uint8_t kind;

    for (kind = 0; kind < 3; kind++) {
        start();
        measure(RANGE_NO_TARGET, 0);
        measure(missing_kinds[kind], 0);
        measure(missing_kinds[kind], 0);
        wait_cs(STEP_ECHO_CS);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
        TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
        wait_cs(1);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
        TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
    }
}

static void test_two_missing_readings_are_no_fault(void)
{
    echoes(4500, 3);
    measure(RANGE_NOT_RISEN, 0);
    measure(RANGE_NOT_RISEN, 0);
    echo(4500);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
}

static void test_fault_never_lowers_a_higher_brake(void)
{
    uint8_t pct;

    echoes(1500, 4);
    pct = brake.brake_pct;
    TEST_ASSERT_TRUE(pct > FAULT_PCT);
    wait_cs(40);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_EQUAL_UINT8(pct, brake.brake_pct);
}

static void test_fault_keeps_a_stop(void)
{
    stop_at_900();
    wait_cs(40);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
    TEST_ASSERT_TRUE(brake.stop);
    echo(1100);
    echo(1101);
    echo(1100);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
}

static void test_stop_works_in_fault(void)
{
    wait_cs(40);
    TEST_ASSERT_FALSE(brake.stop);
    echo(900);
    TEST_ASSERT_TRUE(brake.stop);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
}

static void test_three_good_readings_in_a_row_leave_fault(void)
{
    wait_cs(40);
    echo(4500);
    echo(4490);
    measure(RANGE_NOT_RISEN, 0);
    echo(4480);
    echo(4470);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
    echo(4460);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
    TEST_ASSERT_EQUAL_UINT8(lut_at(law_answer.row, law_answer.col), brake.brake_pct);
}

static void test_a_clear_road_leaves_fault_too(void)
{
    wait_cs(40);
    measure(RANGE_NO_TARGET, 0);
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
}

static void test_a_vanished_near_target_is_gone_after_1200_ms(void)
{
    uint8_t i;

    echoes(2000, 5);
    for (i = 0; i < TARGET_NEAR_CLEARS + 1U; i++) {
        measure(RANGE_NO_TARGET, 0);
        TEST_ASSERT_TRUE(brake.brake_pct >= FAULT_PCT);
    }
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
}

/* The silence forgets its speed, not that it was there: one or two echoes between missing ones do
 * not make it a target that may leave. */
static void test_a_near_target_does_not_vanish_while_the_sensor_comes_and_goes(void)
{
    uint8_t echo_count, i;

    for (echo_count = 1; echo_count <= 2; echo_count++) {
        uint8_t pct;

        start();
        echoes(2000, 5);
        pct = brake.brake_pct;
        for (i = 0; i < 5; i++) {
            measure(RANGE_NO_TARGET, 0);
        }
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
        echoes(2000, echo_count);
        for (i = 0; i < 5; i++) {
            measure(RANGE_NO_TARGET, 0);
            TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
            TEST_ASSERT_EQUAL_UINT8(pct, brake.brake_pct);
        }
    }
}

static void test_a_far_target_may_leave_after_some_clear_readings(void)
{
    uint8_t i;

    echoes(4500, 5);
    for (i = 1; i < TARGET_FAR_CLEARS; i++) {
        measure(RANGE_NO_TARGET, 0);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
        TEST_ASSERT_EQUAL_UINT8(before_pct, brake.brake_pct);
    }
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
}

static void test_readings_that_jump_about_are_a_fault(void)
{
    static const uint16_t __code wild_mm[] = {1500, 5000, 2300, 4300};
    uint8_t i;

    echoes(3300, 4);
    for (i = 0; i < 4; i++) {
        echo(wild_mm[i]);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, fault_code);
        TEST_ASSERT_TRUE(brake.brake_pct >= before_pct);
    }
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
}

static void test_the_same_reading_while_closing_is_stuck(void)
{
    uint8_t pct, i;

    approach(4000, 3000, 100);
    pct = brake.brake_pct;
    for (i = 0; i < 4; i++) {
        echo(3000);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, fault_code);
        TEST_ASSERT_TRUE(brake.brake_pct >= pct);
    }
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    echo(3002);
    echo(3000);
    echo(3000);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
}

static void test_the_same_reading_at_rest_is_fine(void)
{
    uint8_t i;

    approach(3000, 2000, 40); /* 0.67 m/s: 10 m/s2 stop that between two readings */
    for (i = 0; i < 50; i++) {
        echo(2000);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
    }
}

/* What a sensor that hangs, or garbage, leaves behind; then the car stands, before a sensor without
 * noise. */
static void test_a_car_at_rest_ends_every_fault(void)
{
    uint8_t round;

    for (round = 0; round < 3; round++) {
        start();
        if (round == 0) {
            approach(4000, 2050, 150);
        } else if (round == 1) { /* closing at 25 m/s */
            echo(5000);
            echo(3500);
            echo(2000);
        } else { /* opening at 10 m/s */
            echo(1200);
            echo(1800);
            echo(2400);
        }
        echoes(raw_mm, 4);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, fault_code);
        echoes(raw_mm, TARGET_REST_READINGS - 4U);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
        TEST_ASSERT_FALSE(brake.warn);
        echoes(raw_mm, FAULT_GOOD_READINGS);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
        TEST_ASSERT_FALSE(brake.warn);
    }
}

/* --- no dead state ---------------------------------------------------------------------------- */

/* Two stray readings, or someone who crosses. */
static void test_stop_ends_on_a_clear_road(void)
{
    uint8_t i = 0;

    measure(RANGE_NO_TARGET, 0);
    echo(700);
    echo(720);
    while (brake.stop && i < 100) {
        measure(RANGE_NO_TARGET, 0);
        i++;
    }
    TEST_ASSERT_EQUAL_UINT8(LATCH_ROAD_READINGS, i);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
}

static void test_stop_ends_before_another_target(void)
{
    uint8_t i = 0;

    echoes(3000, 5); /* a parked car */
    echoes(700, 4);  /* someone crosses */
    TEST_ASSERT_TRUE(brake.stop);
    while (brake.stop && i < 100) {
        echo(3000);
        i++;
    }
    TEST_ASSERT_EQUAL_UINT8(LATCH_PASSED_READINGS + 1U, i); /* the first of them is not believed */
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
}

/* --- the demand is held ---------------------------------------------------------------------- */

static void test_a_missing_second_reading_does_not_interrupt_stop(void)
{
    uint8_t i;

    for (i = 0; i < 4; i++) {
        start();
        echo(900);
        measure(missing_kinds[i], 0);
        TEST_ASSERT_TRUE(brake.stop);
        TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
        echo(890);
        TEST_ASSERT_TRUE(brake.stop);
    }
}

static void test_two_missing_echoes_after_two_readings_hold_the_brake(void)
{
    uint16_t mm;

    for (mm = 1300; mm <= 4900; mm += 300) {
        start();
        echoes(mm, 2);
        measure(RANGE_NO_TARGET, 0);
        TEST_ASSERT_EQUAL_UINT8(before_pct, brake.brake_pct);
        measure(RANGE_NO_TARGET, 0);
        TEST_ASSERT_EQUAL_UINT8(before_pct, brake.brake_pct);
        TEST_ASSERT_TRUE(brake.brake_pct != 0);
    }
}

static void test_a_lone_stray_echo_lets_go_within_half_a_second(void)
{
    uint16_t mm;
    uint8_t i;

    for (mm = 50; mm <= 5000; mm += 50) {
        start();
        measure(RANGE_NO_TARGET, 0);
        echo(mm);
        for (i = 0; i < 7; i++) {
            measure(RANGE_NO_TARGET, 0);
        }
        TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
        TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
        TEST_ASSERT_FALSE(brake.stop);
    }
}

static void test_the_warning_ends_with_the_target_and_in_fault(void)
{
    uint8_t i;

    approach(4500, 2000, 100);
    TEST_ASSERT_TRUE(brake.warn);
    for (i = 0; i < WARNING_CALM_READINGS; i++) {
        measure(RANGE_NOT_RISEN, 0);
    }
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_FALSE(brake.warn);
}

static void test_a_driver_can_leave_a_fault(void)
{
    wait_cs(40);
    step_held = true;
    wait_cs(BRAKE_OVERRIDE_CS);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    step_held = false;
    wait_cs(1);
    TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
}

/* --- starts that are not clean ---------------------------------------------------------------- */

static void test_a_watchdog_reset_starts_braking_and_ends_with_three_good_readings(void)
{
    brake_init(BRAKE_FAULT_WATCHDOG);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_WATCHDOG, fault_code);
    measure(RANGE_NO_TARGET, 0);
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
}

static void test_a_failed_self_test_lasts_but_still_stops(void)
{
    uint8_t fault, i;

    for (fault = BRAKE_FAULT_TABLE; fault <= BRAKE_FAULT_IDLE; fault++) {
        start();
        brake_init(fault);
        for (i = 0; i < 10; i++) {
            echo((uint16_t)(3000 - i));
            TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
            TEST_ASSERT_EQUAL_UINT8(fault, fault_code);
            TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
        }
        measure(RANGE_NOT_RISEN, 0);
        TEST_ASSERT_EQUAL_UINT8(fault, fault_code);
        echo(900);
        TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
        TEST_ASSERT_TRUE(brake.stop);
    }
}

static void test_a_fault_found_on_the_way_lasts(void)
{
    echoes(3000, 4);
    brake_fail(BRAKE_FAULT_STACK);
    brake_fail(BRAKE_FAULT_RAM);
    echoes(3000, 10);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STACK, fault_code);
}

static void test_a_pwm_pin_that_does_not_follow_is_stop(void)
{
    echoes(3000, 4);
    brake_fail(BRAKE_FAULT_STACK);
    TEST_ASSERT_FALSE(brake.stop);
    brake_fail(BRAKE_FAULT_OUTPUT); /* it is not the first fault, and yet acts */
    TEST_ASSERT_TRUE(brake.stop);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STACK, fault_code);
    echoes(3000, 4);
    TEST_ASSERT_TRUE(brake.stop);

    start();
    brake_fail(BRAKE_FAULT_OUTPUT);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_OUTPUT, fault_code);
}

/* --- warning ---------------------------------------------------------------------------------- */

static void test_warning_comes_800_ms_before_hard_braking_or_with_the_second_reading(void)
{
    assert_warned_in_time(30, 300); /* 0.5 to 5 m/s */
}

static void test_no_warning_while_nothing_closes(void)
{
    uint8_t i;

    for (i = 0; i < 50; i++) {
        echo(1500);
        TEST_ASSERT_FALSE(brake.warn);
    }
    for (i = 0; i < 50; i++) {
        echo((uint16_t)(1500 + 20 * i));
        TEST_ASSERT_FALSE(brake.warn);
    }
}

static void test_warning_ends_half_a_second_after_its_reason(void)
{
    uint8_t i = 0;

    approach(4500, 2000, 100);
    TEST_ASSERT_TRUE(brake.warn);
    while (brake.warn && i < 50) {
        echo((uint16_t)(2000 + (i & 1)));
        i++;
    }
    TEST_ASSERT_TRUE(i >= WARNING_CALM_READINGS);
    TEST_ASSERT_TRUE(i < 25);
}

static void test_a_missing_echo_of_a_target_beyond_reach_brakes_nothing(void)
{
    start();
    echo(5900);
    echo(5800);
    echo(5700);
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
    TEST_ASSERT_TRUE(CLOSING_LAW.closing_mmps >= BRAKE_APPROACH_MMPS);
    measure(RANGE_NOT_RISEN, 0);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
}

static void test_a_target_that_slows_down_is_followed_two_columns_behind(void)
{
    law_restart();
    closing_difference.opening_mmps = 0;
    closing_difference.closing_mmps = 3675; /* the middle of column 10 */
    law_step(TARGET_TRACKED, 3000);
    TEST_ASSERT_EQUAL_UINT8(10, law_answer.col);
    closing_difference.closing_mmps = 2975; /* of column 8 */
    law_step(TARGET_TRACKED, 3000);
    TEST_ASSERT_EQUAL_UINT8(10, law_answer.col);
    closing_difference.closing_mmps = 2625; /* of column 7 */
    law_step(TARGET_TRACKED, 3000);
    TEST_ASSERT_EQUAL_UINT8(9, law_answer.col);
    TEST_ASSERT_EQUAL_UINT8(lut_at(law_answer.row, 9), law_answer.brake_pct);
}

/* --- what a bit that turns over in RAM can do ------------------------------------------------- */

/* Turns over each bit of SIZE bytes, one after the other; true: the check sum shows each. */
static bool each_bit_shows(void *place, uint8_t size)
{
    uint8_t *byte = place, bit;

    while (size-- != 0) {
        for (bit = 1; bit != 0; bit = (uint8_t)(bit << 1)) {
            uint8_t before = brake_sum();

            *byte ^= bit;
            if (brake_sum() == before) {
                return false;
            }
            *byte ^= bit;
            if (brake_sum() != before) {
                return false;
            }
        }
        byte++;
    }
    return true;
}

static void test_the_check_sum_shows_each_bit_that_turns_over(void)
{
    approach(4000, 1600, 300);
    TEST_ASSERT_TRUE(each_bit_shows(&brake.brake_pct, 1));
    TEST_ASSERT_TRUE(each_bit_shows(&brake.state, 1));
    TEST_ASSERT_TRUE(each_bit_shows(&fault_state, 1));
    TEST_ASSERT_TRUE(each_bit_shows(&fault_code, 1));
    TEST_ASSERT_TRUE(each_bit_shows(&latch_state, 1));
    TEST_ASSERT_TRUE(each_bit_shows(&target_worth, 1));
    TEST_ASSERT_TRUE(each_bit_shows(&closing_span_cs, 1));
    TEST_ASSERT_TRUE(each_bit_shows(&closing_place_mm, 2));
    TEST_ASSERT_TRUE(each_bit_shows(&closing_foreseen_mm, 2));
    TEST_ASSERT_TRUE(each_bit_shows((void *)&closing_difference, sizeof closing_difference));
    TEST_ASSERT_TRUE(each_bit_shows((void *)&closing_smooth, sizeof closing_smooth));
}

static void test_the_check_sum_shows_ticks_and_readings(void)
{
    uint8_t before = brake_sum();

    brake_tick(false); /* the silence grows */
    TEST_ASSERT_NOT_EQUAL(before, brake_sum());
    before = brake_sum();
    brake_tick(true); /* and the override */
    TEST_ASSERT_NOT_EQUAL(before, brake_sum());
}

static void test_begun_anew_it_is_in_fault_and_leaves_it_with_three_good_readings(void)
{
    brake_begin_anew();
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STATE, fault_code);
    TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
    TEST_ASSERT_FALSE(brake.stop);
    echoes(4900, 2);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    echo(4900);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
}

static void test_begun_anew_it_brakes_no_less_than_before(void)
{
    uint8_t pct;

    approach(4000, 1300, 300);
    pct = brake.brake_pct;
    TEST_ASSERT_TRUE(pct > FAULT_PCT);
    brake_begin_anew();
    TEST_ASSERT_EQUAL_UINT8(pct, brake.brake_pct);
}

static void test_begun_anew_stop_goes_on_if_two_of_three_say_so(void)
{
    uint8_t wrong;

    for (wrong = 0; wrong < 3; wrong++) {
        start();
        echoes(900, 3);
        if (wrong == 0) {
            brake.stop = false;
        } else if (wrong == 1) {
            latch_twin = 0xFFU - LATCH_OPEN;
        } else {
            latch_state = LATCH_OPEN;
        }
        brake_begin_anew();
        TEST_ASSERT_TRUE(brake.stop);
        TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    }
}

static void test_begun_anew_one_of_three_is_no_stop(void)
{
    uint8_t wrong;

    for (wrong = 0; wrong < 3; wrong++) {
        start();
        if (wrong == 0) {
            brake.stop = true;
        } else if (wrong == 1) {
            latch_twin = 0xFFU - LATCH_HELD;
        } else {
            latch_state = LATCH_HELD;
        }
        brake_begin_anew();
        TEST_ASSERT_FALSE(brake.stop);
        TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
        TEST_ASSERT_TRUE(LATCH_IS_WHOLE());
    }
}

/* Through all states: STOP begins, is held, opens and ends. */
static void test_the_latch_has_a_twin(void)
{
    uint16_t mm;

    for (mm = 3000; mm > 900; mm -= 20) {
        echo(mm);
        TEST_ASSERT_TRUE(LATCH_IS_WHOLE());
    }
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
    for (; mm < 3000; mm += 20) {
        echo(mm);
        TEST_ASSERT_TRUE(LATCH_IS_WHOLE());
    }
    TEST_ASSERT_EQUAL_UINT8(LATCH_OPEN, latch_state);
    latch_hold();
    TEST_ASSERT_TRUE(LATCH_IS_WHOLE());
    latch_override();
    TEST_ASSERT_TRUE(LATCH_IS_WHOLE());
}

/* What has turned over stays visible, whatever the latch does then, and is no STOP. */
static void test_a_bit_of_the_latch_that_turns_over_shows(void)
{
    uint8_t bit;

    for (bit = 1; bit != 0; bit = (uint8_t)(bit << 1)) {
        start();
        echoes(3000, 3);
        latch_state ^= bit;
        brake_tick(false);
        TEST_ASSERT_FALSE(brake.stop);
        echoes(3000, 2);
        TEST_ASSERT_FALSE(LATCH_IS_WHOLE());
        start();
        echoes(3000, 3);
        latch_twin ^= bit;
        brake_tick(false);
        TEST_ASSERT_FALSE(brake.stop);
        echoes(3000, 2);
        TEST_ASSERT_FALSE(LATCH_IS_WHOLE());
    }
}

static void test_begun_anew_a_lasting_fault_lasts(void)
{
    brake_init(BRAKE_FAULT_RAM);
    brake_begin_anew();
    echoes(4900, 5);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
}

static void test_a_fault_that_turns_over_by_itself_brakes_at_the_next_tick(void)
{
    fault_state = FAULT_LASTING;
    brake_tick(false);
    TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
}

/* In the middle of all that can be going on. */
static void test_init_forgets_what_was_before(void)
{
    approach(3000, 900, 60);
    step_held = true;
    wait_cs(50);
    measure(RANGE_NOT_RISEN, 0);
    brake_init(BRAKE_FAULT_NONE);
    test_starts_released();
    TEST_ASSERT_EQUAL_UINT8(RANGE_NO_TARGET, range_reading.kind);
    wait_cs(BRAKE_OVERRIDE_CS - 1U);
    TEST_ASSERT_FALSE(brake.overridden);
    wait_cs(1);
    TEST_ASSERT_TRUE(brake.overridden);
}

static void test_a_fault_found_on_the_way_acts_at_once(void)
{
    brake_fail(BRAKE_FAULT_STACK);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    TEST_ASSERT_EQUAL_UINT8(FAULT_PCT, brake.brake_pct);
}

/* --- in the step itself, before brake_finish -------------------------------------------------- */

static void test_stop_comes_in_the_step_of_its_reading(void)
{
    brake_expect(PERIOD_CS);
    brake_step(RANGE_ECHO, BRAKE_STOP_MM + 1U);
    TEST_ASSERT_FALSE(brake.stop);
    brake_finish();
    brake_expect(PERIOD_CS);
    brake_step(RANGE_ECHO, BRAKE_STOP_MM);
    TEST_ASSERT_TRUE(brake.stop);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_STOP, brake.state);
}

static void test_stop_ends_in_the_step_of_its_last_reading(void)
{
    uint8_t i;

    stop_at_900();
    for (i = 1; i < LATCH_ROAD_READINGS; i++) {
        step(RANGE_NO_TARGET, 0, PERIOD_CS);
        TEST_ASSERT_TRUE(brake.stop);
    }
    step(RANGE_NO_TARGET, 0, PERIOD_CS);
    TEST_ASSERT_FALSE(brake.stop);
}

/* Until the next reading says otherwise. */
static void test_what_the_override_ended_does_not_come_back(void)
{
    stop_at_900();
    step_held = true;
    wait_cs(BRAKE_OVERRIDE_CS);
    step_held = false;
    wait_cs(1);
    TEST_ASSERT_FALSE(brake.overridden);
    TEST_ASSERT_FALSE(brake.stop);
}

/* --- the law's part --------------------------------------------------------------------------- */

static void test_a_target_that_comes_back_into_reach_is_looked_up_afresh(void)
{
    uint16_t mm;

    for (mm = 4900; mm <= 5300; mm += 40) {
        echo(mm);
    }
    TEST_ASSERT_EQUAL_UINT8(BRAKE_RELEASED, brake.state);
    for (mm = 5260; mm >= 4960; mm -= 50) {
        echo(mm);
    }
    TEST_ASSERT_EQUAL_UINT8((4960 - 1000) / 40, law_answer.row);
}

static void law_at(uint8_t worth, uint16_t dist_mm, uint16_t closing_mmps)
{
    closing_difference.closing_mmps = closing_mmps;
    closing_difference.opening_mmps = 0;
    law_step(worth, dist_mm);
}

/* One cell further or slower keeps the cell of a tracked target; a new one is not held at it. */
static void test_only_a_tracked_target_is_held_at_its_cell(void)
{
    law_restart();
    law_at(TARGET_TRACKED, 2020, 3000);
    TEST_ASSERT_EQUAL_UINT8(25, law_answer.row);
    TEST_ASSERT_EQUAL_UINT8(8, law_answer.col);
    law_at(TARGET_TRACKED, 2060, 2700);
    TEST_ASSERT_EQUAL_UINT8(25, law_answer.row);
    TEST_ASSERT_EQUAL_UINT8(8, law_answer.col);
    law_at(TARGET_NEW, 2100, 2400);
    TEST_ASSERT_EQUAL_UINT8(27, law_answer.row);
    TEST_ASSERT_EQUAL_UINT8(6, law_answer.col);
    TEST_ASSERT_TRUE(law_answer.brake_pct != 0);
    law_at(TARGET_ENTERED_LATE, 2100, 2400);
    TEST_ASSERT_EQUAL_UINT8(0, law_answer.brake_pct);
}

/* Where an echo is missing, the target is where it was foreseen: from 1024 mm/s on. */
static void test_a_missing_echo_of_an_approach_brakes_for_the_place_foreseen(void)
{
    uint8_t step_mm, raised = 0;
    uint16_t from_mm;

    for (step_mm = 60; step_mm <= 63; step_mm += 3) { /* 1000 and 1050 mm/s */
        for (from_mm = 4700; from_mm >= 2000; from_mm -= 90) {
            uint16_t next_mm = from_mm - 4U * step_mm;
            uint8_t wanted_pct;

            start();
            approach(from_mm, next_mm + step_mm, step_mm);
            wanted_pct = brake.brake_pct;
            measure(RANGE_NOT_RISEN, 0);
            if (step_mm == 63 && lut_at((uint8_t)((next_mm - 1000U) / 40U), 3) > wanted_pct) {
                wanted_pct = lut_at((uint8_t)((next_mm - 1000U) / 40U), 3);
                raised++;
            }
            TEST_ASSERT_EQUAL_UINT8(wanted_pct, brake.brake_pct);
        }
    }
    TEST_ASSERT_TRUE(raised > 10);
}

/* --- the law in FAULT ------------------------------------------------------------------------- */

/* In 2 m at 3 m/s the law wants more than FAULT_PCT; in a lasting fault it is not asked. */
static void test_fault_lets_the_law_brake_harder_unless_it_lasts(void)
{
    uint8_t lasts;

    for (lasts = 0; lasts <= 1; lasts++) {
        uint8_t i;

        start();
        brake_init(lasts ? BRAKE_FAULT_TABLE : BRAKE_FAULT_WATCHDOG);
        echo(2540);
        echo(2360);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
        TEST_ASSERT_TRUE(lut_at(34, 8) > FAULT_PCT);
        TEST_ASSERT_EQUAL_UINT8(lasts ? FAULT_PCT : lut_at(34, 8), brake.brake_pct);
        TEST_ASSERT_EQUAL_UINT8(!lasts, brake.warn);
        for (i = 0; i < 2; i++) {
            measure(RANGE_NOT_RISEN, 0);
        }
        TEST_ASSERT_TRUE(lasts ? brake.brake_pct == FAULT_PCT : brake.brake_pct > lut_at(34, 8));
    }
}

/* --- the warning, as warning.h says it -------------------------------------------------------- */

static void test_warns_of_what_is_so_in_a_second(void)
{
    uint16_t mm;
    uint8_t step_mm;

    for (step_mm = 20; step_mm <= 150; step_mm += 10) {
        for (mm = 1100; mm <= 6000 - step_mm; mm += 70) {
            uint16_t mmps, ahead_mm;
            bool is_hard;

            start();
            step(RANGE_ECHO, mm + step_mm, PERIOD_CS);
            step(RANGE_ECHO, mm, PERIOD_CS);
            mmps = closing_smooth.closing_mmps;
            ahead_mm = mm > mmps ? mm - mmps : 0;
            is_hard = ahead_mm <= 1000 ||
                      (ahead_mm <= 5000 &&
                       lut_at(ahead_mm == 5000 ? 99 : (uint8_t)((ahead_mm - 1000U) / 40U),
                              (uint8_t)(mmps / 350U)) >= 60);
            if (brake.warn != is_hard) {
                SWEEP_FAIL(mm, "warned, or not, at this distance in mm");
            }
        }
    }
}

static void test_warns_from_300_mmps_on(void)
{
    echo(1318);
    echo(1300);
    TEST_ASSERT_EQUAL_UINT16(300, closing_smooth.closing_mmps);
    TEST_ASSERT_TRUE(brake.warn);
}

static void test_a_clear_reading_is_no_reason_to_warn(void)
{
    approach(5000, 4700, 60);
    TEST_ASSERT_FALSE(brake.warn);
    measure(RANGE_NO_TARGET, 0);
    TEST_ASSERT_FALSE(brake.warn);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_starts_released);
    RUN_TEST(test_no_target_stays_released_for_ever);
    RUN_TEST(test_each_distance_gets_its_row_and_from_the_second_reading_on_the_cell);
    RUN_TEST(test_what_passes_in_one_reading_is_not_braked_for);
    RUN_TEST(test_the_second_reading_brakes);
    RUN_TEST(test_each_speed_gets_its_column);
    RUN_TEST(test_opening_counts_as_no_closing);
    RUN_TEST(test_brake_never_falls_while_the_gap_shrinks);
    RUN_TEST(test_noise_of_two_rows_and_columns_does_not_move_the_brake);
    RUN_TEST(test_target_that_hovers_at_the_far_end_is_kept);
    RUN_TEST(test_first_reading_at_one_metre_stops_at_once);
    RUN_TEST(test_stop_holds_at_a_noisy_metre);
    RUN_TEST(test_stop_lets_go_of_a_target_that_drives_off);
    RUN_TEST(test_stop_holds_a_target_that_opens_too_slowly);
    RUN_TEST(test_two_opening_readings_must_follow_each_other);
    RUN_TEST(test_override_held_a_second_lets_go_and_no_sooner);
    RUN_TEST(test_a_start_forgets_the_override);
    RUN_TEST(test_override_works_only_while_held);
    RUN_TEST(test_an_override_held_for_30_s_is_stuck_until_it_is_released);
    RUN_TEST(test_a_short_press_changes_nothing);
    RUN_TEST(test_glitch_on_a_clear_road_stops_for_two_periods);
    RUN_TEST(test_glitch_below_a_tracked_target_stops_for_one_period);
    RUN_TEST(test_glitch_before_the_first_echo_is_dropped_after_two_readings);
    RUN_TEST(test_glitch_away_from_a_braked_target_moves_nothing);
    RUN_TEST(test_a_second_reading_within_the_metre_makes_stop_sure);
    RUN_TEST(test_a_tracked_approach_makes_stop_sure_at_once);
    RUN_TEST(test_a_missing_reading_never_lowers_the_brake);
    RUN_TEST(test_fault_comes_between_180_and_190_ms_of_silence);
    RUN_TEST(test_two_missing_readings_are_no_fault);
    RUN_TEST(test_fault_never_lowers_a_higher_brake);
    RUN_TEST(test_fault_keeps_a_stop);
    RUN_TEST(test_stop_works_in_fault);
    RUN_TEST(test_three_good_readings_in_a_row_leave_fault);
    RUN_TEST(test_a_clear_road_leaves_fault_too);
    RUN_TEST(test_a_vanished_near_target_is_gone_after_1200_ms);
    RUN_TEST(test_a_near_target_does_not_vanish_while_the_sensor_comes_and_goes);
    RUN_TEST(test_a_far_target_may_leave_after_some_clear_readings);
    RUN_TEST(test_readings_that_jump_about_are_a_fault);
    RUN_TEST(test_the_same_reading_while_closing_is_stuck);
    RUN_TEST(test_the_same_reading_at_rest_is_fine);
    RUN_TEST(test_a_car_at_rest_ends_every_fault);
    RUN_TEST(test_stop_ends_on_a_clear_road);
    RUN_TEST(test_stop_ends_before_another_target);
    RUN_TEST(test_a_missing_second_reading_does_not_interrupt_stop);
    RUN_TEST(test_two_missing_echoes_after_two_readings_hold_the_brake);
    RUN_TEST(test_a_lone_stray_echo_lets_go_within_half_a_second);
    RUN_TEST(test_the_warning_ends_with_the_target_and_in_fault);
    RUN_TEST(test_a_driver_can_leave_a_fault);
    RUN_TEST(test_a_watchdog_reset_starts_braking_and_ends_with_three_good_readings);
    RUN_TEST(test_a_failed_self_test_lasts_but_still_stops);
    RUN_TEST(test_a_fault_found_on_the_way_lasts);
    RUN_TEST(test_a_pwm_pin_that_does_not_follow_is_stop);
    RUN_TEST(test_warning_comes_800_ms_before_hard_braking_or_with_the_second_reading);
    RUN_TEST(test_no_warning_while_nothing_closes);
    RUN_TEST(test_warning_ends_half_a_second_after_its_reason);
    RUN_TEST(test_a_missing_echo_of_a_target_beyond_reach_brakes_nothing);
    RUN_TEST(test_a_target_that_slows_down_is_followed_two_columns_behind);
    RUN_TEST(test_the_check_sum_shows_each_bit_that_turns_over);
    RUN_TEST(test_the_check_sum_shows_ticks_and_readings);
    RUN_TEST(test_begun_anew_it_is_in_fault_and_leaves_it_with_three_good_readings);
    RUN_TEST(test_begun_anew_it_brakes_no_less_than_before);
    RUN_TEST(test_begun_anew_stop_goes_on_if_two_of_three_say_so);
    RUN_TEST(test_begun_anew_one_of_three_is_no_stop);
    RUN_TEST(test_the_latch_has_a_twin);
    RUN_TEST(test_a_bit_of_the_latch_that_turns_over_shows);
    RUN_TEST(test_begun_anew_a_lasting_fault_lasts);
    RUN_TEST(test_a_fault_that_turns_over_by_itself_brakes_at_the_next_tick);
    RUN_TEST(test_init_forgets_what_was_before);
    RUN_TEST(test_a_fault_found_on_the_way_acts_at_once);
    RUN_TEST(test_stop_comes_in_the_step_of_its_reading);
    RUN_TEST(test_stop_ends_in_the_step_of_its_last_reading);
    RUN_TEST(test_what_the_override_ended_does_not_come_back);
    RUN_TEST(test_a_target_that_comes_back_into_reach_is_looked_up_afresh);
    RUN_TEST(test_only_a_tracked_target_is_held_at_its_cell);
    RUN_TEST(test_a_missing_echo_of_an_approach_brakes_for_the_place_foreseen);
    RUN_TEST(test_fault_lets_the_law_brake_harder_unless_it_lasts);
    RUN_TEST(test_warns_of_what_is_so_in_a_second);
    RUN_TEST(test_warns_from_300_mmps_on);
    RUN_TEST(test_a_clear_reading_is_no_reason_to_warn);
    return UNITY_END();
}
