/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/show/trace.c, the files that a run leaves. */
#include "trace.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

static const char csv[] = "build/tests/test_trace.csv", json[] = "build/tests/test_trace.json",
                  uart[] = "build/tests/test_trace.txt";
static const struct trace_paths paths = {.csv = csv, .json = json, .uart = uart};
static const struct board board = {.name = "aboard"};
static struct scenario scenario;
static struct run_setup setup = {
    .hex = "an.ihx", .board = &board, .scenario = &scenario, .seed = 3};
static struct run run;
static struct trace trace;

void setUp(void)
{
    memset(&run, 0, sizeof run);
    telemetry_init(&run.telemetry);
    run.outcome.uart = run.telemetry.log;
    run.outcome.values[METRIC_STOP_WITHIN] = INFINITY;
    run.outcome.values[METRIC_MIN_GAP] = 0.25;
    strcpy(scenario.title, "A \"quoted\" title");
    scenario.expect_count = 1;
    scenario.expect[0] =
        (struct expectation){.metric = METRIC_MIN_GAP, .op = '>', .limit = 0.5, .text = "0.5"};
    TEST_ASSERT_EQUAL(EXIT_FINE, trace_open(&trace, &paths, &brake_world));
}

void tearDown(void)
{
    trace_abandon(&trace);
    telemetry_free(&run.telemetry);
    unlink(csv);
    unlink(json);
    unlink(uart);
}

static void keep_line(void *user, const struct telemetry *telemetry)
{
    (void)user;
    trace_line(&trace, telemetry);
}

/* The controller sends TEXT at 20 ms, about a measurement at MEASURED_MS. */
static void say(const char *text, int64_t measured_ms)
{
    telemetry_take(&run.telemetry, 20000000, measured_ms * 1000000, text, strlen(text), keep_line,
                   NULL);
    run.outcome.uart = run.telemetry.log;
}

static void two_rows(void)
{
    const double first[WORLD_COLUMNS] = {NAN, 3, NAN, -0.0, 0, 0, 0, 0};
    const double second[WORLD_COLUMNS] = {4.98765, 2.5, 0, -1.23456, 36.04, 1, 1, 0};

    trace_row(&trace, 0, first, &run.telemetry);
    trace_row(&trace, 10000000, second, &run.telemetry);
    say("seq,dist_mm,closing_mmps,state,fault\r\n1,4988,,CONTROL,0\r\n", 10);
    trace_row(&trace, 20000000, second, &run.telemetry);
}

static char *contents(const char *path)
{
    static char text[8192];
    FILE *file = fopen(path, "r");

    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static void test_that_a_row_is_a_line_of_csv(void)
{
    two_rows();
    TEST_ASSERT_EQUAL(EXIT_FINE, trace_commit(&trace, &run, &setup));
    TEST_ASSERT_EQUAL_STRING("t_s,gap_m,ego_mps,lead_mps,accel_mps2,brake_pct,stop,lamp,buzzer,"
                             "state,fault,dist_mm,closing_mmps\n"
                             "0.00,,3.0000,,0.000,0.0,0,0,0,,,,\n"
                             "0.01,4.9877,2.5000,0.0000,-1.235,36.0,1,1,0,CONTROL,0,4988,\n"
                             "0.02,4.9877,2.5000,0.0000,-1.235,36.0,1,1,0,CONTROL,0,4988,\n",
                             contents(csv));
    TEST_ASSERT_NOT_NULL(strstr(contents(uart), "4988"));
}

static void test_that_nothing_is_there_before_the_commit(void)
{
    two_rows();
    TEST_ASSERT_NOT_EQUAL(0, access(csv, F_OK));
    TEST_ASSERT_NOT_EQUAL(0, access(json, F_OK));
    trace_abandon(&trace);
    TEST_ASSERT_NOT_EQUAL(0, access(csv, F_OK));
}

static void test_that_a_restart_forgets_the_rows(void)
{
    two_rows();
    trace_restart(&trace);
    two_rows();
    TEST_ASSERT_EQUAL(EXIT_FINE, trace_commit(&trace, &run, &setup));
    TEST_ASSERT_EQUAL(NULL, strstr(strstr(contents(csv), "0.01,"), "\n0.00"));
}

static void test_that_the_json_can_be_read_again(void)
{
    cJSON *root, *series, *expect;

    two_rows();
    TEST_ASSERT_EQUAL(EXIT_FINE, trace_commit(&trace, &run, &setup));
    root = cJSON_Parse(contents(json));
    TEST_ASSERT_NOT_NULL(root);
    TEST_ASSERT_EQUAL_STRING(scenario.title,
                             cJSON_GetStringValue(cJSON_GetObjectItem(root, "title")));
    TEST_ASSERT_EQUAL_STRING("aboard", cJSON_GetStringValue(cJSON_GetObjectItem(root, "board")));
    expect = cJSON_GetArrayItem(cJSON_GetObjectItem(root, "expect"), 0);
    TEST_ASSERT_TRUE(cJSON_IsFalse(cJSON_GetObjectItem(expect, "holds")));
    TEST_ASSERT_EQUAL_STRING("min_gap_m >= 0.5",
                             cJSON_GetStringValue(cJSON_GetObjectItem(expect, "expected")));
    TEST_ASSERT_TRUE(
        cJSON_IsNull(cJSON_GetObjectItem(cJSON_GetObjectItem(root, "outcome"), "stop_within_s")));
    series = cJSON_GetObjectItem(root, "series");
    TEST_ASSERT_EQUAL(13, cJSON_GetArraySize(series)); /* as many as CSV has */
    for (cJSON *one = series->child; one != NULL; one = one->next) {
        TEST_ASSERT_EQUAL(3, cJSON_GetArraySize(one));
    }
    TEST_ASSERT_TRUE(cJSON_IsNull(cJSON_GetArrayItem(cJSON_GetObjectItem(series, "dist_mm"), 0)));
    TEST_ASSERT_EQUAL_DOUBLE(
        4988, cJSON_GetNumberValue(cJSON_GetArrayItem(cJSON_GetObjectItem(series, "dist_mm"), 1)));
    TEST_ASSERT_EQUAL_STRING("CONTROL", cJSON_GetStringValue(cJSON_GetArrayItem(
                                            cJSON_GetObjectItem(series, "state"), 1)));
    TEST_ASSERT_TRUE(cJSON_IsNull(cJSON_GetArrayItem(cJSON_GetObjectItem(series, "gap_m"), 0)));
    TEST_ASSERT_EQUAL_DOUBLE(
        36, cJSON_GetNumberValue(cJSON_GetArrayItem(cJSON_GetObjectItem(series, "brake_pct"), 1)));
    cJSON_Delete(root);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_row_is_a_line_of_csv);
    RUN_TEST(test_that_nothing_is_there_before_the_commit);
    RUN_TEST(test_that_a_restart_forgets_the_rows);
    RUN_TEST(test_that_the_json_can_be_read_again);
    return UNITY_END();
}
