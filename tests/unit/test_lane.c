/* SPDX-License-Identifier: MIT */
/* The lane gate against the angles of the published geometry: inner edge radius 500 m, lane width
 * 3.75 m, so the lane centre's radius is 501.875 m. */
#include "lane.h"
#include <stddef.h>
#include "sweep.h"
#include "unity.h"

#ifndef __SDCC_mcs51
#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979
#endif

#define BEND_UPM 1993 /* 1 / 501.875 m */

void setUp(void)
{
}

void tearDown(void)
{
}

/* 65,536ths of a turn from thousandths of a degree, toward zero. */
static int16_t turns(int16_t millideg)
{
    return (int16_t)((int32_t)millideg * 8192 / 45000);
}

/* The lane at `range_cm` lies between two azimuths; both are right to a twentieth of a degree. */
static void expect_lane(uint16_t range_cm, int16_t outer_millideg, int16_t inner_millideg)
{
    TEST_ASSERT_FALSE(lane_is_own(range_cm, turns((int16_t)(outer_millideg - 50)), BEND_UPM));
    TEST_ASSERT_TRUE(lane_is_own(range_cm, turns((int16_t)(outer_millideg + 50)), BEND_UPM));
    TEST_ASSERT_TRUE(lane_is_own(range_cm, turns((int16_t)(inner_millideg - 50)), BEND_UPM));
    TEST_ASSERT_FALSE(lane_is_own(range_cm, turns((int16_t)(inner_millideg + 50)), BEND_UPM));
    /* The bend the other way is the mirror image. */
    TEST_ASSERT_FALSE(lane_is_own(range_cm, turns((int16_t)-(outer_millideg - 50)), -BEND_UPM));
    TEST_ASSERT_TRUE(lane_is_own(range_cm, turns((int16_t)-(outer_millideg + 50)), -BEND_UPM));
    TEST_ASSERT_TRUE(lane_is_own(range_cm, turns((int16_t)-(inner_millideg - 50)), -BEND_UPM));
    TEST_ASSERT_FALSE(lane_is_own(range_cm, turns((int16_t)-(inner_millideg + 50)), -BEND_UPM));
}

static void test_published_angles(void)
{
    expect_lane(2000, -4244, 6517);
    expect_lane(5000, 702, 5005);
    expect_lane(10000, 4637, 6796);
}

static void test_straight_road(void)
{
    TEST_ASSERT_TRUE(lane_is_own(10000, 0, 0));
    TEST_ASSERT_TRUE(lane_is_own(10000, turns(1050), 0));
    TEST_ASSERT_FALSE(lane_is_own(10000, turns(1100), 0));
    TEST_ASSERT_TRUE(lane_is_own(10000, turns(-1050), 0));
    TEST_ASSERT_FALSE(lane_is_own(10000, turns(-1100), 0));
}

static void test_what_cannot_be_judged_is_not_ours(void)
{
    TEST_ASSERT_TRUE(lane_is_own(LANE_RANGE_MAX_CM, 0, 0));
    TEST_ASSERT_FALSE(lane_is_own(LANE_RANGE_MAX_CM + 1, 0, 0));
    TEST_ASSERT_FALSE(lane_is_own(65535U, 0, 0));
    TEST_ASSERT_FALSE(lane_is_own(LANE_RANGE_MAX_CM, 8192, 32767));
    TEST_ASSERT_FALSE(lane_is_own(LANE_RANGE_MAX_CM, -8192, -32767));
}

/* 2^26 of 1e-8 radians, 38 degrees: one less of them is judged. In cm, millionths of 1/m. */
static void test_no_lane_is_seen_38_degrees_of_a_bend_away(void)
{
    TEST_ASSERT_TRUE(lane_is_own(8191, turns(19350), 8193));
    TEST_ASSERT_FALSE(lane_is_own(4096, turns(19350), 16384));
    TEST_ASSERT_FALSE(lane_is_own(4096, 0, 16384));
    TEST_ASSERT_TRUE(lane_is_own(4096, turns(19350), 16383));
}

#ifndef __SDCC_mcs51
static void test_sine_is_right_to_five(void)
{
    for (uint16_t angle = 0; angle <= LANE_AZIMUTH_MAX_TURN16; angle = (uint16_t)(angle + 256)) {
        TEST_ASSERT_EQUAL_UINT16(round(65536 * sin(angle * PI / 32768)), lane_sine_q16(angle));
    }
    for (uint16_t angle = 0; angle <= LANE_AZIMUTH_MAX_TURN16; angle++) {
        TEST_ASSERT_DOUBLE_WITHIN(5, 65536 * sin(angle * PI / 32768), lane_sine_q16(angle));
    }
}

/* s^2 / (2 r0) - d^2 / (8 r0), in m. */
static double bend_m(double range, double curvature)
{
    return range * range * curvature / 2 - 3.75 * 3.75 / 8 * curvature;
}

/* The same in whole cm, each product rounded down: with 1e-8 radians as 43980 / 2^42, and with
 * d^2 / 8 of 1e-6 / m as 12 / 2^16 cm. */
static double bend_cm(double range_cm, double curvature_upm)
{
    const double angle = floor(1e-8 * pow(2, 42)), lane = round(375 * 375 / 8.0 * 1e-8 * 65536);
    double arc = floor(floor(range_cm * curvature_upm / 1024) * angle / 65536);

    return floor(floor(range_cm * arc / 65536) / 2) - floor(curvature_upm * lane / 65536);
}

/* For azimuths up to that one. The formula leaves open what is within 3 cm of a line. */
static void expect_verdicts(uint16_t range_cm, int16_t curvature_upm, int azimuth_max)
{
    double off_m = bend_m(range_cm / 100.0, curvature_upm * 1e-6);
    double off_cm = bend_cm(range_cm, curvature_upm);

    for (int azimuth = -azimuth_max; azimuth <= azimuth_max; azimuth++) {
        double y_m = range_cm / 100.0 * sin(azimuth * PI / 32768);
        double y_cm = floor(range_cm * (double)lane_sine_q16((uint16_t)abs(azimuth)) / 65536);
        double beside_m = fabs(y_m - off_m) - 1.875;
        bool is_own = lane_is_own(range_cm, (int16_t)azimuth, curvature_upm);

        if ((fabs(beside_m) > 0.03 && is_own != (beside_m < 0)) ||
            is_own != (fabs((azimuth < 0 ? -y_cm : y_cm) - off_cm) <= 187) ||
            is_own != lane_is_own(range_cm, (int16_t)-azimuth, (int16_t)-curvature_upm)) {
            TEST_ASSERT_EQUAL_INT16(range_cm, azimuth);
        }
    }
}

static void test_verdicts_are_those_of_the_formula(void)
{
    static const int16_t curvatures_upm[] = {0, 1, 2, 100, 1993, 5461, 5462, 9999, 30000, 32767};

    for (unsigned c = 0; c < sizeof curvatures_upm / sizeof *curvatures_upm; c++) {
        for (uint16_t range_cm = 100; range_cm <= LANE_RANGE_MAX_CM;
             range_cm = (uint16_t)(range_cm + 598 * SWEEP)) {
            if ((double)range_cm * curvatures_upm[c] < 0.67e8) {
                expect_verdicts(range_cm, curvatures_upm[c], LANE_AZIMUTH_MAX_TURN16);
            }
        }
    }
}

/* In these bends the line itself is straight ahead. */
static void test_a_target_ahead_leaves_the_lane_where_the_bend_does(void)
{
    for (int16_t curvature_upm = 40; curvature_upm < 100; curvature_upm++) {
        for (uint16_t range_cm = 18000; range_cm <= LANE_RANGE_MAX_CM; range_cm += SWEEP) {
            expect_verdicts(range_cm, curvature_upm, 1);
        }
    }
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_published_angles);
    RUN_TEST(test_straight_road);
    RUN_TEST(test_what_cannot_be_judged_is_not_ours);
    RUN_TEST(test_no_lane_is_seen_38_degrees_of_a_bend_away);
#ifndef __SDCC_mcs51
    RUN_TEST(test_sine_is_right_to_five);
    RUN_TEST(test_verdicts_are_those_of_the_formula);
    RUN_TEST(test_a_target_ahead_leaves_the_lane_where_the_bend_does);
#endif
    return UNITY_END();
}
