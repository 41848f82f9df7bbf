#include "trace.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Columns that come from every controller's telemetry; a world's own ones follow. */
static const char *const reported[] = {"state", "fault"};
enum { REPORTED = sizeof reported / sizeof reported[0] };

static double seconds(int64_t t_ns)
{
    return (double)t_ns * 1e-9;
}

/* --- CSV ---------------------------------------------------------------------------------- */

/* The image's identity stands in a last column, in the first row. */
static void csv_begin(const struct trace *trace)
{
    fputs("t_s", trace->csv.stream);
    for (int i = 0; i < trace->class->column_count; i++) {
        fprintf(trace->csv.stream, ",%s", trace->class->columns[i].name);
    }
    for (int i = 0; i < REPORTED; i++) {
        fprintf(trace->csv.stream, ",%s", reported[i]);
    }
    for (int i = 0; i < trace->class->reported_count; i++) {
        fprintf(trace->csv.stream, ",%s", trace->class->reported[i]);
    }
    fputs(trace->image != NULL ? ",image\n" : "\n", trace->csv.stream);
}

static void csv_row(struct trace *trace, int64_t t_ns, const double *values,
                    const struct telemetry *telemetry)
{
    fprintf(trace->csv.stream, "%.2f", seconds(t_ns));
    for (int i = 0; i < trace->class->column_count; i++) {
        fputc(',', trace->csv.stream);
        if (!isnan(values[i])) {
            fprintf(trace->csv.stream, "%.*f", trace->class->columns[i].decimals, values[i] + 0.0);
        }
    }
    for (int i = 0; i < REPORTED; i++) {
        fprintf(trace->csv.stream, ",%s", telemetry_value(telemetry, reported[i]));
    }
    for (int i = 0; i < trace->class->reported_count; i++) {
        fprintf(trace->csv.stream, ",%s", telemetry_value(telemetry, trace->class->reported[i]));
    }
    if (trace->image != NULL) {
        fprintf(trace->csv.stream, ",%s", trace->image_is_said ? "" : trace->image);
        trace->image_is_said = true;
    }
    fputc('\n', trace->csv.stream);
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

static void series_add(struct trace *trace, int index, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void series_add(struct trace *trace, int index, const char *format, ...)
{
    char item[64];
    size_t length;
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(item, sizeof item, format, arguments);
    va_end(arguments);
    length = strlen(item);
    if (trace->series[index].length + length + 3 > trace->series[index].capacity) {
        trace->series[index].capacity = trace->series[index].capacity * 2 + 4096;
        trace->series[index].text =
            realloc(trace->series[index].text, trace->series[index].capacity);
        if (trace->series[index].text == NULL) {
            abort();
        }
    }
    trace->series[index].text[trace->series[index].length] =
        trace->series[index].length == 0 ? '[' : ',';
    memcpy(trace->series[index].text + trace->series[index].length + 1, item, length + 1);
    trace->series[index].length += length + 1;
}

static void json_row(struct trace *trace, int64_t t_ns, const double *values, const char *state)
{
    series_add(trace, 0, "%.2f", seconds(t_ns));
    for (int i = 0; i < trace->class->column_count; i++) {
        if (isnan(values[i])) {
            series_add(trace, i + 1, "null");
        } else {
            series_add(trace, i + 1, "%.*f", trace->class->columns[i].decimals, values[i] + 0.0);
        }
    }
    series_add(trace, trace->class->column_count + 1, "\"%.15s\"", state);
}

static cJSON *json_series(struct trace *trace)
{
    cJSON *series = cJSON_CreateObject();

    for (int i = 0; i < trace->class->column_count + 2; i++) {
        const char *name = i == 0                            ? "t_s"
                           : i <= trace->class->column_count ? trace->class->columns[i - 1].name
                                                             : "state";

        strcat(trace->series[i].text, "]");
        cJSON_AddRawToObject(series, name, trace->series[i].text);
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
    if (trace->series[0].length > 0) {
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

/* --- all of them -------------------------------------------------------------------------- */

void trace_row(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
               const struct telemetry *telemetry)
{
    struct trace *trace = user;
    const char *state = telemetry_value(telemetry, "state");

    if (trace->csv.stream != NULL) {
        csv_row(trace, t_ns, values, telemetry);
    }
    if (trace->vcd.stream != NULL) {
        vcd_row(trace, t_ns, values, state);
    }
    if (trace->json.stream != NULL) {
        json_row(trace, t_ns, values, state);
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
    trace->image_is_said = false;
    trace->vcd_state[0] = '\0';
    for (int i = 0; i < WORLD_COLUMNS + 2; i++) {
        trace->series[i].length = 0;
    }
    if (trace->csv.stream != NULL) {
        csv_begin(trace);
    }
    if (trace->vcd.stream != NULL) {
        vcd_begin(trace);
    }
}

int trace_open(struct trace *trace, const struct trace_paths *paths,
               const struct world_class *class)
{
    const char *const wanted[] = {paths->csv, paths->vcd, paths->json, paths->uart};
    struct trace_file *const files[] = {&trace->csv, &trace->vcd, &trace->json, &trace->uart};

    memset(trace, 0, sizeof *trace);
    trace->class = class;
    trace->image = paths->image;
    for (int i = 0; i < 4; i++) {
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
    struct trace_file *const files[] = {&trace->csv, &trace->vcd};

    for (int i = 0; i < 2; i++) {
        if (files[i]->stream != NULL) {
            memory_end(files[i]);
            memory_begin(files[i]);
        }
    }
    begin(trace);
}

int trace_commit(struct trace *trace, const struct run *run, const struct run_setup *setup)
{
    struct trace_file *const files[] = {&trace->csv, &trace->vcd, &trace->json, &trace->uart};
    int status = EXIT_FINE;

    if (trace->json.stream != NULL) {
        json_write(trace, run, setup);
    }
    if (trace->uart.stream != NULL) {
        fwrite(run->telemetry.log, 1, run->telemetry.length, trace->uart.stream);
    }
    for (int i = 0; i < 4; i++) {
        if (files[i]->stream == NULL) {
            continue;
        }
        fflush(files[i]->stream);
        fwrite(files[i]->text, 1, files[i]->size, files[i]->out.stream);
        if (outfile_commit(&files[i]->out) != EXIT_FINE) {
            status = EXIT_INPUT;
        }
    }
    trace_abandon(trace);
    return status;
}

void trace_abandon(struct trace *trace)
{
    struct trace_file *const files[] = {&trace->csv, &trace->vcd, &trace->json, &trace->uart};

    for (int i = 0; i < 4; i++) {
        memory_end(files[i]);
        outfile_abandon(&files[i]->out);
    }
    for (int i = 0; i < WORLD_COLUMNS + 2; i++) {
        free(trace->series[i].text);
    }
    memset(trace->series, 0, sizeof trace->series);
}
