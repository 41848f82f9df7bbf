/* SPDX-License-Identifier: MIT */
/* closing: both estimators. Places and times are arguments; no clock. */
#include <stddef.h>
#include "unity.h"
#include "closing.h"

#define PERIOD_CS 6U

static uint16_t place_mm;
static uint8_t places;

static void begin(uint16_t dist_mm)
{
    closing_restart();
    closing_place_mm = dist_mm;
    place_mm = dist_mm;
    places = 1;
}

void setUp(void)
{
    begin(3000);
}

void tearDown(void)
{
}

static void take(uint16_t dist_mm, uint8_t span_cs)
{
    place_mm = dist_mm;
    if (places == 1) {
        closing_take_second(dist_mm, span_cs);
    } else {
        closing_expect(span_cs);
        closing_take(dist_mm, span_cs);
        closing_take_difference();
        closing_take_smooth();
    }
    places = 2;
}

static void take_nearer(int16_t step_mm)
{
    take((uint16_t)(place_mm - step_mm), PERIOD_CS);
}

#ifdef __SDCC_mcs51
#define STEP     17
#define READINGS 4
#else
#define STEP     1
#define READINGS 50
#endif

static void test_first_place_has_no_speed(void)
{
    take_nearer(100);
    closing_restart();
    TEST_ASSERT_EQUAL_UINT16(0, closing_difference.closing_mmps);
    TEST_ASSERT_EQUAL_UINT16(0, closing_difference.opening_mmps);
    TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
    TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.opening_mmps);
}

/* step mm in 60 ms is v = step * 50 / 3 mm/s. The difference is off by its unit of 2 mm/s, and so
 * is the first speed w of alpha-beta. Alpha-beta foresees floor(w * f) mm, where f is
 * 6 * 655 / 65536 s. It raises w only where that is less than step. Then w < step / f, which is
 * v * 3932.16 / 3930, and w rises by at most 4.2 mm/s for each mm that is missing. The last rise is
 * for 1 mm. So w < v + v / 1819 + 4.2 for ever. It lowers w only where it foresees more than step,
 * and then w > v + 16. The test allows 5 + v / 1819. */
static void test_every_steady_speed_is_found(void)
{
    int16_t step;

    for (step = -720; step <= 2160; step++) {
        bool is_opening = step < 0;
        uint16_t exact_mmps = (uint16_t)((uint32_t)(is_opening ? -step : step) * 50U / 3U);
        uint16_t difference_mmps, smooth_mmps;
        uint8_t reading;

        begin(is_opening ? 1000 : 6000);
        for (reading = 0; reading < (step > 1000 ? 1 : READINGS); reading++) {
            take_nearer(step);
        }
        difference_mmps =
            is_opening ? closing_difference.opening_mmps : closing_difference.closing_mmps;
        smooth_mmps = is_opening ? closing_smooth.opening_mmps : closing_smooth.closing_mmps;
        if (difference_mmps + 2U < exact_mmps || difference_mmps > exact_mmps + 2U) {
            TEST_ASSERT_EQUAL_UINT16(exact_mmps, difference_mmps);
        }
        if (smooth_mmps + 2U < exact_mmps || smooth_mmps > exact_mmps + 5U + exact_mmps / 1819U) {
            TEST_ASSERT_EQUAL_UINT16(exact_mmps, smooth_mmps);
        }
        if ((is_opening ? closing_difference.closing_mmps : closing_difference.opening_mmps) != 0 ||
            (is_opening ? closing_smooth.closing_mmps : closing_smooth.opening_mmps) != 0) {
            TEST_ASSERT_EQUAL_INT16_MESSAGE(0, step, "both magnitudes for one step in mm");
        }
    }
}

/* A target that stood, off by so much: the smooth speed is a quarter of the difference's, rounded
 * down, and to the bit. Its factor is 1 / 16 of 50 / n, times 2^20 and rounded up. */
static void test_smooth_takes_a_quarter_of_each_deviation(void)
{
    uint8_t span_cs;
    int16_t off;

    for (span_cs = CLOSING_SPAN_MIN_CS; span_cs <= CLOSING_SPAN_MAX_CS; span_cs++) {
        uint32_t rate = (204800UL + span_cs - 1) / span_cs;

        for (off = -350; off <= 350; off += STEP) {
            uint16_t apart = (uint16_t)(off < 0 ? -off : off);
            uint16_t whole_2mmps = (uint16_t)((rate * apart) >> 12);
            uint16_t closing_mmps = (uint16_t)(whole_2mmps >> 2 << 1);
            uint16_t opening_mmps = (uint16_t)((whole_2mmps + 3U) >> 2 << 1);

            begin(3000);
            take(3000, span_cs);
            take((uint16_t)(3000 + off), span_cs);
            if (closing_smooth.closing_mmps != (off < 0 ? closing_mmps : 0) ||
                closing_smooth.opening_mmps != (off > 0 ? opening_mmps : 0) ||
                closing_difference.closing_mmps != (off < 0 ? whole_2mmps << 1 : 0) ||
                closing_difference.opening_mmps != (off > 0 ? whole_2mmps << 1 : 0)) {
                TEST_ASSERT_EQUAL_INT16_MESSAGE(0, off, "mm off: not what the plain product says");
            }
        }
    }
}

static void test_every_span_works(void)
{
    uint8_t span_cs;

    for (span_cs = CLOSING_SPAN_MIN_CS; span_cs <= CLOSING_SPAN_MAX_CS; span_cs++) {
        begin(5000);
        take((uint16_t)(5000 - 10 * span_cs), span_cs);
        TEST_ASSERT_UINT16_WITHIN(2, 1000, closing_difference.closing_mmps);
        TEST_ASSERT_EQUAL_UINT8(span_cs, closing_span_cs);
        take((uint16_t)(5000 - 20 * span_cs), span_cs);
        TEST_ASSERT_UINT16_WITHIN(2, 1000, closing_difference.closing_mmps);
        TEST_ASSERT_UINT16_WITHIN(8, 1000, closing_smooth.closing_mmps);
    }
}

/* mm in n/100 s are 50 * mm / n units of 2 mm/s. The factor of n is rounded up by less than
 * 1 / 4096; where 204800 is a multiple of n it is exact. */
static void test_every_difference_is_the_quotient(void)
{
    uint8_t span_cs;
    uint16_t mm;

    for (span_cs = CLOSING_SPAN_MIN_CS; span_cs <= CLOSING_SPAN_MAX_CS; span_cs++) {
        for (mm = 1; mm <= 3200; mm += STEP) {
            uint32_t units, exact_units = mm * 50UL / span_cs;

            begin(mm);
            take(0, span_cs);
            units = closing_difference.closing_mmps / 2U;
            if (units < exact_units || units * span_cs * 4096UL >= mm * (204800UL + span_cs) ||
                (204800UL % span_cs == 0 && units != exact_units)) {
                TEST_ASSERT_EQUAL_UINT16_MESSAGE(exact_units, units, "not the quotient");
            }
        }
    }
}

static void test_other_spans_count_as_the_longest(void)
{
    uint8_t i;
    static const uint8_t __code other_cs[] = {0, 4, 32, 255};

    for (i = 0; i < 4; i++) {
        begin(5000);
        take(4690, other_cs[i]);
        TEST_ASSERT_UINT16_WITHIN(2, 1000, closing_difference.closing_mmps);
    }
}

static void test_a_move_beyond_what_counts_is_held_to_it(void)
{
    begin(5900);
    take(100, CLOSING_SPAN_MAX_CS);
    TEST_ASSERT_UINT16_WITHIN(4, (uint16_t)(3200UL * 100U / CLOSING_SPAN_MAX_CS),
                              closing_difference.closing_mmps);
    begin(3201);
    take(0, CLOSING_SPAN_MIN_CS);
    TEST_ASSERT_EQUAL_UINT16(64000U, closing_difference.closing_mmps); /* as 3200 mm in 50 ms */
}

/* At 3 m/s, 0.3 s ahead: 6 mm for the factor's rounding. */
static void test_the_next_place_is_foreseen(void)
{
    uint8_t span_cs;

    for (span_cs = CLOSING_SPAN_MIN_CS; span_cs <= CLOSING_SPAN_MAX_CS; span_cs++) {
        begin(5000);
        take_nearer(180);
        closing_expect(span_cs);
        TEST_ASSERT_UINT16_WITHIN(6, 4820U - 30U * span_cs, closing_foreseen_mm);
        begin(1000);
        take_nearer(-180);
        closing_expect(span_cs);
        TEST_ASSERT_UINT16_WITHIN(6, 1180U + 30U * span_cs, closing_foreseen_mm);
    }
}

/* A ramp in speed: the brake at 8 m/s2. The difference lags half a period, alpha-beta three. */
static void test_lag_behind_braking_is_that_of_the_estimator(void)
{
    uint16_t mmps = 5000;
    uint8_t i;

    begin(5000);
    for (i = 0; i < 10; i++) {
        mmps -= 480;
        take_nearer((int16_t)((mmps + 240) * 3L / 50));
    }
    TEST_ASSERT_UINT16_WITHIN(30, mmps + 240, closing_difference.closing_mmps);
    TEST_ASSERT_UINT16_WITHIN(480, mmps + 1200, closing_smooth.closing_mmps);
}

static void test_one_of_the_two_magnitudes_is_always_zero(void)
{
    int16_t step_mm;

    for (step_mm = -60; step_mm <= 60; step_mm += 120) {
        uint8_t i;

        begin(3000);
        take_nearer(step_mm);
        TEST_ASSERT_EQUAL_UINT16(step_mm > 0 ? 1000 : 0, closing_difference.closing_mmps);
        TEST_ASSERT_EQUAL_UINT16(step_mm < 0 ? 1000 : 0, closing_difference.opening_mmps);
        for (i = 0; i < 20; i++) {
            take_nearer((int16_t)-step_mm);
            TEST_ASSERT_TRUE(closing_difference.closing_mmps == 0 ||
                             closing_difference.opening_mmps == 0);
            TEST_ASSERT_TRUE(closing_smooth.closing_mmps == 0 || closing_smooth.opening_mmps == 0);
        }
        TEST_ASSERT_TRUE((step_mm < 0 ? closing_smooth.closing_mmps : closing_smooth.opening_mmps) >
                         900);
    }
}

/* By hand. 3 m/s and 0.31 s are 3000 * 31 * 655 / 65536 = 929.5 mm. A target that stood and is
 * 42 mm further: its place is a quarter of that nearer, 10.5 mm, rounded to 10; its speed is a
 * quarter of 350 units, rounded up to 88, which are 10.6 mm in 60 ms. */
static void test_the_next_place_is_foreseen_to_the_millimetre(void)
{
    begin(5000);
    take_nearer(180);
    closing_expect(31);
    TEST_ASSERT_EQUAL_UINT16(4820 - 929, closing_foreseen_mm);
    begin(3000);
    take_nearer(0);
    take_nearer(-42);
    TEST_ASSERT_EQUAL_UINT16(176, closing_smooth.opening_mmps);
    closing_expect(PERIOD_CS);
    TEST_ASSERT_EQUAL_UINT16(3042 - 10 + 10, closing_foreseen_mm);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_first_place_has_no_speed);
    RUN_TEST(test_every_steady_speed_is_found);
    RUN_TEST(test_smooth_takes_a_quarter_of_each_deviation);
    RUN_TEST(test_every_span_works);
    RUN_TEST(test_every_difference_is_the_quotient);
    RUN_TEST(test_other_spans_count_as_the_longest);
    RUN_TEST(test_a_move_beyond_what_counts_is_held_to_it);
    RUN_TEST(test_the_next_place_is_foreseen);
    RUN_TEST(test_lag_behind_braking_is_that_of_the_estimator);
    RUN_TEST(test_one_of_the_two_magnitudes_is_always_zero);
    RUN_TEST(test_the_next_place_is_foreseen_to_the_millimetre);
    return UNITY_END();
}
