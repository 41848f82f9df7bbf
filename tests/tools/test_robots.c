/* SPDX-License-Identifier: MIT */
/* The robots' plant against the closed form, its limits, and a change of lanes. */
#include "robots.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static struct robots start(int gap_mm, int own_mmps, int lead_mmps)
{
    struct robots robots = {.gap_um = gap_mm * 1000, .own_mmps = own_mmps, .lead_mmps = lead_mmps};

    robots_start(&robots);
    return robots;
}

static void test_constant_acceleration_is_exact(void)
{
    struct robots robots = start(9000, 0, 500);

    for (int step = 0; step < 8; step++) {
        robots_step(&robots, 2000, false);
    }
    /* 0.8 s: 1.6 m/s, 0.64 m driven; the lead drove 0.4 m. */
    TEST_ASSERT_EQUAL_INT(1600, robots.own_mmps);
    TEST_ASSERT_EQUAL_INT(9000000 - 640000 + 400000, robots.gap_um);
}

static void test_speed_stays_from_0_to_2_mps(void)
{
    struct robots robots = start(9000, 1900, 2000);

    robots_step(&robots, 2000, false);
    TEST_ASSERT_EQUAL_INT(2000, robots.own_mmps);
    for (int step = 0; step < 20; step++) {
        robots_step(&robots, -2000, false);
    }
    TEST_ASSERT_EQUAL_INT(0, robots.own_mmps);
}

static void test_motion_control_tells_tenths_of_mps2_apart(void)
{
    struct robots robots = start(9000, 1000, 1000);

    robots_step(&robots, 960, false);
    TEST_ASSERT_EQUAL_INT(1100, robots.own_mmps);
    robots_step(&robots, -1040, false);
    TEST_ASSERT_EQUAL_INT(1000, robots.own_mmps);
    robots_step(&robots, 40, false);
    TEST_ASSERT_EQUAL_INT(1000, robots.own_mmps);
}

static void test_contact_ends_all_motion(void)
{
    struct robots robots = start(100, 2000, 0);

    robots_step(&robots, 0, false);
    TEST_ASSERT_TRUE(robots.collided);
    TEST_ASSERT_EQUAL_INT(1, robots.step);
    TEST_ASSERT_EQUAL_INT(0, robots_gap_mm(&robots));
    robots_step(&robots, 0, true);
    TEST_ASSERT_EQUAL_INT(1, robots.step);
    TEST_ASSERT_EQUAL_INT(-1, robots.changed_step);
}

static void test_free_lane_is_taken_once(void)
{
    struct robots robots = start(1500, 1500, 0);

    robots.lane_is_free = true;
    robots.new_lead_mmps = 1200;
    robots_step(&robots, 0, false);
    TEST_ASSERT_EQUAL_INT(-1, robots.changed_step);
    robots_step(&robots, 0, true);
    TEST_ASSERT_EQUAL_INT(2, robots.changed_step);
    TEST_ASSERT_EQUAL_INT(6000, robots_gap_mm(&robots));
    TEST_ASSERT_EQUAL_INT(1200, robots.lead_mmps);
    TEST_ASSERT_FALSE(robots.lane_is_free);
    for (int step = 0; step < 10; step++) {
        robots_step(&robots, 0, true);
    }
    TEST_ASSERT_EQUAL_INT(6000000 - 10 * 30000, robots.gap_um);
}

static void test_taken_lane_is_not_entered(void)
{
    struct robots robots = start(1500, 500, 500);

    robots_step(&robots, 0, true);
    TEST_ASSERT_EQUAL_INT(-1, robots.changed_step);
    TEST_ASSERT_EQUAL_INT(1500, robots_gap_mm(&robots));
}

static void test_gap_is_measured_to_the_nearest_millimetre(void)
{
    struct robots robots = start(0, 0, 0);

    robots.gap_um = 999500;
    TEST_ASSERT_EQUAL_INT(1000, robots_gap_mm(&robots));
    robots.gap_um = 999499;
    TEST_ASSERT_EQUAL_INT(999, robots_gap_mm(&robots));
}

static void test_a_run_begins_with_what_is_there(void)
{
    struct robots robots = {.gap_um = 1, .step = 5, .least_gap_um = 77};

    robots_start(&robots);
    TEST_ASSERT_EQUAL_INT(0, robots.step);
    TEST_ASSERT_EQUAL_INT(1, robots.least_gap_um);
    TEST_ASSERT_FALSE(robots.collided);
    robots.gap_um = 0;
    robots_start(&robots);
    TEST_ASSERT_TRUE(robots.collided);
}

static void test_accelerations_are_rounded_to_the_nearest_tenth(void)
{
    struct robots robots = start(9000, 0, 0);

    robots_step(&robots, 1950, false);
    TEST_ASSERT_EQUAL_INT(200, robots.own_mmps);
    robots = start(9000, 0, 0);
    robots_step(&robots, 10000, false);
    TEST_ASSERT_EQUAL_INT(1000, robots.own_mmps);
}

static void test_speed_is_limited_to_the_millimetre(void)
{
    struct robots robots = start(9000, 9, 0);

    robots_step(&robots, -100, false);
    TEST_ASSERT_EQUAL_INT(0, robots.own_mmps);
    robots = start(9000, 1991, 0);
    robots_step(&robots, 100, false);
    TEST_ASSERT_EQUAL_INT(2000, robots.own_mmps);
}

/* 1 m/s for 0.1 s is 100 mm. */
static void test_contact_is_a_gap_of_0(void)
{
    struct robots robots = start(100, 1000, 0);

    robots_step(&robots, 0, false);
    TEST_ASSERT_TRUE(robots.collided);
    robots = start(100, 1000, 0);
    robots.gap_um = 100001;
    robots_step(&robots, 0, false);
    TEST_ASSERT_FALSE(robots.collided);
    robots.gap_um = -1600;
    TEST_ASSERT_EQUAL_INT(0, robots_gap_mm(&robots));
}

static void test_least_gap_is_kept(void)
{
    struct robots robots = start(1000, 1000, 0);

    robots_step(&robots, 0, false);
    robots.lead_mmps = 2000;
    robots_step(&robots, 0, false);
    TEST_ASSERT_EQUAL_INT(1000000, robots.gap_um);
    TEST_ASSERT_EQUAL_INT(900000, robots.least_gap_um);
}

static void test_of_several_robots_the_nearest_counts(void)
{
    struct robots robots = start(9000, 1000, 0);
    struct robot_ahead ahead[] = {{true, 5000000, 500}, {true, 3000000, 1500}, {false, 1000000, 0}};

    robots_see_nearest(&robots, ahead, 3);
    TEST_ASSERT_EQUAL_INT(3000000, robots.gap_um);
    TEST_ASSERT_EQUAL_INT(1500, robots.lead_mmps);
    for (int step = 0; step < 14; step++) { /* they come nearer by 0.1 m a step to each other */
        robots_step(&robots, 0, false);
        robots_move_ahead(&robots, ahead, 3);
        TEST_ASSERT_EQUAL_INT(robots.gap_um, ahead[1].gap_um);
    }
    TEST_ASSERT_EQUAL_INT(3000000 + 14 * 50000, ahead[1].gap_um);
    TEST_ASSERT_EQUAL_INT(5000000 - 14 * 50000, ahead[0].gap_um);
    TEST_ASSERT_EQUAL_INT(1000000 - 14 * 100000, ahead[2].gap_um);
    ahead[1].there = false;
    robots_see_nearest(&robots, ahead, 3);
    TEST_ASSERT_EQUAL_INT(4300000, robots.gap_um);
    TEST_ASSERT_EQUAL_INT(500, robots.lead_mmps);
    TEST_ASSERT_EQUAL_INT(3000000, robots.least_gap_um);
    ahead[2] = (struct robot_ahead){true, 700000, 0}; /* cuts in */
    robots_see_nearest(&robots, ahead, 3);
    TEST_ASSERT_EQUAL_INT(700000, robots.least_gap_um);
}

static void test_the_order_of_the_robots_ahead_does_not_matter(void)
{
    struct robots robots = start(9000, 1000, 0);
    struct robot_ahead ahead[] = {{true, 3000000, 1500}, {true, 5000000, 500}, {true, 1, 700}};

    robots_see_nearest(&robots, ahead, 2);
    TEST_ASSERT_EQUAL_INT(3000000, robots.gap_um);
    TEST_ASSERT_EQUAL_INT(1500, robots.lead_mmps);
    robots_step(&robots, 0, false);
    robots_move_ahead(&robots, ahead, 2);
    TEST_ASSERT_EQUAL_INT(3050000, ahead[0].gap_um);
    TEST_ASSERT_EQUAL_INT(1, ahead[2].gap_um);
    robots_see_nearest(&robots, ahead, 3);
    TEST_ASSERT_EQUAL_INT(1, robots.gap_um);
    TEST_ASSERT_EQUAL_INT(700, robots.lead_mmps);
    ahead[0].gap_um = 1; /* side by side: the first one */
    robots_see_nearest(&robots, ahead, 3);
    TEST_ASSERT_EQUAL_INT(1500, robots.lead_mmps);
}

static void test_who_is_not_ahead_is_not_seen(void)
{
    struct robots robots = start(9000, 2000, 1000);
    const struct robot_ahead all[] = {
        {true, 2000000, 700}, {true, 0, 0}, {false, 3000000, 1500}, {true, 4000000, 900}};

    robots_see_nearest(&robots, all + 1, 2); /* the first and the last one are not asked for */
    TEST_ASSERT_EQUAL_INT(ROBOTS_NOBODY_UM, robots.gap_um);
    TEST_ASSERT_EQUAL_INT(0, robots.lead_mmps);
    robots_step(&robots, 0, false);
    TEST_ASSERT_EQUAL_INT(ROBOTS_NOBODY_UM, robots.gap_um);
    TEST_ASSERT_EQUAL_INT(9000000, robots.least_gap_um);
}

static void test_gaps_end_at_a_kilometre(void)
{
    struct robots robots = start(1000000, 0, 60000);
    struct robot_ahead far = {true, 999000000, 20000};

    robots_step(&robots, 0, false);
    TEST_ASSERT_EQUAL_INT(1000000000, robots.gap_um);
    robots_move_ahead(&robots, &far, 1);
    TEST_ASSERT_EQUAL_INT(1000000000, far.gap_um);
    far = (struct robot_ahead){true, 999999999, 0};
    robots_move_ahead(&robots, &far, 1);
    TEST_ASSERT_EQUAL_INT(999999999, far.gap_um);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_constant_acceleration_is_exact);
    RUN_TEST(test_speed_stays_from_0_to_2_mps);
    RUN_TEST(test_motion_control_tells_tenths_of_mps2_apart);
    RUN_TEST(test_contact_ends_all_motion);
    RUN_TEST(test_free_lane_is_taken_once);
    RUN_TEST(test_taken_lane_is_not_entered);
    RUN_TEST(test_gap_is_measured_to_the_nearest_millimetre);
    RUN_TEST(test_a_run_begins_with_what_is_there);
    RUN_TEST(test_accelerations_are_rounded_to_the_nearest_tenth);
    RUN_TEST(test_speed_is_limited_to_the_millimetre);
    RUN_TEST(test_contact_is_a_gap_of_0);
    RUN_TEST(test_least_gap_is_kept);
    RUN_TEST(test_of_several_robots_the_nearest_counts);
    RUN_TEST(test_the_order_of_the_robots_ahead_does_not_matter);
    RUN_TEST(test_who_is_not_ahead_is_not_seen);
    RUN_TEST(test_gaps_end_at_a_kilometre);
    return UNITY_END();
}
