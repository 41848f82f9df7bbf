/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/truck.c, against the geometry of a straight line, a circle and a
 * rectangle. */
#include "truck.h"

#include <math.h>
#include <unity.h>

static const double pi = 3.14159265358979323846;

void setUp(void)
{
}

void tearDown(void)
{
}

/* 2 m from axle to axle, so that a steering angle of 45 degrees is a circle of 2 m radius. */
static struct truck truck_at(double x_m, double y_m, double heading_rad)
{
    return (struct truck){.x_m = x_m,
                          .y_m = y_m,
                          .heading_rad = heading_rad,
                          .speed_mps = 1,
                          .length_m = 2,
                          .width_m = 2,
                          .overhang_m = 1};
}

static void expect(const struct truck *truck, double x_m, double y_m, double heading_rad)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, x_m, truck->x_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, y_m, truck->y_m);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, heading_rad, truck->heading_rad);
}

static void test_that_it_drives_straight_backwards(void)
{
    struct truck truck = truck_at(4, 5, pi / 2);

    truck.speed_mps = 2;
    TEST_ASSERT_EQUAL_DOUBLE(1.5, truck_drive(&truck, 0, 1.5));
    expect(&truck, 4, 2, pi / 2);
    truck = truck_at(4, 5, pi / 6);
    TEST_ASSERT_EQUAL_DOUBLE(2, truck_drive(&truck, 0, 2));
    expect(&truck, 4 - sqrt(3), 4, pi / 6);
}

static void test_that_it_stops_at_y_0(void)
{
    struct truck truck = truck_at(4, 3, pi / 2);

    truck.speed_mps = 2;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5, truck_drive(&truck, 0, 10));
    expect(&truck, 4, 0, pi / 2);
    for (int i = 1; i < 100; i++) {
        truck = truck_at(4, 0.1 * i, pi * i / 101);
        truck_drive(&truck, 0, 1000);
        TEST_ASSERT_EQUAL_DOUBLE(0, truck.y_m);
    }
}

/* From along x, a quarter of the circle takes pi m: 2 m back and 2 m to the side. */
static void test_that_it_drives_along_a_circle(void)
{
    struct truck truck = truck_at(7, 8, 0);

    TEST_ASSERT_EQUAL_DOUBLE(pi, truck_drive(&truck, -pi / 4, pi));
    expect(&truck, 5, 6, pi / 2);
    truck = truck_at(7, 8, 0);
    truck_drive(&truck, pi / 4, pi);
    expect(&truck, 5, 10, -pi / 2);
    truck = truck_at(7, 8, pi / 2); /* and a second quarter */
    truck_drive(&truck, -pi / 4, pi);
    expect(&truck, 9, 6, pi);
}

/* 1 m down on the circle of 2 m is a turn of 60 degrees. */
static void test_that_it_arrives_on_a_circle(void)
{
    struct truck truck = truck_at(7, 1, 0);

    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2 * pi / 3, truck_drive(&truck, -pi / 4, pi));
    expect(&truck, 7 - sqrt(3), 0, pi / 3);
    TEST_ASSERT_EQUAL_DOUBLE(0, truck.y_m);
}

static void test_that_a_step_is_eulers(void)
{
    struct truck truck = truck_at(7, 8, pi / 6);

    TEST_ASSERT_FALSE(truck_step(&truck, -pi / 4, 0.5));
    expect(&truck, 7 - 0.25 * sqrt(3), 7.75, pi / 6 + 0.25);
    truck = truck_at(7, 8, -pi / 6);
    truck.speed_mps = 3;
    TEST_ASSERT_FALSE(truck_step(&truck, pi / 4, 0.5));
    expect(&truck, 7 - 0.75 * sqrt(3), 8.75, -pi / 6 - 0.75);
}

static void test_that_a_step_ends_at_y_0(void)
{
    struct truck truck = truck_at(7, 0.1, pi / 6);

    TEST_ASSERT_TRUE(truck_step(&truck, -pi / 4, 0.5)); /* 0.1 m of 0.25 m */
    expect(&truck, 7 - 0.1 * sqrt(3), 0, pi / 6 + 0.1);
    truck = truck_at(7, 0.5, pi / 2); /* just there */
    TEST_ASSERT_TRUE(truck_step(&truck, -pi / 4, 0.5));
    expect(&truck, 7, 0, pi / 2 + 0.25);
    truck = truck_at(7, 0, 0); /* along the line */
    TEST_ASSERT_TRUE(truck_step(&truck, -pi / 4, 0.5));
    expect(&truck, 6.5, 0, 0.25);
}

static void test_that_the_turn_is_counted_from_upright(void)
{
    struct truck truck = truck_at(0, 0, pi / 2 + 0.3);

    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3, truck_turn_rad(&truck));
    truck.heading_rad = pi / 2 - 0.3 + 2 * pi;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.3, truck_turn_rad(&truck));
    truck.heading_rad = pi / 2 + 0.3 - 4 * pi;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3, truck_turn_rad(&truck));
}

static void test_that_0_4_m_and_2_degrees_are_aligned(void)
{
    static const double sides[] = {1, -1};

    for (int i = 0; i < 2; i++) {
        struct truck truck = truck_at(0.399 * sides[i], 0, pi / 2 + 1.99 * pi / 180 * sides[i]);

        TEST_ASSERT_TRUE(truck_is_aligned(&truck));
        truck.x_m = 0.401 * sides[i];
        TEST_ASSERT_FALSE(truck_is_aligned(&truck));
        truck.x_m = 0;
        truck.heading_rad = pi / 2 + 2.01 * pi / 180 * sides[i];
        TEST_ASSERT_FALSE(truck_is_aligned(&truck));
    }
}

/* The outline of a truck with its axle at (0, 0) that points up is x -1..1, y -1..3. */
static void test_that_the_outline_must_be_within_the_place(void)
{
    struct truck truck = truck_at(0, 0, pi / 2);
    double tilt = 0.1, front_m, rear_m;

    TEST_ASSERT_TRUE(truck_fits(&truck, 2.001));
    TEST_ASSERT_FALSE(truck_fits(&truck, 1.999));
    for (double side = -1; side <= 1; side += 2) {
        truck = truck_at(0.5 * side, 0, pi / 2);
        TEST_ASSERT_TRUE(truck_fits(&truck, 3.001));
        TEST_ASSERT_FALSE(truck_fits(&truck, 2.999));
        /* Tilted, the front sticks out to one side, the rear to the other. */
        truck = truck_at(0, 0, pi / 2 + tilt * side);
        front_m = 3 * sin(tilt) + cos(tilt);
        TEST_ASSERT_TRUE(truck_fits(&truck, 2 * front_m + 0.001));
        TEST_ASSERT_FALSE(truck_fits(&truck, 2 * front_m - 0.001));
        truck.x_m = side;
        rear_m = 1 + sin(tilt) + cos(tilt);
        TEST_ASSERT_TRUE(truck_fits(&truck, 2 * rear_m + 0.001));
        TEST_ASSERT_FALSE(truck_fits(&truck, 2 * rear_m - 0.001));
    }
    truck = truck_at(0, 0, -pi / 2);
    TEST_ASSERT_FALSE(truck_fits(&truck, 100)); /* the wrong way round */
}

/* A rectangle at 30 degrees, 3 m to its front, 1 m to its rear, 1 m to each side. */
static void test_that_each_corner_touches_its_wall(void)
{
    const struct truck truck = truck_at(10, 20, pi / 6);
    const double along = cos(pi / 6), across = sin(pi / 6), hair = 1e-6;
    const struct lot open = {-INFINITY, INFINITY, -INFINITY, INFINITY};
    struct lot lot = open;
    const struct {
        double *wall_m, reach_m, outward;
    } walls[] = {{&lot.west_m, 10 - along - across, -1},
                 {&lot.east_m, 10 + 3 * along + across, 1},
                 {&lot.south_m, 20 - across - along, -1},
                 {&lot.north_m, 20 + 3 * across + along, 1}};

    TEST_ASSERT_FALSE(truck_touches(&truck, &open));
    for (int i = 0; i < 4; i++) {
        lot = open;
        *walls[i].wall_m = walls[i].reach_m + walls[i].outward * hair;
        TEST_ASSERT_FALSE(truck_touches(&truck, &lot));
        *walls[i].wall_m = walls[i].reach_m - walls[i].outward * hair;
        TEST_ASSERT_TRUE(truck_touches(&truck, &lot));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_it_drives_straight_backwards);
    RUN_TEST(test_that_it_stops_at_y_0);
    RUN_TEST(test_that_it_drives_along_a_circle);
    RUN_TEST(test_that_it_arrives_on_a_circle);
    RUN_TEST(test_that_a_step_is_eulers);
    RUN_TEST(test_that_a_step_ends_at_y_0);
    RUN_TEST(test_that_the_turn_is_counted_from_upright);
    RUN_TEST(test_that_0_4_m_and_2_degrees_are_aligned);
    RUN_TEST(test_that_the_outline_must_be_within_the_place);
    RUN_TEST(test_that_each_corner_touches_its_wall);
    return UNITY_END();
}
