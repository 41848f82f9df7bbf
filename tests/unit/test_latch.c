/* SPDX-License-Identifier: MIT */
/* latch: each row and column of the table in latch.h; what makes a column. */
#include <stddef.h>
#include "unity.h"
#include "latch.h"
#include "target.h"

void setUp(void)
{
    latch_init();
    target_worth = TARGET_TRACKED;
    closing_smooth.closing_mmps = 0;
    closing_smooth.opening_mmps = 0;
}

void tearDown(void)
{
}

static void be_in(uint8_t state)
{
    latch_state = state;
    latch_twin = (uint8_t)~state;
}

static void take(uint8_t kind, uint16_t dist_mm, bool is_believed)
{
    range_reading.kind = kind;
    range_reading.dist_mm = dist_mm;
    latch_take(is_believed);
}

static void echo(uint16_t dist_mm)
{
    take(RANGE_ECHO, dist_mm, true);
}

static void clear(uint8_t count)
{
    while (count-- != 0) {
        take(RANGE_NO_TARGET, 0, true);
    }
}

/* Events, one for each column but `passed` and `road`. */
static void override(void)
{
    latch_override();
}

static void within(void)
{
    take(RANGE_ECHO, BRAKE_STOP_MM, false);
}

static void within_tracked(void)
{
    echo(BRAKE_STOP_MM);
}

static void near_by(void)
{
    echo(BRAKE_STOP_MM + 1U);
}

static void at_near_end(void)
{
    echo(LATCH_NEAR_MM);
}

static void opening(void)
{
    closing_smooth.opening_mmps = LATCH_OPENING_MMPS + 1U;
    echo(LATCH_NEAR_MM + 1U);
}

static void beyond(void)
{
    closing_smooth.opening_mmps = LATCH_OPENING_MMPS + 1U; /* of another target */
    take(RANGE_ECHO, LATCH_NEAR_MM + 1U, false);
}

static void beyond_tracked(void)
{
    closing_smooth.opening_mmps = LATCH_OPENING_MMPS;
    echo(LATCH_NEAR_MM + 1U);
}

static void one_clear(void)
{
    clear(1);
}

static void fault(void)
{
    take(RANGE_NOT_RISEN, 0, false);
    take(RANGE_NOT_FALLEN, 0, false);
    take(RANGE_DEAD_ZONE, 0, false);
}

static void (*const events[])(void) = {override, within, within_tracked, near_by,   at_near_end,
                                       opening,  beyond, beyond_tracked, one_clear, fault};
#define EVENTS 10U

#define O LATCH_OPEN
#define T LATCH_TRIAL
#define D LATCH_DOUBTED
#define H LATCH_HELD
#define G LATCH_OPENING

static void check_row(uint8_t state, const uint8_t __code *wanted)
{
    uint8_t i;

    for (i = 0; i < EVENTS; i++) {
        setUp();
        be_in(state);
        events[i]();
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(wanted[i], latch_state, "row of the table");
    }
}

static void test_row_open(void)
{
    static const uint8_t __code wanted[] = {O, T, H, O, O, O, O, O, O, O};

    check_row(LATCH_OPEN, wanted);
}

static void test_row_trial(void)
{
    static const uint8_t __code wanted[] = {O, H, H, H, H, O, D, O, D, T};

    check_row(LATCH_TRIAL, wanted);
}

static void test_row_doubted(void)
{
    static const uint8_t __code wanted[] = {O, H, H, H, H, O, O, O, O, D};

    check_row(LATCH_DOUBTED, wanted);
}

static void test_row_held(void)
{
    static const uint8_t __code wanted[] = {O, H, H, H, H, G, H, H, H, H};

    check_row(LATCH_HELD, wanted);
}

static void test_row_opening(void)
{
    static const uint8_t __code wanted[] = {O, H, H, H, H, O, H, H, G, G};

    check_row(LATCH_OPENING, wanted);
}

static void test_held_ends_with_two_seconds_of_nothing_but_clear(void)
{
    uint8_t state;

    for (state = LATCH_HELD; state <= LATCH_OPENING; state++) {
        setUp();
        be_in(state);
        clear(LATCH_ROAD_READINGS - 1U);
        TEST_ASSERT_EQUAL_UINT8(state, latch_state);
        clear(1);
        TEST_ASSERT_EQUAL_UINT8(LATCH_OPEN, latch_state);
    }
}

/* What ends STOP in any state, and goes on to. */
static void test_two_seconds_of_clear_road_end_every_state(void)
{
    uint8_t state;

    for (state = 0; state < LATCH_STATES; state++) {
        setUp();
        clear(LATCH_ROAD_READINGS - 1U);
        be_in(state);
        clear(1);
        TEST_ASSERT_EQUAL_UINT8(LATCH_OPEN, latch_state);
    }
}

static void test_any_other_reading_begins_the_two_seconds_anew(void)
{
    uint8_t i;

    be_in(LATCH_HELD);
    for (i = 0; i < 3; i++) {
        clear(LATCH_ROAD_READINGS - 1U);
        take(i == 0 ? RANGE_NOT_RISEN : RANGE_ECHO, i == 1 ? 900 : 2000, false);
        TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
    }
    clear(LATCH_ROAD_READINGS);
    TEST_ASSERT_EQUAL_UINT8(LATCH_OPEN, latch_state);
}

/* Readings of a target that begins beyond 1.3 m, and stays. */
static void see_another(uint8_t readings)
{
    uint8_t i;

    for (i = 0; i < readings; i++) {
        target_worth = i == 0 ? TARGET_GLIMPSE : i == 1 ? TARGET_NEW : TARGET_TRACKED;
        echo(3000);
    }
}

static void test_held_ends_when_another_target_is_tracked_for_a_second(void)
{
    be_in(LATCH_HELD);
    see_another(LATCH_PASSED_READINGS - 1U);
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
    echo(3000);
    TEST_ASSERT_EQUAL_UINT8(LATCH_OPEN, latch_state);
}

static void test_another_target_tracked_for_a_second_ends_every_state(void)
{
    uint8_t state;

    for (state = 0; state < LATCH_STATES; state++) {
        setUp();
        see_another(LATCH_PASSED_READINGS - 1U);
        be_in(state);
        echo(3000);
        TEST_ASSERT_EQUAL_UINT8(LATCH_OPEN, latch_state);
    }
}

/* The counts stop at their ends: however long the road is clear, or the other target there. */
static void test_what_ends_stop_ends_it_at_any_later_time(void)
{
    uint16_t i;

    clear(LATCH_ROAD_READINGS);
    for (i = 0; i < 300; i++) {
        be_in(LATCH_HELD);
        clear(1);
        TEST_ASSERT_EQUAL_UINT8(LATCH_OPEN, latch_state);
    }
    see_another(LATCH_PASSED_READINGS);
    for (i = 0; i < 300; i++) {
        be_in(LATCH_HELD);
        echo(3000);
        TEST_ASSERT_EQUAL_UINT8(LATCH_OPEN, latch_state);
    }
}

static void test_the_target_of_stop_does_not_end_it_however_long_it_stands_beyond(void)
{
    uint8_t i;

    be_in(LATCH_HELD);
    for (i = 0; i < 250; i++) {
        echo(3000);
    }
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
}

static void test_a_near_echo_begins_the_second_anew(void)
{
    be_in(LATCH_HELD);
    see_another(LATCH_PASSED_READINGS - 1U);
    take(RANGE_ECHO, 900, false);
    see_another(LATCH_PASSED_READINGS - 1U);
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
}

static void test_a_beginning_begins_both_counts_anew(void)
{
    see_another(LATCH_PASSED_READINGS - 1U);
    setUp();
    be_in(LATCH_HELD);
    echo(3000);
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
    clear(LATCH_ROAD_READINGS - 1U);
    setUp();
    be_in(LATCH_HELD);
    clear(1);
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
}

static void test_what_is_not_believed_does_not_count_for_the_second(void)
{
    uint8_t i;

    be_in(LATCH_HELD);
    see_another(2);
    for (i = 0; i < 100; i++) {
        take(RANGE_ECHO, 3000, false);
    }
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
}

/* A bit of the state or of its twin that has turned over: it stays so, for main to see. */
static void test_a_state_without_its_twin_stays(void)
{
    uint16_t bit;
    uint8_t state;

    for (state = 0; state < LATCH_STATES; state++) {
        for (bit = 1; bit <= 0x80; bit <<= 1) {
            be_in(state);
            latch_state ^= (uint8_t)bit;
            TEST_ASSERT_FALSE(LATCH_IS_WHOLE());
            echo(900);
            TEST_ASSERT_EQUAL_UINT8(state ^ bit, latch_state);
            TEST_ASSERT_FALSE(LATCH_IS_WHOLE());
            be_in(state);
            latch_twin ^= (uint8_t)bit;
            echo(900);
            TEST_ASSERT_EQUAL_UINT8(state, latch_state);
            TEST_ASSERT_FALSE(LATCH_IS_WHOLE());
        }
    }
}

static void test_hold_is_held(void)
{
    latch_hold();
    TEST_ASSERT_EQUAL_UINT8(LATCH_HELD, latch_state);
}

/* Each reading counts, whatever the other bytes are. */
static void test_the_sum_shows_each_count(void)
{
    uint8_t sum;

    clear(1);
    be_in(0xFF);
    sum = latch_sum();
    be_in(LATCH_HELD);
    clear(1);
    be_in(0xFF);
    TEST_ASSERT_TRUE(latch_sum() != sum);
    be_in(LATCH_HELD);
    see_another(1); /* and the clear readings begin anew: two bits change */
    be_in(0xFF);
    sum = latch_sum();
    be_in(LATCH_HELD);
    echo(3000);
    be_in(0xFF);
    TEST_ASSERT_TRUE(latch_sum() != sum);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_row_open);
    RUN_TEST(test_row_trial);
    RUN_TEST(test_row_doubted);
    RUN_TEST(test_row_held);
    RUN_TEST(test_row_opening);
    RUN_TEST(test_held_ends_with_two_seconds_of_nothing_but_clear);
    RUN_TEST(test_two_seconds_of_clear_road_end_every_state);
    RUN_TEST(test_any_other_reading_begins_the_two_seconds_anew);
    RUN_TEST(test_held_ends_when_another_target_is_tracked_for_a_second);
    RUN_TEST(test_another_target_tracked_for_a_second_ends_every_state);
    RUN_TEST(test_what_ends_stop_ends_it_at_any_later_time);
    RUN_TEST(test_the_target_of_stop_does_not_end_it_however_long_it_stands_beyond);
    RUN_TEST(test_a_near_echo_begins_the_second_anew);
    RUN_TEST(test_a_beginning_begins_both_counts_anew);
    RUN_TEST(test_what_is_not_believed_does_not_count_for_the_second);
    RUN_TEST(test_a_state_without_its_twin_stays);
    RUN_TEST(test_hold_is_held);
    RUN_TEST(test_the_sum_shows_each_count);
    return UNITY_END();
}
