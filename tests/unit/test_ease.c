/* SPDX-License-Identifier: MIT */
/* ease: the weight at every speed and distance, the hold and its end. */
#include <stddef.h>
#include "unity.h"
#include "ease.h"

#define FAR_MM 3000U /* no near zone there */

static void closing(uint16_t mmps)
{
    closing_smooth.closing_mmps = mmps;
    closing_smooth.opening_mmps = 0;
}

static void opening(uint16_t mmps)
{
    closing_smooth.closing_mmps = 0;
    closing_smooth.opening_mmps = mmps;
}

void setUp(void)
{
    ease_restart();
    closing(0);
}

void tearDown(void)
{
}

static void test_closing_from_874_mmps_gets_the_whole_table(void)
{
    uint8_t pct;

    for (pct = 0; pct <= 100; pct++) {
        closing(EASE_SPAN_MMPS - EASE_OPENING_MMPS);
        TEST_ASSERT_EQUAL_UINT8(pct, ease_pct(pct, FAR_MM));
        closing(36000U);
        TEST_ASSERT_EQUAL_UINT8(pct, ease_pct(pct, FAR_MM));
    }
}

static void test_a_gap_that_opens_gets_nothing(void)
{
    opening(EASE_OPENING_MMPS);
    TEST_ASSERT_EQUAL_UINT8(0, ease_pct(100, FAR_MM));
    TEST_ASSERT_EQUAL_UINT8(0, ease_pct(100, 500));
    opening(36000U);
    TEST_ASSERT_EQUAL_UINT8(0, ease_pct(100, FAR_MM));
}

/* (v + 150) / 1024 of the table: at a constant gap 14 of 100 (by hand: 37/256). */
static void test_weight_between(void)
{
    TEST_ASSERT_EQUAL_UINT8(14, ease_pct(100, FAR_MM));
    closing(362);
    TEST_ASSERT_EQUAL_UINT8(50, ease_pct(100, FAR_MM));
    opening(100);
    TEST_ASSERT_EQUAL_UINT8(5, ease_pct(100, FAR_MM));
}

static void test_never_more_than_the_table_and_rises_with_speed(void)
{
    uint8_t before = 0, pct;
    uint16_t mmps;

    for (mmps = 150; mmps != 0; mmps--) {
        ease_restart();
        opening(mmps);
        pct = ease_pct(80, FAR_MM);
        TEST_ASSERT_TRUE(pct >= before && pct <= 80);
        before = pct;
    }
    for (mmps = 0; mmps < 1200; mmps++) {
        ease_restart();
        closing(mmps);
        pct = ease_pct(80, FAR_MM);
        TEST_ASSERT_TRUE(pct >= before && pct <= 80);
        before = pct;
    }
    TEST_ASSERT_EQUAL_UINT8(80, before);
}

static void test_near_a_constant_gap_gets_the_whole_table(void)
{
    uint8_t before = 0, pct;
    uint16_t mm;

    for (mm = 2000; mm > 20; mm--) {
        ease_restart();
        pct = ease_pct(100, mm);
        TEST_ASSERT_TRUE(pct >= before);
        before = pct;
        if (mm == 1800) {
            TEST_ASSERT_EQUAL_UINT8(14, pct);
        }
        if (mm == 1288) {
            TEST_ASSERT_EQUAL_UINT8(100, pct);
        }
    }
    opening(EASE_STILL_MMPS + 1);
    TEST_ASSERT_EQUAL_UINT8(5, ease_pct(100, 1288));
}

static void stand(uint8_t readings)
{
    while (readings-- != 0) {
        ease_pct(20, FAR_MM);
    }
}

static void test_a_constant_gap_is_held_harder_and_harder(void)
{
    uint8_t i;

    stand(EASE_STILL_READINGS);
    TEST_ASSERT_EQUAL_UINT8(3, ease_pct(20, FAR_MM));
    for (i = 2; i <= EASE_HOLD_PCT; i++) {
        TEST_ASSERT_EQUAL_UINT8(i < 3 ? 3 : i, ease_pct(20, FAR_MM));
    }
    stand(100);
    TEST_ASSERT_EQUAL_UINT8(EASE_HOLD_PCT, ease_pct(20, FAR_MM));
}

static void test_noise_does_not_let_go(void)
{
    stand(100);
    opening(EASE_OPENING_MMPS - 1);
    TEST_ASSERT_EQUAL_UINT8(EASE_HOLD_PCT, ease_pct(20, FAR_MM));
    closing(300);
    TEST_ASSERT_EQUAL_UINT8(EASE_HOLD_PCT, ease_pct(20, FAR_MM));
}

static void test_an_opening_gap_lets_go_at_once(void)
{
    stand(100);
    opening(EASE_OPENING_MMPS);
    TEST_ASSERT_EQUAL_UINT8(0, ease_pct(20, FAR_MM));
    closing(0);
    TEST_ASSERT_EQUAL_UINT8(3, ease_pct(20, FAR_MM));
}

static void test_another_target_lets_go(void)
{
    stand(100);
    ease_restart();
    TEST_ASSERT_EQUAL_UINT8(3, ease_pct(20, FAR_MM));
}

/* A reading that closes or opens, or no brake at all: the count starts again. */
static void test_no_hold_without_a_standing_start(void)
{
    uint8_t i;

    for (i = 0; i < 10; i++) {
        stand(EASE_STILL_READINGS - 1);
        closing(EASE_STILL_MMPS + 1);
        stand(1);
        closing(0);
        stand(EASE_STILL_READINGS - 1);
        opening(EASE_STILL_MMPS + 1);
        stand(1);
        closing(0);
        stand(EASE_STILL_READINGS - 1);
        TEST_ASSERT_EQUAL_UINT8(0, ease_pct(0, FAR_MM));
    }
}

/* 100 mm/s still seem to stand, either way. */
static void test_a_gap_that_changes_a_little_is_held(void)
{
    uint8_t is_opening;

    for (is_opening = 0; is_opening <= 1; is_opening++) {
        ease_restart();
        if (is_opening) {
            opening(EASE_STILL_MMPS);
        } else {
            closing(EASE_STILL_MMPS);
        }
        stand(100);
        closing(0);
        TEST_ASSERT_EQUAL_UINT8(EASE_HOLD_PCT, ease_pct(20, FAR_MM));
    }
}

/* The reading after EASE_STILL_READINGS is the first that holds; a fast one begins the count anew.
 */
static void test_a_fast_reading_begins_the_count_anew(void)
{
    stand(EASE_STILL_READINGS - 1);
    closing(EASE_SPAN_MMPS);
    stand(1);
    closing(0);
    stand(EASE_STILL_READINGS);
    TEST_ASSERT_EQUAL_UINT8(0, ease_pct(0, FAR_MM));

    stand(EASE_STILL_READINGS);
    closing(EASE_SPAN_MMPS);
    stand(1);
    closing(0);
    stand(EASE_STILL_READINGS + 1U);
    closing(EASE_STILL_MMPS + 1U);
    TEST_ASSERT_EQUAL_UINT8(1, ease_pct(0, FAR_MM));
}

/* Restarted, the whole count is due, and nothing is held. */
static void test_restart_begins_the_count_anew(void)
{
    stand(EASE_STILL_READINGS);
    ease_restart();
    stand(EASE_STILL_READINGS);
    TEST_ASSERT_EQUAL_UINT8(0, ease_pct(0, FAR_MM));
}

/* By hand: w = (v + 150) / 4 and (w * table + 128) / 256, both rounded down. */
static void test_weight_is_rounded(void)
{
    closing(2); /* 152 / 4 = 38 */
    TEST_ASSERT_EQUAL_UINT8(15, ease_pct(100, FAR_MM));
    closing(106); /* 64 * 2 + 128 = 256 */
    TEST_ASSERT_EQUAL_UINT8(1, ease_pct(2, FAR_MM));
    closing(358); /* 127 * 1 + 128 = 255 */
    TEST_ASSERT_EQUAL_UINT8(0, ease_pct(1, FAR_MM));
}

/* By hand: w = (1800 - d) / 2, where that is more than the 37 of a constant gap. */
static void test_weight_of_a_near_gap(void)
{
    ease_restart();
    TEST_ASSERT_EQUAL_UINT8(20, ease_pct(100, 1700)); /* 50 */
    TEST_ASSERT_EQUAL_UINT8(50, ease_pct(100, 1546)); /* 127 */
    TEST_ASSERT_EQUAL_UINT8(49, ease_pct(100, 1547)); /* 126 */
    opening(EASE_STILL_MMPS);
    TEST_ASSERT_EQUAL_UINT8(100, ease_pct(100, 1288));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_closing_from_874_mmps_gets_the_whole_table);
    RUN_TEST(test_a_gap_that_opens_gets_nothing);
    RUN_TEST(test_weight_between);
    RUN_TEST(test_never_more_than_the_table_and_rises_with_speed);
    RUN_TEST(test_near_a_constant_gap_gets_the_whole_table);
    RUN_TEST(test_a_constant_gap_is_held_harder_and_harder);
    RUN_TEST(test_noise_does_not_let_go);
    RUN_TEST(test_an_opening_gap_lets_go_at_once);
    RUN_TEST(test_another_target_lets_go);
    RUN_TEST(test_no_hold_without_a_standing_start);
    RUN_TEST(test_a_gap_that_changes_a_little_is_held);
    RUN_TEST(test_a_fast_reading_begins_the_count_anew);
    RUN_TEST(test_restart_begins_the_count_anew);
    RUN_TEST(test_weight_is_rounded);
    RUN_TEST(test_weight_of_a_near_gap);
    return UNITY_END();
}
