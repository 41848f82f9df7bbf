/* SPDX-License-Identifier: MIT */
/* Beat frequencies to range and closing speed. */
#include "fmcw.h"
#include <stddef.h>
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_five_metres_at_twenty_mps_needs_the_sign(void)
{
    /* f_r = 5 * 1000.69, f_d = 20 * 513.7: f+ = -5,270 Hz, f- = 15,277 Hz. */
    TEST_ASSERT_TRUE(fmcw_pair_is_possible(-5270, 15277));
    TEST_ASSERT_UINT16_WITHIN(1, 500, fmcw_range_cm(-5270, 15277));
    TEST_ASSERT_INT16_WITHIN(1, 720, fmcw_closing_dkmh(-5270, 15277));

    /* A mixer without a sign would read this as far and slow. */
    TEST_ASSERT_UINT16_WITHIN(1, 1027, fmcw_range_cm(5270, 15277));
    TEST_ASSERT_INT16_WITHIN(1, 351, fmcw_closing_dkmh(5270, 15277));
}

static void test_equal_beats_are_equal_speeds(void)
{
    TEST_ASSERT_EQUAL_INT16(0, fmcw_closing_dkmh(100069, 100069));
    TEST_ASSERT_UINT16_WITHIN(1, 10000, fmcw_range_cm(100069, 100069));
}

static void test_opening_is_negative(void)
{
    TEST_ASSERT_INT16_WITHIN(1, -720, fmcw_closing_dkmh(15277, -5270));
}

static void test_limits_of_what_is_possible(void)
{
    TEST_ASSERT_TRUE(fmcw_pair_is_possible(0, 0));
    TEST_ASSERT_FALSE(fmcw_pair_is_possible(-1, 0));
    TEST_ASSERT_TRUE(fmcw_pair_is_possible(500000, 548575));
    TEST_ASSERT_FALSE(fmcw_pair_is_possible(500000, 548576));
    TEST_ASSERT_TRUE(fmcw_pair_is_possible(100000, 231071));
    TEST_ASSERT_FALSE(fmcw_pair_is_possible(100000, 231072));
    TEST_ASSERT_TRUE(fmcw_pair_is_possible(231071, 100000));
    TEST_ASSERT_FALSE(fmcw_pair_is_possible(231072, 100000));
    TEST_ASSERT_FALSE(fmcw_pair_is_possible(-8388608, 8388607));
    TEST_ASSERT_FALSE(fmcw_pair_is_possible(8388607, 8388607));
}

static void test_open_sign_is_seen_only_where_both_readings_are_possible(void)
{
    /* 5 m and 20 m/s behind a mixer without a sign, own speed 200 km/h and 20 km/h. */
    TEST_ASSERT_TRUE(fmcw_sign_is_open(5270, 15277, 2000));
    TEST_ASSERT_FALSE(fmcw_sign_is_open(5270, 15277, 200));
    /* 50 m and 10 m/s: the other reading would be 351 km/h. */
    TEST_ASSERT_FALSE(fmcw_sign_is_open(44898, 55172, 2000));
    /* Opening: f+ is the larger one, and its sign is plain. */
    TEST_ASSERT_FALSE(fmcw_sign_is_open(15277, 5270, 2000));
    TEST_ASSERT_FALSE(fmcw_sign_is_open(200000, 200001, 2500));
    /* Equal beats: the other reading would be a target at 0 m. */
    TEST_ASSERT_FALSE(fmcw_sign_is_open(1000, 1000, 2000));
    TEST_ASSERT_TRUE(fmcw_sign_is_open(1000, 1001, 2000));
}

/* The other reading is that of -f+, and possible up to 10 km/h above the own speed. */
static void test_open_sign_is_that_of_a_possible_closing_speed(void)
{
    int32_t sum_hz;

    for (sum_hz = 1; sum_hz < FMCW_DIFF_END_HZ; sum_hz += 1117) {
        int32_t up_hz = sum_hz / 3;
        int16_t closing_dkmh = fmcw_closing_dkmh(-up_hz, sum_hz - up_hz);
        if (closing_dkmh >= 100 && closing_dkmh < 2600) {
            uint16_t own_dkmh = (uint16_t)(closing_dkmh - 100);
            TEST_ASSERT_TRUE(fmcw_sign_is_open(up_hz, sum_hz - up_hz, own_dkmh));
            TEST_ASSERT_TRUE(fmcw_sign_is_open(up_hz, sum_hz - up_hz, own_dkmh + 1U));
            if (own_dkmh != 0) {
                TEST_ASSERT_FALSE(fmcw_sign_is_open(up_hz, sum_hz - up_hz, own_dkmh - 1U));
            }
        } else {
            TEST_ASSERT_EQUAL(closing_dkmh < 100, fmcw_sign_is_open(up_hz, sum_hz - up_hz, 0));
        }
    }
    TEST_ASSERT_FALSE(fmcw_sign_is_open(0, FMCW_DIFF_END_HZ - 1, 2500));
    TEST_ASSERT_FALSE(fmcw_sign_is_open(0, FMCW_DIFF_END_HZ, 2500));
    TEST_ASSERT_FALSE(fmcw_sign_is_open(0, FMCW_DIFF_END_HZ + 1, 2500));
}

#ifndef __SDCC_mcs51
/* Against the formulas themselves, over everything that is possible. */
static void test_range_is_exact_to_a_centimetre(void)
{
    const double metre_per_hz = 299792458.0 * 2e-3 / (8 * 150e6);

    for (int32_t sum_hz = 0; sum_hz < FMCW_SUM_END_HZ; sum_hz++) {
        double error_cm =
            fmcw_range_cm(sum_hz / 3, sum_hz - sum_hz / 3) - sum_hz * metre_per_hz * 100;
        TEST_ASSERT_TRUE_MESSAGE(error_cm > -2.3 && error_cm <= 0.0, "cm");
    }
}

/* Rounded to the nearest, but for 1 Hz that is cut off before, and the rounding of the factor: half
 * of 1 in 36743, of 4593 units. */
static void test_closing_is_exact_to_a_tenth(void)
{
    const double dkmh_per_hz = 299792458.0 / (4 * 77e9) * 36;
    const double factor_dkmh = 4593 * 0.5 / 36743;

    for (int32_t diff_hz = 0; diff_hz < FMCW_DIFF_END_HZ; diff_hz++) {
        int16_t dkmh = fmcw_closing_dkmh(150000 - diff_hz, 150000);
        double error_dkmh = dkmh - (double)diff_hz * dkmh_per_hz;

        TEST_ASSERT_TRUE_MESSAGE(error_dkmh < 0.5 + factor_dkmh, "0.1 km/h");
        TEST_ASSERT_TRUE_MESSAGE(error_dkmh > -0.5 - dkmh_per_hz - factor_dkmh, "0.1 km/h");
        TEST_ASSERT_EQUAL_INT16(-dkmh, fmcw_closing_dkmh(150000, 150000 - diff_hz));
    }
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_five_metres_at_twenty_mps_needs_the_sign);
    RUN_TEST(test_equal_beats_are_equal_speeds);
    RUN_TEST(test_opening_is_negative);
    RUN_TEST(test_limits_of_what_is_possible);
    RUN_TEST(test_open_sign_is_seen_only_where_both_readings_are_possible);
    RUN_TEST(test_open_sign_is_that_of_a_possible_closing_speed);
#ifndef __SDCC_mcs51
    RUN_TEST(test_range_is_exact_to_a_centimetre);
    RUN_TEST(test_closing_is_exact_to_a_tenth);
#endif
    return UNITY_END();
}
