/* SPDX-License-Identifier: MIT */
/* Polar form: spot values on the chip, and on the host the whole domain against libm. */
#include "cordic.h"
#include <stddef.h>
#include "unity.h"

#ifndef __SDCC_mcs51
#include <math.h>
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
                TEST_ASSERT_DOUBLE_WITHIN(9, atan2(across, along) * 32768 / 3.14159265358979,
                                          cordic_polar.angle);
            }
        }
    }
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_spot_values);
    RUN_TEST(test_mirror_image_is_exactly_the_opposite);
#ifndef __SDCC_mcs51
    RUN_TEST(test_whole_domain_against_libm);
#endif
    return UNITY_END();
}
