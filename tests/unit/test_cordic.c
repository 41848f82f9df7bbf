/* SPDX-License-Identifier: MIT */
/* Polar form: spot values on the chip, and on the host the whole domain against libm and against
 * the method in floating point. */
#include "cordic.h"
#include <stddef.h>
#include "unity.h"

#ifndef __SDCC_mcs51
#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979
#endif

void setUp(void)
{
}

void tearDown(void)
{
}

static void expect_polar(int16_t across, int16_t along, uint16_t length, int16_t angle)
{
    cordic_to_polar(across, along);
    TEST_ASSERT_UINT16_WITHIN(9, length, cordic_polar.length);
    TEST_ASSERT_INT16_WITHIN(9, angle, cordic_polar.angle);
}

static void test_spot_values(void)
{
    /* Lengths are 1.646760 times the hypotenuse, angles 65,536ths of a turn. */
    expect_polar(0, 5120, 8431, 0);
    expect_polar(5120, 5120, 11924, 8192);
    expect_polar(5120, 0, 8431, 16384);
    expect_polar(3000, 4000, 8234, 6712); /* 36.870 degrees */
    expect_polar(-3000, 4000, 8234, -6712);
    expect_polar(7680, 10240, 21078, 6712); /* 15 m, 20 m */
    expect_polar(20480, 20480, 47696, 8192);
    expect_polar(-20480, 0, 33726, -16384);
}

static void test_the_origin_has_no_length(void)
{
    cordic_to_polar(0, 0);
    TEST_ASSERT_EQUAL_UINT16(0, cordic_polar.length);
}

static void test_mirror_image_is_exactly_the_opposite(void)
{
    int16_t across, along;

    for (along = 0; along <= CORDIC_ALONG_MAX; along += 1777) {
        for (across = 1; across <= CORDIC_ACROSS_MAX; across += 911) {
            uint16_t length;
            int16_t angle;
            cordic_to_polar(across, along);
            length = cordic_polar.length;
            angle = cordic_polar.angle;
            cordic_to_polar(-across, along);
            TEST_ASSERT_EQUAL_UINT16(length, cordic_polar.length);
            TEST_ASSERT_EQUAL_INT16(-angle, cordic_polar.angle);
        }
    }
}

#ifndef __SDCC_mcs51
static void test_whole_domain_against_libm(void)
{
    for (int along = 0; along <= CORDIC_ALONG_MAX; along += 11) {
        for (int across = -CORDIC_ACROSS_MAX; across <= CORDIC_ACROSS_MAX; across += 17) {
            double length = hypot(across, along);
            cordic_to_polar((int16_t)across, (int16_t)along);
            TEST_ASSERT_DOUBLE_WITHIN(9, length * CORDIC_GAIN, cordic_polar.length);
            if (length >= 300) {
                TEST_ASSERT_DOUBLE_WITHIN(9, atan2(across, along) * 32768 / PI, cordic_polar.angle);
            }
        }
    }
}

/* The method: a point that is less than half the domain in both ways is made twice as large, at
 * most four times. Then step i turns it towards the axis by atan(2^-i), and a point on the axis as
 * one of the positive side. All numbers are whole, rounded down. */
static void expect_method(int across, int along)
{
    double x = along, y = abs(across), angle = 0, enlarged = 1;

    while (enlarged < 16 && x < CORDIC_ALONG_MAX / 2 && y < CORDIC_ACROSS_MAX / 2) {
        x *= 2;
        y *= 2;
        enlarged *= 2;
    }
    for (int i = 0; i <= 12; i++) {
        double part = pow(2, -i), side = y >= 0 ? 1 : -1, y_part = floor(fabs(y) * part);

        y -= side * floor(x * part);
        x += y_part;
        angle += side * round(atan(part) * 32768 / PI);
    }
    cordic_to_polar((int16_t)across, (int16_t)along);
    TEST_ASSERT_EQUAL_UINT16(floor(x / enlarged), cordic_polar.length);
    TEST_ASSERT_EQUAL_INT16(across < 0 ? -angle : angle, cordic_polar.angle);
}

/* Around where the enlarging ends, and over the whole domain. */
static void test_each_step_is_that_of_the_method(void)
{
    static const int EDGES[] = {0, 640, 1280, 2560, 5120, 10240, 20479};

    for (unsigned i = 0; i < sizeof EDGES / sizeof *EDGES; i++) {
        for (int off = -1; off <= 1; off++) {
            int edge = abs(EDGES[i] + off);

            for (int other = 0; other <= CORDIC_ALONG_MAX; other += 16) {
                expect_method(edge, other);
                expect_method(-edge, other);
                expect_method(other, edge);
            }
        }
    }
    for (int along = 0; along <= CORDIC_ALONG_MAX; along += 71) {
        for (int across = -CORDIC_ACROSS_MAX; across <= CORDIC_ACROSS_MAX; across += 113) {
            expect_method(across, along);
        }
    }
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_spot_values);
    RUN_TEST(test_the_origin_has_no_length);
    RUN_TEST(test_mirror_image_is_exactly_the_opposite);
#ifndef __SDCC_mcs51
    RUN_TEST(test_whole_domain_against_libm);
    RUN_TEST(test_each_step_is_that_of_the_method);
#endif
    return UNITY_END();
}
