/* SPDX-License-Identifier: MIT */
/* closing, of the TF-Luna: both estimators, 100 readings a second. */
#define SENSOR_tfluna
#include <stddef.h>
#include "unity.h"
#include "closing_tfluna.c"

static uint16_t place_mm;

/* The target's first place, and 60 ms later its second one. */
static void begin(uint16_t dist_mm, int16_t step_mm)
{
    closing_restart();
    closing_place_mm = dist_mm;
    place_mm = (uint16_t)(dist_mm - step_mm);
    closing_take_second(place_mm, 6);
}

static void take(uint16_t dist_mm, uint8_t span_cs)
{
    place_mm = dist_mm;
    closing_expect(span_cs);
    closing_take(dist_mm, span_cs);
    closing_take_difference();
    closing_take_smooth();
}

/* In steps of 1 cm, as the sensor says it: the speed is steps_mm in each 1/100 s, from 8 m on. */
static void drive(int16_t mm_per_cs, uint8_t readings)
{
    int16_t way_mm = 0;

    while (readings-- != 0) {
        way_mm = (int16_t)(way_mm + mm_per_cs);
        take((uint16_t)(place_mm - way_mm / 10 * 10), 1);
        way_mm = (int16_t)(way_mm - way_mm / 10 * 10);
    }
}

/* With the sign: positive when closing. */
static int32_t speed(const struct closing_speed *estimate)
{
    TEST_ASSERT_TRUE(estimate->closing_mmps == 0 || estimate->opening_mmps == 0);
    return (int32_t)estimate->closing_mmps - (int32_t)estimate->opening_mmps;
}

void setUp(void)
{
    begin(8000, 0);
}

void tearDown(void)
{
}

static void test_first_place_has_no_speed(void)
{
    begin(8000, 300);
    closing_restart();
    TEST_ASSERT_EQUAL_INT32(0, speed(&closing_difference));
    TEST_ASSERT_EQUAL_INT32(0, speed(&closing_smooth));
}

static void test_both_begin_with_the_difference(void)
{
    int16_t mm;

    for (mm = -720; mm <= 2160; mm += 10) {
        begin(6000, mm);
        TEST_ASSERT_INT32_WITHIN(8, (int32_t)mm * 1000 / 60, speed(&closing_difference));
        TEST_ASSERT_EQUAL_INT32(speed(&closing_difference), speed(&closing_smooth));
        TEST_ASSERT_EQUAL_UINT8(6, closing_span_cs);
        TEST_ASSERT_EQUAL_UINT16(6000 - mm, closing_place_mm);
    }
}

static void test_a_longer_time_to_the_second_place_counts(void)
{
    uint8_t cs;

    for (cs = 6; cs <= 40; cs++) {
        closing_place_mm = 6000;
        closing_take_second(5000, cs);
        TEST_ASSERT_INT32_WITHIN(8, 100000L / (cs < 31 ? cs : 31), speed(&closing_difference));
    }
}

/* More counts as 3.2 m. */
static void test_a_far_too_long_way_counts_as_the_longest(void)
{
    uint16_t most_mmps;

    begin(8000, 3200);
    most_mmps = closing_smooth.closing_mmps;
    begin(8000, 3201);
    TEST_ASSERT_EQUAL_UINT16(most_mmps, closing_smooth.closing_mmps);
    begin(2000, -3201);
    TEST_ASSERT_EQUAL_UINT16(most_mmps, closing_smooth.opening_mmps);
}

/* The difference takes a place only if it is 60 ms after the one that it took last. */
static void test_the_difference_is_one_of_60_ms(void)
{
    uint8_t i;

    for (i = 1; i < 6; i++) {
        take((uint16_t)(place_mm - 100), 1);
        TEST_ASSERT_EQUAL_INT32(0, speed(&closing_difference));
    }
    take((uint16_t)(place_mm - 100), 1);
    TEST_ASSERT_INT32_WITHIN(8, 10000, speed(&closing_difference));
    TEST_ASSERT_EQUAL_UINT8(6, closing_span_cs);
    take((uint16_t)(place_mm + 50), 3);
    TEST_ASSERT_INT32_WITHIN(8, 10000, speed(&closing_difference));
    take((uint16_t)(place_mm + 50), 5);
    TEST_ASSERT_INT32_WITHIN(8, -1250, speed(&closing_difference));
    TEST_ASSERT_EQUAL_UINT8(8, closing_span_cs);
}

static void test_a_constant_speed_is_found(void)
{
    int16_t mm_per_cs;

    for (mm_per_cs = -30; mm_per_cs <= 80; mm_per_cs++) {
        begin(mm_per_cs < 0 ? 3000 : 8000, (int16_t)(mm_per_cs * 6 / 10 * 10));
        drive(mm_per_cs, 70);
        TEST_ASSERT_INT32_WITHIN(70, (int32_t)mm_per_cs * 100, speed(&closing_smooth));
        TEST_ASSERT_INT32_WITHIN(170, (int32_t)mm_per_cs * 100, speed(&closing_difference));
    }
}

/* From a wrong beginning, too. */
static void test_a_wrong_beginning_is_forgotten(void)
{
    begin(7000, 200);
    drive(0, 100);
    TEST_ASSERT_INT32_WITHIN(20, 0, speed(&closing_smooth));
}

/* One reading that is 2 cm off moves the smooth speed by 2 cm / 64 / 10 ms. */
static void test_noise_moves_the_smooth_speed_little(void)
{
    take(8020, 1);
    TEST_ASSERT_INT32_WITHIN(3, -31, speed(&closing_smooth));
    begin(4000, 0);
    take(3980, 1);
    TEST_ASSERT_INT32_WITHIN(3, 31, speed(&closing_smooth));
}

static void test_a_place_far_off_counts_as_the_furthest(void)
{
    int32_t most;

    begin(4000, 0);
    take(4320, 1);
    most = speed(&closing_smooth);
    TEST_ASSERT_INT32_WITHIN(3, -500, most);
    begin(4000, 0);
    take(4330, 1);
    TEST_ASSERT_EQUAL_INT32(most, speed(&closing_smooth));
    begin(4000, 0);
    take(3680, 1);
    most = speed(&closing_smooth);
    TEST_ASSERT_INT32_WITHIN(3, 500, most);
    begin(4000, 0);
    take(3670, 1);
    TEST_ASSERT_EQUAL_INT32(most, speed(&closing_smooth));
}

/* A missing reading is no error: the next one is where it should be. */
static void test_the_place_is_foreseen_over_any_time(void)
{
    uint8_t cs;

    begin(6000, 600); /* 10 m/s */
    for (cs = 1; cs <= 31; cs++) {
        closing_expect(cs);
        TEST_ASSERT_INT32_WITHIN(3, 5400 - (cs < 25 ? cs : 25) * 100, closing_foreseen_mm);
    }
    begin(3000, -600);
    for (cs = 1; cs <= 25; cs++) {
        closing_expect(cs);
        TEST_ASSERT_INT32_WITHIN(3, 3600 + cs * 100, closing_foreseen_mm);
    }
}

/* Below 0 mm it goes on modulo 2^16. */
static void test_a_place_behind_the_sensor_is_foreseen_below_zero(void)
{
    begin(1500, 1000);
    closing_expect(20);
    TEST_ASSERT_INT16_WITHIN(8, 500 - 3333, (int16_t)closing_foreseen_mm);
    TEST_ASSERT_TRUE(closing_foreseen_mm > 60000U);
    take(0, 20);
    TEST_ASSERT_TRUE(closing_smooth.closing_mmps > 10000U);
}

/* Rounded down: 1 mm in n/100 s is 50 / n units of 2 mm/s, which is in the table as 1 / 4096. */
static void test_each_time_has_its_rate(void)
{
    uint8_t span_cs, i;
    int16_t mm;

    for (span_cs = CLOSING_SPAN_MIN_CS; span_cs <= CLOSING_SPAN_MAX_CS; span_cs++) {
        uint16_t rate = (uint16_t)((204800UL + span_cs - 1U) / span_cs);

        for (i = 0; i < 40; i++) {
            mm = (int16_t)(i < 30 ? 3200 - i : i - 29);
            closing_place_mm = 8000;
            closing_take_second((uint16_t)(8000 - mm), span_cs);
            TEST_ASSERT_EQUAL_INT32(2 * ((((uint32_t)mm << 4) * rate) >> 16),
                                    speed(&closing_smooth));
            closing_place_mm = 8000;
            closing_take_second((uint16_t)(8000 + mm), span_cs);
            TEST_ASSERT_EQUAL_INT32(-2 * (int32_t)((((uint32_t)mm << 4) * rate) >> 16),
                                    speed(&closing_smooth));
        }
    }
}

/* By hand: 25 / 128 of the quarters of 1 mm for the speed, 3 / 16 for the place, rounded down. */
static void test_a_place_off_moves_speed_and_place_by_their_parts(void)
{
    static const struct {
        int16_t off_mm, speed_mmps, place_mm;
    } cases[] = {{0, 0, 4000},       {1, 0, 4000},     {2, 2, 3999},       {-1, -2, 4000},
                 {-2, -4, 4000},     {100, 156, 3981}, {-100, -158, 4018}, {319, 498, 3940},
                 {-319, -500, 4060}, {320, 500, 3940}, {-320, -500, 4060}, {321, 500, 3940},
                 {-321, -500, 4060}, {900, 500, 3940}, {-900, -500, 4060}};
    uint8_t i;

    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        begin(4000, 0);
        take((uint16_t)(4000 - cases[i].off_mm), 1);
        TEST_ASSERT_EQUAL_INT32(cases[i].speed_mmps, speed(&closing_smooth));
        closing_expect(0);
        TEST_ASSERT_EQUAL_UINT16(cases[i].place_mm, closing_foreseen_mm);
    }
}

static void test_the_way_of_a_quarter_of_a_second_is_foreseen(void)
{
    begin(8000, 2100); /* 35 m/s: 8.75 m */
    closing_expect(25);
    TEST_ASSERT_INT16_WITHIN(2, 5900 - 8750, (int16_t)closing_foreseen_mm);
    begin(1300, 300); /* 5 m/s: from 1 m on 1249.8 mm, rounded down as the speed is */
    closing_expect(25);
    TEST_ASSERT_EQUAL_INT16(-250, (int16_t)closing_foreseen_mm);
}

/* A quarter of a mm on either side of the furthest. */
static void test_the_furthest_is_320_mm_to_a_quarter(void)
{
    int16_t off_4mm;

    for (off_4mm = -1290; off_4mm <= 1290; off_4mm = off_4mm == -1270 ? 1270 : off_4mm + 1) {
        int16_t counts_4mm = off_4mm < -1280 ? -1280 : off_4mm > 1280 ? 1280 : off_4mm;

        closing_place_mm = 4000;
        foreseen_4mm = (uint16_t)(4000 * 4 + off_4mm);
        smooth_2mmps = 1000;
        closing_take_smooth();
        /* 640 of 128 and 240 of 16 make the numbers positive, so that both divisions round down. */
        TEST_ASSERT_EQUAL_UINT16(1000 + (counts_4mm * 25L + 640L * 128) / 128 - 640, smooth_2mmps);
        TEST_ASSERT_EQUAL_UINT16(foreseen_4mm - ((counts_4mm * 3 + 240 * 16) / 16 - 240),
                                 smooth_4mm);
    }
}

/* The sum tells each bit of what is kept from one reading to the next. */
static void test_each_bit_changes_the_sum(void)
{
    uint8_t sum, bit;

    begin(6000, 300);
    take(5950, 1);
    sum = closing_sum();
    for (bit = 1; bit != 0; bit = (uint8_t)(bit << 1)) {
#define CHANGES(variable, mask)                                                                    \
    variable ^= (mask);                                                                            \
    TEST_ASSERT_TRUE(closing_sum() != sum);                                                        \
    variable ^= (mask)
        CHANGES(mark_mm, bit);
        CHANGES(mark_mm, (uint16_t)(bit << 8));
        CHANGES(foreseen_4mm, bit);
        CHANGES(foreseen_4mm, (uint16_t)(bit << 8));
        CHANGES(smooth_4mm, bit);
        CHANGES(smooth_4mm, (uint16_t)(bit << 8));
        CHANGES(smooth_2mmps, bit);
        CHANGES(smooth_2mmps, (uint16_t)(bit << 8));
        CHANGES(since_mark_cs, bit);
        CHANGES(closing_span_cs, bit);
        CHANGES(closing_place_mm, bit);
        CHANGES(closing_foreseen_mm, bit);
        CHANGES(closing_smooth.closing_mmps, bit);
        CHANGES(closing_smooth.opening_mmps, bit);
        CHANGES(closing_difference.closing_mmps, bit);
        CHANGES(closing_difference.opening_mmps, bit);
    }
    TEST_ASSERT_EQUAL_UINT8(sum, closing_sum());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_first_place_has_no_speed);
    RUN_TEST(test_both_begin_with_the_difference);
    RUN_TEST(test_a_longer_time_to_the_second_place_counts);
    RUN_TEST(test_a_far_too_long_way_counts_as_the_longest);
    RUN_TEST(test_the_difference_is_one_of_60_ms);
    RUN_TEST(test_a_constant_speed_is_found);
    RUN_TEST(test_a_wrong_beginning_is_forgotten);
    RUN_TEST(test_noise_moves_the_smooth_speed_little);
    RUN_TEST(test_a_place_far_off_counts_as_the_furthest);
    RUN_TEST(test_the_place_is_foreseen_over_any_time);
    RUN_TEST(test_a_place_behind_the_sensor_is_foreseen_below_zero);
    RUN_TEST(test_each_time_has_its_rate);
    RUN_TEST(test_a_place_off_moves_speed_and_place_by_their_parts);
    RUN_TEST(test_the_way_of_a_quarter_of_a_second_is_foreseen);
    RUN_TEST(test_the_furthest_is_320_mm_to_a_quarter);
    RUN_TEST(test_each_bit_changes_the_sum);
    return UNITY_END();
}
