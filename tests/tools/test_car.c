/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/car.c, the plant, against hand calculation and a plain fine Euler
 * sum. */
#include "car.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static const int64_t ms = 1000000;
static struct scenario scenario;
static struct car car;

void setUp(void)
{
    memset(&scenario, 0, sizeof scenario);
    scenario.ego = (struct ego){.speed_mps = 3,
                                .brake_max_mps2 = 8,
                                .brake_lag_s = 0.2,
                                .brake_dead_s = 0.05,
                                .driver = DRIVER_COASTS,
                                .driver_mps = SCENARIO_UNSET,
                                .driver_mps2 = 2};
    scenario.lead.appears_s = scenario.lead.leaves_s = scenario.lead.change_s = SCENARIO_UNSET;
}

void tearDown(void)
{
}

static void put_lead(double gap_m, double speed_mps)
{
    scenario.lead.present = true;
    scenario.lead.gap_m = gap_m;
    scenario.lead.speed_mps = speed_mps;
}

static void begin(void)
{
    car_init(&car, &scenario, ms);
}

static void test_that_nothing_happens_before_the_dead_time_is_over(void)
{
    begin();
    car_demand(&car, 0, 100);
    car_advance(&car, 50 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(3, car.v_mps);
    TEST_ASSERT_EQUAL_DOUBLE(0.15, car.x_m);
    car_advance(&car, 51 * ms);
    TEST_ASSERT_TRUE(car.v_mps < 3);
}

static void test_that_the_brake_follows_its_lag(void)
{
    begin();
    car_demand(&car, 0, 50);
    car_advance(&car, 250 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4 * (1 - exp(-1)), car.brake_mps2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3 - 4 * (0.2 - 0.2 * (1 - exp(-1))), car.v_mps);
}

/* 8 m/s2, dead time, lag: summed up in steps of a microsecond. */
static double euler_stop_m(double v, double drag)
{
    double x = 0, b = 0, dt = 1e-6;

    for (double t = 0; v > 0; t += dt) {
        if (t >= 0.05) {
            b += (8 - b) / 0.2 * dt;
        }
        v -= (b + drag) * dt;
        x += v * dt;
    }
    return x;
}

static void test_that_the_stopping_distance_is_that_of_a_fine_sum(void)
{
    for (double v = 0.5; v < 7; v += 1.5) {
        scenario.ego.speed_mps = v;
        scenario.ego.rolling_mps2 = 0.15;
        begin();
        car_demand(&car, 0, 100);
        car_advance(&car, 5000 * ms);
        TEST_ASSERT_EQUAL_DOUBLE(0, car.v_mps);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, euler_stop_m(v, 0.15), car.x_m);
    }
}

static void test_that_braking_stops_the_car_and_never_reverses_it(void)
{
    double rest_m;

    begin();
    car_demand(&car, 0, 100);
    car_advance(&car, 2000 * ms);
    rest_m = car.x_m;
    car_advance(&car, 9000 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(rest_m, car.x_m);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.v_mps);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.accel_mps2);
}

static void drive_through(int64_t step_ns)
{
    car_init(&car, &scenario, step_ns);
    for (int i = 0; i < 60; i++) { /* a demand that wanders, at times off every grid */
        car_demand(&car, i * 61 * ms + i * 12345, (i * 37) % 70);
        if (i % 7 == 3) {
            car_demand(&car, i * 61 * ms + i * 12345 + 9 * ms, 0);
        }
    }
    car_advance(&car, 4000 * ms);
}

static void test_that_halving_the_step_changes_nothing_without_a_driver(void)
{
    struct car coarse;

    scenario.ego.speed_mps = 12;
    put_lead(20, 4);
    drive_through(1 * ms);
    coarse = car;
    drive_through(ms / 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, coarse.x_m, car.x_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, coarse.v_mps, car.v_mps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, coarse.record.min_gap_m, car.record.min_gap_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, coarse.record.peak_jerk_mps3, car.record.peak_jerk_mps3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, coarse.record.square_mps3, car.record.square_mps3);
}

static void test_that_halving_the_step_moves_a_driven_car_by_less_than_a_millimetre(void)
{
    struct car coarse;

    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.driver_mps = 6;
    scenario.ego.rolling_mps2 = 0.15;
    drive_through(1 * ms);
    coarse = car;
    drive_through(ms / 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, coarse.x_m, car.x_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, coarse.v_mps, car.v_mps);
}

static void test_that_an_impact_has_its_speed_and_time(void)
{
    put_lead(6, 1);
    begin();
    car_advance(&car, 9000 * ms);
    TEST_ASSERT_TRUE(car.record.impact);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3, car.record.impact_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, car.record.impact_mps);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.record.min_gap_m);
}

static void test_that_the_impact_of_a_braking_car_is_exact(void)
{
    double v, x;

    scenario.ego.speed_mps = 10;
    put_lead(5, 0);
    begin();
    car_demand(&car, 0, 100);
    car_advance(&car, 3000 * ms);
    v = car.record.impact_mps;
    x = car.record.impact_s;
    car_init(&car, &scenario, 17 * ms);
    car_demand(&car, 0, 100);
    car_advance(&car, 3000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, v, car.record.impact_mps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, x, car.record.impact_s);
    TEST_ASSERT_TRUE(v > sqrt(100 - 2 * 8 * 5)); /* the brake at full strength all the way */
    TEST_ASSERT_TRUE(v < sqrt(100 - 2 * 8 * (5 - 10 * 0.3))); /* and only after 0.3 s */
}

static void test_that_the_driver_holds_his_speed_against_the_drag(void)
{
    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.rolling_mps2 = 0.15;
    begin();
    car_advance(&car, 10000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3, car.v_mps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 30, car.x_m);
}

static void test_that_the_throttle_is_cut_while_the_brake_is_asked_for(void)
{
    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.rolling_mps2 = 1;
    begin();
    car_demand(&car, 0, 0.5);
    car_advance(&car, 40 * ms); /* still in the dead time: it rolls */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3 - 0.04, car.v_mps);
}

static void test_that_the_driver_moves_off_when_the_brake_lets_go(void)
{
    scenario.ego.speed_mps = 0;
    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.driver_mps = 2;
    begin();
    car_demand(&car, 0, 100);
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.v_mps);
    car_demand(&car, 1000 * ms, 0);
    car_advance(&car, 6000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 2, car.v_mps);
}

static void test_that_full_braking_jerks_with_its_slope_at_the_start(void)
{
    begin();
    car_demand(&car, 0, 100);
    car_advance(&car, 3000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 40, car.record.peak_jerk_mps3); /* 8 m/s2 in 0.2 s */
    TEST_ASSERT_TRUE(car.record.peak_decel_mps2 > 6.5 && car.record.peak_decel_mps2 < 8);
}

static void test_that_rest_is_recorded_with_its_gap(void)
{
    put_lead(3, 0);
    begin();
    car_demand(&car, 0, 100);
    car_advance(&car, 3000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 3 - euler_stop_m(3, 0), car.record.rest_gap_m);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, car.record.rest_s, car.record.still_s); /* to the step */
    TEST_ASSERT_TRUE(car.record.rest_s > 0.6 && car.record.rest_s < 0.7);
}

static void test_that_standing_behind_a_moving_car_is_counted(void)
{
    scenario.ego.speed_mps = 0;
    put_lead(3, 1);
    begin();
    car_advance(&car, 2000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, car.record.stuck_s);
}

static void test_that_the_lead_brakes_to_a_stop(void)
{
    double speed;

    put_lead(2, 2);
    scenario.lead.change_s = 1;
    scenario.lead.change_mps2 = -2;
    scenario.lead.change_to_mps = 0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2 + 0.75, car_lead_path_m(&scenario.lead, 1.5, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, speed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3, car_lead_path_m(&scenario.lead, 7, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0, speed);
}

static void test_that_a_profile_is_walked_point_by_point(void)
{
    double speed;

    scenario.lead.profile = (struct profile){.points = {{1, 2}, {2, 2}, {4, 0}}, .count = 3};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, car_lead_path_m(&scenario.lead, 0.5, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2, speed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4 + 1.5, car_lead_path_m(&scenario.lead, 3, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, speed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6, car_lead_path_m(&scenario.lead, 9, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0, speed);
}

static void test_that_a_car_cuts_in_where_the_ego_is_then(void)
{
    put_lead(1.5, 2);
    scenario.lead.appears_s = 1;
    scenario.lead.leaves_s = 2;
    begin();
    TEST_ASSERT_TRUE(isinf(car_gap_m(&car)));
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5, car_gap_m(&car));
    car_advance(&car, 1500 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, car_gap_m(&car));
    car_advance(&car, 2000 * ms);
    TEST_ASSERT_TRUE(isinf(car_gap_m(&car)));
    TEST_ASSERT_FALSE(car.record.impact);
}

/* A second target: the gap is that to the nearer one, and the car hits whichever comes first. */
static void test_that_the_nearer_of_two_targets_counts(void)
{
    put_lead(4, 3); /* as fast as the ego */
    scenario.lead2 = scenario.lead;
    scenario.lead2.gap_m = 6;
    scenario.lead2.speed_mps = 1;
    begin();
    TEST_ASSERT_EQUAL(0, car_nearest(&car));
    car_advance(&car, 1500 * ms);
    TEST_ASSERT_EQUAL(1, car_nearest(&car));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3, car_gap_m(&car));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, car_lead_mps(&car));
    car_advance(&car, 5000 * ms);
    TEST_ASSERT_TRUE(car.record.impact);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3, car.record.impact_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, car.record.impact_mps);
}

/* What stands beside the lane is passed, and does not count while something is in the way. */
static void test_that_a_target_beside_the_lane_comes_second(void)
{
    put_lead(8, 3);
    scenario.lead2 = scenario.lead;
    scenario.lead2.gap_m = 3;
    scenario.lead2.speed_mps = 0;
    scenario.lead2.lane = 0.6;
    begin();
    TEST_ASSERT_EQUAL(0, car_nearest(&car));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3, car_target_gap_m(&car, 1));
    car_advance(&car, 2000 * ms);
    TEST_ASSERT_FALSE(car.record.impact);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -3, car_target_gap_m(&car, 1));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8, car.record.min_gap_m);
}

/* 2 m/s; 4 m/s2 off from 1 s on; let go at 1.25 s with 1 m/s after 0.375 m; 2 m/s2 on from 2 s to
 * 3 m/s; by hand: at 2 s 2 + 0.375 + 0.75 m, 1 s later 1 + 1 m more at 3 m/s, then 3 m a second. */
static void test_that_a_lead_obeys_commands(void)
{
    put_lead(100, 2);
    begin();
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_TRUE(car_command_lead(&car, 0, -4, 3));
    car_advance(&car, 1250 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, car_target_mps(&car, 0));
    TEST_ASSERT_TRUE(car_command_lead(&car, 0, 0, 3));
    car_advance(&car, 2000 * ms);
    TEST_ASSERT_TRUE(car_command_lead(&car, 0, 2, 3));
    car_advance(&car, 4000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3, car_target_mps(&car, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100 + 2 + 0.375 + 0.75 + 2 + 3,
                              car.x_m + car_target_gap_m(&car, 0));
}

static void test_that_commands_end_with_the_points_of_a_profile(void)
{
    int taken = 0;

    put_lead(100, 2);
    begin();
    while (taken < 2 * PROFILE_POINTS && car_command_lead(&car, 0, taken % 2 == 0 ? -0.1 : 0, 3)) {
        taken++;
        car_advance(&car, car.now_ns + 100 * ms);
    }
    TEST_ASSERT_EQUAL(PROFILE_POINTS - 2, taken);
    TEST_ASSERT_TRUE(car.targets[0].lead.profile.count <= PROFILE_POINTS);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_nothing_happens_before_the_dead_time_is_over);
    RUN_TEST(test_that_the_brake_follows_its_lag);
    RUN_TEST(test_that_the_stopping_distance_is_that_of_a_fine_sum);
    RUN_TEST(test_that_braking_stops_the_car_and_never_reverses_it);
    RUN_TEST(test_that_halving_the_step_changes_nothing_without_a_driver);
    RUN_TEST(test_that_halving_the_step_moves_a_driven_car_by_less_than_a_millimetre);
    RUN_TEST(test_that_an_impact_has_its_speed_and_time);
    RUN_TEST(test_that_the_impact_of_a_braking_car_is_exact);
    RUN_TEST(test_that_the_driver_holds_his_speed_against_the_drag);
    RUN_TEST(test_that_the_throttle_is_cut_while_the_brake_is_asked_for);
    RUN_TEST(test_that_the_driver_moves_off_when_the_brake_lets_go);
    RUN_TEST(test_that_full_braking_jerks_with_its_slope_at_the_start);
    RUN_TEST(test_that_rest_is_recorded_with_its_gap);
    RUN_TEST(test_that_standing_behind_a_moving_car_is_counted);
    RUN_TEST(test_that_the_lead_brakes_to_a_stop);
    RUN_TEST(test_that_a_profile_is_walked_point_by_point);
    RUN_TEST(test_that_a_car_cuts_in_where_the_ego_is_then);
    RUN_TEST(test_that_the_nearer_of_two_targets_counts);
    RUN_TEST(test_that_a_target_beside_the_lane_comes_second);
    RUN_TEST(test_that_a_lead_obeys_commands);
    RUN_TEST(test_that_commands_end_with_the_points_of_a_profile);
    return UNITY_END();
}
