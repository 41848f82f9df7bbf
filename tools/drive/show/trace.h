/* SPDX-License-Identifier: MIT */
/* What a run leaves behind: CSV for people, VCD for a waveform viewer, JSON for machines, and which
 * instructions of the image were run. */
#ifndef FUZZY51_TRACE_H
#define FUZZY51_TRACE_H

#include "diag.h"
#include "run.h"

#include <stdbool.h>

enum { TRACE_REPORTED = 8 }; /* state, fault, and the world's `reported` columns */

struct trace {
    const struct world_class *class;
    struct trace_file {
        struct outfile out;
        FILE *stream; /* in memory until the run is done; NULL: not wanted */
        char *text;
        size_t size;
    } csv, vcd, json, uart, coverage;
    uint8_t covered[SIM_COVER_BYTES]; /* for run_setup.cover, if the coverage is wanted */
    int64_t vcd_ns;                   /* time of the last stamp */
    char vcd_state[TELEMETRY_FIELD_SIZE];
    /* For CSV and JSON, which are written when the run is over: a line of the controller comes
     * later than the rows that it tells about. */
    struct trace_row {
        int64_t t_ns;
        double values[WORLD_COLUMNS];
    } *rows;
    size_t row_count, row_capacity;
    struct trace_line {
        int64_t for_ns; /* from then on its values hold */
        char values[TRACE_REPORTED][TELEMETRY_FIELD_SIZE];
    } *lines;
    size_t line_count, line_capacity;
    const char *image; /* what the image says of itself; NULL: nothing */
};

struct trace_paths {
    const char *csv, *vcd, *json, *uart, *coverage; /* NULL: not wanted */
    const char *image; /* what the image says of itself; NULL: nothing */
};

/* Opens what is wanted. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int trace_open(struct trace *trace, const struct trace_paths *paths,
               const struct world_class *class);

/* Its observer's functions; user is the trace. */
void trace_restart(void *user);
void trace_pin(void *user, int64_t t_ns, enum board_pin pin, bool level);
void trace_line(void *user, const struct telemetry *telemetry);
void trace_row(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
               const struct telemetry *telemetry);

/* Completes the files of a finished run. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int trace_commit(struct trace *trace, const struct run *run, const struct run_setup *setup);

/* Throws away what was not committed. */
void trace_abandon(struct trace *trace);

#endif
