/* SPDX-License-Identifier: MIT */
/* The follower: the printed values of its specification, its table against the rules worked out in
 * full, and what it does with frames. Built for both rule sets. */
#include <stddef.h>
#include <stdio.h>
#include "unity.h"

/* Files under test that want this controller's table. */
#include "lut.c"
#include "follow.c"

void setUp(void)
{
    follow_init();
}

void tearDown(void)
{
}

static void situation(uint16_t gap_mm, int16_t closing_mmps, bool lane_is_taken)
{
    follow.gap_mm = gap_mm;
    follow.lead_mmps = closing_mmps < 0 ? (uint16_t)-closing_mmps : 0;
    follow.own_mmps = closing_mmps < 0 ? 0 : (uint16_t)closing_mmps;
    follow.lane_is_taken = lane_is_taken;
    follow_decide();
    follow_decide();
}

#if FOLLOW_YIELDS
static void one_frame(uint16_t gap_mm, uint16_t closing_mmps)
{
    follow.gap_mm = gap_mm;
    follow.own_mmps = closing_mmps;
    follow.lead_mmps = 0;
    follow.lane_is_taken = false;
    follow_decide();
}

static void test_one_frame_neither_releases_the_brake_nor_asks_for_a_lane(void)
{
    situation(800, 1800, false);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);
    one_frame(9000, 0);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(1000, follow.throttle_us);
    one_frame(800, 1800);
    one_frame(9000, 0);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);
    one_frame(9000, 0);
    TEST_ASSERT_EQUAL_UINT8(0, follow.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(2000, follow.throttle_us);
    one_frame(800, 1800); /* more brake needs one frame only */
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);

    one_frame(1500, 1800);
    TEST_ASSERT_FALSE(follow.asks_for_lane);
    one_frame(1500, 1800);
    TEST_ASSERT_TRUE(follow.asks_for_lane);
    one_frame(9000, 0);
    TEST_ASSERT_FALSE(follow.asks_for_lane);

    situation(1500, 1800, false);
    follow_lose(60);
    one_frame(1500, 1800);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);
    TEST_ASSERT_FALSE(follow.asks_for_lane);
}
#endif

/* Gap and closing speed in cm and cm/s, command and change in halves, for the safe rules. */
static const struct {
    uint16_t gap_cm;
    int16_t closing_cmps;
    int8_t command_x2;
    uint8_t change_x2;
} spots[] = {
    {950, 0, 2, 0},    {800, -150, 2, 0}, {600, 150, 2, 0},  {500, 190, 2, 0}, {400, 150, 1, 0},
    {400, -150, 2, 0}, {320, -40, 0, 0},  {300, -120, 2, 0}, {250, 160, 0, 0}, {190, 150, 0, 2},
    {150, 180, 0, 2},  {100, 180, 0, 2},  {95, 180, -1, 1},  {80, 180, -2, 0}, {50, 50, -2, 0},
    {150, 50, 0, 0},   {50, -150, 0, 0},  {200, -200, 1, 0},
};

static void test_spot_values_are_the_printed_ones(void)
{
    uint8_t i;

    for (i = 0; i < sizeof spots / sizeof spots[0]; i++) {
        int8_t command_x2 = spots[i].command_x2;

#if !FOLLOW_YIELDS
        if (spots[i].gap_cm == 50 && spots[i].closing_cmps == 50) {
            command_x2 = 0;
        }
#endif
        situation((uint16_t)(spots[i].gap_cm * 10), (int16_t)(spots[i].closing_cmps * 10), false);
        TEST_ASSERT_EQUAL_INT8(command_x2, follow.command_x2);
        TEST_ASSERT_EQUAL_UINT8(spots[i].change_x2, follow.change_x2);
        TEST_ASSERT_EQUAL(spots[i].change_x2 == 2, follow.asks_for_lane);
    }
}

static void test_refused_change_brakes_unless_as_published(void)
{
    situation(1500, 1800, false);
    TEST_ASSERT_TRUE(follow.asks_for_lane);
    TEST_ASSERT_EQUAL_UINT8(0, follow.brake_pct);
    situation(1500, 1800, true);
    TEST_ASSERT_TRUE(follow.asks_for_lane); /* it still asks: the lane may become free */
    TEST_ASSERT_EQUAL_UINT8(FOLLOW_YIELDS ? 100 : 0, follow.brake_pct);
    situation(950, 1800, true); /* a wish on the threshold is one, too */
    TEST_ASSERT_FALSE(follow.asks_for_lane);
    TEST_ASSERT_EQUAL_UINT8(FOLLOW_YIELDS ? 100 : 50, follow.brake_pct);
    situation(5000, 1800, true); /* no wish */
    TEST_ASSERT_EQUAL_UINT8(0, follow.brake_pct);
}

static void test_commands_become_brake_or_throttle(void)
{
    situation(9000, 0, false);
    TEST_ASSERT_EQUAL_UINT8(0, follow.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(2000, follow.throttle_us);
    situation(4000, 1500, false);
    TEST_ASSERT_EQUAL_UINT8(0, follow.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(1500, follow.throttle_us);
    situation(3000, 0, false);
    TEST_ASSERT_EQUAL_UINT8(0, follow.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(1000, follow.throttle_us);
    situation(950, 1800, false);
    TEST_ASSERT_EQUAL_UINT8(50, follow.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(1000, follow.throttle_us);
    situation(800, 1800, false);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(1000, follow.throttle_us);
}

static void test_gap_beyond_the_table_is_a_far_one(void)
{
    situation(10001, 2500, false);
    TEST_ASSERT_EQUAL_INT8(2, follow.command_x2);
    situation(FOLLOW_GAP_MAX_MM, -2500, false);
    TEST_ASSERT_EQUAL_INT8(2, follow.command_x2);
}

static void payload(uint16_t gap_mm, uint16_t own_mmps, uint16_t lead_mmps, uint8_t lane)
{
    frame_body[0] = (uint8_t)(gap_mm >> 8);
    frame_body[1] = (uint8_t)gap_mm;
    frame_body[2] = (uint8_t)(own_mmps >> 8);
    frame_body[3] = (uint8_t)own_mmps;
    frame_body[4] = (uint8_t)(lead_mmps >> 8);
    frame_body[5] = (uint8_t)lead_mmps;
    frame_body[6] = lane;
    frame_body[7] = FOLLOW_CHANGE_MM >> 8;
    frame_body[8] = FOLLOW_CHANGE_MM & 255;
}

static void change_distance(uint16_t change_mm)
{
    payload(1500, 1800, 0, 0);
    frame_body[7] = (uint8_t)(change_mm >> 8);
    frame_body[8] = (uint8_t)change_mm;
}

static void test_change_distance_comes_with_the_frame(void)
{
    change_distance(1449);
    TEST_ASSERT_TRUE(follow_read());
    follow_decide();
    follow_decide();
    TEST_ASSERT_TRUE(follow.asks_for_lane); /* 1.5 m is 0.05 m and more beyond it */
    change_distance(1551);
    TEST_ASSERT_TRUE(follow_read());
    follow_decide();
    TEST_ASSERT_FALSE(follow.asks_for_lane);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);
    change_distance(FOLLOW_CHANGE_MIN_MM - 1);
    TEST_ASSERT_FALSE(follow_read());
    change_distance(FOLLOW_CHANGE_MAX_MM + 1);
    TEST_ASSERT_FALSE(follow_read());
    TEST_ASSERT_EQUAL_UINT16(1551, follow.change_mm);
    change_distance(FOLLOW_CHANGE_MIN_MM);
    TEST_ASSERT_TRUE(follow_read());
    change_distance(FOLLOW_CHANGE_MAX_MM);
    TEST_ASSERT_TRUE(follow_read());
}

static void test_payload_out_of_range_is_refused_and_changes_nothing(void)
{
    payload(3000, 1200, 900, 1);
    TEST_ASSERT_TRUE(follow_read());
    payload(20001, 0, 0, 0);
    TEST_ASSERT_FALSE(follow_read());
    payload(0, 2501, 0, 0);
    TEST_ASSERT_FALSE(follow_read());
    payload(0, 0, 2501, 0);
    TEST_ASSERT_FALSE(follow_read());
    payload(0, 0, 0, 2);
    TEST_ASSERT_FALSE(follow_read());
    TEST_ASSERT_EQUAL_UINT16(3000, follow.gap_mm);
    TEST_ASSERT_EQUAL_UINT16(1200, follow.own_mmps);
    TEST_ASSERT_EQUAL_UINT16(900, follow.lead_mmps);
    TEST_ASSERT_TRUE(follow.lane_is_taken);
    payload(20000, 2500, 2500, 0);
    TEST_ASSERT_TRUE(follow_read());
    TEST_ASSERT_FALSE(follow.lane_is_taken);
}

static void test_robot_waits_braked_and_a_lost_link_brakes_and_asks_for_nothing(void)
{
    TEST_ASSERT_TRUE(follow.stop);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);
    follow_lose(60); /* nothing was up yet */
    TEST_ASSERT_TRUE(follow.stop);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);

    situation(1500, 1800, false);
    TEST_ASSERT_FALSE(follow.stop);
    TEST_ASSERT_TRUE(follow.asks_for_lane);

    follow_lose(60);
    TEST_ASSERT_EQUAL_UINT8(FOLLOW_FAULT, follow.state);
    TEST_ASSERT_EQUAL_UINT8(FOLLOW_YIELDS ? 100 : 60, follow.brake_pct); /* it is near */
    TEST_ASSERT_EQUAL_UINT16(FOLLOW_THROTTLE_CLOSED_US, follow.throttle_us);
    TEST_ASSERT_FALSE(follow.asks_for_lane);
    TEST_ASSERT_FALSE(follow.stop);

    situation(800, 1800, false);
    follow_lose(60); /* never less than before */
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);

    situation(1999, 0, false);
    TEST_ASSERT_EQUAL_UINT8(0, follow.brake_pct);
    follow_lose(60);
    TEST_ASSERT_EQUAL_UINT8(FOLLOW_YIELDS ? 100 : 60, follow.brake_pct);
    situation(2000, 0, false);
    follow_lose(60);
    TEST_ASSERT_EQUAL_UINT8(60, follow.brake_pct);
}

static void test_a_lost_link_closes_the_throttle(void)
{
    situation(9000, 0, false);
    TEST_ASSERT_EQUAL_UINT8(FOLLOW_CONTROL, follow.state);
    TEST_ASSERT_EQUAL_UINT16(2000, follow.throttle_us);
    follow_lose(60);
    TEST_ASSERT_EQUAL_UINT16(1000, follow.throttle_us);
}

static void test_a_beginning_forgets_what_was_asked_for(void)
{
    situation(1500, 1800, false);
    TEST_ASSERT_TRUE(follow.asks_for_lane);
    follow_init();
    TEST_ASSERT_EQUAL_UINT8(FOLLOW_WAITING, follow.state);
    TEST_ASSERT_EQUAL_UINT8(0, follow.change_x2);
    TEST_ASSERT_FALSE(follow.asks_for_lane);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);
#if FOLLOW_YIELDS
    one_frame(1500, 1800);
    TEST_ASSERT_FALSE(follow.asks_for_lane);
    TEST_ASSERT_EQUAL_UINT8(100, follow.brake_pct);
#endif
}

static void test_check_sum_covers_both_outputs(void)
{
    TEST_ASSERT_EQUAL_HEX16(LUT_CRC16, lut_crc16(LUT_CRC16_START, 0, LUT_BYTES));
    TEST_ASSERT_EQUAL_HEX16(
        LUT_CRC16, lut_crc16(lut_crc16(LUT_CRC16_START, 0, LUT_BYTES - 20), LUT_BYTES - 20, 20));
}

#ifndef __SDCC_mcs51

/* Memberships in thousandths: up over 2,000 to `peak`, down over 2,000 after it; 1,000 beyond the
 * ends. */
static int hat(int x, int peak, int slope)
{
    int away = x < peak ? peak - x : x - peak;

    return away >= slope ? 0 : (slope - away) * 1000000 / slope;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* The system once more, from its sets and rules: which commands hold the greatest maximum. */
static void decide(int gap_mm, int closing_mmps, int *command_x2, int *change_x2)
{
    int gap[5], closing[3], change[3];
    int command_is[3] = {0}, change_is[2] = {0};
    int to_change_mm = gap_mm - 1000;

    for (int i = 0; i < 5; i++) {
        gap[i] = hat(gap_mm, 1000 + 2000 * i, 2000);
    }
    if (gap_mm < 1000) {
        gap[0] = 1000000;
    }
    if (gap_mm > 9000) {
        gap[4] = 1000000;
    }
    for (int i = 0; i < 3; i++) {
        closing[i] = hat(closing_mmps, 2000 * (i - 1), 2000);
    }
    change[0] = to_change_mm <= -100 ? 1000000 : hat(to_change_mm, -100, 100);
    change[1] = hat(to_change_mm, 0, 100);
    change[2] = to_change_mm >= 100 ? 1000000 : hat(to_change_mm, 100, 100);

#define RULE(strength, command, changes)                                                           \
    do {                                                                                           \
        int is = strength;                                                                         \
        command_is[(command) + 1] =                                                                \
            is > command_is[(command) + 1] ? is : command_is[(command) + 1];                       \
        change_is[changes] = is > change_is[changes] ? is : change_is[changes];                    \
    } while (0)
    RULE(gap[4], 1, 0);
    RULE(gap[3], 1, 0);
    RULE(gap[2], 1, 0);
    RULE(least(gap[1], closing[0]), 1, 0);
    RULE(least(gap[1], closing[1]), 0, 0);
    RULE(least(gap[1], closing[2]), 0, 0);
    RULE(least(gap[0], closing[0]), 0, 0);
    RULE(least(gap[0], least(closing[2], change[0])), -1, 0);
    RULE(least(gap[0], least(closing[2], change[1])), 0, 1);
    RULE(least(gap[0], least(closing[2], change[2])), 0, 1);
    if (FOLLOW_YIELDS) {
        RULE(least(gap[0], least(closing[1], change[0])), -1, 0);
        RULE(least(gap[0], least(closing[1], change[1])), 0, 0);
        RULE(least(gap[0], least(closing[1], change[2])), 0, 0);
    } else {
        RULE(least(gap[0], closing[1]), 0, 0);
    }

    int low = 0, high = 2;
    int most = command_is[0] > command_is[1] ? command_is[0] : command_is[1];
    most = command_is[2] > most ? command_is[2] : most;
    while (command_is[low] != most) {
        low++;
    }
    while (command_is[high] != most) {
        high--;
    }
    *command_x2 = low + high - 2;
    *change_x2 = change_is[0] == change_is[1] ? 1 : change_is[1] > change_is[0] ? 2 : 0;
}

static void expect_system(int gap_mm, int closing_mmps)
{
    int command_x2, change_x2;

    decide(gap_mm, closing_mmps, &command_x2, &change_x2);
    follow.gap_mm = (uint16_t)gap_mm;
    follow.own_mmps = (uint16_t)(closing_mmps + 2000);
    follow.lead_mmps = 2000;
    follow_look_up();
    if (follow.command_x2 != command_x2 || follow.change_x2 != change_x2) {
        char text[120];

        snprintf(text, sizeof text, "gap %d mm, closing %d mm/s: %d %d, wanted %d %d", gap_mm,
                 closing_mmps, follow.command_x2, follow.change_x2, command_x2, change_x2);
        TEST_FAIL_MESSAGE(text);
    }
}

static void test_thresholds_and_cells_are_the_whole_system(void)
{
    for (int gap_mm = 0; gap_mm <= 10000; gap_mm++) {
        for (int closing_mmps = -2000; closing_mmps <= 2000; closing_mmps += 20) {
            expect_system(gap_mm, closing_mmps);
        }
        for (int off_mmps = -1; off_mmps <= 1; off_mmps += 2) {
            expect_system(gap_mm, -1000 + off_mmps);
            expect_system(gap_mm, 1000 + off_mmps);
        }
    }
}

#endif

/* Both tables, and slices that end before, at and after the end of the first one. */
static void test_the_check_sum_is_the_headers_in_slices_of_any_size(void)
{
    uint8_t slice;

    for (slice = 1; slice <= LUT_BYTES; slice++) {
        uint16_t crc = LUT_CRC16_START;
        uint8_t offset = 0;

        while (offset != LUT_BYTES) {
            uint8_t left = (uint8_t)(LUT_BYTES - offset), count = left < slice ? left : slice;

            crc = lut_crc16(crc, offset, count);
            offset = (uint8_t)(offset + count);
        }
        TEST_ASSERT_EQUAL_HEX16(LUT_CRC16, crc);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_spot_values_are_the_printed_ones);
#if FOLLOW_YIELDS
    RUN_TEST(test_one_frame_neither_releases_the_brake_nor_asks_for_a_lane);
#endif
    RUN_TEST(test_change_distance_comes_with_the_frame);
    RUN_TEST(test_refused_change_brakes_unless_as_published);
    RUN_TEST(test_commands_become_brake_or_throttle);
    RUN_TEST(test_gap_beyond_the_table_is_a_far_one);
    RUN_TEST(test_payload_out_of_range_is_refused_and_changes_nothing);
    RUN_TEST(test_robot_waits_braked_and_a_lost_link_brakes_and_asks_for_nothing);
    RUN_TEST(test_a_lost_link_closes_the_throttle);
    RUN_TEST(test_a_beginning_forgets_what_was_asked_for);
    RUN_TEST(test_check_sum_covers_both_outputs);
#ifndef __SDCC_mcs51
    RUN_TEST(test_thresholds_and_cells_are_the_whole_system);
#endif
    RUN_TEST(test_the_check_sum_is_the_headers_in_slices_of_any_size);
    return UNITY_END();
}
