/* SPDX-License-Identifier: MIT */
/* The parking controller: the laws against the published example, and when the car stands. */
#include "lut.c"
#include "park.c"
#include <stddef.h>
#include "unity.h"
#include "sweep.h"

#ifndef __SDCC_mcs51
#include <math.h>
#endif

static void place(int16_t x_dm, int16_t y_dm, int16_t heading_deg)
{
    park.x = (int16_t)(((int32_t)x_dm * 512 + (x_dm < 0 ? -5 : 5)) / 10);
    park.y = (int16_t)(((int32_t)y_dm * 512 + 5) / 10);
    park.heading = (uint16_t)((int32_t)heading_deg * 8192 / 45);
}

static void send(int16_t x, int16_t y, uint16_t heading)
{
    frame_body[0] = (uint8_t)((uint16_t)x >> 8);
    frame_body[1] = (uint8_t)x;
    frame_body[2] = (uint8_t)((uint16_t)y >> 8);
    frame_body[3] = (uint8_t)y;
    frame_body[4] = (uint8_t)(heading >> 8);
    frame_body[5] = (uint8_t)heading;
}

/* Takes a frame and checks the start from there, to the end. Returns how many steps that took. */
static uint16_t start_from(int16_t x, int16_t y, uint16_t heading)
{
    uint16_t steps = 0;

    send(x, y, heading);
    TEST_ASSERT_TRUE(park_read());
    do {
        park_decide();
        TEST_ASSERT_EQUAL_INT16(x, park.x);
        TEST_ASSERT_EQUAL_INT16(y, park.y);
        TEST_ASSERT_EQUAL_UINT16(heading, park.heading);
        steps++;
    } while (park.state == PARK_CHECKING);
    return steps;
}

void setUp(void)
{
    park_init();
}

void tearDown(void)
{
}

/* Thousandths of a degree; the printed float values are met to 0.15 degrees, 27 of 65,536. */
static void expect_angle(int32_t millideg, int16_t theta)
{
    TEST_ASSERT_INT16_WITHIN(27, (int16_t)(millideg * 1024 / 5625), theta);
}

/* Metres in tenths, degrees; then thousandths of a metre and of degrees. */
static void expect_laws(int16_t x_dm, int16_t y_dm, int16_t heading_deg, uint16_t dist_mm,
                        int32_t far_millideg, int32_t near_millideg, int32_t theta_millideg)
{
    place(x_dm, y_dm, heading_deg);
    park_steer();
    TEST_ASSERT_UINT16_WITHIN(10, dist_mm, park.dist_mm);
    expect_angle(far_millideg, park.theta_far);
    expect_angle(near_millideg, park.theta_near);
    expect_angle(theta_millideg, park.theta);
}

static void test_published_spot_values(void)
{
    expect_laws(150, 200, 0, 25000, 4349, 17430, 4349);
    expect_laws(-150, 200, 180, 25000, -4349, -17430, -4349);
    expect_laws(100, 250, 90, 26926, 45000, 45000, 45000);
    expect_laws(50, 150, 60, 15811, 32175, 5810, 32175);
    expect_laws(120, 280, 30, 30463, -4007, 25944, -4007);
    expect_laws(200, 300, -90, 36056, -45000, -36761, -45000);
    expect_laws(20, 60, 100, 6325, 45000, 24324, 41509);
    expect_laws(10, 50, 85, 5099, 45000, 2162, 24641);
    expect_laws(-5, 40, 92, 4031, -31625, -1581, -9326);
    expect_laws(5, 30, 88, 3041, 43312, 1581, 2013);
    expect_laws(2, 20, 90, 2010, 28553, 1432, 1432);
    expect_laws(-3, 10, 91, 1044, -45000, -1149, -1149);
}

static void test_left_and_right_are_mirror_images(void)
{
    int16_t x_dm, y_dm, heading_deg;

    for (y_dm = 10; y_dm <= 300; y_dm += 97) {
        for (x_dm = 3; x_dm <= 200; x_dm += 67) {
            for (heading_deg = -80; heading_deg <= 80; heading_deg += 40) {
                int16_t theta;
                place(x_dm, y_dm, heading_deg);
                park_steer();
                theta = park.theta;
                park.x = -park.x;
                park.heading = (uint16_t)(32768U - park.heading);
                park_steer();
                TEST_ASSERT_EQUAL_INT16(-theta, park.theta);
            }
        }
    }
}

static void test_car_stands_until_it_knows_where_it_is(void)
{
    TEST_ASSERT_TRUE(park_must_stand());
    TEST_ASSERT_EQUAL_UINT16(PARK_SERVO_MID_US, park.servo_us);
    start_from(0, 10000, QUARTER_TURN);
    TEST_ASSERT_FALSE(park_must_stand());
}

static void test_servo_pulse_is_one_to_two_milliseconds(void)
{
    start_from(5120, 12800, QUARTER_TURN);
    TEST_ASSERT_EQUAL_UINT16(2000, park.servo_us);
    send(-5120, 12800, QUARTER_TURN);
    TEST_ASSERT_TRUE(park_read());
    park_decide();
    TEST_ASSERT_EQUAL_UINT16(1000, park.servo_us);
    send(0, 12800, QUARTER_TURN);
    TEST_ASSERT_TRUE(park_read());
    park_decide();
    TEST_ASSERT_UINT16_WITHIN(1, 1500, park.servo_us);
}

static void test_at_the_line_it_stands_for_good(void)
{
    start_from(0, 100, QUARTER_TURN);
    TEST_ASSERT_FALSE(park_must_stand());
    send(0, 0, QUARTER_TURN);
    TEST_ASSERT_TRUE(park_read());
    park_decide();
    TEST_ASSERT_EQUAL_UINT8(PARK_ARRIVED, park.state);
    send(0, 100, QUARTER_TURN);
    TEST_ASSERT_TRUE(park_read());
    park_decide();
    TEST_ASSERT_TRUE(park_must_stand());
    park_lose();
    TEST_ASSERT_EQUAL_UINT8(PARK_ARRIVED, park.state);
}

static void test_lost_link_stops_the_car_and_keeps_the_wheel(void)
{
    uint16_t servo_us;

    start_from(5120, 12800, 8192);
    servo_us = park.servo_us;
    park_lose();
    TEST_ASSERT_EQUAL_UINT8(PARK_FAULT, park.state);
    TEST_ASSERT_TRUE(park_must_stand());
    TEST_ASSERT_EQUAL_UINT16(servo_us, park.servo_us);
    park_decide();
    TEST_ASSERT_FALSE(park_must_stand());
}

#ifndef PARK_AS_PUBLISHED
static void test_car_stands_with_straight_wheels_while_it_checks(void)
{
    send(5120, 12800, QUARTER_TURN);
    TEST_ASSERT_TRUE(park_read());
    park_decide();
    TEST_ASSERT_EQUAL_UINT8(PARK_CHECKING, park.state);
    TEST_ASSERT_TRUE(park_must_stand());
    TEST_ASSERT_EQUAL_UINT16(PARK_SERVO_MID_US, park.servo_us);
}

/* 19.5 m straight ahead are 79 steps of 0.25 m, and one step sees the end. */
static void test_check_takes_a_step_for_each_quarter_of_a_metre(void)
{
    TEST_ASSERT_EQUAL_UINT16(81, start_from(0, 10000, QUARTER_TURN));
}

/* Returns how many steps the check took. */
static uint16_t expect_dead_zone(int16_t x, int16_t y, uint16_t heading)
{
    uint16_t steps;

    park_init();
    steps = start_from(x, y, heading);
    TEST_ASSERT_EQUAL_UINT8(PARK_DEAD_ZONE, park.state);
    TEST_ASSERT_TRUE(park_must_stand());
    return steps;
}

/* 6 m and 10 m before the place, as in the study; half a metre beside it; the wrong way round;
 * turned by 14 degrees; beside the line; nearer than 0.25 m to the end of the range; over 88 m. */
static void test_starts_that_do_not_end_in_the_place_are_in_the_dead_zone(void)
{
    expect_dead_zone(1024, 3072, 18204);
    expect_dead_zone(1536, 5120, 27307);
    expect_dead_zone(256, 10, QUARTER_TURN);
    expect_dead_zone(0, 10, 3 * QUARTER_TURN);
    expect_dead_zone(0, 10, QUARTER_TURN + 2549U);
    expect_dead_zone(513, 63, QUARTER_TURN);
    expect_dead_zone(PARK_X_MAX_512 - 100, 10000, 32768U);
    expect_dead_zone(0, PARK_Y_MAX_512 - 100, 3 * QUARTER_TURN);
    expect_dead_zone(16178, 372, 34470U);
}

static void test_dead_zone_lasts_until_the_next_start(void)
{
    expect_dead_zone(1024, 3072, 18204);
    park_lose();
    TEST_ASSERT_EQUAL_UINT8(PARK_DEAD_ZONE, park.state);
    start_from(0, 10000, QUARTER_TURN);
    TEST_ASSERT_EQUAL_UINT8(PARK_DEAD_ZONE, park.state);
    send(0, 0, QUARTER_TURN);
    TEST_ASSERT_TRUE(park_read());
    park_decide();
    TEST_ASSERT_EQUAL_UINT8(PARK_DEAD_ZONE, park.state);
}

/* Frames from one place until the state is another one. Returns how many. */
static uint16_t frames_until_change(int16_t x, int16_t y, uint16_t heading)
{
    uint8_t state = park.state;
    uint16_t frames = 0;

    while (park.state == state && frames < 3U * PLAN_STEPS_MAX) {
        send(x, y, heading);
        TEST_ASSERT_TRUE(park_read());
        park_decide();
        TEST_ASSERT_EQUAL_INT16(x, park.x);
        TEST_ASSERT_EQUAL_INT16(y, park.y);
        TEST_ASSERT_TRUE(park_must_stand());
        frames++;
    }
    return frames;
}

static void test_out_of_the_dead_zone_the_car_is_ready_for_the_next_start(void)
{
    uint16_t steps = expect_dead_zone(1024, 3072, 18204);

    /* The way from there is driven once more first; then that of 19.5 m, in 80 steps. */
    TEST_ASSERT_EQUAL_UINT16(steps + 80U, frames_until_change(0, 10000, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PARK_READY, park.state);
    TEST_ASSERT_EQUAL_UINT16(PARK_SERVO_MID_US, park.servo_us);
    park_lose();
    TEST_ASSERT_EQUAL_UINT8(PARK_READY, park.state);

    frames_until_change(1024, 3072, 18204);
    TEST_ASSERT_EQUAL_UINT8(PARK_DEAD_ZONE, park.state);
    frames_until_change(0, 10000, QUARTER_TURN);
    TEST_ASSERT_EQUAL_UINT8(PARK_READY, park.state);
    TEST_ASSERT_EQUAL_UINT16(3U * PLAN_STEPS_MAX, frames_until_change(0, 10000, QUARTER_TURN));
}

static void test_lost_link_ends_the_check_and_it_begins_anew(void)
{
    uint8_t steps;

    send(0, 10000, QUARTER_TURN);
    TEST_ASSERT_TRUE(park_read());
    for (steps = 0; steps < 50; steps++) {
        park_decide();
    }
    park_lose();
    TEST_ASSERT_EQUAL_UINT8(PARK_FAULT, park.state);
    TEST_ASSERT_EQUAL_UINT16(81, start_from(0, 10000, QUARTER_TURN));
    TEST_ASSERT_EQUAL_UINT8(PARK_DRIVING, park.state);
}
#endif

static void test_a_beginning_forgets_the_wheels_and_the_check(void)
{
    park.theta = 1234;
    park.state = PARK_DRIVING;
#ifdef PARK_AS_PUBLISHED
    is_checked = false;
#else
    is_checked = true;
#endif
    park_init();
    TEST_ASSERT_EQUAL_INT16(0, park.theta);
    TEST_ASSERT_EQUAL_UINT8(PARK_WAITING, park.state);
#ifdef PARK_AS_PUBLISHED
    TEST_ASSERT_TRUE(is_checked);
#else
    TEST_ASSERT_FALSE(is_checked);
#endif
}

static void test_the_wheels_turn_by_45_degrees_at_most(void)
{
    TEST_ASSERT_EQUAL_INT16(8192, limited(8193));
    TEST_ASSERT_EQUAL_INT16(8191, limited(8191));
    TEST_ASSERT_EQUAL_INT16(-8192, limited(-8193));
    TEST_ASSERT_EQUAL_INT16(-8191, limited(-8191));
}

/* From 3 m to 7 m in 256 cells. */
static void test_every_distance_has_its_weight(void)
{
    uint16_t dist_mm;

    for (dist_mm = 0; dist_mm < 9000U; dist_mm++) {
        uint32_t cell = dist_mm < 3000U ? 0 : (dist_mm - 3000UL) * 256U / 4000U;
        uint8_t wanted = lut_at(cell < 256U ? (uint8_t)cell : 255, 0);

        if (weight_at(dist_mm) != wanted) {
            SWEEP_FAIL(dist_mm, "the weight at this distance in mm");
        }
    }
}

/* An offset of 1/512 m is 2.5 / 65,536 of a turn, rounded down. */
static void test_the_near_law_is_odd_down_to_the_smallest_offset(void)
{
    park.y = 1000;
    park.heading = QUARTER_TURN;
    park.x = 1;
    park_steer();
    TEST_ASSERT_EQUAL_INT16(2, park.theta_near);
    park.x = -1;
    park_steer();
    TEST_ASSERT_EQUAL_INT16(-2, park.theta_near);
}

static void test_it_drives_until_it_is_on_the_line(void)
{
    start_from(0, 100, QUARTER_TURN);
    send(0, 1, QUARTER_TURN);
    TEST_ASSERT_TRUE(park_read());
    park_decide();
    TEST_ASSERT_EQUAL_UINT8(PARK_DRIVING, park.state);
}

static void test_each_value_is_taken_up_to_its_limit(void)
{
    send(PARK_X_MAX_512, PARK_Y_MAX_512, 0);
    TEST_ASSERT_TRUE(park_read());
    send(-PARK_X_MAX_512, PARK_Y_MIN_512, 0);
    TEST_ASSERT_TRUE(park_read());
}

static void expect_refused(int16_t x, int16_t y)
{
    send(x, y, 1234);
    TEST_ASSERT_FALSE(park_read());
    TEST_ASSERT_EQUAL_INT16(100, park.x);
    TEST_ASSERT_EQUAL_INT16(200, park.y);
    TEST_ASSERT_EQUAL_UINT16(300, park.heading);
}

static void test_values_out_of_range_are_refused_and_change_nothing(void)
{
    send(100, 200, 300);
    TEST_ASSERT_TRUE(park_read());
    expect_refused(PARK_X_MAX_512 + 1, 5000);
    expect_refused(-PARK_X_MAX_512 - 1, 5000);
    expect_refused(0, PARK_Y_MAX_512 + 1);
    expect_refused(0, PARK_Y_MIN_512 - 1);
    expect_refused(INT16_MIN, INT16_MIN);
}

#ifndef __SDCC_mcs51
#define DEG (180 / 3.14159265358979)

/* The laws in floating point, as published. NAN where an angle wraps: opposite lock, a true tie. */
static double law_deg(double x_m, double y_m, double psi_deg)
{
    double phi_deg = -atan2(x_m, y_m) * DEG;
    double delta_deg = remainder(psi_deg - 90, 360);
    double off_line_deg = remainder(delta_deg - phi_deg, 360);
    double far_deg = -3 * phi_deg + 2 * off_line_deg;
    double near_deg = x_m / 8 * DEG + delta_deg;
    double w = fmin(fmax((hypot(x_m, y_m) - 3) / 4, 0), 1);

    if (fabs(delta_deg) > 179.9 || fabs(off_line_deg) > 179.9) {
        return NAN;
    }
    return w * fmin(fmax(far_deg, -45), 45) + (1 - w) * fmin(fmax(near_deg, -45), 45);
}

/* CORDIC's length and gain, rounded down, by a factor that is rounded down, too. */
static void expect_distance(void)
{
    double error_mm = park.dist_mm - cordic_polar.length * 1000.0 / 512 / CORDIC_GAIN;

    TEST_ASSERT_TRUE_MESSAGE(error_mm > -1.6 && error_mm < 0.001, "mm");
}

/* X / 8 rad, rounded down by less than 1; up to 3216 / 512 m it is not limited. The factor is right
 * to 1 / 2^20, which makes 0.003. */
static void expect_near(int16_t x, double wanted)
{
    double error;

    park.x = x;
    park_steer();
    error = (x < 0 ? -park.theta_near : park.theta_near) - wanted;
    TEST_ASSERT_TRUE_MESSAGE(error > -1.003 && error < 0.003, "turn16");
}

static void test_the_near_law_is_a_radian_for_each_8_m(void)
{
    park.y = 0;
    park.heading = QUARTER_TURN;
    for (int16_t x = 0; x <= 3216; x++) {
        double wanted = x / 4096.0 * DEG * 65536 / 360;

        expect_near(x, wanted);
        expect_near((int16_t)-x, wanted);
    }
}

/* On the line the near law steers by the heading alone. */
static void test_each_steering_angle_has_its_pulse(void)
{
    start_from(0, 100, QUARTER_TURN);
    for (int theta = 0; theta <= PARK_THETA_MAX_TURN16; theta++) {
        send(0, 100, (uint16_t)(QUARTER_TURN + theta));
        TEST_ASSERT_TRUE(park_read());
        park_decide();
        TEST_ASSERT_EQUAL_INT16(theta, park.theta);
        TEST_ASSERT_EQUAL_UINT16(1500 + theta * 500 / 8192, park.servo_us);
    }
}

static void test_laws_against_floating_point(void)
{
    unsigned states = 0, ties = 0;

    for (int x_dm = -250; x_dm <= 250; x_dm += 7) {
        for (int y_dm = 5; y_dm <= 350; y_dm += 7) {
            for (int heading_deg = -90; heading_deg < 270; heading_deg += 11) {
                double theta_deg;
                place((int16_t)x_dm, (int16_t)y_dm, (int16_t)heading_deg);
                park_steer();
                expect_distance();
                theta_deg = law_deg(park.x / 512.0, park.y / 512.0, park.heading * 360.0 / 65536);
                states++;
                if (isnan(theta_deg)) {
                    ties++;
                } else {
                    TEST_ASSERT_DOUBLE_WITHIN(0.4, theta_deg, park.theta * 360.0 / 65536);
                }
            }
        }
    }
    TEST_ASSERT_TRUE(ties < states / 25);
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_beginning_forgets_the_wheels_and_the_check);
    RUN_TEST(test_the_wheels_turn_by_45_degrees_at_most);
    RUN_TEST(test_every_distance_has_its_weight);
    RUN_TEST(test_the_near_law_is_odd_down_to_the_smallest_offset);
    RUN_TEST(test_it_drives_until_it_is_on_the_line);
    RUN_TEST(test_each_value_is_taken_up_to_its_limit);
    RUN_TEST(test_published_spot_values);
    RUN_TEST(test_left_and_right_are_mirror_images);
    RUN_TEST(test_car_stands_until_it_knows_where_it_is);
    RUN_TEST(test_servo_pulse_is_one_to_two_milliseconds);
    RUN_TEST(test_at_the_line_it_stands_for_good);
    RUN_TEST(test_lost_link_stops_the_car_and_keeps_the_wheel);
#ifndef PARK_AS_PUBLISHED
    RUN_TEST(test_car_stands_with_straight_wheels_while_it_checks);
    RUN_TEST(test_check_takes_a_step_for_each_quarter_of_a_metre);
    RUN_TEST(test_starts_that_do_not_end_in_the_place_are_in_the_dead_zone);
    RUN_TEST(test_dead_zone_lasts_until_the_next_start);
    RUN_TEST(test_out_of_the_dead_zone_the_car_is_ready_for_the_next_start);
    RUN_TEST(test_lost_link_ends_the_check_and_it_begins_anew);
#endif
    RUN_TEST(test_values_out_of_range_are_refused_and_change_nothing);
#ifndef __SDCC_mcs51
    RUN_TEST(test_the_near_law_is_a_radian_for_each_8_m);
    RUN_TEST(test_each_steering_angle_has_its_pulse);
    RUN_TEST(test_laws_against_floating_point);
#endif
    return UNITY_END();
}
