/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/tfluna.c, the lidar's frames and what may be wrong with them;
 * figures from Benewake's manual SJ-PM-TF-Luna A03. */
#include "sensor_settings.h"
#include "tfluna.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static struct tfluna tfluna;
static uint8_t frame[TFLUNA_FRAME];
static enum sensor_answer answer;

void setUp(void)
{
    default_settings();
    settings.sensor.kind = SENSOR_TFLUNA;
    settings.sensor.noise_m = 0;
}

void tearDown(void)
{
    sensing_free(&tfluna.sensing);
}

static void begin(uint64_t seed)
{
    sensing_free(&tfluna.sensing);
    tfluna_init(&tfluna, &settings, seed);
}

static size_t take(double gap_m)
{
    return tfluna_take(&tfluna, gap_m, 0, frame, &answer);
}

static int dist_cm(void)
{
    return frame[2] + 256 * frame[3];
}

static int strength(void)
{
    return frame[4] + 256 * frame[5];
}

static bool sum_is_right(void)
{
    int sum = 0;

    for (int i = 0; i < TFLUNA_FRAME - 1; i++) {
        sum += frame[i];
    }
    return (sum & 0xFF) == frame[TFLUNA_FRAME - 1];
}

/* --- healthy ------------------------------------------------------------------------------ */

static void test_that_a_frame_has_its_nine_bytes(void)
{
    /* By hand: 300 cm = 0x12C, 25 C is (25 + 256) * 8 = 2248 = 0x8C8; strength
     * 1000 (3/4)^-1.32193 = 1463 = 0x5B7; the sum is 0x59 + 0x59 + 0x2C + 1 + 0xB7 + 5 + 0xC8 + 8.
     */
    static const uint8_t expected[] = {0x59, 0x59, 0x2C, 0x01, 0xB7, 0x05, 0xC8, 0x08, 0x6B};

    begin(1);
    TEST_ASSERT_EQUAL(TFLUNA_FRAME, take(3));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, frame, TFLUNA_FRAME);
    TEST_ASSERT_EQUAL(SENSOR_TARGET, answer);
}

static void test_that_the_strength_joins_the_tables_of_the_manual(void)
{
    static const double dist_m[] = {4, 6, 8}, noise_m[] = {0.01, 0.015, 0.02};

    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1000, tfluna_strength(&settings.sensor, 4));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 400, tfluna_strength(&settings.sensor, 8));
    for (int i = 0; i < 3; i++) {
        TEST_ASSERT_DOUBLE_WITHIN(0.0021, noise_m[i],
                                  tfluna_noise_m(tfluna_strength(&settings.sensor, dist_m[i])));
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.03, tfluna_noise_m(100));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.03, tfluna_noise_m(200));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.025, tfluna_noise_m(300));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.005, tfluna_noise_m(2000));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.005, tfluna_noise_m(9000));
}

static void test_that_a_white_car_is_seen_up_to_8_m(void)
{
    begin(1);
    take(8);
    TEST_ASSERT_EQUAL(800, dist_cm());
    take(8.01);
    TEST_ASSERT_EQUAL(0, dist_cm());
    TEST_ASSERT_LESS_THAN(TFLUNA_WEAK, strength());
    TEST_ASSERT_EQUAL(SENSOR_NONE, answer);
    take(INFINITY);
    TEST_ASSERT_EQUAL(0, dist_cm());
    TEST_ASSERT_EQUAL(0, strength());
    TEST_ASSERT_TRUE(sum_is_right());
}

static void test_that_a_black_car_is_seen_from_4_3_m_on(void)
{
    /* (1000 / 9) (d/4)^-1.32193 = 100: d = 4 (10/9)^(1/1.32193) */
    const double from_m = 4 * pow(10.0 / 9, 1 / 1.32193);

    settings.sensor.reflectivity_pct = 10;
    begin(1);
    take(from_m + 0.01);
    TEST_ASSERT_EQUAL(0, dist_cm());
    TEST_ASSERT_EQUAL(SENSOR_NONE, answer);
    take(from_m - 0.01);
    TEST_ASSERT_EQUAL(432, dist_cm());
    TEST_ASSERT_EQUAL(100, strength());
}

static void test_that_the_distance_is_the_mean_of_one_period(void)
{
    begin(1);
    tfluna_take(&tfluna, 4, 10, frame, &answer);
    TEST_ASSERT_EQUAL(405, dist_cm()); /* 5 ms ago at 10 m/s */
    settings.sensor.rate_hz = 50;
    begin(1);
    tfluna_take(&tfluna, 4, -10, frame, &answer);
    TEST_ASSERT_EQUAL(390, dist_cm());
}

static void test_that_frames_come_at_the_rate(void)
{
    int64_t first_ns;

    for (uint64_t seed = 0; seed < 50; seed++) {
        begin(seed);
        first_ns = tfluna.due_ns;
        TEST_ASSERT_TRUE(first_ns >= 0 && first_ns < 10000000);
        take(3);
        TEST_ASSERT_EQUAL_INT64(first_ns, tfluna.sent_ns);
        TEST_ASSERT_EQUAL_INT64(first_ns + 10000000, tfluna.due_ns);
    }
    settings.sensor.rate_hz = 12.5;
    settings.sensor.start_up_s = 0.5;
    begin(3);
    first_ns = tfluna.due_ns;
    TEST_ASSERT_TRUE(first_ns >= 500000000 && first_ns < 580000000);
    take(3);
    TEST_ASSERT_EQUAL_INT64(first_ns + 80000000, tfluna.due_ns);
}

static void test_that_noise_follows_the_strength(void)
{
    double sum = 0, squares = 0;
    const int n = 20000;

    settings.sensor.noise_m = SCENARIO_UNSET;
    begin(42);
    for (int i = 0; i < n; i++) {
        double error_cm;

        take(4);
        error_cm = dist_cm() - 400;
        sum += error_cm;
        squares += error_cm * error_cm;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 0, sum / n);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, sqrt(1 + 1.0 / 12), sqrt(squares / n)); /* and whole cm */
}

static void test_that_the_distance_grows_again_in_the_dead_zone(void)
{
    begin(1);
    take(0.2);
    TEST_ASSERT_EQUAL(20, dist_cm());
    take(0.05);
    TEST_ASSERT_EQUAL(35, dist_cm());
}

static void test_that_dropouts_come_as_often_as_asked_for(void)
{
    int dropped = 0;

    settings.sensor.dropout = 0.1;
    begin(42);
    for (int i = 0; i < 10000; i++) {
        take(2);
        dropped += dist_cm() == 0;
        TEST_ASSERT_EQUAL(dist_cm() == 0 ? SENSOR_MISSING : SENSOR_TARGET, answer);
    }
    TEST_ASSERT_INT_WITHIN(100, 1000, dropped);
}

/* --- faults ------------------------------------------------------------------------------- */

static void test_that_a_sensor_that_is_off_sends_nothing_and_keeps_its_pace(void)
{
    int64_t first_ns;

    fault(0, FAULT_OFF, 0)->for_s = 0.02;
    begin(1);
    first_ns = tfluna.due_ns; /* cppcheck-suppress unreadVariable; it cannot read the macro below */
    TEST_ASSERT_EQUAL(0, take(2));
    TEST_ASSERT_EQUAL(SENSOR_MISSING, answer);
    TEST_ASSERT_EQUAL(0, take(2));
    TEST_ASSERT_EQUAL(TFLUNA_FRAME, take(2));
    TEST_ASSERT_EQUAL_INT64(first_ns + 20000000, tfluna.sent_ns);
}

static void test_that_a_stuck_sensor_repeats_its_last_distance(void)
{
    fault(0, FAULT_STUCK, 0.01);
    begin(1);
    take(3);
    take(2);
    TEST_ASSERT_EQUAL(300, dist_cm());
    TEST_ASSERT_TRUE(sum_is_right());
}

static void test_that_sunlight_sends_the_strength_65535(void)
{
    int low_cm = 65535, high_cm = 0;

    fault(0, FAULT_BLIND, 0)->for_s = 4;
    begin(1);
    for (int i = 0; i < 300; i++) {
        TEST_ASSERT_EQUAL(TFLUNA_FRAME, take(2));
        TEST_ASSERT_EQUAL(65535, strength());
        TEST_ASSERT_EQUAL(SENSOR_MISSING, answer);
        TEST_ASSERT_TRUE(sum_is_right());
        low_cm = dist_cm() < low_cm ? dist_cm() : low_cm;
        high_cm = dist_cm() > high_cm ? dist_cm() : high_cm;
    }
    TEST_ASSERT_TRUE(low_cm < 30 && high_cm > 870 && high_cm <= 900);
}

static void test_that_rain_takes_strength_and_adds_near_echoes(void)
{
    int near = 0;

    fault(0, FAULT_RAIN, 0)->scale = 0.2;
    settings.faults[0].share = 0;
    begin(1);
    take(8); /* 0.2 * 400 */
    TEST_ASSERT_EQUAL(0, dist_cm());
    TEST_ASSERT_EQUAL(80, strength());
    TEST_ASSERT_EQUAL(SENSOR_MISSING, answer);
    take(4);
    TEST_ASSERT_EQUAL(400, dist_cm());
    TEST_ASSERT_EQUAL(200, strength());

    settings.faults[0].share = 0.1;
    settings.faults[0].dist_m = 0.8;
    begin(1);
    for (int i = 0; i < 10000; i++) {
        take(4);
        near += dist_cm() <= 80;
        TEST_ASSERT_TRUE(dist_cm() == 400 || (dist_cm() >= 20 && dist_cm() <= 80));
        TEST_ASSERT_TRUE(strength() >= TFLUNA_WEAK);
    }
    TEST_ASSERT_INT_WITHIN(100, 1000, near);
}

static void test_that_a_share_of_the_frames_has_a_wrong_sum(void)
{
    int wrong = 0;

    fault(0, FAULT_SUM, 0)->share = 0.25;
    begin(1);
    for (int i = 0; i < 10000; i++) {
        TEST_ASSERT_EQUAL(TFLUNA_FRAME, take(4));
        wrong += !sum_is_right();
        TEST_ASSERT_EQUAL(sum_is_right() ? SENSOR_TARGET : SENSOR_MISSING, answer);
    }
    TEST_ASSERT_INT_WITHIN(150, 2500, wrong);
}

static void test_that_a_torn_frame_lacks_any_of_its_bytes(void)
{
    static const uint8_t whole[] = {0x59, 0x59, 0x2C, 0x01, 0xB7, 0x05, 0xC8, 0x08, 0x6B};
    unsigned lost = 0;

    fault(0, FAULT_TORN, 0);
    begin(1);
    for (int i = 0; i < 200; i++) {
        size_t at = 0;

        TEST_ASSERT_EQUAL(TFLUNA_FRAME - 1, take(3));
        while (at < TFLUNA_FRAME - 1 && frame[at] == whole[at]) {
            at++;
        }
        TEST_ASSERT_EQUAL(0, memcmp(whole + at + 1, frame + at, TFLUNA_FRAME - 1 - at));
        lost |= 1u << at;
    }
    TEST_ASSERT_EQUAL_HEX(0x1FC, lost & 0x1FC); /* the second 59 shows as the third byte's place */
}

static void test_that_a_fault_leaves_the_later_noise_alone(void)
{
    static const enum fault_kind kinds[] = {FAULT_OFF,  FAULT_STUCK, FAULT_GARBAGE, FAULT_BLIND,
                                            FAULT_RAIN, FAULT_SUM,   FAULT_TORN};
    int healthy_cm;

    settings.sensor.noise_m = 0.05;
    begin(7);
    for (int i = 0; i < 20; i++) {
        take(3);
    }
    healthy_cm = dist_cm();
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        fault(0, kinds[k], 0)->for_s = 0.1;
        settings.faults[0].share = 0.5;
        begin(7);
        for (int i = 0; i < 20; i++) {
            take(3);
        }
        TEST_ASSERT_EQUAL(healthy_cm, dist_cm());
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_frame_has_its_nine_bytes);
    RUN_TEST(test_that_the_strength_joins_the_tables_of_the_manual);
    RUN_TEST(test_that_a_white_car_is_seen_up_to_8_m);
    RUN_TEST(test_that_a_black_car_is_seen_from_4_3_m_on);
    RUN_TEST(test_that_the_distance_is_the_mean_of_one_period);
    RUN_TEST(test_that_frames_come_at_the_rate);
    RUN_TEST(test_that_noise_follows_the_strength);
    RUN_TEST(test_that_the_distance_grows_again_in_the_dead_zone);
    RUN_TEST(test_that_dropouts_come_as_often_as_asked_for);
    RUN_TEST(test_that_a_sensor_that_is_off_sends_nothing_and_keeps_its_pace);
    RUN_TEST(test_that_a_stuck_sensor_repeats_its_last_distance);
    RUN_TEST(test_that_sunlight_sends_the_strength_65535);
    RUN_TEST(test_that_rain_takes_strength_and_adds_near_echoes);
    RUN_TEST(test_that_a_share_of_the_frames_has_a_wrong_sum);
    RUN_TEST(test_that_a_torn_frame_lacks_any_of_its_bytes);
    RUN_TEST(test_that_a_fault_leaves_the_later_noise_alone);
    return UNITY_END();
}
