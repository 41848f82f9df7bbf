/* SPDX-License-Identifier: MIT */
/* law_classic: the safe distance at every speed, and when it brakes and stops braking. */
#include <stddef.h>
#include "unity.h"
#include "law_classic.c"

static struct closing_speed __data speed;

static uint8_t brake_pct(uint8_t worth, uint16_t dist_mm)
{
    law_step(worth, dist_mm);
    return law_answer.brake_pct;
}

void setUp(void)
{
    closing_difference.closing_mmps = 0;
    closing_difference.opening_mmps = 0;
    law_restart();
}

void tearDown(void)
{
}

/* v * 0.3 s + v^2 / (2 * 6.4 m/s2) + 1 m, by hand. */
static void test_safe_distance_by_hand(void)
{
    static const uint16_t __code speeds_mmps[] = {0, 1000, 2000, 4000, 5264, 8000};
    static const uint16_t __code safe_mm[] = {1000, 1378, 1912, 3450, 4744, 8400};
    uint8_t i;

    for (i = 0; i < 6; i++) {
        TEST_ASSERT_UINT16_WITHIN(4, safe_mm[i], law_classic_safe_mm(speeds_mmps[i]));
    }
}

/* At every speed: exact within 4 mm, never more than exact, never falling. */
static void test_safe_distance_at_every_speed(void)
{
    uint16_t mmps, before_mm = 0;

    for (mmps = 0; mmps < 8192; mmps++) {
        uint16_t safe_mm = law_classic_safe_mm(mmps);
        uint16_t exact_mm = (uint16_t)(1000U + mmps * 3UL / 10U + (uint32_t)mmps * mmps / 12800U);

        if (safe_mm < before_mm || safe_mm > exact_mm + 1U || safe_mm + 4U < exact_mm) {
            TEST_ASSERT_EQUAL_UINT16_MESSAGE(exact_mm, safe_mm, "safe distance");
        }
        before_mm = safe_mm;
    }
    TEST_ASSERT_EQUAL_UINT16(before_mm, law_classic_safe_mm(8192));
    TEST_ASSERT_EQUAL_UINT16(before_mm, law_classic_safe_mm(65535U));
}

static void test_all_or_nothing_at_the_safe_distance(void)
{
    uint16_t safe_mm;

    speed.opening_mmps = 0;
    for (speed.closing_mmps = 0; speed.closing_mmps < 5000; speed.closing_mmps += 250) {
        safe_mm = law_classic_safe_mm(speed.closing_mmps);
        TEST_ASSERT_EQUAL_UINT8(100, law_pct((uint16_t)(safe_mm - 1U), &speed));
        TEST_ASSERT_EQUAL_UINT8(0, law_pct(safe_mm, &speed));
    }
}

static void test_opening_counts_as_standing(void)
{
    speed.closing_mmps = 0;
    speed.opening_mmps = 5000;
    TEST_ASSERT_EQUAL_UINT8(0, law_pct(1000, &speed));
    TEST_ASSERT_EQUAL_UINT8(100, law_pct(999, &speed));
}

static void test_brakes_until_half_a_metre_more_than_safe(void)
{
    closing_difference.closing_mmps = 2000;
    TEST_ASSERT_EQUAL_UINT8(0, brake_pct(TARGET_TRACKED, 1950));
    TEST_ASSERT_EQUAL_UINT8(100, brake_pct(TARGET_TRACKED, 1900));
    closing_difference.closing_mmps = 0;
    TEST_ASSERT_EQUAL_UINT8(100, brake_pct(TARGET_TRACKED, 1500));
    TEST_ASSERT_EQUAL_UINT8(0, brake_pct(TARGET_TRACKED, 1501));
    TEST_ASSERT_EQUAL_UINT8(0, brake_pct(TARGET_TRACKED, 1400));
}

static void test_another_target_is_judged_afresh(void)
{
    TEST_ASSERT_EQUAL_UINT8(100, brake_pct(TARGET_NEW, 900));
    TEST_ASSERT_EQUAL_UINT8(0, brake_pct(TARGET_NEW, 1200));
    TEST_ASSERT_EQUAL_UINT8(100, brake_pct(TARGET_TRACKED, 900));
    TEST_ASSERT_EQUAL_UINT8(0, brake_pct(TARGET_ENTERED, 1200));
}

/* Its three factors are rounded down, 19660 / 65536 for 0.3 and 5242 / 65536 for 1024 / 12800, and
 * so is each product. By hand. */
static void test_safe_distance_is_rounded_down(void)
{
    TEST_ASSERT_EQUAL_UINT16(1000 + 2 + 0, law_classic_safe_mm(10));
    TEST_ASSERT_EQUAL_UINT16(1000 + 47 + 1, law_classic_safe_mm(160));
    TEST_ASSERT_EQUAL_UINT16(1000 + 360 + 113, law_classic_safe_mm(1203));
    TEST_ASSERT_EQUAL_UINT16(1000 + 1094 + 1038, law_classic_safe_mm(3647));
}

/* As where the target has left the law's reach and comes back. */
static void test_restart_forgets_that_it_braked(void)
{
    TEST_ASSERT_EQUAL_UINT8(100, brake_pct(TARGET_TRACKED, 999));
    TEST_ASSERT_EQUAL_UINT8(100, brake_pct(TARGET_TRACKED, 1000));
    law_restart();
    TEST_ASSERT_EQUAL_UINT8(0, brake_pct(TARGET_TRACKED, 1000));
}

static void test_there_is_no_cell(void)
{
    law_answer.row = 1;
    law_answer.col = 1;
    TEST_ASSERT_EQUAL_UINT8(100, brake_pct(TARGET_TRACKED, 900));
    TEST_ASSERT_EQUAL_UINT8(0, law_answer.row);
    TEST_ASSERT_EQUAL_UINT8(0, law_answer.col);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_safe_distance_by_hand);
    RUN_TEST(test_safe_distance_at_every_speed);
    RUN_TEST(test_all_or_nothing_at_the_safe_distance);
    RUN_TEST(test_opening_counts_as_standing);
    RUN_TEST(test_brakes_until_half_a_metre_more_than_safe);
    RUN_TEST(test_another_target_is_judged_afresh);
    RUN_TEST(test_safe_distance_is_rounded_down);
    RUN_TEST(test_restart_forgets_that_it_braked);
    RUN_TEST(test_there_is_no_cell);
    return UNITY_END();
}
