/* SPDX-License-Identifier: MIT */
/* The chip in the page: drive's loop, the fast engine and the plant, compiled to WebAssembly. So
 * the report's page drives the real image itself. The page writes texts to the memory that
 * page_text returns, and reads texts where page_row and the like say. All texts end with a 0. */
#include "base.h"
#include "car.h"
#include "diag.h"
#include "fast.h"
#include "identity.h"
#include "run.h"

#include <ini.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FOR_THE_PAGE(name) __attribute__((export_name(#name)))

enum { SETTINGS_MAX = 64, TEXT_SIZE = 4096 };

static struct {
    char *image; /* Intel HEX */
    char said[TEXT_SIZE], row[TEXT_SIZE];
    double values[WORLD_COLUMNS];
    struct scenario scenario;
    struct run_setup setup;
    struct run run;
    struct loop *loop;
} page;

/* --- what this machine has, and a page does not ----------------------------------------------- */

int diag_error(const char *file, int line, const char *format, ...)
{
    size_t length = strlen(page.said);
    va_list arguments;

    (void)file;
    (void)line;
    va_start(arguments, format);
    vsnprintf(page.said + length, sizeof page.said - length, format, arguments);
    va_end(arguments);
    return EXIT_INPUT;
}

/* The only file that is read is the image. */
FILE *fopen(const char *restrict path, const char *restrict mode)
{
    (void)path;
    return fmemopen(page.image, strlen(page.image), mode);
}

/* A scenario comes as settings. */
int ini_parse_stream(ini_reader reader, void *stream, ini_handler handler, void *user)
{
    (void)reader;
    (void)stream;
    (void)handler;
    (void)user;
    abort();
}

/* --- one drive -------------------------------------------------------------------------------- */

static void end_drive(void)
{
    if (page.loop != NULL) {
        run_end(page.loop);
        run_free(&page.run);
        page.loop = NULL;
    }
}

static void keep_row(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
                     const struct telemetry *telemetry)
{
    (void)user;
    (void)t_ns;
    (void)telemetry;
    memcpy(page.values, values, sizeof page.values);
}

/* "sensor.kind=..." if the image says that it reads another sensor than the first; else NULL. */
static char *sensor_setting(void)
{
    static char setting[IDENTITY_WORD + 16];
    static struct hexfile hex;
    static struct identity identity;

    if (hexfile_read(&hex, "image") != EXIT_FINE) {
        return NULL;
    }
    identity_find(&identity, &hex);
    if (strcmp(identity.sensor, "tfluna") != 0) {
        return NULL;
    }
    snprintf(setting, sizeof setting, "sensor.kind=%s", identity.sensor);
    return setting;
}

/* SIZE bytes for a text of the page; to be freed by page_begin. */
FOR_THE_PAGE(page_text) char *page_text(size_t size)
{
    char *text = malloc(size);

    if (text == NULL) {
        abort();
    }
    return text;
}

/* Begins a drive of IMAGE, built for BOARD, on the scenario that SETTINGS says: a line each,
 * "section.key=value". Takes all three texts. Returns 1, or 0 when page_said tells why not. */
FOR_THE_PAGE(page_begin) int page_begin(char *image, char *board, char *settings)
{
    static const struct run_observer observer = {.row = keep_row};
    char *lines[SETTINGS_MAX], *rest = settings;
    int count = 0;

    end_drive();
    page.said[0] = '\0';
    page.image = image;
    lines[count] = sensor_setting();
    count += lines[count] != NULL;
    while (rest != NULL && count < SETTINGS_MAX) {
        lines[count++] = strsep(&rest, "\n");
    }
    page.setup = (struct run_setup){.engine = &fast_engine,
                                    .hex = "image",
                                    .board = board_find(board),
                                    .scenario = &page.scenario,
                                    .quantum_us = RUN_QUANTUM_US,
                                    .step_us = WORLD_STEP_NS / 1000};
    if (page.setup.board == NULL) {
        diag_error(NULL, 0, "no board '%s'", board);
    } else if (scenario_from(&page.scenario, lines, count) == EXIT_FINE) {
        page.setup.seed = (uint64_t)page.scenario.seed;
        page.loop = run_begin(&page.run, &page.setup, &observer, 1);
    }
    if (page.loop != NULL && !page.run.triggered) {
        diag_error(NULL, 0, "the image did not start: %.200s", page.run.telemetry.log);
        end_drive();
    }
    free(image);
    free(board);
    free(settings);
    return page.loop != NULL;
}

/* What was wrong. */
FOR_THE_PAGE(page_said) const char *page_said(void)
{
    return page.said;
}

/* Drives on for 10 ms. Returns 0 when the drive is over. */
FOR_THE_PAGE(page_next) int page_next(void)
{
    return page.loop != NULL && run_next(page.loop);
}

/* From now on the car ahead gains that acceleration, up to TOP_MPS. Returns 0 if it cannot, for
 * lack of a car ahead or after too many commands. */
FOR_THE_PAGE(page_lead) int page_lead(double accel_mps2, double top_mps)
{
    struct rig *rig = page.loop != NULL ? ((struct base *)run_world(page.loop))->rig : NULL;

    return rig != NULL && rig->car.targets[0].lead.present &&
           car_command_lead(&rig->car, 0, accel_mps2, top_mps);
}

/* --- texts, as JSON --------------------------------------------------------------------------- */

static void add(const char *format, ...) __attribute__((format(printf, 1, 2)));

static void add(const char *format, ...)
{
    size_t length = strlen(page.row);
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(page.row + length, sizeof page.row - length, format, arguments);
    va_end(arguments);
}

static void add_number(const char *name, double value, int decimals)
{
    if (isfinite(value)) {
        add("\"%s\":%.*f,", name, decimals, value);
    } else {
        add("\"%s\":null,", name);
    }
}

/* A quantity that the controller reports, or null. */
static void add_reported(const char *name)
{
    const char *text = telemetry_value(&page.run.telemetry, name);
    char *end;
    double value = strtod(text, &end);

    add_number(name, end != text && *end == '\0' ? value : NAN, 0);
}

/* The present row of the trace: its columns, what the controller last reported, and its "state". */
FOR_THE_PAGE(page_row) const char *page_row(void)
{
    const struct world_class *class = page.scenario.world;

    strcpy(page.row, "{");
    for (int i = 0; i < class->column_count; i++) {
        add_number(class->columns[i].name, page.values[i], class->columns[i].decimals);
    }
    for (int i = 0; i < class->reported_count; i++) {
        add_reported(class->reported[i]);
    }
    add("\"state\":\"%s\",\"t_s\":%.2f}", telemetry_value(&page.run.telemetry, "state"),
        (double)page.run.duration_ns * 1e-9);
    return page.row;
}

/* Ends the drive and says its outcome: each metric that is a number. */
FOR_THE_PAGE(page_outcome) const char *page_outcome(void)
{
    const struct outcome *outcome = &page.run.outcome;

    strcpy(page.row, "{");
    if (page.loop != NULL) {
        run_end(page.loop);
        page.loop = NULL;
        for (enum metric metric = 0; metric < METRIC_COUNT; metric++) {
            if (expect_kind(metric) == KIND_NUMBER || expect_kind(metric) == KIND_COUNT) {
                add_number(expect_name(metric), outcome->values[metric], 4);
            }
        }
        add_number("rest_s", outcome->rest_s, 4);
        run_free(&page.run);
    }
    add("\"is\":\"outcome\"}");
    return page.row;
}
