/* SPDX-License-Identifier: MIT */
/* The sign-of-life watch: three good frames to trust, a silence to stop trusting. */
#include "link.h"
#include <stddef.h>
#include "unity.h"

void setUp(void)
{
    link_init(LINK_WAITING, 0);
}

void tearDown(void)
{
}

static void bring_up(uint16_t now_ms)
{
    (void)link_good(now_ms);
    (void)link_good(now_ms);
    (void)link_good(now_ms);
}

static void test_link_waits_for_three_good_frames_in_a_row(void)
{
    TEST_ASSERT_EQUAL_UINT8(LINK_WAITING, link_check(0));
    TEST_ASSERT_FALSE(link_good(100));
    TEST_ASSERT_FALSE(link_good(200));
    TEST_ASSERT_EQUAL_UINT8(LINK_WAITING, link_check(299));
    TEST_ASSERT_TRUE(link_good(300));
    TEST_ASSERT_EQUAL_UINT8(LINK_UP, link_check(300));
}

static void test_link_that_does_not_come_up_in_time_is_lost(void)
{
    (void)link_good(450);
    (void)link_good(480);
    TEST_ASSERT_EQUAL_UINT8(LINK_WAITING, link_check(499));
    TEST_ASSERT_EQUAL_UINT8(LINK_LOST, link_check(500));
    TEST_ASSERT_FALSE(link_good(510));
}

static void test_after_a_watchdog_reset_it_is_lost_from_the_start(void)
{
    link_init(LINK_LOST, 0);
    TEST_ASSERT_EQUAL_UINT8(LINK_LOST, link_check(0));
    TEST_ASSERT_FALSE(link_good(50));
    TEST_ASSERT_FALSE(link_good(100));
    TEST_ASSERT_TRUE(link_good(150));
}

static void test_bad_frame_breaks_the_row_but_not_the_link(void)
{
    (void)link_good(0);
    (void)link_good(100);
    link_bad();
    TEST_ASSERT_FALSE(link_good(200));
    TEST_ASSERT_FALSE(link_good(300));
    TEST_ASSERT_TRUE(link_good(400));
    link_bad();
    TEST_ASSERT_EQUAL_UINT8(LINK_UP, link_check(500));
    TEST_ASSERT_TRUE(link_good(500));
}

static void test_silence_loses_the_link(void)
{
    bring_up(100);
    TEST_ASSERT_EQUAL_UINT8(LINK_UP, link_check(319));
    TEST_ASSERT_EQUAL_UINT8(LINK_LOST, link_check(320));
    TEST_ASSERT_EQUAL_UINT8(LINK_LOST, link_check(319)); /* lost is lost */
}

static void test_bad_frames_are_no_sign_of_life(void)
{
    uint16_t now_ms;

    bring_up(0);
    for (now_ms = 20; now_ms < 220; now_ms += 20) {
        link_bad();
        TEST_ASSERT_EQUAL_UINT8(LINK_UP, link_check(now_ms));
    }
    TEST_ASSERT_EQUAL_UINT8(LINK_LOST, link_check(220));
}

static void test_frame_after_a_silence_does_not_undo_it(void)
{
    bring_up(0);
    TEST_ASSERT_FALSE(link_good(220));
    TEST_ASSERT_FALSE(link_good(250));
    TEST_ASSERT_TRUE(link_good(300));
}

static void test_one_bad_frame_in_a_row_is_no_silence_and_two_are(void)
{
    bring_up(0);
    link_bad();
    TEST_ASSERT_EQUAL_UINT8(LINK_UP, link_check(200));
    TEST_ASSERT_TRUE(link_good(210)); /* 200 ms, read off ticks, are 190 to 210 */
    link_bad();
    link_bad();
    TEST_ASSERT_EQUAL_UINT8(LINK_LOST, link_check(210 + 290)); /* two: 300 ms, read as 290 */
}

static void test_a_link_begins_anew_at_any_time(void)
{
    bring_up(100);
    link_init(LINK_WAITING, 60000);
    TEST_ASSERT_EQUAL_UINT8(LINK_WAITING, link_check(60499));
    TEST_ASSERT_EQUAL_UINT8(LINK_LOST, link_check(60500));
    TEST_ASSERT_FALSE(link_good(60600));
    TEST_ASSERT_FALSE(link_good(60700));
    link_init(LINK_LOST, 60800);
    TEST_ASSERT_FALSE(link_good(60900));
}

static void test_clock_may_wrap(void)
{
    link_init(LINK_WAITING, 65400U);
    bring_up(65500U);
    TEST_ASSERT_EQUAL_UINT8(LINK_UP, link_check((uint16_t)(65500U + 219U)));
    TEST_ASSERT_EQUAL_UINT8(LINK_LOST, link_check((uint16_t)(65500U + 220U)));
}

/* However long it was lost. */
static void test_a_lost_link_comes_back_at_any_time(void)
{
    link_init(LINK_LOST, 0);
    bring_up(30000);
    TEST_ASSERT_EQUAL_UINT8(LINK_UP, link_check(30000));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_link_waits_for_three_good_frames_in_a_row);
    RUN_TEST(test_link_that_does_not_come_up_in_time_is_lost);
    RUN_TEST(test_after_a_watchdog_reset_it_is_lost_from_the_start);
    RUN_TEST(test_bad_frame_breaks_the_row_but_not_the_link);
    RUN_TEST(test_silence_loses_the_link);
    RUN_TEST(test_bad_frames_are_no_sign_of_life);
    RUN_TEST(test_frame_after_a_silence_does_not_undo_it);
    RUN_TEST(test_one_bad_frame_in_a_row_is_no_silence_and_two_are);
    RUN_TEST(test_a_link_begins_anew_at_any_time);
    RUN_TEST(test_clock_may_wrap);
    RUN_TEST(test_a_lost_link_comes_back_at_any_time);
    return UNITY_END();
}
