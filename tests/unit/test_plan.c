/* SPDX-License-Identifier: MIT */
/* The way to the place, driven in thought: its sines and tangents, one step, and where the way
 * ends. The steering angle is this test's, not that of the parking laws. */
#include "plan.c"
#include <stddef.h>
#include "unity.h"
#include "sweep.h"

#ifndef __SDCC_mcs51
#include <math.h>
#include <stdlib.h>
#endif

#define STEP_512 128 /* 0.25 m */

/* On the simulated chip not every angle has its turn. */
#ifdef __SDCC_mcs51
#define EVERY_TURN16 331U
#else
#define EVERY_TURN16 1U
#endif

__idata struct park park;
static int16_t law_theta;
static int16_t law_x, law_y; /* what the law was asked about */
static uint16_t law_heading;

void park_steer(void)
{
    law_x = park.x;
    law_y = park.y;
    law_heading = park.heading;
    park.theta = law_theta;
}

static void begin_at(int16_t at_x, int16_t at_y, uint16_t at_heading)
{
    park.x = at_x;
    park.y = at_y;
    park.heading = at_heading;
    plan_begin();
}

static uint8_t step_from(int16_t at_x, int16_t at_y, uint16_t at_heading)
{
    begin_at(at_x, at_y, at_heading);
    return plan_step();
}

void setUp(void)
{
    law_theta = 0;
}

void tearDown(void)
{
}

static void test_sines_of_the_four_quarters(void)
{
    uint16_t angle;

    TEST_ASSERT_EQUAL_INT16(0, plan_sine_q15(0));
    TEST_ASSERT_INT16_WITHIN(4, 16384, plan_sine_q15(5461)); /* 30 degrees */
    TEST_ASSERT_EQUAL_INT16(32767, plan_sine_q15(QUARTER_TURN));
    for (angle = 0; angle <= QUARTER_TURN; angle += EVERY_TURN16) {
        int16_t sine = plan_sine_q15(angle);
        if (plan_sine_q15(HALF_TURN - angle) != sine || plan_sine_q15(0U - angle) != -sine ||
            plan_sine_q15(HALF_TURN + angle) != -sine) {
            TEST_ASSERT_EQUAL_UINT16(0xFFFFU, angle);
        }
    }
}

/* Where 0.25 m ends between two numbers, it is the larger one. */
static void test_parts_of_a_step_are_rounded_to_the_nearest(void)
{
    int32_t sine;

    for (sine = -32767; sine <= 32767; sine += EVERY_TURN16) {
        int32_t nearest = (sine + 128 + 32768) / 256 - 128;
        if (of_step((int16_t)sine) != nearest) {
            TEST_ASSERT_EQUAL_INT16(nearest, of_step((int16_t)sine));
        }
    }
    TEST_ASSERT_EQUAL_INT16(0, of_step(127));
    TEST_ASSERT_EQUAL_INT16(1, of_step(128));
    TEST_ASSERT_EQUAL_INT16(0, of_step(-128));
    TEST_ASSERT_EQUAL_INT16(-1, of_step(-129));
}

static void test_straight_steps_go_backwards(void)
{
    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(1000, 5000, 0));
    TEST_ASSERT_EQUAL_INT16(1000 - STEP_512, x);
    TEST_ASSERT_EQUAL_INT16(5000, y);
    TEST_ASSERT_EQUAL_UINT16(0, heading);
    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(1000, 5000, QUARTER_TURN));
    TEST_ASSERT_EQUAL_INT16(1000, x);
    TEST_ASSERT_EQUAL_INT16(5000 - STEP_512, y);
}

static void test_the_law_is_asked_about_the_way_and_the_place_stays(void)
{
    step_from(1000, 5000, 8192);
    TEST_ASSERT_EQUAL_INT16(1000, law_x);
    TEST_ASSERT_EQUAL_INT16(5000, law_y);
    TEST_ASSERT_EQUAL_UINT16(8192, law_heading);
    law_theta = PARK_THETA_MAX_TURN16;
    plan_step();
    TEST_ASSERT_EQUAL_INT16(1000 - 91, law_x); /* 128 cos 45 degrees: 90.5 */
    TEST_ASSERT_EQUAL_INT16(5000 - 91, law_y);
    TEST_ASSERT_EQUAL_UINT16(8192, law_heading);
    plan_step();
    TEST_ASSERT_TRUE(law_heading < 8192);
    TEST_ASSERT_EQUAL_INT16(1000, park.x);
    TEST_ASSERT_EQUAL_INT16(5000, park.y);
    TEST_ASSERT_EQUAL_UINT16(8192, park.heading);
}

/* The mirror image at the x axis: the same x, the opposite turn. */
static void test_left_and_right_turns_are_mirror_images(void)
{
    static const int16_t __code THETAS[] = {0, 1, 2, 1000, 1001, 8191, 8192};
    uint8_t i;

    for (i = 0; i < sizeof THETAS / sizeof THETAS[0]; i++) {
        uint16_t angle = 0;
        do {
            int16_t mirrored_x;
            uint16_t mirrored_heading;
            begin_at(0, 5000, (uint16_t)(0U - angle));
            move((int16_t)-THETAS[i]);
            mirrored_x = x;
            mirrored_heading = (uint16_t)(0U - heading);
            begin_at(0, 5000, angle);
            move(THETAS[i]);
            if (x != mirrored_x || heading != mirrored_heading) {
                TEST_ASSERT_EQUAL_INT16(mirrored_x, x);
                TEST_ASSERT_EQUAL_UINT16(mirrored_heading, heading);
            }
            angle += EVERY_TURN16;
        } while (angle >= EVERY_TURN16);
    }
}

/* At Y = 0 the way has ended; the front end, 2508 in front of the axle, may be off by 235. */
static void test_the_place_has_room_for_the_axle_and_the_angle(void)
{
    TEST_ASSERT_EQUAL_UINT8(PLAN_PARKS, step_from(235, 0, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(236, 0, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_PARKS, step_from(-235, -127, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(-236, -127, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(PLAN_X_MAX_512, 0, 0));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(235, 0, QUARTER_TURN + 100U));
    TEST_ASSERT_EQUAL_UINT8(PLAN_PARKS, step_from(0, 0, QUARTER_TURN + 900U));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(0, 0, QUARTER_TURN - 1100U));
}

static void test_the_way_ends_at_the_line_and_not_before(void)
{
    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(0, 1, QUARTER_TURN));
    TEST_ASSERT_EQUAL_INT16(1 - STEP_512, y);
    TEST_ASSERT_EQUAL_UINT8(PLAN_PARKS, plan_step());
    TEST_ASSERT_EQUAL_INT16(1 - STEP_512, y);
}

static void test_near_the_line_the_car_is_in_front_of_it(void)
{
    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(512, 63, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(-512, 63, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(513, 63, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(-513, 63, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(513, 64, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(-513, 64, QUARTER_TURN));
}

static void test_the_way_keeps_away_from_the_end_of_the_range(void)
{
    const int16_t x_max = PLAN_X_MAX_512 - STEP_512, y_max = PLAN_Y_MAX_512 - STEP_512;

    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(x_max, 5000, HALF_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(x_max + 1, 5000, HALF_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(-x_max, 5000, 0));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(-x_max - 1, 5000, 0));
    TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, step_from(0, y_max, 3U * QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, step_from(0, y_max + 1, 3U * QUARTER_TURN));
}

/* In a circle of 4 m for ever. */
static void test_the_way_has_at_most_88_metres(void)
{
    uint16_t steps;

    law_theta = PARK_THETA_MAX_TURN16;
    begin_at(0, 10000, 0);
    for (steps = 0; steps < 88000U / 250U; steps++) {
        TEST_ASSERT_EQUAL_UINT8(PLAN_GOES_ON, plan_step());
    }
    TEST_ASSERT_EQUAL_UINT8(PLAN_DEAD_ZONE, plan_step());
}

#ifndef __SDCC_mcs51
#define RAD_PER_TURN16 (3.14159265358979 / 32768)

/* The table's own numbers are the nearest ones that it can hold. */
static void test_sines_against_libm(void)
{
    for (unsigned i = 0; i < SINES; i++) {
        double sine = fmin(round(32768 * sin(256 * i * RAD_PER_TURN16)), 32767);

        TEST_ASSERT_EQUAL_INT16(sine, plan_sine_q15((uint16_t)(256 * i)));
    }
    for (unsigned angle = 0; angle < 65536; angle++) {
        TEST_ASSERT_DOUBLE_WITHIN(5, 32768 * sin(angle * RAD_PER_TURN16),
                                  plan_sine_q15((uint16_t)angle));
    }
}

static void test_tangents_against_libm(void)
{
    for (unsigned i = 0; i < TANGENTS; i++) {
        double tan_q16 = fmin(round(65536 * tan(256 * i * RAD_PER_TURN16)), 65535);

        TEST_ASSERT_EQUAL_UINT16(tan_q16, tangent((uint16_t)(256 * i)));
    }
    for (uint16_t angle = 0; angle <= PARK_THETA_MAX_TURN16; angle++) {
        TEST_ASSERT_DOUBLE_WITHIN(25, 65536 * tan(angle * RAD_PER_TURN16), tangent(angle));
    }
}

/* 0.25 m along the circle whose radius is the distance of the axles by the tangent. The turn is
 * rounded towards 0, and the tangent is right to 25: a quarter of a unit here. */
static void test_steps_turn_as_the_circle_does(void)
{
    for (int theta = 0; theta <= PARK_THETA_MAX_TURN16; theta++) {
        double turn = tan(theta * RAD_PER_TURN16) * 250 / PARK_AXLES_MM / RAD_PER_TURN16;

        for (unsigned from = 0; from < 65536; from += 4099) {
            double half_way = from * RAD_PER_TURN16 - turn * RAD_PER_TURN16 / 2;

            begin_at(0, 5000, (uint16_t)from);
            move((int16_t)theta);
            double turned = (uint16_t)(from - heading);
            TEST_ASSERT_TRUE_MESSAGE(turned > turn - 1.15 && turned < turn + 0.35, "turn");
            TEST_ASSERT_DOUBLE_WITHIN(0.55, -STEP_512 * cos(half_way), x);
            TEST_ASSERT_DOUBLE_WITHIN(0.55, -STEP_512 * sin(half_way), y - 5000);
        }
    }
}

/* In 1/512 m, rounded down: the room is 0.46 m, the front end is 4.9 m in front of the axle. */
static void test_every_end_of_a_way_is_judged_by_its_front_end(void)
{
    const double room_512 = floor(0.460 * 512), front_512 = floor(4.900 * 512);

    for (int off = -240; off <= 240; off++) {
        for (int angle = -900; angle <= 900; angle++) {
            double front = floor(abs(plan_sine_q15((uint16_t)angle)) * front_512 / 32768);
            uint8_t wanted = abs(off) + front <= room_512 ? PLAN_PARKS : PLAN_DEAD_ZONE;

            if (step_from((int16_t)off, 0, (uint16_t)(QUARTER_TURN + angle)) != wanted) {
                SWEEP_FAIL(off, "off in 1/512 m");
            }
        }
    }
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sines_of_the_four_quarters);
    RUN_TEST(test_parts_of_a_step_are_rounded_to_the_nearest);
    RUN_TEST(test_straight_steps_go_backwards);
    RUN_TEST(test_the_law_is_asked_about_the_way_and_the_place_stays);
    RUN_TEST(test_left_and_right_turns_are_mirror_images);
    RUN_TEST(test_the_place_has_room_for_the_axle_and_the_angle);
    RUN_TEST(test_the_way_ends_at_the_line_and_not_before);
    RUN_TEST(test_near_the_line_the_car_is_in_front_of_it);
    RUN_TEST(test_the_way_keeps_away_from_the_end_of_the_range);
    RUN_TEST(test_the_way_has_at_most_88_metres);
#ifndef __SDCC_mcs51
    RUN_TEST(test_sines_against_libm);
    RUN_TEST(test_tangents_against_libm);
    RUN_TEST(test_steps_turn_as_the_circle_does);
    RUN_TEST(test_every_end_of_a_way_is_judged_by_its_front_end);
#endif
    return UNITY_END();
}
