/* SPDX-License-Identifier: MIT */
/* The brake behind a TF-Luna: 100 readings a second, and the times of target.h, latch.h, fault.h
 * and ease.h are the same as with the sensor of 60 ms. */
#define SENSOR_tfluna
#define ESTIMATOR_smooth
#define BRAKE_RISE_PCT 3U
#include <stddef.h>
#include "unity.h"
#include "lut.c" /* first: it takes the table's data */
#undef LUT_DATA
#include "cell.c"
#include "closing_tfluna.c"
#undef RATE
#include "ease.c"
#include "law_tuned.c"
#include "brake.c"
#include "target.c"
#include "fault.c"
#undef FAULT
#include "latch.c"
#include "warning.c"
#include "cells.h"

static uint16_t place_mm;

/* One period of the sensor, as main.c takes it: what is due is expected, the tick, the reading. */
static void look(uint8_t kind, uint16_t dist_mm)
{
    brake_expect(RANGE_PERIOD_CS);
    brake_tick(false);
    brake_step(kind, dist_mm);
    brake_finish();
}

static void clear(uint8_t readings)
{
    for (; readings != 0; readings--) {
        look(RANGE_NO_TARGET, 0);
    }
}

static void echo(uint16_t dist_mm)
{
    place_mm = dist_mm;
    look(RANGE_ECHO, dist_mm);
}

/* A frame is lost. */
static void lost(uint8_t readings)
{
    for (; readings != 0; readings--) {
        brake_expect(RANGE_PERIOD_CS);
        brake_tick(false);
    }
}

/* So many readings of a target, each so much nearer than the one before. */
static void approach(int16_t step_mm, uint8_t readings)
{
    for (; readings != 0; readings--) {
        echo((uint16_t)(place_mm - step_mm));
    }
}

/* From that place on until it is tracked. */
static void track(uint16_t from_mm, int16_t step_mm)
{
    echo(from_mm);
    approach(step_mm, 20);
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
}

void setUp(void)
{
    brake_init(BRAKE_FAULT_NONE);
}

void tearDown(void)
{
}

/* --- a target --------------------------------------------------------------------------------- */

/* The second place is 60 ms after the first: in 10 ms a step of 1 cm would be 1 m/s. */
static void test_a_speed_needs_60_ms(void)
{
    uint8_t i;

    echo(5000);
    for (i = 1; i < 6; i++) {
        approach(50, 1);
        TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
        TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
    }
    approach(50, 1);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_UINT16_WITHIN(8, 5000, closing_smooth.closing_mmps);
    approach(50, 1);
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
}

static void test_an_echo_after_a_clear_road_has_entered_and_one_after_a_lost_frame_has_not(void)
{
    clear(1);
    echo(7900);
    TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED, target_worth);
    setUp();
    clear(1);
    lost(1);
    echo(7900);
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
}

static void test_lost_frames_do_not_lose_a_target(void)
{
    uint8_t frames;

    for (frames = 1; frames <= 15; frames++) {
        setUp();
        track(7000, 80);
        lost(frames);
        echo((uint16_t)(place_mm - 80 * (frames + 1)));
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
        TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
        TEST_ASSERT_UINT16_WITHIN(100, 8000, closing_smooth.closing_mmps);
    }
}

/* The two readings' places are as far apart as wheels can bring them in 60 ms. */
static void test_one_stray_frame_leaves_the_target_alone(void)
{
    track(6000, 50);
    look(RANGE_ECHO, 3000);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, fault_code);
    echo((uint16_t)(place_mm - 100));
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
}

static void test_another_target_takes_over_after_60_ms(void)
{
    uint8_t i;

    track(7000, 0);
    for (i = 0; i < 6; i++) {
        look(RANGE_ECHO, 3000);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, fault_code);
        TEST_ASSERT_EQUAL_UINT16(7000, closing_place_mm);
    }
    look(RANGE_ECHO, 3000);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_EQUAL_UINT16(3000, closing_place_mm);
}

/* An echo that fits neither of them is the one aside from then on. */
static void test_the_echo_aside_is_exchanged_for_one_that_it_cannot_have_become(void)
{
    track(7000, 0);
    look(RANGE_ECHO, 3000);
    look(RANGE_ECHO, 5000);
    TEST_ASSERT_EQUAL_UINT16(5000, aside_mm);
    look(RANGE_ECHO, 5000);
    TEST_ASSERT_EQUAL_UINT16(5000, aside_mm);
    TEST_ASSERT_EQUAL_UINT8(1, since_aside_cs);
    lost(7);
    look(RANGE_ECHO, 6500); /* no wheels bring it there in 80 ms */
    TEST_ASSERT_EQUAL_UINT16(6500, aside_mm);
}

/* The same 60 ms later, where two places so far apart could tell a speed. */
static void test_after_60_ms_an_echo_that_fits_neither_takes_the_place_aside(void)
{
    echo(7000);
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
    look(RANGE_ECHO, 3000);
    TEST_ASSERT_EQUAL_UINT16(3000, aside_mm);
    lost(4);
    look(RANGE_ECHO, 2000); /* as far as wheels can bring it in 50 ms, but an echo aside is there */
    TEST_ASSERT_EQUAL_UINT16(3000, aside_mm);
    look(RANGE_ECHO, 2000);
    TEST_ASSERT_EQUAL_UINT16(2000, aside_mm);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, fault_code);
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
}

static void test_what_came_back_after_a_clear_reading_tells_its_speed_after_60_ms(void)
{
    clear(1);
    echo(5000);
    clear(1);
    echo(4900);
    TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED, target_worth);
    clear(1);
    lost(2);
    clear(1);
    echo(4700);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW_LATE, target_worth);
    TEST_ASSERT_UINT16_WITHIN(8, 300000U / 7U / 10U, closing_smooth.closing_mmps);
}

/* --- the times of clear roads ----------------------------------------------------------------- */

/* How many clear readings end the target. */
static uint8_t clears_that_end(void)
{
    uint8_t readings = 0;

    while (target_worth != TARGET_NONE && readings < 255U) {
        clear(1);
        readings++;
    }
    return readings;
}

static void test_clear_roads_end_a_target_after_the_same_times(void)
{
    echo(3000);
    TEST_ASSERT_EQUAL_UINT8(12, clears_that_end());
    setUp();
    track(7000, 0);
    TEST_ASSERT_EQUAL_UINT8(24, clears_that_end());
}

static void test_a_near_target_is_lost_for_1200_ms(void)
{
    uint8_t i;

    track(3000, 0);
    for (i = 1; i < 120; i++) {
        clear(1);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_LOST, fault_code);
    }
    TEST_ASSERT_TRUE(was_near);
    clear(1);
    TEST_ASSERT_FALSE(was_near);
}

static void test_fault_comes_after_180_ms_without_a_believed_reading(void)
{
    track(3000, 0);
    clear(17);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
    clear(2);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
}

static void test_180_ms_of_good_readings_end_fault(void)
{
    uint8_t i;

    brake_init(BRAKE_FAULT_WATCHDOG);
    for (i = 0; i < 17; i++) {
        echo(3000);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    }
    echo(3000);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_CONTROL, brake.state);
}

/* --- stuck ------------------------------------------------------------------------------------ */

/* At 2 m/s the sensor says the same place again and again for 5 readings. */
static void test_a_slow_target_is_not_stuck(void)
{
    uint8_t i, k;

    echo(4000);
    for (i = 0; i < 60; i++) {
        for (k = 0; k < 5; k++) {
            echo(place_mm);
            TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
        }
        place_mm -= 10;
    }
}

/* The same reading is stuck once the target should have come 123 mm. */
static void test_the_same_reading_of_a_moving_target_is_stuck(void)
{
    uint8_t i;
    int16_t step;

    for (step = 20; step <= 80; step += 20) {
        setUp();
        track(7500, step);
        for (i = 0; fault_code == BRAKE_FAULT_NONE && i < 20; i++) {
            echo(place_mm);
        }
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, fault_code);
        TEST_ASSERT_INT16_WITHIN(step + 25, 123, (int16_t)(i * step));
    }
}

static void test_a_stuck_target_that_moves_on_is_another_one(void)
{
    track(7500, 50);
    while (fault_code != BRAKE_FAULT_STUCK) {
        echo(place_mm);
    }
    approach(10, 1);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
    TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
}

/* It would have gone further than a byte can count. */
static void test_a_target_that_is_lost_for_long_is_stuck_when_it_comes_back_to_its_place(void)
{
    track(7500, 120);
    lost(25);
    echo(place_mm);
    TEST_ASSERT_EQUAL_UINT8(255, run_way);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, fault_code);
}

static void test_how_far_it_should_have_come_is_speed_times_time(void)
{
    static const struct {
        uint8_t speed, way, time_cs, sum;
    } cases[] = {{47, 0, 1, 47},  {48, 0, 1, 48},   {12, 24, 2, 48},
                 {51, 0, 5, 255}, {128, 0, 2, 255}, {255, 255, 9, 255}};
    uint8_t i;

    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        has_changed = false;
        run_speed = cases[i].speed;
        run_way = cases[i].way;
        TEST_ASSERT_EQUAL(cases[i].sum >= TARGET_STUCK_WAY, has_come_far(cases[i].time_cs));
        TEST_ASSERT_EQUAL_UINT8(cases[i].sum, run_way);
    }
}

static void test_another_reading_begins_the_way_anew(void)
{
    track(7000, 50);
    closing_difference.closing_mmps = 0x1334;
    closing_smooth.closing_mmps = 0x1234;
    has_changed = true;
    run_speed = run_way = 9;
    (void)has_come_far(1);
    TEST_ASSERT_FALSE(has_changed);
    TEST_ASSERT_EQUAL_UINT8(0x12, run_speed);
    TEST_ASSERT_EQUAL_UINT8(0x12, run_way);
    closing_smooth.closing_mmps = 0;
    closing_smooth.opening_mmps = 0x1534;
    has_changed = true;
    (void)has_come_far(1);
    TEST_ASSERT_EQUAL_UINT8(0x15, run_speed);
    closing_smooth.opening_mmps = 0; /* it may have come to rest */
    has_changed = true;
    TEST_ASSERT_FALSE(has_come_far(200));
    TEST_ASSERT_EQUAL_UINT8(0, run_speed);
    TEST_ASSERT_EQUAL_UINT8(0, run_way);
    drop();
    TEST_ASSERT_TRUE(has_changed);
}

static void test_a_stuck_reading_lasts_for_its_readings(void)
{
    track(7500, 50);
    while (fault_code != BRAKE_FAULT_STUCK) {
        echo(place_mm);
    }
    TEST_ASSERT_EQUAL_UINT8(TARGET_REST_READINGS, stuck_readings);
    echo(place_mm);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, fault_code);
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
}

static void test_no_time_counts_as_one_hundredth_of_a_second(void)
{
    track(7000, 0);
    TEST_ASSERT_EQUAL_UINT8(0, since_cs);
    target_expect(0);
    TEST_ASSERT_EQUAL_UINT8(1, since_cs);
    target_expect(1);
    TEST_ASSERT_EQUAL_UINT8(2, since_cs);
}

/* --- STOP ------------------------------------------------------------------------------------- */

static void test_the_first_frame_within_a_metre_stops_at_once(void)
{
    clear(5);
    echo(BRAKE_STOP_MM);
    TEST_ASSERT_TRUE(brake.stop);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
}

/* A lone frame within a metre, on a clear road, as two of the HC-SR04's periods: 120 ms. */
static void test_a_lone_stray_frame_is_stop_for_120_ms(void)
{
    uint8_t readings = 0;

    clear(5);
    echo(800);
    while (brake.stop && readings < 100) {
        clear(1);
        readings++;
    }
    TEST_ASSERT_EQUAL_UINT8(12, readings);
}

/* A stray echo of three frames is still one. */
static void test_a_short_stray_echo_is_not_confirmed(void)
{
    clear(5);
    echo(800);
    echo(800);
    echo(1200);
    TEST_ASSERT_EQUAL_UINT8(LATCH_TRIAL, latch_state);
    clear(4);
    TEST_ASSERT_EQUAL_UINT8(LATCH_DOUBTED, latch_state);
    look(RANGE_ECHO, 7000);
    TEST_ASSERT_EQUAL_UINT8(LATCH_DOUBTED, latch_state);
    clear(5);
    TEST_ASSERT_FALSE(brake.stop);
}

static void test_an_echo_60_ms_later_confirms_stop(void)
{
    clear(5);
    echo(800);
    clear(5);
    echo(800);
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
    setUp();
    echo(800);
    clear(7);
    TEST_ASSERT_EQUAL_UINT8(LATCH_DOUBTED, latch_state);
    echo(800);
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
}

static void test_a_tracked_target_ends_a_stray_stop_at_once(void)
{
    track(3000, 0);
    look(RANGE_ECHO, 800);
    TEST_ASSERT_TRUE(brake.stop);
    echo(3000);
    TEST_ASSERT_FALSE(brake.stop);
}

/* STOP is held, and the target creeps away to 1.35 m. */
static void stop_and_creep(void)
{
    setUp();
    track(1900, 30);
    approach(30, 15);
    TEST_ASSERT_TRUE(brake.stop);
    approach(-1, 250);
    approach(-1, 250);
    TEST_ASSERT_TRUE(brake.stop);
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
}

/* Opening for 60 ms moves HELD to OPENING, and the next such reading ends it. */
static void test_stop_ends_when_the_gap_opens_for_60_ms(void)
{
    uint8_t readings = 0;

    stop_and_creep();
    while (brake.stop && readings < 100) {
        approach(-5, 1);
        if (closing_smooth.opening_mmps > LATCH_OPENING_MMPS) {
            readings++;
        }
    }
    TEST_ASSERT_EQUAL_UINT8(LATCH_OPENING_READINGS + 1U, readings);
}

static void test_a_slow_reading_between_begins_the_60_ms_anew(void)
{
    uint8_t i;

    stop_and_creep();
    for (i = 0; opening_readings < LATCH_OPENING_READINGS - 1U && i < 100; i++) {
        approach(-5, 1);
    }
    closing_smooth.opening_mmps = LATCH_OPENING_MMPS;
    latch_take(true);
    TEST_ASSERT_EQUAL_UINT8(0, opening_readings);
    TEST_ASSERT_TRUE(brake.stop);
}

static void test_stop_ends_after_two_seconds_of_clear_road(void)
{
    track(1900, 30);
    approach(30, 15);
    clear(199);
    TEST_ASSERT_TRUE(brake.stop);
    clear(1);
    TEST_ASSERT_FALSE(brake.stop);
}

/* --- the law ---------------------------------------------------------------------------------- */

/* A target that entered gets more brake with each frame. */
static void test_what_enters_brakes_more_and_more(void)
{
    uint8_t i, before_pct = 0;

    clear(3);
    place_mm = 8000;
    for (i = 0; i < 6; i++) {
        approach(85, 1);
        TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED, target_worth);
        TEST_ASSERT_TRUE(brake.brake_pct >= before_pct);
        before_pct = brake.brake_pct;
    }
    TEST_ASSERT_TRUE(before_pct > 0);
    approach(85, 1);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_TRUE(brake.brake_pct >= before_pct);
}

/* Above 60 % the demand rises by 3 % a reading, whatever the law says. */
static void test_the_demand_rises_gently_above_60_pct(void)
{
    uint8_t before_pct, readings;

    clear(3);
    place_mm = 8000;
    for (readings = 0; brake.brake_pct < 100U && readings < 80U; readings++) {
        before_pct = brake.brake_pct;
        approach(90, 1);
        TEST_ASSERT_TRUE(brake.brake_pct <= BRAKE_SUDDEN_PCT ||
                         brake.brake_pct <= before_pct + BRAKE_RISE_PCT);
    }
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
}

static void test_the_rise_has_its_limits(void)
{
    static const struct {
        uint8_t now_pct, wanted_pct, pct;
    } cases[] = {{0, 100, 60},  {0, 60, 60},   {0, 61, 60},    {56, 100, 60},
                 {57, 100, 60}, {58, 100, 61}, {90, 100, 93},  {90, 93, 93},
                 {90, 92, 92},  {90, 10, 10},  {100, 100, 100}};
    uint8_t i;

    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        demand_pct = cases[i].now_pct;
        TEST_ASSERT_EQUAL_UINT8(cases[i].pct, rising(cases[i].wanted_pct));
    }
}

/* A target is in reach up to 8 m, and from then on up to 8.08 m. */
static void test_a_target_is_in_reach_up_to_8_m(void)
{
    echo(8001);
    TEST_ASSERT_FALSE(is_in_reach);
    echo(8000);
    TEST_ASSERT_TRUE(is_in_reach);
    echo(8080);
    TEST_ASSERT_TRUE(is_in_reach);
    echo(8081);
    TEST_ASSERT_FALSE(is_in_reach);
}

/* 1.92 s at a constant gap, then 1 % each 60 ms up to the hold. */
static void test_a_car_that_stands_is_held_after_the_same_time(void)
{
    uint8_t still = (uint8_t)EASE_STILL_READINGS, i;

    ease_restart();
    closing_smooth.closing_mmps = 0;
    closing_smooth.opening_mmps = 0;
    TEST_ASSERT_EQUAL_UINT8(192, still);
    for (i = 0; i < still; i++) {
        TEST_ASSERT_EQUAL_UINT8(1, ease_pct(7, 3000));
    }
    for (i = 1; i <= EASE_HOLD_PCT; i++) {
        uint8_t k;

        ease_pct(7, 3000);
        TEST_ASSERT_EQUAL_UINT8(i, hold_pct);
        for (k = 1; k < 6; k++) {
            ease_pct(7, 3000);
            TEST_ASSERT_EQUAL_UINT8(i, hold_pct);
        }
    }
    TEST_ASSERT_EQUAL_UINT8(EASE_HOLD_PCT, ease_pct(7, 3000));
}

/* --- counts of the latch and the warning ------------------------------------------------------ */

static void test_a_beginning_forgets_the_counts(void)
{
    clear_readings = elsewhere_readings = opening_readings = early_readings = 3;
    latch_init();
    TEST_ASSERT_EQUAL_UINT8(0, clear_readings);
    TEST_ASSERT_EQUAL_UINT8(0, elsewhere_readings);
    TEST_ASSERT_EQUAL_UINT8(0, opening_readings);
    TEST_ASSERT_EQUAL_UINT8(0, early_readings);
}

static void see(uint16_t dist_mm, bool is_of_target)
{
    range_reading.kind = RANGE_ECHO;
    range_reading.dist_mm = dist_mm;
    latch_take(is_of_target);
}

static void test_a_near_echo_begins_the_opening_anew(void)
{
    opening_readings = 3;
    see(LATCH_NEAR_MM, true);
    TEST_ASSERT_EQUAL_UINT8(0, opening_readings);
}

static void test_a_target_opens_when_it_is_faster_than_the_limit_in_six_readings(void)
{
    uint8_t i;

    closing_smooth.opening_mmps = LATCH_OPENING_MMPS + 1U;
    for (i = 1; i < 20; i++) {
        TEST_ASSERT_EQUAL(i >= 6, is_opening());
    }
    closing_smooth.opening_mmps = LATCH_OPENING_MMPS;
    TEST_ASSERT_FALSE(is_opening());
    closing_smooth.opening_mmps = LATCH_OPENING_MMPS + 1U;
    TEST_ASSERT_FALSE(is_opening());
}

/* OPENING has no time in which a stray echo is left out. */
static void test_another_echo_ends_opening_at_once(void)
{
    latch_state = LATCH_OPENING;
    latch_twin = (uint8_t)~LATCH_OPENING;
    early_readings = 3;
    see(3000, false);
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
}

static void test_another_target_ends_stop_with_its_hundredth_reading(void)
{
    uint8_t i;

    latch_hold();
    target_worth = TARGET_NEW;
    for (i = 1; i < 100; i++) {
        see(3000, true);
        TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
    }
    see(3000, true);
    TEST_ASSERT_EQUAL_UINT8(LATCH_OPEN, latch_state);
}

static void test_a_warning_lasts_half_a_second(void)
{
    uint8_t i;

    target_worth = TARGET_TRACKED;
    TEST_ASSERT_TRUE(warning_take(true));
    for (i = 1; i < 50; i++) {
        TEST_ASSERT_TRUE(warning_take(false));
    }
    TEST_ASSERT_FALSE(warning_take(false));
}

/* --- table ------------------------------------------------------------------------------------ */

static void test_every_distance_and_speed_lies_in_its_cell(void)
{
    check_cells();
}

/* Within 1/16 s, from where the table ends. */
static void test_a_target_that_entered_came_from_where_the_table_ends(void)
{
    uint16_t way_mm;

    for (way_mm = 1; way_mm <= LAW_TUNED_FIRST_MM; way_mm++) {
        law_step(TARGET_ENTERED, (uint16_t)(8000U - way_mm));
        TEST_ASSERT_EQUAL_UINT8(cell_col((uint16_t)(16U * way_mm), 0), law_answer.col);
    }
}

/* --- sums ------------------------------------------------------------------------------------- */

/* Bytes of what must not change between two readings. */
static const struct {
    void *place;
    uint8_t bytes;
} KEPT[] = {
    {(void *)&demand_pct, sizeof demand_pct},
    {(void *)&override_cs, sizeof override_cs},
    {(void *)&since_cs, sizeof since_cs},
    {(void *)&since_aside_cs, sizeof since_aside_cs},
    {(void *)&aside_mm, sizeof aside_mm},
    {(void *)&stuck_readings, sizeof stuck_readings},
    {(void *)&clears, sizeof clears},
    {(void *)&latch_state, sizeof latch_state},
    {(void *)&clear_readings, sizeof clear_readings},
    {(void *)&elsewhere_readings, sizeof elsewhere_readings},
    {(void *)&run_speed, sizeof run_speed},
    {(void *)&run_way, sizeof run_way},
    {(void *)&opening_readings, sizeof opening_readings},
    {(void *)&early_readings, sizeof early_readings},
};

/* Turns over each bit of them, one after the other. */
static void expect_each_bit_in_the_sum(void)
{
    uint8_t sum = brake_sum(), i, k, bit;

    for (i = 0; i < sizeof KEPT / sizeof KEPT[0]; i++) {
        uint8_t *byte = KEPT[i].place;

        for (k = 0; k < KEPT[i].bytes; k++) {
            for (bit = 1; bit != 0; bit = (uint8_t)(bit << 1)) {
                byte[k] ^= bit;
                TEST_ASSERT_TRUE(brake_sum() != sum);
                byte[k] ^= bit;
            }
        }
    }
}

/* Whatever the other bits are. */
static void test_each_bit_changes_the_sum(void)
{
    uint8_t round, i, k, chance = 1;

    for (round = 0; round < 8; round++) {
        for (i = 0; i < sizeof KEPT / sizeof KEPT[0]; i++) {
            uint8_t *byte = KEPT[i].place;

            for (k = 0; k < KEPT[i].bytes; k++) {
                chance = (uint8_t)(chance * 5U + 29U);
                byte[k] = chance;
            }
        }
        expect_each_bit_in_the_sum();
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_speed_needs_60_ms);
    RUN_TEST(test_an_echo_after_a_clear_road_has_entered_and_one_after_a_lost_frame_has_not);
    RUN_TEST(test_lost_frames_do_not_lose_a_target);
    RUN_TEST(test_one_stray_frame_leaves_the_target_alone);
    RUN_TEST(test_another_target_takes_over_after_60_ms);
    RUN_TEST(test_the_echo_aside_is_exchanged_for_one_that_it_cannot_have_become);
    RUN_TEST(test_after_60_ms_an_echo_that_fits_neither_takes_the_place_aside);
    RUN_TEST(test_what_came_back_after_a_clear_reading_tells_its_speed_after_60_ms);
    RUN_TEST(test_clear_roads_end_a_target_after_the_same_times);
    RUN_TEST(test_a_near_target_is_lost_for_1200_ms);
    RUN_TEST(test_fault_comes_after_180_ms_without_a_believed_reading);
    RUN_TEST(test_180_ms_of_good_readings_end_fault);
    RUN_TEST(test_a_slow_target_is_not_stuck);
    RUN_TEST(test_the_same_reading_of_a_moving_target_is_stuck);
    RUN_TEST(test_a_stuck_target_that_moves_on_is_another_one);
    RUN_TEST(test_a_target_that_is_lost_for_long_is_stuck_when_it_comes_back_to_its_place);
    RUN_TEST(test_how_far_it_should_have_come_is_speed_times_time);
    RUN_TEST(test_another_reading_begins_the_way_anew);
    RUN_TEST(test_a_stuck_reading_lasts_for_its_readings);
    RUN_TEST(test_no_time_counts_as_one_hundredth_of_a_second);
    RUN_TEST(test_the_first_frame_within_a_metre_stops_at_once);
    RUN_TEST(test_a_lone_stray_frame_is_stop_for_120_ms);
    RUN_TEST(test_a_short_stray_echo_is_not_confirmed);
    RUN_TEST(test_an_echo_60_ms_later_confirms_stop);
    RUN_TEST(test_a_tracked_target_ends_a_stray_stop_at_once);
    RUN_TEST(test_stop_ends_when_the_gap_opens_for_60_ms);
    RUN_TEST(test_a_slow_reading_between_begins_the_60_ms_anew);
    RUN_TEST(test_stop_ends_after_two_seconds_of_clear_road);
    RUN_TEST(test_what_enters_brakes_more_and_more);
    RUN_TEST(test_the_demand_rises_gently_above_60_pct);
    RUN_TEST(test_the_rise_has_its_limits);
    RUN_TEST(test_a_target_is_in_reach_up_to_8_m);
    RUN_TEST(test_a_car_that_stands_is_held_after_the_same_time);
    RUN_TEST(test_a_beginning_forgets_the_counts);
    RUN_TEST(test_a_near_echo_begins_the_opening_anew);
    RUN_TEST(test_a_target_opens_when_it_is_faster_than_the_limit_in_six_readings);
    RUN_TEST(test_another_echo_ends_opening_at_once);
    RUN_TEST(test_another_target_ends_stop_with_its_hundredth_reading);
    RUN_TEST(test_a_warning_lasts_half_a_second);
    RUN_TEST(test_every_distance_and_speed_lies_in_its_cell);
    RUN_TEST(test_a_target_that_entered_came_from_where_the_table_ends);
    RUN_TEST(test_each_bit_changes_the_sum);
    return UNITY_END();
}
