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

/* --- closed forms --------------------------------------------------------------------------- */

/* A brake that acts at once, and steps so long that only the closed form is right in them. */
static void begin_at_once(double speed_mps, int64_t step_ns)
{
    scenario.ego.speed_mps = speed_mps;
    scenario.ego.brake_lag_s = 1e-9;
    scenario.ego.brake_dead_s = 0;
    car_init(&car, &scenario, step_ns);
}

/* 4 m/s and 8 m/s2: v^2 / 2a = 1 m, v / a = 0.5 s. */
static void test_that_the_braking_distance_is_v2_by_2a(void)
{
    put_lead(3, 0);
    scenario.event_s = 0.1;
    begin_at_once(4, 300 * ms);
    car_demand(&car, 0, 100);
    TEST_ASSERT_EQUAL_DOUBLE(100, car.acting_pct);
    car_advance(&car, 600 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.v_mps);
    car_advance(&car, 3000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 1, car.x_m);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.v_mps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 0.5, car.record.rest_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 2, car.record.rest_gap_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 2, car.record.min_gap_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 0.5, car.record.first_rest_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.6, car.record.still_s); /* the end of that step */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8, car.record.peak_decel_mps2);
}

static void test_that_drag_adds_to_the_brake(void)
{
    scenario.ego.rolling_mps2 = 0.5;
    begin_at_once(4, 300 * ms);
    car_demand(&car, 0, 25); /* 2 m/s2 */
    car_advance(&car, 9000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 16 / 2.5 / 2, car.x_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 4 / 2.5, car.record.rest_s);
}

static void test_that_a_rest_before_the_event_is_not_its_rest(void)
{
    scenario.event_s = 1;
    begin_at_once(4, 300 * ms);
    car_demand(&car, 0, 100);
    car_advance(&car, 3000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 0.5, car.record.rest_s);
    TEST_ASSERT_EQUAL_DOUBLE(INFINITY, car.record.first_rest_s);
}

/* 10 m/s, 8 m/s2, 5 m: the root of 100 - 80 m/s, (10 - that) / 8 s. Then all stands. */
static void test_that_a_braking_car_hits_with_the_closed_forms_speed(void)
{
    double v_mps = sqrt(100 - 2 * 8 * 5), t_s = (10 - v_mps) / 8;

    put_lead(5, 0);
    begin_at_once(10, 10000 * ms);
    car_demand(&car, 0, 100);
    car_advance(&car, 9000 * ms);
    TEST_ASSERT_TRUE(car.record.impact);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, t_s, car.record.impact_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, v_mps, car.record.impact_mps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, v_mps, car.v_mps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 5, car.x_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 8, car.brake_mps2);
    TEST_ASSERT_INT64_WITHIN(100, (int64_t)(t_s * 1e9), car.now_ns);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.record.min_gap_m);
}

/* Both move: the lead brakes from 6 m/s at 1 s with 2 m/s2, the ego rolls at 8 m/s, 5 m behind: 3 m
 * at 1 s, then 2 t + t^2 = 3, so t = 1 s; the lead drives at 4 m/s then. The impact is within a
 * step that begins at 0, or at 1.5 s. */
static void test_that_an_impact_on_a_braking_car_has_the_difference_of_speeds(void)
{
    static const int64_t step_ms[] = {10000, 1500};

    put_lead(5, 6);
    scenario.lead.change_s = 1;
    scenario.lead.change_mps2 = -2;
    for (int i = 0; i < 2; i++) {
        begin_at_once(8, step_ms[i] * ms);
        car_advance(&car, 9000 * ms);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, car.record.impact_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4, car.record.impact_mps);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 16, car.x_m);
        TEST_ASSERT_EQUAL_INT64(2000 * ms, car.now_ns);
    }
}

/* The driver looks once a step: 10 m/s, a gain of 2 / s, steps of 0.1 s: 20 % of what lacks. */
static void test_that_the_driver_closes_a_fifth_of_what_lacks_in_a_tenth_of_a_second(void)
{
    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.driver_mps = 10;
    scenario.ego.driver_mps2 = 100;
    begin_at_once(0, 100 * ms);
    for (int i = 1; i <= 20; i++) {
        car_advance(&car, i * 100 * ms);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10 * (1 - pow(0.8, i)), car.v_mps);
    }
}

/* 2 m/s2 less 0.5 of drag: a v, a^2 t, a t^2 / 2. */
static void test_that_the_drivers_push_is_limited(void)
{
    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.driver_mps = 1000;
    scenario.ego.rolling_mps2 = 0.5;
    begin_at_once(0, 100 * ms);
    car_advance(&car, 4000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 6, car.v_mps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 12, car.x_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5, car.accel_mps2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 9, car.record.square_mps3);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.record.peak_decel_mps2);
}

static void test_that_a_push_below_the_drag_does_not_move_a_car(void)
{
    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.driver_mps = 10;
    scenario.ego.driver_mps2 = 0.5;
    scenario.ego.rolling_mps2 = 1;
    begin_at_once(0, 100 * ms);
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.x_m);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.v_mps);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.accel_mps2);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.record.square_mps3);
}

/* What acts is what was demanded a dead time ago, demand by demand, for longer than the queue. */
static void test_that_each_demand_acts_after_the_dead_time(void)
{
    begin_at_once(100, 10 * ms);
    car.ego.brake_dead_s = 0.05;
    for (int i = 0; i < 700; i++) {
        car_demand(&car, i * ms, i % 97);
        TEST_ASSERT_EQUAL_DOUBLE(i < 50 ? 0 : (i - 50) % 97, car.acting_pct);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 8 * 0.01 * (648 % 97), car.brake_mps2);
}

/* 300 demands within the dead time, of which 256 have room: the last place takes what comes. */
static void test_that_too_many_demands_end_with_the_last_one(void)
{
    begin_at_once(100, 10 * ms);
    car.ego.brake_dead_s = 1;
    for (int i = 0; i < 5; i++) {
        car_demand(&car, i * ms, 50); /* so that the queue does not begin at its first place */
    }
    car_advance(&car, 1500 * ms);
    for (int i = 0; i < 300; i++) {
        car_demand(&car, 2000 * ms + i * ms, 1 + i % 97);
        TEST_ASSERT_EQUAL_DOUBLE(50, car.acting_pct);
        TEST_ASSERT_EQUAL(i < CAR_DEMANDS ? i + 1 : CAR_DEMANDS, car.demand_count);
    }
    for (int i = 0; i < 255; i++) {
        car_advance(&car, 3000 * ms + i * ms);
        TEST_ASSERT_EQUAL_DOUBLE(1 + i % 97, car.acting_pct);
    }
    car_advance(&car, 3298 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(1 + 254 % 97, car.acting_pct);
    car_advance(&car, 3299 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(1 + 299 % 97, car.acting_pct);
}

static void test_that_a_demand_and_a_cut_take_the_car_to_their_time(void)
{
    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.driver_mps = 10;
    begin_at_once(3, 100 * ms);
    car_cut(&car, 0, true);
    car_demand(&car, 1000 * ms, 0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3, car.x_m); /* it rolls */
    car_cut(&car, 2000 * ms, false);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 6, car.x_m);
    car_advance(&car, 2100 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.2, car.v_mps); /* 2 m/s2 */
}

static void test_that_the_driver_waits_until_the_brake_has_let_go(void)
{
    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.driver_mps = 10;
    begin_at_once(8, 10 * ms);
    car.ego.brake_dead_s = 0.05;
    car_demand(&car, 0, 50);
    car_demand(&car, 500 * ms, 0);
    car_advance(&car, 550 * ms); /* 4 m/s2 from 0.05 to 0.55 s */
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 6, car.v_mps);
    car_advance(&car, 560 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 6.02, car.v_mps);
}

/* --- targets -------------------------------------------------------------------------------- */

static void test_that_a_lead_changes_its_speed_as_planned(void)
{
    double speed;

    put_lead(2, 2);
    scenario.lead.change_s = 1;
    scenario.lead.change_mps2 = -2;
    scenario.lead.change_to_mps = 1;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, car_lead_path_m(&scenario.lead, 0.5, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2, speed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2 + 0.75 + 1.5, car_lead_path_m(&scenario.lead, 3, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, speed);
    scenario.lead.change_mps2 = 2; /* away from 1 m/s: the change takes no time */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2 + 2, car_lead_path_m(&scenario.lead, 3, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, speed);
    scenario.lead.change_mps2 = 0;
    scenario.lead.change_to_mps = 4;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2 + 8, car_lead_path_m(&scenario.lead, 3, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4, speed);
}

static void test_that_a_profile_holds_its_first_speed_until_its_first_point(void)
{
    double speed;

    scenario.lead.speed_mps = 9;
    scenario.lead.profile = (struct profile){.points = {{1, 2}, {2, 4}, {2, 7}}, .count = 3};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, car_lead_path_m(&scenario.lead, 0.5, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2, speed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2 + 1.25, car_lead_path_m(&scenario.lead, 1.5, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3, speed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2 + 3 + 7, car_lead_path_m(&scenario.lead, 3, &speed));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7, speed);
    scenario.lead.profile.count = 1;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6, car_lead_path_m(&scenario.lead, 3, &speed));
}

static void test_that_nothing_ahead_is_no_target(void)
{
    scenario.event_s = 0.1;
    begin();
    TEST_ASSERT_EQUAL(-1, car_nearest(&car));
    TEST_ASSERT_EQUAL_DOUBLE(0, car_lead_mps(&car));
    scenario.lead2 = scenario.lead;
    scenario.lead2.present = true;
    scenario.lead2.gap_m = 4;
    begin();
    TEST_ASSERT_EQUAL(1, car_nearest(&car));
    TEST_ASSERT_EQUAL_DOUBLE(4, car_gap_m(&car));
}

/* Each is 1 m nearer than the one before; those that are not there yet do not count. */
static void test_that_each_of_eight_targets_counts(void)
{
    for (int i = 0; i < LEADS_MAX; i++) {
        scenario.leads[i] = scenario.lead;
        scenario.leads[i].present = true;
        scenario.leads[i].gap_m = 20 - i;
        scenario.leads[i].speed_mps = 3 + i;
        scenario.leads[i].appears_s = i;
    }
    begin();
    for (int i = 0; i < LEADS_MAX; i++) {
        car_advance(&car, i * 1000 * ms);
        TEST_ASSERT_EQUAL(i, car_nearest(&car));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3 + i, car_lead_mps(&car));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 20 - i, car_gap_m(&car));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 20 - i, car.record.min_gap_m);
    }
}

/* It comes within a step of a second, at 0.5 s, and stands 2 m ahead: 2 m at 3 m/s. */
static void test_that_the_eighth_target_is_hit(void)
{
    put_lead(2, 0);
    scenario.leads[LEADS_MAX - 1] = scenario.lead;
    scenario.leads[LEADS_MAX - 1].appears_s = 0.5;
    scenario.lead.present = false;
    car_init(&car, &scenario, 1000 * ms);
    car_advance(&car, 5000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 + 2 / 3.0, car.record.impact_s);
}

static void test_that_half_a_lane_beside_is_out_of_the_way(void)
{
    static const double lanes[] = {0.5, -0.5, 0.499, -0.499};

    put_lead(1, 0);
    for (int i = 0; i < 4; i++) {
        scenario.lead.lane = lanes[i];
        begin();
        TEST_ASSERT_EQUAL(0, car_nearest(&car)); /* there is no other */
        car_advance(&car, 1000 * ms);
        TEST_ASSERT_EQUAL(i >= 2, car.record.impact);
        TEST_ASSERT_EQUAL_DOUBLE(i >= 2 ? 0 : INFINITY, car.record.min_gap_m);
    }
}

static void test_that_a_car_in_the_way_comes_first_in_either_place(void)
{
    put_lead(3, 0);
    scenario.lead.lane = 1;
    scenario.lead2 = scenario.lead;
    scenario.lead2.gap_m = 8;
    scenario.lead2.lane = 0;
    begin();
    TEST_ASSERT_EQUAL(1, car_nearest(&car));
    TEST_ASSERT_EQUAL_DOUBLE(8, car.record.min_gap_m);
}

/* Between two steps of a second: the second target comes at 0.5 s and goes at 0.75 s. */
static void test_that_a_target_comes_and_goes_within_a_step(void)
{
    put_lead(50, 3);
    scenario.lead2 = scenario.lead;
    scenario.lead2.gap_m = 2;
    scenario.lead2.speed_mps = 1;
    scenario.lead2.appears_s = 0.5;
    scenario.lead2.leaves_s = 0.75;
    begin_at_once(3, 1000 * ms);
    car_advance(&car, 500 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, car_gap_m(&car));
    begin_at_once(3, 1000 * ms);
    car_advance(&car, 700 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.6, car_gap_m(&car));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.6, car.record.min_gap_m);
    begin_at_once(3, 1000 * ms);
    car_advance(&car, 2000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, car.record.min_gap_m); /* 1.5 m at 0.75 s, when it is gone */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 50, car_gap_m(&car));
}

/* They would touch 0.3 s after the other one has come; it is gone after 0.25 s. */
static void test_that_a_target_that_goes_within_a_step_is_not_hit(void)
{
    put_lead(0.6, 1);
    scenario.lead.appears_s = 0.5;
    scenario.lead.leaves_s = 0.75;
    begin_at_once(3, 1000 * ms);
    car_advance(&car, 2000 * ms);
    TEST_ASSERT_FALSE(car.record.impact);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.6, car.record.min_gap_m);
}

static void test_that_a_car_at_rest_begins_at_rest(void)
{
    put_lead(4, 1);
    begin_at_once(0, 100 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.record.rest_s);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.record.first_rest_s);
    TEST_ASSERT_EQUAL_DOUBLE(4, car.record.rest_gap_m);
    TEST_ASSERT_EQUAL_DOUBLE(4, car.record.min_gap_m);
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(4, car.record.min_gap_m);
    TEST_ASSERT_EQUAL_DOUBLE(INFINITY, car.record.still_s); /* the other one moves */
    begin_at_once(2, 100 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(INFINITY, car.record.rest_s);
    TEST_ASSERT_EQUAL_DOUBLE(INFINITY, car.record.rest_gap_m);
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.record.stuck_s); /* it drives */
}

static void test_that_a_car_that_creeps_away_leaves_nobody_stuck(void)
{
    put_lead(4, 0.1);
    begin_at_once(0, 100 * ms);
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(0, car.record.stuck_s);
    put_lead(4, 0.1005);
    begin_at_once(0, 100 * ms);
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, car.record.stuck_s);
}

static void test_that_who_drives_again_is_not_still(void)
{
    scenario.ego.driver = DRIVER_HOLDS;
    scenario.ego.driver_mps = 2;
    begin_at_once(2, 100 * ms);
    car_demand(&car, 0, 100);
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.3, car.record.still_s); /* 0.25 s: within the third step */
    car_demand(&car, 1000 * ms, 0);
    car_advance(&car, 1500 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(INFINITY, car.record.still_s);
}

static void test_that_a_lead_told_to_speed_up_to_less_keeps_its_speed(void)
{
    put_lead(100, 2);
    begin();
    car_advance(&car, 1000 * ms);
    TEST_ASSERT_TRUE(car_command_lead(&car, 0, 1, 1));
    car_advance(&car, 3000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, car_target_mps(&car, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 106, car.x_m + car_target_gap_m(&car, 0));
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
    RUN_TEST(test_that_the_braking_distance_is_v2_by_2a);
    RUN_TEST(test_that_drag_adds_to_the_brake);
    RUN_TEST(test_that_a_rest_before_the_event_is_not_its_rest);
    RUN_TEST(test_that_a_braking_car_hits_with_the_closed_forms_speed);
    RUN_TEST(test_that_an_impact_on_a_braking_car_has_the_difference_of_speeds);
    RUN_TEST(test_that_the_driver_closes_a_fifth_of_what_lacks_in_a_tenth_of_a_second);
    RUN_TEST(test_that_the_drivers_push_is_limited);
    RUN_TEST(test_that_a_push_below_the_drag_does_not_move_a_car);
    RUN_TEST(test_that_each_demand_acts_after_the_dead_time);
    RUN_TEST(test_that_too_many_demands_end_with_the_last_one);
    RUN_TEST(test_that_a_demand_and_a_cut_take_the_car_to_their_time);
    RUN_TEST(test_that_the_driver_waits_until_the_brake_has_let_go);
    RUN_TEST(test_that_a_lead_changes_its_speed_as_planned);
    RUN_TEST(test_that_a_profile_holds_its_first_speed_until_its_first_point);
    RUN_TEST(test_that_nothing_ahead_is_no_target);
    RUN_TEST(test_that_each_of_eight_targets_counts);
    RUN_TEST(test_that_the_eighth_target_is_hit);
    RUN_TEST(test_that_half_a_lane_beside_is_out_of_the_way);
    RUN_TEST(test_that_a_car_in_the_way_comes_first_in_either_place);
    RUN_TEST(test_that_a_target_comes_and_goes_within_a_step);
    RUN_TEST(test_that_a_target_that_goes_within_a_step_is_not_hit);
    RUN_TEST(test_that_a_car_at_rest_begins_at_rest);
    RUN_TEST(test_that_a_car_that_creeps_away_leaves_nobody_stuck);
    RUN_TEST(test_that_who_drives_again_is_not_still);
    RUN_TEST(test_that_a_lead_told_to_speed_up_to_less_keeps_its_speed);
    return UNITY_END();
}
