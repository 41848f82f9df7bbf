/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/servo.c, pulse by pulse. */
#include "servo.h"

#include <unity.h>

static const int64_t us = 1000;
static struct servo servo;

void setUp(void)
{
    servo_init(&servo, false);
}

void tearDown(void)
{
}

/* A pulse of WIDTH_NS that begins at T_NS; returns what its end says. */
static bool pulse(int64_t t_ns, int64_t width_ns)
{
    TEST_ASSERT_FALSE(servo_edge(&servo, t_ns, true));
    TEST_ASSERT_TRUE(servo.high);
    TEST_ASSERT_EQUAL_INT64(t_ns, servo.rise_ns);
    return servo_edge(&servo, t_ns + width_ns, false);
}

static void test_that_a_pulse_is_as_long_as_it_is_high(void)
{
    TEST_ASSERT_TRUE(pulse(7000 * us, 1500 * us));
    TEST_ASSERT_FALSE(servo.high);
    TEST_ASSERT_EQUAL_INT64(8500 * us, servo.fall_ns);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1500, servo.pulse_us);
    TEST_ASSERT_FALSE(pulse(27000 * us, 1500 * us)); /* the same again */
    TEST_ASSERT_TRUE(pulse(47000 * us, 1501 * us));
    TEST_ASSERT_TRUE(pulse(67000 * us, 1499 * us));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1499, servo.pulse_us);
}

static void test_that_only_half_a_millisecond_to_two_and_a_half_count(void)
{
    TEST_ASSERT_FALSE(pulse(0, 500 * us - 1));
    TEST_ASSERT_FALSE(pulse(20000 * us, 2500 * us + 1));
    TEST_ASSERT_EQUAL_DOUBLE(0, servo.pulse_us);
    TEST_ASSERT_TRUE(pulse(40000 * us, 500 * us));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 500, servo.pulse_us);
    TEST_ASSERT_TRUE(pulse(60000 * us, 2500 * us));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2500, servo.pulse_us);
    TEST_ASSERT_FALSE(pulse(80000 * us, 100 * us));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2500, servo.pulse_us);
}

static void test_that_a_pin_that_begins_high_gives_no_pulse_when_it_falls(void)
{
    servo_init(&servo, true);
    TEST_ASSERT_TRUE(servo.high);
    TEST_ASSERT_FALSE(servo_edge(&servo, 1500 * us, false));
    TEST_ASSERT_EQUAL_DOUBLE(0, servo.pulse_us);
}

static void test_that_times_begin_anew_and_the_last_pulse_stays(void)
{
    pulse(9000 * us, 1800 * us);
    servo_restart(&servo, true);
    TEST_ASSERT_TRUE(servo.high);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1800, servo.pulse_us);
    TEST_ASSERT_FALSE(servo_edge(&servo, 10500 * us, false)); /* it rose before the times began */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1800, servo.pulse_us);
}

static void test_that_the_throttle_opens_from_1_to_2_ms(void)
{
    static const int64_t widths_us[] = {600, 1000, 1250, 1500, 2000, 2400};
    static const double throttle_pct[] = {0, 0, 25, 50, 100, 100};

    TEST_ASSERT_EQUAL_DOUBLE(0, servo_throttle_pct(&servo));
    for (int i = 0; i < 6; i++) {
        pulse(i * 20000 * us, widths_us[i] * us);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, throttle_pct[i], servo_throttle_pct(&servo));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_pulse_is_as_long_as_it_is_high);
    RUN_TEST(test_that_only_half_a_millisecond_to_two_and_a_half_count);
    RUN_TEST(test_that_a_pin_that_begins_high_gives_no_pulse_when_it_falls);
    RUN_TEST(test_that_times_begin_anew_and_the_last_pulse_stays);
    RUN_TEST(test_that_the_throttle_opens_from_1_to_2_ms);
    return UNITY_END();
}
