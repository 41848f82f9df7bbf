/* SPDX-License-Identifier: MIT */
/* The safe distance against the published judgement's test set. */
#include "safe.h"
#include <stddef.h>
#include "unity.h"

#ifndef __SDCC_mcs51
#include <math.h>
#endif

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_spot_values(void)
{
    TEST_ASSERT_UINT16_WITHIN(5, 7900, safe_distance_cm(590));
    TEST_ASSERT_UINT16_WITHIN(5, 8090, safe_distance_cm(600));
    TEST_ASSERT_UINT16_WITHIN(5, 10010, safe_distance_cm(700));
    TEST_ASSERT_UINT16_WITHIN(5, 16940, safe_distance_cm(1000));
    TEST_ASSERT_UINT16_WITHIN(5, 52380, safe_distance_cm(2000));
}

static void test_standing_car_keeps_five_metres(void)
{
    TEST_ASSERT_EQUAL_UINT16(500, safe_distance_cm(0));
}

static void test_beyond_16_bits_it_stays_at_the_top(void)
{
    TEST_ASSERT_EQUAL_UINT16(65535, safe_distance_cm(SAFE_SPEED_MAX_DKMH));
}

static void test_it_never_falls_as_speed_rises(void)
{
    uint16_t own_dkmh, last_cm = 0;

    for (own_dkmh = 0; own_dkmh <= SAFE_SPEED_MAX_DKMH; own_dkmh++) {
        uint16_t safe_cm = safe_distance_cm(own_dkmh);
        TEST_ASSERT_TRUE(safe_cm >= last_cm);
        last_cm = safe_cm;
    }
}

#ifndef __SDCC_mcs51
/* 2.5 s of thinking and 5 m, and the square of the speed: rounded down where the 8051 is. */
static void test_each_part_is_rounded_as_the_comments_say(void)
{
    const double factor = (1 / 5.0 - 1 / 13.0) * 100 / (36 * 36) * 128;

    for (unsigned own_dkmh = 0; own_dkmh <= SAFE_SPEED_MAX_DKMH; own_dkmh++) {
        unsigned square = own_dkmh * own_dkmh / 128;
        double braking_cm = square + floor(square * round((factor - 1) * 65536) / 65536);
        double sum_cm = own_dkmh * 7 - own_dkmh / 18 + 500 + braking_cm;

        TEST_ASSERT_EQUAL_UINT16(fmin(sum_cm, 65535), safe_distance_cm((uint16_t)own_dkmh));
    }
}

static void test_it_is_the_formula_to_2_2_cm(void)
{
    for (uint16_t own_dkmh = 0; own_dkmh <= SAFE_SPEED_MAX_DKMH; own_dkmh++) {
        double own_mps = own_dkmh / 36.0;
        double exact_cm = (own_mps * 2.5 + own_mps * own_mps * (1 / 5.0 - 1 / 13.0) + 5) * 100;

        TEST_ASSERT_DOUBLE_WITHIN(2.2, exact_cm < 65535 ? exact_cm : 65535,
                                  safe_distance_cm(own_dkmh));
    }
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_spot_values);
    RUN_TEST(test_standing_car_keeps_five_metres);
    RUN_TEST(test_beyond_16_bits_it_stays_at_the_top);
    RUN_TEST(test_it_never_falls_as_speed_rises);
#ifndef __SDCC_mcs51
    RUN_TEST(test_each_part_is_rounded_as_the_comments_say);
    RUN_TEST(test_it_is_the_formula_to_2_2_cm);
#endif
    return UNITY_END();
}
