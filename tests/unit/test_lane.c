/* SPDX-License-Identifier: MIT */
/* The lane gate against the angles of the published geometry: inner edge radius 500 m, lane width
 * 3.75 m, so the lane centre's radius is 501.875 m. */
#include "lane.h"
#include <stddef.h>
#include "unity.h"

#ifndef __SDCC_mcs51
#include <math.h>
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

#ifndef __SDCC_mcs51
static void test_sine_is_right_to_five(void)
{
    for (uint16_t angle = 0; angle <= LANE_AZIMUTH_MAX_TURN16; angle++) {
        TEST_ASSERT_DOUBLE_WITHIN(5, 65536 * sin(angle * 3.14159265358979 / 32768),
                                  lane_sine_q16(angle));
    }
}

/* Every verdict, but those on targets within 3 cm of a line. */
static void test_verdicts_are_those_of_the_formula(void)
{
    static const int16_t curvatures_upm[] = {-32767, -5000, -1993, -100, 0,
                                             1,      100,   1993,  9999, 32767};

    for (unsigned c = 0; c < sizeof curvatures_upm / sizeof *curvatures_upm; c++) {
        for (uint16_t range_cm = 100; range_cm <= LANE_RANGE_MAX_CM;
             range_cm = (uint16_t)(range_cm + 163)) {
            double curvature = curvatures_upm[c] * 1e-6, range = range_cm / 100.0;
            if (fabs(range * curvature) > 0.67) {
                continue;
            }
            for (int16_t azimuth = -LANE_AZIMUTH_MAX_TURN16; azimuth <= LANE_AZIMUTH_MAX_TURN16;
                 azimuth++) {
                double side = curvature < 0 ? -1 : 1;
                double y = side * range * sin(azimuth * 3.14159265358979 / 32768);
                double off = fabs(y - range * range * fabs(curvature) / 2 +
                                  3.75 * 3.75 / 8 * fabs(curvature));
                if (fabs(off - 1.875) > 0.03) {
                    TEST_ASSERT_EQUAL(off <= 1.875,
                                      lane_is_own(range_cm, azimuth, curvatures_upm[c]));
                }
            }
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
#ifndef __SDCC_mcs51
    RUN_TEST(test_sine_is_right_to_five);
    RUN_TEST(test_verdicts_are_those_of_the_formula);
#endif
    return UNITY_END();
}
