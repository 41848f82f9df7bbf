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
    return UNITY_END();
}
