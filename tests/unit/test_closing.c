/* SPDX-License-Identifier: MIT */
/* closing: both estimators, the gate, dropouts. Readings and times are arguments; no clock. */
#include <stddef.h>
#include "unity.h"
#include "closing.h"

#define PERIOD_CS 6U

static uint16_t place_mm;

void setUp(void)
{
    closing_restart();
}

void tearDown(void)
{
}

static bool update(uint16_t dist_mm, uint8_t elapsed_cs)
{
    bool is_believed;

    closing_expect(elapsed_cs);
    is_believed = closing_update(dist_mm);

    if (is_believed && closing_samples == 3) {
        closing_take_difference();
        closing_take_smooth();
    }
    return is_believed;
}

static bool read_at(uint16_t dist_mm)
{
    place_mm = dist_mm;
    return update(dist_mm, PERIOD_CS);
}

static bool read_nearer(int16_t step_mm)
{
    return read_at((uint16_t)(place_mm - step_mm));
}

static void test_first_reading_has_no_speed(void)
{
    TEST_ASSERT_TRUE(read_at(3000));
    TEST_ASSERT_EQUAL_UINT8(1, closing_samples);
    TEST_ASSERT_EQUAL_UINT16(0, closing_difference.closing_mmps);
    TEST_ASSERT_EQUAL_UINT16(0, closing_difference.opening_mmps);
}

/* step mm in 60 ms is step * 50 / 3 mm/s. The difference is off by its unit of 2 mm/s, alpha-beta
 * by a quarter of the millimetre that its place may be off. */
static void test_every_steady_speed_is_found(void)
{
    int16_t step;

    for (step = -320; step <= 2100; step++) {
        bool is_opening = step < 0;
        uint16_t exact_mmps = (uint16_t)((uint32_t)(is_opening ? -step : step) * 50U / 3U);
        uint16_t difference_mmps, smooth_mmps;
        uint8_t reading;

        closing_restart();
        read_at(is_opening ? 1000 : 6000);
        for (reading = 0; reading < (step > 1000 ? 1 : 4); reading++) {
            if (!read_nearer(step)) {
                TEST_ASSERT_EQUAL_INT16_MESSAGE(0, step, "a steady step in mm was set aside");
            }
        }
        difference_mmps =
            is_opening ? closing_difference.opening_mmps : closing_difference.closing_mmps;
        smooth_mmps = is_opening ? closing_smooth.opening_mmps : closing_smooth.closing_mmps;
        if (difference_mmps + 2U < exact_mmps || difference_mmps > exact_mmps + 2U) {
            TEST_ASSERT_EQUAL_UINT16(exact_mmps, difference_mmps);
        }
        if (smooth_mmps + 5U < exact_mmps || smooth_mmps > exact_mmps + 5U) {
            TEST_ASSERT_EQUAL_UINT16(exact_mmps, smooth_mmps);
        }
        if ((is_opening ? closing_difference.closing_mmps : closing_difference.opening_mmps) != 0 ||
            (is_opening ? closing_smooth.closing_mmps : closing_smooth.opening_mmps) != 0) {
            TEST_ASSERT_EQUAL_INT16_MESSAGE(0, step, "both magnitudes for one step in mm");
        }
    }
}

#ifdef __SDCC_mcs51
#define STEP 17
#else
#define STEP 1
#endif

/* A target that stood, off by so much: the smooth speed is a quarter of the difference's, to the
 * bit. Its factor is 1 / 16 of 50 / n, times 2^20 and rounded up. */
static void test_smooth_takes_a_quarter_of_each_deviation_within_the_gate(void)
{
    uint8_t period_cs;
    int16_t off;

    for (period_cs = CLOSING_ELAPSED_MIN_CS; period_cs <= CLOSING_ELAPSED_MAX_CS; period_cs++) {
        uint32_t rate = (204800UL + period_cs - 1) / period_cs;

        for (off = -350; off <= 350; off += STEP) {
            uint16_t apart = (uint16_t)(off < 0 ? -off : off);
            uint16_t whole_2mmps = (uint16_t)((rate * apart) >> 12),
                     mmps = (uint16_t)(whole_2mmps >> 2 << 1);

            closing_restart();
            update(3000, period_cs);
            update(3000, period_cs);
            update((uint16_t)(3000 + off), period_cs);
            if (closing_smooth.closing_mmps != (off < 0 ? mmps : 0) ||
                closing_smooth.opening_mmps != (off > 0 ? mmps : 0) ||
                closing_difference.closing_mmps != (off < 0 ? whole_2mmps << 1 : 0) ||
                closing_difference.opening_mmps != (off > 0 ? whole_2mmps << 1 : 0)) {
                TEST_ASSERT_EQUAL_INT16_MESSAGE(0, off, "mm off: not what the plain product says");
            }
        }
    }
}

static void test_true_elapsed_time_counts_after_a_dropout(void)
{
    uint8_t missing;

    for (missing = 0; missing <= 4; missing++) {
        uint8_t i;

        closing_restart();
        read_at(5000);
        read_nearer(180);
        read_nearer(180);
        for (i = 0; i < missing; i++) {
            closing_expect(PERIOD_CS);
            place_mm -= 180;
        }
        TEST_ASSERT_TRUE(read_nearer(180));
        TEST_ASSERT_UINT16_WITHIN(4, 3000, closing_difference.closing_mmps);
        TEST_ASSERT_UINT16_WITHIN(10, 3000, closing_smooth.closing_mmps);
    }
}

static void test_other_periods_work_too(void)
{
    uint8_t period_cs;

    for (period_cs = CLOSING_ELAPSED_MIN_CS; period_cs <= CLOSING_ELAPSED_MAX_CS; period_cs++) {
        closing_restart();
        update(5000, period_cs);
        update((uint16_t)(5000 - 10 * period_cs), period_cs);
        TEST_ASSERT_UINT16_WITHIN(2, 1000, closing_difference.closing_mmps);
    }
}

static void test_a_time_too_short_counts_as_the_shortest(void)
{
    uint8_t elapsed_cs;

    for (elapsed_cs = 0; elapsed_cs < CLOSING_ELAPSED_MIN_CS; elapsed_cs++) {
        closing_restart();
        update(3000, CLOSING_ELAPSED_MIN_CS);
        TEST_ASSERT_TRUE(update(2900, elapsed_cs));
        TEST_ASSERT_UINT16_WITHIN(2, 100U * 100U / CLOSING_ELAPSED_MIN_CS,
                                  closing_difference.closing_mmps);
    }
}

static void test_a_target_starts_anew_after_a_long_silence(void)
{
    read_at(5000);
    read_nearer(100);
    read_nearer(100);
    closing_expect(CLOSING_ELAPSED_MAX_CS);

    TEST_ASSERT_TRUE(read_at(1500));
    TEST_ASSERT_EQUAL_UINT8(1, closing_samples);
    TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
}

static void test_gate_opens_with_the_third_reading_and_at_its_limit(void)
{
    int16_t off;

    for (off = -400; off <= 400; off++) {
        bool expected = off >= -350 && off <= 350;

        closing_restart();
        read_at(3000);
        read_at(3000);
        if (read_at((uint16_t)(3000 + off)) != expected) {
            TEST_ASSERT_EQUAL_INT16_MESSAGE(350, off,
                                            "mm off: believed, or not, on the wrong side");
        }
    }
}

static void test_second_reading_may_be_as_far_as_36_mps_go(void)
{
    read_at(5000);
    TEST_ASSERT_TRUE(read_at(5000 - 2160));
    TEST_ASSERT_UINT16_WITHIN(2, 36000U, closing_difference.closing_mmps);

    closing_restart();
    read_at(5000);
    TEST_ASSERT_FALSE(read_at(5000 - 2161));
    TEST_ASSERT_EQUAL_UINT8(1, closing_samples);
}

static void test_one_wild_reading_leaves_the_speeds_alone(void)
{
    uint8_t i;

    read_at(4000);
    for (i = 0; i < 5; i++) {
        read_nearer(60);
    }
    TEST_ASSERT_UINT16_WITHIN(2, 1000, closing_difference.closing_mmps);

    TEST_ASSERT_FALSE(update(600, PERIOD_CS));
    TEST_ASSERT_UINT16_WITHIN(2, 1000, closing_difference.closing_mmps);
    TEST_ASSERT_UINT16_WITHIN(2, 1000, closing_smooth.closing_mmps);

    TEST_ASSERT_TRUE(read_nearer(120));
    TEST_ASSERT_UINT16_WITHIN(3, 1000, closing_difference.closing_mmps);
    TEST_ASSERT_UINT16_WITHIN(3, 1000, closing_smooth.closing_mmps);
    TEST_ASSERT_EQUAL_UINT8(3, closing_samples);
}

static void test_second_reading_that_agrees_is_believed(void)
{
    read_at(4000);
    read_at(4000);
    read_at(4000);
    TEST_ASSERT_FALSE(read_at(2000));

    TEST_ASSERT_TRUE(read_nearer(180));
    TEST_ASSERT_EQUAL_UINT8(2, closing_samples);
    TEST_ASSERT_UINT16_WITHIN(2, 3000, closing_difference.closing_mmps);
    TEST_ASSERT_UINT16_WITHIN(2, 3000, closing_smooth.closing_mmps);
}

static void test_readings_that_agree_with_nothing_are_never_believed(void)
{
    static const uint16_t __code wild_mm[] = {600, 5600, 1700, 3100, 4600};
    uint8_t i;

    read_at(4000);
    read_at(4000);
    read_at(4000);
    for (i = 0; i < 4; i++) {
        TEST_ASSERT_FALSE(read_at(wild_mm[i]));
    }
}

/* A ramp in speed: the brake at 8 m/s2. The difference lags half a period, alpha-beta three. */
static void test_lag_behind_braking_is_that_of_the_estimator(void)
{
    uint16_t mmps = 5000;
    uint8_t i;

    read_at(5000);
    for (i = 0; i < 10; i++) {
        mmps -= 480;
        read_nearer((int16_t)((mmps + 240) * 3L / 50));
    }
    TEST_ASSERT_UINT16_WITHIN(30, mmps + 240, closing_difference.closing_mmps);
    TEST_ASSERT_UINT16_WITHIN(480, mmps + 1200, closing_smooth.closing_mmps);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_first_reading_has_no_speed);
    RUN_TEST(test_every_steady_speed_is_found);
    RUN_TEST(test_smooth_takes_a_quarter_of_each_deviation_within_the_gate);
    RUN_TEST(test_true_elapsed_time_counts_after_a_dropout);
    RUN_TEST(test_other_periods_work_too);
    RUN_TEST(test_a_time_too_short_counts_as_the_shortest);
    RUN_TEST(test_a_target_starts_anew_after_a_long_silence);
    RUN_TEST(test_gate_opens_with_the_third_reading_and_at_its_limit);
    RUN_TEST(test_second_reading_may_be_as_far_as_36_mps_go);
    RUN_TEST(test_one_wild_reading_leaves_the_speeds_alone);
    RUN_TEST(test_second_reading_that_agrees_is_believed);
    RUN_TEST(test_readings_that_agree_with_nothing_are_never_believed);
    RUN_TEST(test_lag_behind_braking_is_that_of_the_estimator);
    return UNITY_END();
}
