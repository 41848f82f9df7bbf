/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/sonar.c and sensor.c, the sensor and its faults; figures from the
 * HC-SR04 data sheet. */
#include "sensor_settings.h"
#include "sonar.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static const int64_t us = 1000, ms = 1000000;
static struct sonar sonar;

void setUp(void)
{
    default_settings();
}

void tearDown(void)
{
    sensing_free(&sonar.sensing);
}

static void begin(uint64_t seed)
{
    sensing_free(&sonar.sensing);
    sonar_init(&sonar, &settings, seed);
}

/* The pulse that the echo line shows, us; 0: none; -1: it never ends. */
static double pulse_us(int64_t *rise_ns)
{
    int64_t at_ns, begin_ns = 0;
    bool level;
    double length = 0;

    while (sonar_next_event(&sonar, INT64_MAX, &at_ns, &level)) {
        if (level) {
            begin_ns = at_ns;
            length = -1;
        } else if (length < 0) {
            length = (double)(at_ns - begin_ns) / 1000;
        }
    }
    if (rise_ns != NULL) {
        *rise_ns = begin_ns;
    }
    return length;
}

/* What a controller reads at T_NS: metres, 0: nothing, -1: never ends, INFINITY: no target. */
static double read_m(int64_t t_ns, double gap_m)
{
    double length;

    sonar_trigger(&sonar, t_ns, 12 * us, gap_m, 0);
    length = pulse_us(NULL);
    if (length > 37999 && length < 38001) {
        return INFINITY;
    }
    return length > 0 ? length * 1e-6 * 343.2 / 2 : length;
}

static void test_that_the_speed_of_sound_follows_the_temperature(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 343.2, sonar_sound_mps(20));
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 331.3, sonar_sound_mps(0));
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 354.7, sonar_sound_mps(40));
}

static void test_that_the_echo_lasts_as_long_as_the_sound(void)
{
    begin(1);
    for (int i = 0; i <= 498; i++) {
        double gap = 0.02 + 0.01 * i, length;
        int64_t t = i * 60 * ms, rise;

        TEST_ASSERT_EQUAL(SENSOR_TARGET, sonar_trigger(&sonar, t, 10 * us, gap, 0));
        length = pulse_us(&rise);
        TEST_ASSERT_EQUAL_INT64(t + 450 * us, rise);
        TEST_ASSERT_DOUBLE_WITHIN(0.01, 2 * gap / 343.2 * 1e6, length);
    }
}

static void test_that_sound_meets_a_closing_target_nearer(void)
{
    begin(1);
    sonar_trigger(&sonar, 0, 10 * us, 5, 10);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 10 / 353.2 * 1e6, pulse_us(NULL));
}

static void test_that_no_target_is_a_pulse_of_38_ms(void)
{
    begin(1);
    TEST_ASSERT_EQUAL(SENSOR_NONE, sonar_trigger(&sonar, 0, 10 * us, 5.01, 0));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 38000, pulse_us(NULL));
    TEST_ASSERT_EQUAL(SENSOR_NONE, sonar_trigger(&sonar, 60 * ms, 10 * us, INFINITY, 0));
    TEST_ASSERT_EQUAL(SENSOR_NONE, sonar_trigger(&sonar, 120 * ms, 10 * us, 0.019, 0));
}

static void test_that_a_short_trigger_is_not_heard(void)
{
    begin(1);
    TEST_ASSERT_EQUAL(SENSOR_DEAF, sonar_trigger(&sonar, 0, 9999, 2, 0));
    TEST_ASSERT_EQUAL_DOUBLE(0, pulse_us(NULL));
}

static void test_that_a_trigger_during_an_echo_is_not_heard(void)
{
    begin(1);
    sonar_trigger(&sonar, 0, 10 * us, 2, 0);
    TEST_ASSERT_EQUAL(SENSOR_DEAF, sonar_trigger(&sonar, 12 * ms, 10 * us, 2, 0));
    TEST_ASSERT_EQUAL(SENSOR_TARGET, sonar_trigger(&sonar, 13 * ms, 10 * us, 2, 0));
}

static void test_that_the_horizon_covers_the_echo_under_way(void)
{
    begin(1);
    TEST_ASSERT_EQUAL_INT64(1 * ms + 450 * us, sonar_horizon_ns(&sonar, 1 * ms));
    sonar_trigger(&sonar, 2 * ms, 10 * us, 1.716, 0); /* 10 ms of echo */
    TEST_ASSERT_EQUAL_INT64(12 * ms + 900 * us, sonar_horizon_ns(&sonar, 3 * ms));
}

static void test_that_noise_has_its_deviation_and_no_bias(void)
{
    double sum = 0, squares = 0;
    const int n = 20000;

    settings.sensor.noise_m = 0.01;
    begin(42);
    for (int i = 0; i < n; i++) {
        double error = read_m(i * 60 * ms, 2) - 2;

        sum += error;
        squares += error * error;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.0003, 0, sum / n);
    TEST_ASSERT_DOUBLE_WITHIN(0.0002, 0.01, sqrt(squares / n));
}

static void test_that_dropouts_come_as_often_as_asked_for(void)
{
    int dropped = 0;

    settings.sensor.dropout = 0.1;
    begin(42);
    for (int i = 0; i < 10000; i++) {
        dropped += isinf(read_m(i * 60 * ms, 2)) != 0;
    }
    TEST_ASSERT_INT_WITHIN(100, 1000, dropped);
}

static void test_that_the_same_seed_gives_the_same_readings(void)
{
    double first[50];

    settings.sensor.noise_m = 0.02;
    settings.sensor.dropout = 0.1;
    begin(7);
    for (int i = 0; i < 50; i++) {
        first[i] = read_m(i * 60 * ms, 2);
    }
    begin(7);
    for (int i = 0; i < 50; i++) {
        TEST_ASSERT_TRUE(memcmp(&first[i], &(double){read_m(i * 60 * ms, 2)}, sizeof(double)) == 0);
    }
    begin(8);
    TEST_ASSERT_TRUE(fabs(read_m(0, 2) - first[0]) > 1e-6);
}

static void test_that_a_fault_leaves_the_later_noise_alone(void)
{
    double healthy;

    settings.sensor.noise_m = 0.02;
    begin(7);
    for (int i = 0; i < 5; i++) {
        read_m(i * 60 * ms, 2);
    }
    healthy = read_m(5 * 60 * ms, 2);
    fault(0, FAULT_GARBAGE, 0)->for_s = 0.2;
    begin(7);
    for (int i = 0; i < 5; i++) {
        read_m(i * 60 * ms, 2);
    }
    TEST_ASSERT_EQUAL_DOUBLE(healthy, read_m(5 * 60 * ms, 2));
}

static void test_that_readings_are_rounded_to_the_step(void)
{
    settings.sensor.step_m = 0.01;
    begin(1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.23, read_m(0, 1.2345));
}

/* --- faults ------------------------------------------------------------------------------- */

static void test_that_a_sensor_that_is_off_says_nothing(void)
{
    fault(0, FAULT_OFF, 0.1)->for_s = 0.1;
    begin(1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2, read_m(0, 2));
    TEST_ASSERT_EQUAL(SENSOR_MISSING, sonar_trigger(&sonar, 120 * ms, 10 * us, 2, 0));
    TEST_ASSERT_EQUAL_DOUBLE(0, pulse_us(NULL));
    TEST_ASSERT_EQUAL(SENSOR_NONE, sonar_trigger(&sonar, 180 * ms, 10 * us, INFINITY, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2, read_m(240 * ms, 2));
}

static void test_that_an_unplugged_line_goes_high_and_cuts_the_echo(void)
{
    int64_t at;
    bool level;

    fault(0, FAULT_OFF, 0.005)->line = 1;
    begin(1);
    sonar_trigger(&sonar, 0, 10 * us, 0.1, 0); /* over before the plug comes out */
    TEST_ASSERT_TRUE(sonar_next_event(&sonar, 5 * ms, &at, &level));
    TEST_ASSERT_TRUE(sonar_next_event(&sonar, 5 * ms, &at, &level));
    TEST_ASSERT_FALSE(level);
    TEST_ASSERT_EQUAL_INT64(5 * ms, sensing_boundary_ns(&sonar.sensing, 0));
    sonar_pass_boundary(&sonar, 5 * ms);
    TEST_ASSERT_TRUE(sonar_next_event(&sonar, 5 * ms, &at, &level));
    TEST_ASSERT_TRUE(level);
    TEST_ASSERT_EQUAL_INT64(5 * ms, at);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, sensing_boundary_ns(&sonar.sensing, 5 * ms));
}

static void test_that_a_dead_line_ends_an_echo_early(void)
{
    int64_t at;
    bool level;

    fault(0, FAULT_OFF, 0.005);
    begin(1);
    sonar_trigger(&sonar, 0, 10 * us, 2, 0);
    TEST_ASSERT_TRUE(sonar_next_event(&sonar, 5 * ms, &at, &level));
    TEST_ASSERT_TRUE(level);
    sonar_pass_boundary(&sonar, 5 * ms);
    TEST_ASSERT_TRUE(sonar_next_event(&sonar, INT64_MAX, &at, &level));
    TEST_ASSERT_FALSE(level);
    TEST_ASSERT_EQUAL_INT64(5 * ms, at);
    TEST_ASSERT_FALSE(sonar_next_event(&sonar, INT64_MAX, &at, &level));
}

static void test_that_a_stuck_sensor_repeats_its_last_reading(void)
{
    fault(0, FAULT_STUCK, 0.1);
    begin(1);
    read_m(0, 3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 3, read_m(120 * ms, 2));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 3, read_m(180 * ms, INFINITY));
}

static void test_that_a_sensor_stuck_before_it_saw_anything_says_no_target(void)
{
    static const double first_m[] = {INFINITY, 7, 0.01}; /* nothing, beyond max_m, below min_m */

    for (int i = 0; i < 3; i++) {
        fault(0, FAULT_STUCK, 0);
        begin(1);
        TEST_ASSERT_EQUAL_DOUBLE(INFINITY, read_m(0, first_m[i]));
        TEST_ASSERT_EQUAL_DOUBLE(INFINITY, read_m(60 * ms, 2)); /* for ever */
    }
}

static void test_that_garbage_has_nothing_to_do_with_the_distance(void)
{
    double low = INFINITY, high = 0;

    fault(0, FAULT_GARBAGE, 0);
    begin(3);
    for (int i = 0; i < 200; i++) {
        double reading = read_m(i * 60 * ms, 2);

        low = fmin(low, reading);
        high = fmax(high, reading);
    }
    TEST_ASSERT_TRUE(low < 0.3 && high > 6);
}

static void test_that_a_wrong_sensor_scales_and_shifts(void)
{
    fault(0, FAULT_WRONG, 0)->scale = 1.5;
    settings.faults[0].offset_m = -0.2;
    begin(1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2.8, read_m(0, 2));
}

static void test_that_a_slow_sensor_skips_triggers(void)
{
    fault(0, FAULT_SLOW, 0)->period_s = 0.15;
    begin(1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2, read_m(0, 2));
    TEST_ASSERT_EQUAL(SENSOR_MISSING, sonar_trigger(&sonar, 60 * ms, 10 * us, 2, 0));
    TEST_ASSERT_EQUAL_DOUBLE(0, read_m(120 * ms, 2));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2, read_m(180 * ms, 2));
}

static void test_that_a_delayed_sensor_shows_the_past(void)
{
    fault(0, FAULT_DELAYED, 0)->delay_s = 0.2;
    begin(1);
    for (int i = 0; i <= 100; i++) {
        sensing_observe(&sonar.sensing, i * 10 * ms, 5 - 0.03 * i); /* 3 m/s */
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 5 - 3 * 0.805, read_m(1005 * ms, 5 - 3 * 1.005));
}

static void test_that_an_intermittent_sensor_comes_and_goes(void)
{
    fault(0, FAULT_INTERMITTENT, 1)->off_s = 0.3;
    settings.faults[0].on_s = 0.2;
    begin(1);
    TEST_ASSERT_EQUAL_DOUBLE(0, read_m(1100 * ms, 2));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2, read_m(1400 * ms, 2));
    TEST_ASSERT_EQUAL_DOUBLE(0, read_m(1600 * ms, 2));
    TEST_ASSERT_EQUAL_INT64(1000 * ms, sensing_boundary_ns(&sonar.sensing, 0));
    TEST_ASSERT_EQUAL_INT64(1300 * ms, sensing_boundary_ns(&sonar.sensing, 1000 * ms));
    TEST_ASSERT_EQUAL_INT64(1500 * ms, sensing_boundary_ns(&sonar.sensing, 1300 * ms));
    TEST_ASSERT_EQUAL_INT64(1800 * ms, sensing_boundary_ns(&sonar.sensing, 1500 * ms));
}

static void test_that_a_glitch_lasts_so_many_readings(void)
{
    fault(0, FAULT_GLITCH, 0.1)->dist_m = 0.5;
    settings.faults[0].readings = 2;
    begin(1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2, read_m(0, 2));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.5, read_m(120 * ms, 2));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.5, read_m(180 * ms, INFINITY));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2, read_m(240 * ms, 2));
}

static void test_that_the_p_variant_holds_its_line_until_a_target_is_there(void)
{
    settings.sensor.no_target = NO_TARGET_HIGH;
    begin(1);
    TEST_ASSERT_EQUAL_DOUBLE(-1, read_m(0, INFINITY));
    TEST_ASSERT_EQUAL_DOUBLE(0, read_m(60 * ms, INFINITY)); /* no new edge: still high */
    TEST_ASSERT_TRUE(sonar.level);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2, read_m(120 * ms, 2));
}

static void test_that_a_silent_variant_gives_no_pulse_for_no_target(void)
{
    settings.sensor.no_target = NO_TARGET_SILENT;
    begin(1);
    TEST_ASSERT_EQUAL_DOUBLE(0, read_m(0, INFINITY));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2, read_m(60 * ms, 2));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_the_speed_of_sound_follows_the_temperature);
    RUN_TEST(test_that_the_echo_lasts_as_long_as_the_sound);
    RUN_TEST(test_that_sound_meets_a_closing_target_nearer);
    RUN_TEST(test_that_no_target_is_a_pulse_of_38_ms);
    RUN_TEST(test_that_a_short_trigger_is_not_heard);
    RUN_TEST(test_that_a_trigger_during_an_echo_is_not_heard);
    RUN_TEST(test_that_the_horizon_covers_the_echo_under_way);
    RUN_TEST(test_that_noise_has_its_deviation_and_no_bias);
    RUN_TEST(test_that_dropouts_come_as_often_as_asked_for);
    RUN_TEST(test_that_the_same_seed_gives_the_same_readings);
    RUN_TEST(test_that_a_fault_leaves_the_later_noise_alone);
    RUN_TEST(test_that_readings_are_rounded_to_the_step);
    RUN_TEST(test_that_a_sensor_that_is_off_says_nothing);
    RUN_TEST(test_that_an_unplugged_line_goes_high_and_cuts_the_echo);
    RUN_TEST(test_that_a_dead_line_ends_an_echo_early);
    RUN_TEST(test_that_a_stuck_sensor_repeats_its_last_reading);
    RUN_TEST(test_that_a_sensor_stuck_before_it_saw_anything_says_no_target);
    RUN_TEST(test_that_garbage_has_nothing_to_do_with_the_distance);
    RUN_TEST(test_that_a_wrong_sensor_scales_and_shifts);
    RUN_TEST(test_that_a_slow_sensor_skips_triggers);
    RUN_TEST(test_that_a_delayed_sensor_shows_the_past);
    RUN_TEST(test_that_an_intermittent_sensor_comes_and_goes);
    RUN_TEST(test_that_a_glitch_lasts_so_many_readings);
    RUN_TEST(test_that_the_p_variant_holds_its_line_until_a_target_is_there);
    RUN_TEST(test_that_a_silent_variant_gives_no_pulse_for_no_target);
    return UNITY_END();
}
