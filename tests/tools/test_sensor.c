/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/sensor.c by itself, and in sonar.c and tfluna.c what test_sonar.c
 * and test_tfluna.c leave out: the edges of times, the numbers of chance, each place of a fault. */
#include "sensor_settings.h"
#include "sonar.h"
#include "tfluna.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static const int64_t us = 1000, ms = 1000000;
static struct sensing sensing;
static struct sonar sonar;
static struct tfluna tfluna;
static enum sensor_answer answer;

void tearDown(void)
{
    sensing_free(&sensing);
    sensing_free(&sonar.sensing);
    sensing_free(&tfluna.sensing);
}

void setUp(void)
{
    tearDown(); /* also between parts of a case */
    default_settings();
    memset(&sensing, 0, sizeof sensing);
    memset(&sonar, 0, sizeof sonar);
    memset(&tfluna, 0, sizeof tfluna);
}

/* Sees all, and has a noise of 1 m. */
static struct sight look(const struct sensing *of, double gap_m)
{
    (void)of;
    return (struct sight){!isinf(gap_m), gap_m, 1};
}

static void begin(void)
{
    sensing_free(&sensing);
    sensing_init(&sensing, &settings, look, 100, 7);
}

/* The noise of the next reading: its third number. */
static double next_noise_m(void)
{
    struct random same = sensing.random;

    random_uniform(&same);
    random_uniform(&same);
    return random_normal(&same);
}

/* The reading of a sensor without noise; INFINITY: no target, -1: nothing. */
static double read_m(int64_t t_ns, double gap_m)
{
    struct reading reading = sensing_read(&sensing, t_ns, gap_m - next_noise_m());

    sensing_note(&sensing, &reading);
    return reading.kind == READ_TARGET ? reading.dist_m : reading.kind == READ_NONE ? INFINITY : -1;
}

#define READS(expected, t_ns, gap_m) TEST_ASSERT_DOUBLE_WITHIN(1e-9, expected, read_m(t_ns, gap_m))

/* --- chance ------------------------------------------------------------------------------- */

static void test_that_a_reading_takes_three_numbers_for_garbage_dropout_and_noise(void)
{
    struct random same;
    double garbage, expected_m;

    fault(0, FAULT_GARBAGE, 0.5)->offset_m = 5; /* no matter: it is not FAULT_WRONG */
    begin();
    random_seed(&same, 7);
    for (int i = 0; i < 3; i++) {
        random_uniform(&same);
        random_uniform(&same);
        expected_m = 50 + random_normal(&same);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, expected_m, sensing_read(&sensing, i * ms, 50).dist_m);
    }
    garbage = random_uniform(&same);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100 * garbage, sensing_read(&sensing, 500 * ms, 50).dist_m);
}

static void test_that_rain_has_the_seed_with_a_word_of_its_own(void)
{
    struct random rain;
    bool is_drop;
    double drop_m;

    random_seed(&rain, 7 ^ 0x5241494Eu); /* RAIN */
    fault(0, FAULT_RAIN, 0)->share = 0.5;
    settings.sensor.min_m = 0;
    begin();
    for (int i = 0; i < 50; i++) {
        is_drop = random_uniform(&rain) < 0.5;
        drop_m = random_uniform(&rain); /* up to 1 m */
        READS(is_drop ? drop_m : 50, i * ms, 50);
    }
}

static void test_that_garbage_goes_as_far_as_the_sensor_can_say(void)
{
    for (uint64_t seed = 1; seed < 20; seed++) {
        struct random same;
        double garbage;
        int64_t at_ns, rise_ns = 0;
        bool level = false;
        uint8_t frame[TFLUNA_FRAME];

        random_seed(&same, seed);
        garbage = random_uniform(&same);
        fault(0, FAULT_GARBAGE, 0);
        sonar_init(&sonar, &settings, seed);
        TEST_ASSERT_EQUAL(SENSOR_TARGET, sonar_trigger(&sonar, 0, 10 * us, 2, 0));
        while (sonar_next_event(&sonar, INT64_MAX, &at_ns, &level)) {
            rise_ns = level ? at_ns : rise_ns;
        }
        TEST_ASSERT_DOUBLE_WITHIN(2, garbage * 38e6, (double)(at_ns - rise_ns));
        tfluna_init(&tfluna, &settings, seed);
        tfluna_take(&tfluna, 2, 0, frame, &answer);
        TEST_ASSERT_EQUAL(SENSOR_TARGET, answer);
        TEST_ASSERT_EQUAL(lround(garbage * 900), frame[2] + 256 * frame[3]);
    }
}

static void test_that_a_lidars_frames_begin_at_the_start_up_and_a_part_of_the_period(void)
{
    struct random chance;

    random_seed(&chance, 7 ^ 0x4C554E41u); /* LUNA */
    settings.sensor.kind = SENSOR_TFLUNA;
    settings.sensor.start_up_s = 0.3;
    memset(&tfluna, 0x55, sizeof tfluna);
    tfluna_init(&tfluna, &settings, 7);
    TEST_ASSERT_EQUAL_INT64(llround(300e6 + random_uniform(&chance) * 10e6), tfluna.due_ns);
    TEST_ASSERT_EQUAL_INT64(0, tfluna.sent_ns); /* none was */
}

/* --- faults in time ------------------------------------------------------------------------ */

static void test_that_a_fault_has_its_time(void)
{
    struct fault *one = &sensing.faults[1];

    *one = (struct fault){.kind = FAULT_STUCK, .from_s = 0.5, .for_s = 0.25};
    TEST_ASSERT_FALSE(sensing_fault_acts(&sensing, 1, 0.4999));
    TEST_ASSERT_TRUE(sensing_fault_acts(&sensing, 1, 0.5));
    TEST_ASSERT_TRUE(sensing_fault_acts(&sensing, 1, 0.7499));
    TEST_ASSERT_FALSE(sensing_fault_acts(&sensing, 1, 0.75));
    one->for_s = SCENARIO_UNSET;
    TEST_ASSERT_TRUE(sensing_fault_acts(&sensing, 1, 1e6));
    TEST_ASSERT_FALSE(sensing_fault_acts(&sensing, 0, 1e6));
    one->kind = -1;
    TEST_ASSERT_FALSE(sensing_fault_acts(&sensing, 1, 0.6));
    *one = (struct fault){.kind = FAULT_GLITCH, .from_s = 0.5, .for_s = 0.25};
    TEST_ASSERT_TRUE(sensing_fault_acts(&sensing, 1, 1e6)); /* it ends by its readings */
}

static void test_that_each_place_of_a_fault_counts(void)
{
    double noise_m;
    bool level;

    for (int which = 0; which < SENSOR_FAULTS; which++) {
        setUp();
        fault(which, FAULT_OFF, 1);
        begin();
        TEST_ASSERT_FALSE(sensing_is_silenced(&sensing, 0.999, &level));
        TEST_ASSERT_TRUE(sensing_is_silenced(&sensing, 1, &level));
        TEST_ASSERT_EQUAL_INT64(1000 * ms, sensing_boundary_ns(&sensing, 0));
        fault(which, FAULT_STUCK, 0)->dist_m = 1.5;
        begin();
        READS(1.5, 0, 3);
        fault(which, FAULT_GLITCH, 0)->readings = 2;
        begin();
        READS(1.5, 0, 3);
        READS(1.5, ms, 3);
        READS(3, 2 * ms, 3);
        fault(which, FAULT_DELAYED, 0)->delay_s = 0.5;
        begin();
        sensing_observe(&sensing, 0, 8);
        noise_m = next_noise_m();
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8 + noise_m, sensing_read(&sensing, ms, 3).dist_m);
    }
}

static void test_that_a_silent_line_rests_low_or_high(void)
{
    bool level;

    fault(0, FAULT_OFF, 0);
    begin();
    TEST_ASSERT_TRUE(sensing_is_silenced(&sensing, 0, &level));
    TEST_ASSERT_FALSE(level);
    fault(1, FAULT_HIGH, 1);
    begin();
    TEST_ASSERT_TRUE(sensing_is_silenced(&sensing, 0.5, &level));
    TEST_ASSERT_FALSE(level);
    TEST_ASSERT_TRUE(sensing_is_silenced(&sensing, 1, &level));
    TEST_ASSERT_TRUE(level);
    settings.faults[1].kind = -1;
    settings.faults[0].line = 1;
    begin();
    TEST_ASSERT_TRUE(sensing_is_silenced(&sensing, 0, &level));
    TEST_ASSERT_TRUE(level);
    settings.faults[0].kind = -1;
    begin();
    TEST_ASSERT_FALSE(sensing_is_silenced(&sensing, 0, &level));
    TEST_ASSERT_FALSE(level);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, sensing_boundary_ns(&sensing, -1));
}

static void test_that_an_intermittent_fault_begins_with_its_off_time(void)
{
    bool level;

    fault(0, FAULT_INTERMITTENT, 1.1)->off_s = 0.3;
    settings.faults[0].on_s = 0.4;
    begin();
    TEST_ASSERT_FALSE(sensing_is_silenced(&sensing, 1.099, &level));
    TEST_ASSERT_TRUE(sensing_is_silenced(&sensing, 1.101, &level));
    TEST_ASSERT_TRUE(sensing_is_silenced(&sensing, 1.399, &level));
    TEST_ASSERT_FALSE(sensing_is_silenced(&sensing, 1.401, &level));
    TEST_ASSERT_FALSE(sensing_is_silenced(&sensing, 1.799, &level));
    TEST_ASSERT_TRUE(sensing_is_silenced(&sensing, 1.801, &level));
    TEST_ASSERT_EQUAL_INT64(1100 * ms, sensing_boundary_ns(&sensing, 1 * ms));
    TEST_ASSERT_EQUAL_INT64(1400 * ms, sensing_boundary_ns(&sensing, 1100 * ms));
    TEST_ASSERT_EQUAL_INT64(1800 * ms, sensing_boundary_ns(&sensing, 1400 * ms));
    TEST_ASSERT_EQUAL_INT64(1800 * ms, sensing_boundary_ns(&sensing, 1799 * ms));
    settings.faults[0].for_s = 0.5;
    begin();
    TEST_ASSERT_EQUAL_INT64(1600 * ms, sensing_boundary_ns(&sensing, 1400 * ms));
    fault(0, FAULT_STUCK, 1)->for_s = 2; /* of that kind on_s and off_s say nothing */
    begin();
    TEST_ASSERT_EQUAL_INT64(3000 * ms, sensing_boundary_ns(&sensing, 1000 * ms));
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, sensing_boundary_ns(&sensing, 3000 * ms));
}

/* --- readings ----------------------------------------------------------------------------- */

static void test_that_a_stuck_sensor_repeats_what_it_said_first_or_last_or_is_told(void)
{
    fault(0, FAULT_STUCK, 0);
    begin();
    READS(2, 0, 2);
    READS(2, ms, 3);
    settings.faults[0].from_s = 0.5;
    begin();
    READS(4, 0, 4);
    READS(4, 500 * ms, 3);
    settings.faults[0].dist_m = 1.5;
    begin();
    READS(4, 0, 4);
    READS(1.5, 500 * ms, 3);
}

static void test_that_a_slow_sensor_answers_after_its_period(void)
{
    fault(0, FAULT_SLOW, 0)->period_s = 0.15;
    begin();
    READS(2, 10 * ms, 2);
    READS(-1, 159 * ms, 2);
    READS(2, 160 * ms, 2);
    READS(-1, 309 * ms, 2);
    READS(2, 310 * ms, 2);
}

static void test_that_a_wrong_sensor_is_neither_slow_nor_old(void)
{
    fault(0, FAULT_WRONG, 0)->scale = 1;
    settings.faults[0].offset_m = 0.5;
    settings.faults[0].period_s = settings.faults[0].delay_s = 1;
    fault(1, FAULT_DELAYED, 10)->delay_s = 1;
    begin();
    sensing_observe(&sensing, 0, 8);
    READS(2 + 0.5, 500 * ms, 2);
    READS(3 + 0.5, 600 * ms, 3);
}

/* The gap as it was: of the first one before there was any, in between on a straight line, but not
 * from or to nothing. */
static void test_that_an_old_reading_is_of_the_past(void)
{
    static const double gaps_m[] = {9, 5, 6, INFINITY, 3, 4};

    fault(0, FAULT_DELAYED, 0)->delay_s = 1;
    begin();
    TEST_ASSERT_EQUAL(READ_NONE, sensing_read(&sensing, 1000 * ms, 2).kind);
    for (int i = 0; i < 6; i++) {
        sensing_observe(&sensing, (i + 1) * 100 * ms, gaps_m[i]);
    }
    static const struct {
        int64_t t_ms;
        double gap_m;
    } past[] = {{1050, 9},   {1100, 9}, {1125, 8},        {1200, 5},        {1250, 5.5},
                {1300, 6},   {1350, 6}, {1400, INFINITY}, {1450, INFINITY}, {1500, 3},
                {1550, 3.5}, {1600, 4}, {1700, 4}};

    for (size_t i = 0; i < sizeof past / sizeof past[0]; i++) {
        double noise_m = next_noise_m();
        struct reading reading = sensing_read(&sensing, past[i].t_ms * ms, 2);

        if (isinf(past[i].gap_m)) {
            TEST_ASSERT_EQUAL(READ_NONE, reading.kind);
        } else {
            TEST_ASSERT_EQUAL(READ_TARGET, reading.kind);
            TEST_ASSERT_DOUBLE_WITHIN(1e-6, past[i].gap_m + noise_m, reading.dist_m);
        }
    }
    sensing_free(&sensing);
    TEST_ASSERT_NULL(sensing.past);
    sensing_observe(&sensing, 0, 7);
    TEST_ASSERT_EQUAL(1, sensing.past_count);
}

/* --- the echo line ------------------------------------------------------------------------ */

static void expect_event(int64_t t_ns, bool level)
{
    int64_t at_ns = -1;
    bool is_high = !level;

    TEST_ASSERT_FALSE(sonar_next_event(&sonar, t_ns - 1, &at_ns, &is_high));
    TEST_ASSERT_TRUE(sonar_next_event(&sonar, t_ns, &at_ns, &is_high));
    TEST_ASSERT_EQUAL_INT64(t_ns, at_ns);
    TEST_ASSERT_EQUAL(level, is_high);
}

static void test_that_a_line_that_was_left_high_falls_50_us_before_the_next_echo(void)
{
    settings.sensor.no_target = NO_TARGET_HIGH;
    sonar_init(&sonar, &settings, 7);
    TEST_ASSERT_EQUAL(SENSOR_NONE, sonar_trigger(&sonar, 0, 10 * us, INFINITY, 0));
    expect_event(450 * us, true);
    TEST_ASSERT_EQUAL(SENSOR_DEAF, sonar_trigger(&sonar, 449 * us, 10 * us, INFINITY, 0));
    TEST_ASSERT_EQUAL(SENSOR_NONE, sonar_trigger(&sonar, 20 * ms, 10 * us, INFINITY, 0));
    TEST_ASSERT_EQUAL(SENSOR_TARGET, sonar_trigger(&sonar, 60 * ms, 10 * us, 1.716, 0));
    expect_event(60 * ms + 450 * us, false);
    expect_event(60 * ms + 500 * us, true);
    expect_event(70 * ms + 500 * us, false);
    TEST_ASSERT_EQUAL(SENSOR_DEAF, sonar_trigger(&sonar, 70 * ms, 10 * us, 1.716, 0));
}

static void test_that_a_silent_answer_does_not_keep_the_sensor_busy(void)
{
    settings.sensor.no_target = NO_TARGET_SILENT;
    sonar_init(&sonar, &settings, 7);
    TEST_ASSERT_EQUAL(SENSOR_TARGET, sonar_trigger(&sonar, 0, 10 * us, 1.716, 0));
    expect_event(450 * us, true);
    expect_event(450 * us + 10 * ms, false);
    TEST_ASSERT_EQUAL(SENSOR_NONE, sonar_trigger(&sonar, 20 * ms, 10 * us, INFINITY, 0));
    TEST_ASSERT_EQUAL_INT64(20 * ms + 450 * us, sonar_horizon_ns(&sonar, 0));
}

static void test_that_a_boundary_leaves_an_echo_on_its_way_alone(void)
{
    fault(0, FAULT_HIGH, 0.1)->for_s = 0.1;
    fault(1, FAULT_STUCK, 0.005);
    sonar_init(&sonar, &settings, 7);
    sonar_trigger(&sonar, 0, 10 * us, 1.716, 0);
    sonar_pass_boundary(&sonar, 5 * ms); /* of the other fault */
    expect_event(450 * us, true);
    expect_event(450 * us + 10 * ms, false);
    sonar_trigger(&sonar, 99500 * us, 10 * us, 1.716, 0);
    expect_event(99950 * us, true);
    sonar_pass_boundary(&sonar, 100 * ms); /* it is high already, and stays so */
    TEST_ASSERT_EQUAL(0, sonar.event_count);
    sonar_pass_boundary(&sonar, 200 * ms);
    expect_event(200 * ms, false);
    TEST_ASSERT_EQUAL(SENSOR_TARGET, sonar_trigger(&sonar, 201 * ms, 10 * us, 2, 0));
}

static void test_that_a_short_fault_holds_the_line_and_ends_the_echo(void)
{
    fault(0, FAULT_HIGH, 1)->for_s = 0.005;
    fault(1, FAULT_OFF, 0.005)->for_s = 0.001;
    sonar_init(&sonar, &settings, 7);
    sonar_trigger(&sonar, 0, 10 * us, 1.716, 0);
    expect_event(450 * us, true);
    sonar_pass_boundary(&sonar, 5 * ms);
    expect_event(5 * ms, false);
    TEST_ASSERT_EQUAL(SENSOR_TARGET, sonar_trigger(&sonar, 8 * ms, 10 * us, 0.1, 0));
    expect_event(8 * ms + 450 * us, true);
    sonar_next_event(&sonar, INT64_MAX, &(int64_t){0}, &(bool){false});
    sonar_pass_boundary(&sonar, 1000 * ms);
    expect_event(1000 * ms, true);
}

static void test_that_a_trigger_is_heard_until_the_fault_begins(void)
{
    fault(0, FAULT_OFF, 1);
    sonar_init(&sonar, &settings, 7);
    TEST_ASSERT_EQUAL(SENSOR_TARGET, sonar_trigger(&sonar, 999 * ms, 10 * us, 0.1, 0));
    sonar_init(&sonar, &settings, 7);
    TEST_ASSERT_EQUAL(SENSOR_MISSING, sonar_trigger(&sonar, 1000 * ms, 10 * us, 0.1, 0));
    sonar_init(&sonar, &settings, 7);
    TEST_ASSERT_EQUAL(SENSOR_TARGET, sonar_trigger(&sonar, 900 * ms, 10 * us, 2, 0));
    sonar_pass_boundary(&sonar, 1000 * ms);
    TEST_ASSERT_TRUE(sonar.busy_ns >= 900 * ms);
}

/* --- the lidar ---------------------------------------------------------------------------- */

/* The frame, with other bytes before and behind it. */
static uint8_t place[4 * TFLUNA_FRAME], *const sent = place + TFLUNA_FRAME;

static void begin_lidar(void)
{
    settings.sensor.kind = SENSOR_TFLUNA;
    settings.sensor.noise_m = 0;
    tfluna_init(&tfluna, &settings, 7);
    tfluna.due_ns = 0;
    for (size_t i = 0; i < sizeof place; i++) {
        place[i] = (uint8_t)(7 * i + 1);
    }
}

static size_t take(double gap_m, double closing_mps)
{
    return tfluna_take(&tfluna, gap_m, closing_mps, sent, &answer);
}

static int dist_cm(void)
{
    return sent[2] + 256 * sent[3];
}

static int strength(void)
{
    return sent[4] + 256 * sent[5];
}

static void test_that_the_strength_has_its_limits(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(65534, tfluna_strength(&settings.sensor, 0.001));
    settings.sensor.reflectivity_pct = 1e-3;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1000 * pow(0.0025, -log2(2.5)) * 1e-3 / 90,
                              tfluna_strength(&settings.sensor, 0.005)); /* as at 1 cm */
    settings.sensor.reflectivity_pct = 90;
    begin_lidar();
    TEST_ASSERT_TRUE(tfluna_is_seen(&tfluna, 8));
    TEST_ASSERT_FALSE(tfluna_is_seen(&tfluna, 8.001));
    settings.sensor.reflectivity_pct = 9.001; /* 100 at 4 m */
    begin_lidar();
    TEST_ASSERT_TRUE(tfluna_is_seen(&tfluna, 4));
    TEST_ASSERT_FALSE(tfluna_is_seen(&tfluna, 4.001));
}

static void test_that_numbers_stay_within_their_16_bits(void)
{
    settings.sensor.max_m = 1e6;
    settings.sensor.reflectivity_pct = 1e9;
    begin_lidar();
    take(655.36, 0);
    TEST_ASSERT_EQUAL(65535, dist_cm());
    TEST_ASSERT_EQUAL(65534, strength());
    settings.sensor.dropout = 1; /* no target, however strong */
    begin_lidar();
    take(1, 0);
    TEST_ASSERT_EQUAL(0, dist_cm());
    TEST_ASSERT_EQUAL(99, strength());
}

static void test_that_near_and_fast_targets_show_the_geometry(void)
{
    settings.sensor.min_m = 2;
    begin_lidar();
    take(1, 0);
    TEST_ASSERT_EQUAL(300, dist_cm());
    take(2, 1000); /* 5 ms before it was 5 m farther */
    TEST_ASSERT_EQUAL(700, dist_cm());
}

static void test_that_a_lidars_fault_has_its_time_and_place(void)
{
    for (int which = 0; which < SENSOR_FAULTS; which++) {
        setUp();
        fault(which, FAULT_BLIND, 1)->for_s = 1;
        settings.faults[which].share = 0; /* the sun blinds each reading */
        begin_lidar();
        for (int i = 0; i < 250; i++) {
            take(2, 0);
            TEST_ASSERT_EQUAL(i >= 100 && i < 200, strength() == TFLUNA_BLINDED);
        }
        fault(which, FAULT_RAIN, 1)->scale = 0.5;
        settings.faults[which].share = 0;
        begin_lidar();
        for (int i = 0; i < 250; i++) {
            take(4, 0);
            TEST_ASSERT_EQUAL(i >= 100 && i < 200 ? 500 : 1000, strength());
        }
        fault(which, FAULT_WRONG, 0)->scale = 2; /* of the distance, not of the strength */
        begin_lidar();
        take(4, 0);
        TEST_ASSERT_EQUAL(1000, strength());
        fault(which, FAULT_SLOW, 0)->period_s = 0.025;
        settings.faults[which].for_s = 9;
        begin_lidar();
        for (int i = 0; i < 9; i++) {
            TEST_ASSERT_EQUAL(i % 3 == 0 ? TFLUNA_FRAME : 0, take(4, 0));
        }
    }
}

static void test_that_the_sum_is_of_the_frames_own_bytes(void)
{
    uint8_t sum = 0;

    begin_lidar();
    take(3, 0);
    for (int i = 0; i < TFLUNA_FRAME - 1; i++) {
        sum = (uint8_t)(sum + sent[i]);
    }
    TEST_ASSERT_EQUAL(sum, sent[TFLUNA_FRAME - 1]);
}

static void test_that_a_torn_frame_writes_no_byte_behind_it(void)
{
    fault(0, FAULT_TORN, 0);
    begin_lidar();
    for (int i = 0; i < 200; i++) {
        take(3, 0);
        for (size_t at = 2 * TFLUNA_FRAME; at < sizeof place; at++) {
            TEST_ASSERT_EQUAL((uint8_t)(7 * at + 1), place[at]);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_reading_takes_three_numbers_for_garbage_dropout_and_noise);
    RUN_TEST(test_that_rain_has_the_seed_with_a_word_of_its_own);
    RUN_TEST(test_that_garbage_goes_as_far_as_the_sensor_can_say);
    RUN_TEST(test_that_a_lidars_frames_begin_at_the_start_up_and_a_part_of_the_period);
    RUN_TEST(test_that_a_fault_has_its_time);
    RUN_TEST(test_that_each_place_of_a_fault_counts);
    RUN_TEST(test_that_a_silent_line_rests_low_or_high);
    RUN_TEST(test_that_an_intermittent_fault_begins_with_its_off_time);
    RUN_TEST(test_that_a_stuck_sensor_repeats_what_it_said_first_or_last_or_is_told);
    RUN_TEST(test_that_a_slow_sensor_answers_after_its_period);
    RUN_TEST(test_that_a_wrong_sensor_is_neither_slow_nor_old);
    RUN_TEST(test_that_an_old_reading_is_of_the_past);
    RUN_TEST(test_that_a_line_that_was_left_high_falls_50_us_before_the_next_echo);
    RUN_TEST(test_that_a_silent_answer_does_not_keep_the_sensor_busy);
    RUN_TEST(test_that_a_boundary_leaves_an_echo_on_its_way_alone);
    RUN_TEST(test_that_a_short_fault_holds_the_line_and_ends_the_echo);
    RUN_TEST(test_that_a_trigger_is_heard_until_the_fault_begins);
    RUN_TEST(test_that_the_strength_has_its_limits);
    RUN_TEST(test_that_numbers_stay_within_their_16_bits);
    RUN_TEST(test_that_near_and_fast_targets_show_the_geometry);
    RUN_TEST(test_that_a_lidars_fault_has_its_time_and_place);
    RUN_TEST(test_that_the_sum_is_of_the_frames_own_bytes);
    RUN_TEST(test_that_a_torn_frame_writes_no_byte_behind_it);
    return UNITY_END();
}
