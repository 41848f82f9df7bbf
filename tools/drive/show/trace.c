/* SPDX-License-Identifier: MIT */
#include "trace.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Columns that come from every controller's telemetry; a world's own ones follow. */
static const char *const reported[] = {"state", "fault"};
enum { REPORTED = sizeof reported / sizeof reported[0], FILES = 5 };

static double seconds(int64_t t_ns)
{
    return (double)t_ns * 1e-9;
}

/* --- rows and lines ------------------------------------------------------------------------ */

static int reported_count(const struct trace *trace)
{
    return REPORTED + trace->class->reported_count;
}

/* The names of the reported columns: state, fault, then the world's own. */
static const char *reported_name(const struct trace *trace, int index)
{
    return index < REPORTED ? reported[index] : trace->class->reported[index - REPORTED];
}

/* Makes room in ARRAY for one more item of SIZE bytes. */
static void *grown(void *array, size_t count, size_t *capacity, size_t size)
{
    if (count == *capacity) {
        *capacity = *capacity * 2 + 256;
        array = realloc(array, *capacity * size);
        if (array == NULL) {
            abort();
        }
    }
    return array;
}

void trace_line(void *user, const struct telemetry *telemetry)
{
    struct trace *trace = user;
    struct trace_line *line;

    trace->lines =
        grown(trace->lines, trace->line_count, &trace->line_capacity, sizeof trace->lines[0]);
    line = &trace->lines[trace->line_count++];
    line->for_ns = telemetry->line_for_ns;
    for (int i = 0; i < reported_count(trace) && i < TRACE_REPORTED; i++) {
        strcpy(line->values[i], telemetry_value(telemetry, reported_name(trace, i)));
    }
}

static void keep_row(struct trace *trace, int64_t t_ns, const double *values)
{
    struct trace_row *row;

    trace->rows = grown(trace->rows, trace->row_count, &trace->row_capacity, sizeof trace->rows[0]);
    row = &trace->rows[trace->row_count++];
    row->t_ns = t_ns;
    memcpy(row->values, values, sizeof row->values);
}

/* What the controller has reported for ROW; *LINE is the number of lines for rows so far. "":
 * nothing yet. */
static const char *reported_at(const struct trace *trace, const struct trace_row *row, size_t *line,
                               int index)
{
    while (*line < trace->line_count && trace->lines[*line].for_ns <= row->t_ns) {
        ++*line;
    }
    return *line == 0 ? "" : trace->lines[*line - 1].values[index];
}

/* --- CSV ---------------------------------------------------------------------------------- */

/* The image's identity stands in a last column, in the first row. */
static void csv_write(const struct trace *trace)
{
    FILE *out = trace->csv.stream;
    size_t line = 0;

    fputs("t_s", out);
    for (int i = 0; i < trace->class->column_count; i++) {
        fprintf(out, ",%s", trace->class->columns[i].name);
    }
    for (int i = 0; i < reported_count(trace); i++) {
        fprintf(out, ",%s", reported_name(trace, i));
    }
    fputs(trace->image != NULL ? ",image\n" : "\n", out);
    for (size_t k = 0; k < trace->row_count; k++) {
        const struct trace_row *row = &trace->rows[k];

        fprintf(out, "%.2f", seconds(row->t_ns));
        for (int i = 0; i < trace->class->column_count; i++) {
            fputc(',', out);
            if (!isnan(row->values[i])) {
                fprintf(out, "%.*f", trace->class->columns[i].decimals, row->values[i] + 0.0);
            }
        }
        for (int i = 0; i < reported_count(trace); i++) {
            fprintf(out, ",%s", reported_at(trace, row, &line, i));
        }
        if (trace->image != NULL) {
            fprintf(out, ",%s", k == 0 ? trace->image : "");
        }
        fputc('\n', out);
    }
}

/* --- VCD ---------------------------------------------------------------------------------- */

/* Short names: pins from 'A' on, columns from 'a' on, the state last. */
static char pin_id(int pin)
{
    return (char)('A' + pin);
}

static char column_id(int column)
{
    return (char)('a' + column);
}

static const char state_id = 's';

static void vcd_begin(const struct trace *trace)
{
    FILE *out = trace->vcd.stream;

    fputs("$version fuzzy51 drive $end\n$timescale 1ns $end\n$scope module drive $end\n", out);
    for (int pin = 0; pin < BOARD_PINS; pin++) {
        fprintf(out, "$var wire 1 %c pin_%s $end\n", pin_id(pin), board_pin_name(pin));
    }
    for (int i = 0; i < trace->class->column_count; i++) {
        fprintf(out, "$var real 64 %c %s $end\n", column_id(i), trace->class->columns[i].name);
    }
    fprintf(out, "$var string 1 %c state $end\n", state_id);
    fputs("$upscope $end\n$enddefinitions $end\n", out);
}

static void vcd_stamp(struct trace *trace, int64_t t_ns)
{
    if (t_ns > trace->vcd_ns) {
        fprintf(trace->vcd.stream, "#%lld\n", (long long)t_ns);
        trace->vcd_ns = t_ns;
    }
}

static void vcd_row(struct trace *trace, int64_t t_ns, const double *values, const char *state)
{
    vcd_stamp(trace, t_ns);
    for (int i = 0; i < trace->class->column_count; i++) {
        if (!isnan(values[i])) {
            fprintf(trace->vcd.stream, "r%.6g %c\n", values[i], column_id(i));
        }
    }
    if (strcmp(state, trace->vcd_state) != 0) {
        strcpy(trace->vcd_state, state);
        fprintf(trace->vcd.stream, "s%s %c\n", state, state_id);
    }
}

void trace_pin(void *user, int64_t t_ns, enum board_pin pin, bool level)
{
    struct trace *trace = user;

    if (trace->vcd.stream == NULL) {
        return;
    }
    vcd_stamp(trace, t_ns);
    fprintf(trace->vcd.stream, "%d%c\n", level, pin_id(pin));
}

/* --- JSON --------------------------------------------------------------------------------- */

/* A list as JSON, written item by item. */
struct list {
    FILE *out;
    char *text;
    size_t size;
};

static void list_begin(struct list *list)
{
    list->out = open_memstream(&list->text, &list->size);
    if (list->out == NULL) {
        abort();
    }
}

/* Ends LIST as the member NAME of OBJECT. */
static void list_end(struct list *list, cJSON *object, const char *name)
{
    fputc(']', list->out);
    fclose(list->out);
    cJSON_AddRawToObject(object, name, list->text);
    free(list->text);
}

static const char *separator(size_t index)
{
    return index == 0 ? "[" : ",";
}

static bool is_number(const char *text)
{
    return text[0] != '\0' && text[text[0] == '-'] != '\0' &&
           strspn(text + (text[0] == '-'), "0123456789") == strlen(text + (text[0] == '-'));
}

/* Column I of the world, or with I = -1 the time. */
static void json_column(const struct trace *trace, cJSON *series, int i)
{
    struct list list;

    list_begin(&list);
    for (size_t k = 0; k < trace->row_count; k++) {
        const struct trace_row *row = &trace->rows[k];

        fputs(separator(k), list.out);
        if (i < 0) {
            fprintf(list.out, "%.2f", seconds(row->t_ns));
        } else if (isnan(row->values[i])) {
            fputs("null", list.out);
        } else {
            fprintf(list.out, "%.*f", trace->class->columns[i].decimals, row->values[i] + 0.0);
        }
    }
    list_end(&list, series, i < 0 ? "t_s" : trace->class->columns[i].name);
}

static void json_reported(const struct trace *trace, cJSON *series, int i)
{
    struct list list;
    size_t line = 0;

    list_begin(&list);
    for (size_t k = 0; k < trace->row_count; k++) {
        const char *value = reported_at(trace, &trace->rows[k], &line, i);

        fputs(separator(k), list.out);
        if (is_number(value)) {
            fprintf(list.out, "%ld", strtol(value, NULL, 10));
        } else if (value[0] == '\0') {
            fputs(strcmp(reported_name(trace, i), "state") == 0 ? "\"\"" : "null", list.out);
        } else {
            cJSON *string = cJSON_CreateString(value);
            char *text = cJSON_PrintUnformatted(string);

            fputs(text, list.out);
            free(text);
            cJSON_Delete(string);
        }
    }
    list_end(&list, series, reported_name(trace, i));
}

static cJSON *json_series(const struct trace *trace)
{
    cJSON *series = cJSON_CreateObject();

    for (int i = -1; i < trace->class->column_count; i++) {
        json_column(trace, series, i);
    }
    for (int i = 0; i < reported_count(trace); i++) {
        json_reported(trace, series, i);
    }
    return series;
}

static void json_number(cJSON *object, const char *name, double value)
{
    char text[40];

    snprintf(text, sizeof text, "%.6g", value);
    if (isfinite(value)) {
        cJSON_AddRawToObject(object, name, text);
    } else {
        cJSON_AddNullToObject(object, name);
    }
}

static cJSON *json_outcome(const struct outcome *outcome)
{
    cJSON *object = cJSON_CreateObject();
    char text[EXPECT_VALUE + 16];

    for (enum metric metric = 0; metric < METRIC_COUNT; metric++) {
        enum expect_kind kind = expect_kind(metric);

        expect_value(metric, outcome, text, sizeof text);
        if (kind == KIND_NUMBER || kind == KIND_COUNT) {
            json_number(object, expect_name(metric), outcome->values[metric]);
        } else if (metric != METRIC_NEVER && metric != METRIC_UART_SAYS) {
            cJSON_AddStringToObject(object, expect_name(metric), text);
        }
    }
    return object;
}

static cJSON *json_expect(const struct scenario *scenario, const struct outcome *outcome)
{
    cJSON *list = cJSON_CreateArray();

    for (int i = 0; i < scenario->expect_count; i++) {
        cJSON *item = cJSON_CreateObject();
        char text[EXPECT_VALUE + 64];

        expect_format(&scenario->expect[i], text, sizeof text);
        cJSON_AddStringToObject(item, "expected", text);
        expect_value(scenario->expect[i].metric, outcome, text, sizeof text);
        cJSON_AddStringToObject(item, "value", text);
        cJSON_AddBoolToObject(item, "holds", expect_holds(&scenario->expect[i], outcome));
        cJSON_AddItemToArray(list, item);
    }
    return list;
}

static void json_write(struct trace *trace, const struct run *run, const struct run_setup *setup)
{
    cJSON *root = cJSON_CreateObject();
    char *text;

    cJSON_AddStringToObject(root, "scenario", setup->scenario->file);
    cJSON_AddStringToObject(root, "title", setup->scenario->title);
    cJSON_AddStringToObject(root, "board", setup->board->name);
    cJSON_AddStringToObject(root, "hex", setup->hex);
    if (trace->image != NULL) {
        cJSON_AddStringToObject(root, "image", trace->image);
    }
    json_number(root, "seed", (double)setup->seed);
    json_number(root, "duration_s", seconds(run->duration_ns));
    json_number(root, "boot_s", seconds(run->boot_ns));
    cJSON_AddItemToObject(root, "outcome", json_outcome(&run->outcome));
    cJSON_AddItemToObject(root, "expect", json_expect(setup->scenario, &run->outcome));
    if (trace->row_count > 0) {
        cJSON_AddItemToObject(root, "series", json_series(trace));
    }
    text = cJSON_Print(root);
    if (text == NULL) {
        abort();
    }
    fputs(text, trace->json.stream);
    fputc('\n', trace->json.stream);
    free(text);
    cJSON_Delete(root);
}

/* --- coverage ----------------------------------------------------------------------------- */

/* The addresses of the instructions that were run, in order. */
static void coverage_write(const struct trace *trace)
{
    for (unsigned address = 0; address < 8 * SIM_COVER_BYTES; address++) {
        if (trace->covered[address / 8] >> address % 8 & 1) {
            fprintf(trace->coverage.stream, "%04X\n", address);
        }
    }
}

/* --- all of them -------------------------------------------------------------------------- */

void trace_row(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
               const struct telemetry *telemetry)
{
    struct trace *trace = user;

    if (trace->vcd.stream != NULL) {
        vcd_row(trace, t_ns, values, telemetry_value(telemetry, "state"));
    }
    if (trace->csv.stream != NULL || trace->json.stream != NULL) {
        keep_row(trace, t_ns, values);
    }
}

static void memory_begin(struct trace_file *file)
{
    file->stream = open_memstream(&file->text, &file->size);
    if (file->stream == NULL) {
        abort();
    }
}

static void memory_end(struct trace_file *file)
{
    if (file->stream != NULL) {
        fclose(file->stream);
    }
    free(file->text);
    file->stream = NULL;
    file->text = NULL;
}

static void begin(struct trace *trace)
{
    trace->vcd_ns = -1;
    trace->vcd_state[0] = '\0';
    trace->row_count = trace->line_count = 0;
    memset(trace->covered, 0, sizeof trace->covered);
    if (trace->vcd.stream != NULL) {
        vcd_begin(trace);
    }
}

int trace_open(struct trace *trace, const struct trace_paths *paths,
               const struct world_class *class)
{
    const char *const wanted[] = {paths->csv, paths->vcd, paths->json, paths->uart,
                                  paths->coverage};
    struct trace_file *const files[] = {&trace->csv, &trace->vcd, &trace->json, &trace->uart,
                                        &trace->coverage};

    memset(trace, 0, sizeof *trace);
    trace->class = class;
    trace->image = paths->image;
    for (int i = 0; i < FILES; i++) {
        if (wanted[i] == NULL) {
            continue;
        }
        if (outfile_open(&files[i]->out, wanted[i]) != EXIT_FINE) {
            trace_abandon(trace);
            return EXIT_INPUT;
        }
        memory_begin(files[i]);
    }
    begin(trace);
    return EXIT_FINE;
}

void trace_restart(void *user)
{
    struct trace *trace = user;

    if (trace->vcd.stream != NULL) {
        memory_end(&trace->vcd);
        memory_begin(&trace->vcd);
    }
    begin(trace);
}

int trace_commit(struct trace *trace, const struct run *run, const struct run_setup *setup)
{
    struct trace_file *const files[] = {&trace->csv, &trace->vcd, &trace->json, &trace->uart,
                                        &trace->coverage};
    int status = EXIT_FINE;

    if (trace->csv.stream != NULL) {
        csv_write(trace);
    }
    if (trace->json.stream != NULL) {
        json_write(trace, run, setup);
    }
    if (trace->uart.stream != NULL) {
        fwrite(run->telemetry.log, 1, run->telemetry.length, trace->uart.stream);
    }
    if (trace->coverage.stream != NULL) {
        coverage_write(trace);
    }
    for (int i = 0; i < FILES; i++) {
        if (files[i]->stream == NULL) {
            continue;
        }
        fflush(files[i]->stream);
        fwrite(files[i]->text, 1, files[i]->size, files[i]->out.stream);
        if (outfile_flush(&files[i]->out) != EXIT_FINE) {
            status = EXIT_INPUT;
        }
    }
    for (int i = 0; i < FILES && status == EXIT_FINE; i++) {
        if (files[i]->stream != NULL) {
            status = outfile_commit(&files[i]->out);
        }
    }
    trace_abandon(trace);
    return status;
}

void trace_abandon(struct trace *trace)
{
    struct trace_file *const files[] = {&trace->csv, &trace->vcd, &trace->json, &trace->uart,
                                        &trace->coverage};

    for (int i = 0; i < FILES; i++) {
        memory_end(files[i]);
        outfile_abandon(&files[i]->out);
    }
    free(trace->rows);
    free(trace->lines);
    trace->rows = NULL;
    trace->lines = NULL;
    trace->row_count = trace->row_capacity = trace->line_count = trace->line_capacity = 0;
}
