/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/scenario/expect.c: what was measured and what was expected, in words; and
 * what holds where test_drive_parts.c does not look. */
#include "expect.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static struct outcome outcome;

void setUp(void)
{
    outcome_clear(&outcome);
}

void tearDown(void)
{
}

static void expect_words(const char *words, enum metric metric)
{
    char text[100] = "?";

    expect_value(metric, &outcome, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING(words, text);
}

static bool holds(enum metric metric, char op, const char *text, double limit)
{
    struct expectation expectation = {.metric = metric, .op = op, .limit = limit};

    strcpy(expectation.text, text);
    return expect_holds(&expectation, &outcome);
}

static void test_that_a_cleared_outcome_has_measured_nothing_but_that_no_reset_came(void)
{
    memset(&outcome, 1, sizeof outcome);
    outcome_clear(&outcome);
    for (enum metric metric = 0; metric < METRIC_COUNT; metric++) {
        if (metric == METRIC_RESETS) {
            TEST_ASSERT_EQUAL_DOUBLE(0, outcome.values[metric]);
        } else if (metric == METRIC_RESET_BRAKE) {
            TEST_ASSERT_EQUAL_DOUBLE(INFINITY, outcome.values[metric]);
        } else {
            TEST_ASSERT_TRUE(isnan(outcome.values[metric]));
        }
    }
    TEST_ASSERT_EQUAL_STRING("", outcome.states);
    TEST_ASSERT_EQUAL_STRING("", outcome.final_state);
    TEST_ASSERT_EQUAL_STRING("", outcome.uart);
}

static void test_that_an_expectation_is_written_as_in_the_scenario(void)
{
    struct expectation expectation = {.metric = METRIC_MIN_GAP, .op = '>', .text = "0.5"};
    char text[100];

    expect_format(&expectation, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("min_gap_m >= 0.5", text);
    expectation.op = '<';
    expect_format(&expectation, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("min_gap_m <= 0.5", text);
    expectation = (struct expectation){.metric = METRIC_IMPACT, .op = '=', .text = "none"};
    expect_format(&expectation, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("impact = none", text);
}

static void test_that_a_number_has_its_decimals_and_its_unit(void)
{
    outcome.values[METRIC_MIN_GAP] = 1.23456;
    expect_words("1.235 m", METRIC_MIN_GAP);
    outcome.values[METRIC_MAX_BRAKE] = 86.28;
    expect_words("86.3 %", METRIC_MAX_BRAKE);
    outcome.values[METRIC_WARNINGS] = 0;
    expect_words("0", METRIC_WARNINGS);
}

static void test_that_what_is_no_number_is_said_in_words(void)
{
    expect_words("not measured by this app", METRIC_MIN_GAP);
    expect_words("not measured by this app", METRIC_IMPACT);
    expect_words("not measured by this app", METRIC_PARKED);
    outcome.values[METRIC_MIN_GAP] = INFINITY;
    expect_words("never", METRIC_MIN_GAP);
    outcome.values[METRIC_MIN_GAP] = -INFINITY;
    expect_words("none before", METRIC_MIN_GAP);
}

static void test_that_a_choice_is_said_by_its_words(void)
{
    outcome.values[METRIC_IMPACT] = 0;
    expect_words("none", METRIC_IMPACT);
    outcome.values[METRIC_IMPACT] = 1;
    expect_words("any", METRIC_IMPACT);
    outcome.values[METRIC_PARKED] = 0;
    expect_words("no", METRIC_PARKED);
    outcome.values[METRIC_PARKED] = 1;
    expect_words("yes", METRIC_PARKED);
}

static void test_that_states_and_text_are_said(void)
{
    expect_words("none", METRIC_FINAL_STATE);
    expect_words("", METRIC_REACHED);
    expect_words("0 bytes", METRIC_UART_SAYS);
    strcpy(outcome.states, "RELEASED STOP ");
    strcpy(outcome.final_state, "STOP");
    outcome.uart = "hello";
    expect_words("STOP", METRIC_FINAL_STATE);
    strcpy(outcome.final_state, "S");
    expect_words("S", METRIC_FINAL_STATE);
    expect_words("RELEASED STOP", METRIC_REACHED);
    expect_words("RELEASED STOP", METRIC_NEVER);
    expect_words("5 bytes", METRIC_UART_SAYS);
}

static void test_that_parked_is_judged(void)
{
    TEST_ASSERT_FALSE(holds(METRIC_PARKED, '=', "yes", 0)); /* nothing was measured */
    TEST_ASSERT_FALSE(holds(METRIC_PARKED, '=', "no", 0));
    outcome.values[METRIC_PARKED] = 1;
    TEST_ASSERT_TRUE(holds(METRIC_PARKED, '=', "yes", 0));
    TEST_ASSERT_FALSE(holds(METRIC_PARKED, '=', "no", 0));
    outcome.values[METRIC_PARKED] = 0;
    TEST_ASSERT_TRUE(holds(METRIC_PARKED, '=', "no", 0));
    TEST_ASSERT_FALSE(holds(METRIC_PARKED, '=', "yes", 0));
}

static void test_that_a_number_that_is_too_small_or_too_large_is_not_equal(void)
{
    outcome.values[METRIC_WARNINGS] = 2;
    TEST_ASSERT_FALSE(holds(METRIC_WARNINGS, '=', "3", 3));
    TEST_ASSERT_TRUE(holds(METRIC_WARNINGS, '=', "2", 2));
    TEST_ASSERT_FALSE(holds(METRIC_WARNINGS, '=', "1", 1));
    TEST_ASSERT_TRUE(holds(METRIC_WARNINGS, '<', "3", 3));
    TEST_ASSERT_TRUE(holds(METRIC_WARNINGS, '>', "1", 1));
}

static void test_that_states_of_the_same_length_differ(void)
{
    strcpy(outcome.states, "STOP ");
    TEST_ASSERT_FALSE(holds(METRIC_REACHED, '=', "OPEN", 0));
    TEST_ASSERT_FALSE(holds(METRIC_REACHED, '=', "STO", 0));
    TEST_ASSERT_FALSE(holds(METRIC_REACHED, '=', "STOPS", 0));
    TEST_ASSERT_TRUE(holds(METRIC_REACHED, '=', "STOP", 0));
    TEST_ASSERT_FALSE(holds(METRIC_FINAL_STATE, '=', "STOP", 0)); /* nobody said which came last */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_cleared_outcome_has_measured_nothing_but_that_no_reset_came);
    RUN_TEST(test_that_an_expectation_is_written_as_in_the_scenario);
    RUN_TEST(test_that_a_number_has_its_decimals_and_its_unit);
    RUN_TEST(test_that_what_is_no_number_is_said_in_words);
    RUN_TEST(test_that_a_choice_is_said_by_its_words);
    RUN_TEST(test_that_states_and_text_are_said);
    RUN_TEST(test_that_parked_is_judged);
    RUN_TEST(test_that_a_number_that_is_too_small_or_too_large_is_not_equal);
    RUN_TEST(test_that_states_of_the_same_length_differ);
    return UNITY_END();
}
