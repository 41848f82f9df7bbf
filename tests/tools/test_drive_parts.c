/* SPDX-License-Identifier: MIT */
/* Under test: what drive reads off the controller and judges by: pwm.c, telemetry.c, expect.c,
 * hexfile.c, board.c, and the grid of s51.c. */
#include "board.h"
#include "expect.h"
#include "common/hexfile.h"
#include "pwm.h"
#include "sim.h"
#include "telemetry.h"

#include "common/diag.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

static const int64_t us = 1000, ms = 1000000;
static const char path[] = "build/tests/test_drive_parts.ihx";
static struct pwm pwm;
static struct telemetry telemetry;
static struct outcome outcome;

void setUp(void)
{
    pwm_init(&pwm, 0, false);
    telemetry_init(&telemetry);
    memset(&outcome, 0, sizeof outcome);
    outcome.uart = "";
}

void tearDown(void)
{
    telemetry_free(&telemetry);
    unlink(path);
}

/* --- pwm ---------------------------------------------------------------------------------- */

static void test_that_the_duty_is_read_from_rise_to_rise(void)
{
    for (int duty = 1; duty < 100; duty++) {
        pwm_init(&pwm, 0, false);
        pwm_edge(&pwm, 1 * ms, true);
        pwm_edge(&pwm, 1 * ms + duty * 100 * us, false);
        TEST_ASSERT_EQUAL_DOUBLE(0, pwm.duty_pct); /* no whole period yet */
        TEST_ASSERT_TRUE(pwm_edge(&pwm, 11 * ms, true));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, duty, pwm.duty_pct);
    }
}

static void test_that_a_pin_without_edges_is_steady_after_one_and_a_half_periods(void)
{
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, pwm_steady_ns(&pwm)); /* it is already */
    pwm_edge(&pwm, 1 * ms, true);
    TEST_ASSERT_EQUAL_INT64(16 * ms, pwm_steady_ns(&pwm));
    TEST_ASSERT_TRUE(pwm_settle(&pwm));
    TEST_ASSERT_EQUAL_DOUBLE(100, pwm.duty_pct);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, pwm_steady_ns(&pwm));
    pwm_edge(&pwm, 40 * ms, false);
    TEST_ASSERT_TRUE(pwm_settle(&pwm));
    TEST_ASSERT_EQUAL_DOUBLE(0, pwm.duty_pct);
}

/* --- telemetry ---------------------------------------------------------------------------- */

static int lines;

static void count_line(void *user, const struct telemetry *seen)
{
    (void)user;
    (void)seen;
    lines++;
}

static void say(const char *text, int64_t t_ns)
{
    telemetry_take(&telemetry, t_ns, t_ns, text, strlen(text), count_line, NULL);
}

static void test_that_columns_are_found_by_their_names(void)
{
    lines = 0;
    say("# fuzzy51 1.0 brake\r\nseq,ms,dist_mm,state\r\n", 1);
    TEST_ASSERT_EQUAL_STRING("", telemetry_value(&telemetry, "state"));
    say("7,60", 20);
    say("0,1234,CONT", 30);
    say("ROL\r\n", 40);
    TEST_ASSERT_EQUAL(1, lines);
    TEST_ASSERT_EQUAL_STRING("CONTROL", telemetry_value(&telemetry, "state"));
    TEST_ASSERT_EQUAL_STRING("1234", telemetry_value(&telemetry, "dist_mm"));
    TEST_ASSERT_EQUAL_STRING("", telemetry_value(&telemetry, "nothing"));
    TEST_ASSERT_EQUAL_INT64(20, telemetry.line_ns); /* when it began */
}

static void test_that_other_lines_are_kept_but_not_read(void)
{
    lines = 0;
    say("seq,state\r\n8,A\r\n9\r\nx,B\r\n# 9,C\r\n9,D,E\r\n", 1);
    TEST_ASSERT_EQUAL(1, lines);
    TEST_ASSERT_EQUAL_STRING("A", telemetry_value(&telemetry, "state"));
    TEST_ASSERT_NOT_NULL(strstr(telemetry.log, "9,D,E"));
}

static void test_that_endless_lines_and_zeros_do_no_harm(void)
{
    char noise[1000];

    memset(noise, 'x', sizeof noise);
    noise[500] = '\0';
    for (int i = 0; i < 20; i++) {
        telemetry_take(&telemetry, i, i, noise, sizeof noise, NULL, NULL);
    }
    say("\nseq,state\n1,B\n", 30);
    TEST_ASSERT_EQUAL_STRING("B", telemetry_value(&telemetry, "state"));
    TEST_ASSERT_EQUAL(20000 + 15, telemetry.length);
}

/* --- expect ------------------------------------------------------------------------------- */

static bool holds(enum metric metric, char op, const char *text, double limit)
{
    struct expectation expectation = {.metric = metric, .op = op, .limit = limit};

    strcpy(expectation.text, text);
    return expect_holds(&expectation, &outcome);
}

static void test_that_numbers_are_compared_at_their_limits(void)
{
    outcome.values[METRIC_MIN_GAP] = 0.5;
    TEST_ASSERT_TRUE(holds(METRIC_MIN_GAP, '>', "0.5", 0.5));
    TEST_ASSERT_FALSE(holds(METRIC_MIN_GAP, '>', "0.51", 0.51));
    TEST_ASSERT_TRUE(holds(METRIC_MIN_GAP, '<', "0.5", 0.5));
    TEST_ASSERT_FALSE(holds(METRIC_MIN_GAP, '<', "0.49", 0.49));
    outcome.values[METRIC_STOP_TOGGLES] = 2;
    TEST_ASSERT_TRUE(holds(METRIC_STOP_TOGGLES, '=', "2", 2));
    TEST_ASSERT_FALSE(holds(METRIC_STOP_TOGGLES, '=', "1", 1));
}

static void test_that_what_never_came_holds_no_upper_limit(void)
{
    outcome.values[METRIC_STOP_WITHIN] = INFINITY;
    TEST_ASSERT_FALSE(holds(METRIC_STOP_WITHIN, '<', "1e9", 1e9));
    outcome.values[METRIC_RMS_ACCEL] = NAN;
    TEST_ASSERT_FALSE(holds(METRIC_RMS_ACCEL, '<', "1", 1));
    TEST_ASSERT_FALSE(holds(METRIC_RMS_ACCEL, '>', "1", 1));
}

static void test_that_an_impact_is_judged(void)
{
    TEST_ASSERT_TRUE(holds(METRIC_IMPACT, '=', "none", 0));
    outcome.values[METRIC_IMPACT] = 1; /* even at no closing speed */
    TEST_ASSERT_FALSE(holds(METRIC_IMPACT, '=', "none", 0));
    TEST_ASSERT_TRUE(holds(METRIC_IMPACT, '=', "any", 0));
}

static void test_that_states_are_whole_words(void)
{
    strcpy(outcome.states, "RELEASED CONTROL ");
    strcpy(outcome.final_state, "CONTROL");
    TEST_ASSERT_TRUE(holds(METRIC_REACHED, '=', "CONTROL, RELEASED", 0));
    TEST_ASSERT_FALSE(holds(METRIC_REACHED, '=', "CONTROL, STOP", 0));
    TEST_ASSERT_FALSE(holds(METRIC_REACHED, '=', "CONT", 0));
    TEST_ASSERT_TRUE(holds(METRIC_NEVER, '=', "STOP, FAULT", 0));
    TEST_ASSERT_FALSE(holds(METRIC_NEVER, '=', "STOP,RELEASED", 0));
    TEST_ASSERT_TRUE(holds(METRIC_FINAL_STATE, '=', "CONTROL", 0));
    TEST_ASSERT_FALSE(holds(METRIC_FINAL_STATE, '=', "STOP", 0));
    outcome.uart = "# reset=watchdog";
    TEST_ASSERT_TRUE(holds(METRIC_UART_SAYS, '=', "reset=watchdog", 0));
    TEST_ASSERT_FALSE(holds(METRIC_UART_SAYS, '=', "reset=power-on", 0));
}

static void test_that_every_metric_has_its_own_name(void)
{
    for (enum metric metric = 0; metric < METRIC_COUNT; metric++) {
        TEST_ASSERT_EQUAL(metric, expect_find(expect_name(metric)));
    }
    TEST_ASSERT_EQUAL(METRIC_COUNT, expect_find("gap"));
}

/* --- image, board, grid ------------------------------------------------------------------- */

static int read_hex(const char *text)
{
    static struct hexfile hex;
    FILE *file = fopen(path, "w");

    fputs(text, file);
    fclose(file);
    return hexfile_read(&hex, path);
}

static void test_that_a_broken_image_is_refused(void)
{
    TEST_ASSERT_EQUAL(EXIT_FINE, read_hex(":0400000002002132A7\n:00000001FF\n"));
    TEST_ASSERT_EQUAL(EXIT_USAGE, read_hex(":0400000002002132A8\n:00000001FF\n")); /* check sum */
    TEST_ASSERT_EQUAL(EXIT_USAGE, read_hex(":0400000002002132A7\n"));              /* no end */
    TEST_ASSERT_EQUAL(EXIT_USAGE, read_hex(":00000001FF\n"));                      /* empty */
    TEST_ASSERT_EQUAL(EXIT_USAGE, read_hex(":0500000002002132A7\n:00000001FF\n")); /* count */
    TEST_ASSERT_EQUAL(EXIT_USAGE, read_hex("\177ELF\n"));
    TEST_ASSERT_EQUAL(EXIT_USAGE, read_hex(":020000040001F9\n:00000001FF\n")); /* beyond 64 KB */
    TEST_ASSERT_EQUAL(EXIT_USAGE, read_hex(":04FFFE0002002132AA\n:00000001FF\n"));
}

static void test_that_boards_are_known_by_name(void)
{
    TEST_ASSERT_NOT_NULL(board_find("stc89c516rd"));
    TEST_ASSERT_EQUAL(0xB2, board_find("at89s52")->pins[PIN_ECHO]);
    TEST_ASSERT_NULL(board_find("stc89c516r"));
    TEST_ASSERT_NOT_NULL(strstr(board_names(), "generic8052"));
}

static void test_that_sync_times_lie_between_machine_cycles(void)
{
    static const long clocks[] = {12000000, 11059200, 24000000};

    for (int i = 0; i < 3; i++) {
        struct sim sim = {.clk_hz = clocks[i]};
        double cycle_ns = 12e9 / (double)clocks[i];

        for (int64_t t = 1; t < 600000000000; t = t * 3 + 12345) {
            int64_t grid = sim_grid_ns(&sim, t);

            TEST_ASSERT_TRUE(grid >= t - 1 && (double)(grid - t) <= cycle_ns + 1);
            TEST_ASSERT_DOUBLE_WITHIN(0.001, 0.5, fmod((double)grid, cycle_ns) / cycle_ns);
            TEST_ASSERT_EQUAL_INT64(grid, sim_grid_ns(&sim, grid));
        }
    }
}

static void test_that_a_pin_that_begins_high_is_at_100_percent(void)
{
    pwm_init(&pwm, 0, true);
    TEST_ASSERT_EQUAL_DOUBLE(100, pwm.duty_pct);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, pwm_steady_ns(&pwm));
    TEST_ASSERT_FALSE(pwm_edge(&pwm, 1 * ms, false));
    TEST_ASSERT_EQUAL_INT64(16 * ms, pwm_steady_ns(&pwm)); /* not low for long enough yet */
    TEST_ASSERT_FALSE(pwm_edge(&pwm, 3 * ms, true));       /* no period yet */
    TEST_ASSERT_EQUAL_DOUBLE(100, pwm.duty_pct);
}

static void test_that_a_period_that_begins_is_not_steady(void)
{
    TEST_ASSERT_FALSE(pwm_edge(&pwm, 1 * ms, true));
    TEST_ASSERT_FALSE(pwm_edge(&pwm, 2 * ms, false)); /* low at 0 %, but in a period */
    TEST_ASSERT_EQUAL_INT64(17 * ms, pwm_steady_ns(&pwm));
    TEST_ASSERT_TRUE(pwm_edge(&pwm, 11 * ms, true));
    TEST_ASSERT_FALSE(pwm_edge(&pwm, 12 * ms, false));
    TEST_ASSERT_FALSE(pwm_edge(&pwm, 21 * ms, true)); /* the same duty */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10, pwm.duty_pct);
}

static void test_that_a_period_lasts_a_nanosecond_at_least(void)
{
    pwm_init(&pwm, 0, true);
    pwm_edge(&pwm, 5, false);
    pwm_edge(&pwm, 5, true);
    TEST_ASSERT_FALSE(pwm_edge(&pwm, 5, true));
    TEST_ASSERT_EQUAL_DOUBLE(100, pwm.duty_pct);
    pwm_edge(&pwm, 5, false);
    TEST_ASSERT_TRUE(pwm_edge(&pwm, 6, true));
    TEST_ASSERT_EQUAL_DOUBLE(0, pwm.duty_pct);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_the_duty_is_read_from_rise_to_rise);
    RUN_TEST(test_that_a_pin_without_edges_is_steady_after_one_and_a_half_periods);
    RUN_TEST(test_that_columns_are_found_by_their_names);
    RUN_TEST(test_that_other_lines_are_kept_but_not_read);
    RUN_TEST(test_that_endless_lines_and_zeros_do_no_harm);
    RUN_TEST(test_that_numbers_are_compared_at_their_limits);
    RUN_TEST(test_that_what_never_came_holds_no_upper_limit);
    RUN_TEST(test_that_an_impact_is_judged);
    RUN_TEST(test_that_states_are_whole_words);
    RUN_TEST(test_that_every_metric_has_its_own_name);
    RUN_TEST(test_that_a_broken_image_is_refused);
    RUN_TEST(test_that_boards_are_known_by_name);
    RUN_TEST(test_that_sync_times_lie_between_machine_cycles);
    RUN_TEST(test_that_a_pin_that_begins_high_is_at_100_percent);
    RUN_TEST(test_that_a_period_that_begins_is_not_steady);
    RUN_TEST(test_that_a_period_lasts_a_nanosecond_at_least);
    return UNITY_END();
}
