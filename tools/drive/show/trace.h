/* What a run leaves behind: CSV for people, VCD for a waveform viewer, JSON for machines. */
#ifndef FUZZY51_TRACE_H
#define FUZZY51_TRACE_H

#include "diag.h"
#include "run.h"

#include <stdbool.h>

struct trace {
    const struct world_class *class;
    struct trace_file {
        struct outfile out;
        FILE *stream; /* in memory until the run is done; NULL: not wanted */
        char *text;
        size_t size;
    } csv, vcd, json, uart;
    int64_t vcd_ns; /* time of the last stamp */
    char vcd_state[TELEMETRY_FIELD_SIZE];
    struct {
        char *text; /* "[0,0.01,..." */
        size_t length, capacity;
    } series[WORLD_COLUMNS + 2]; /* of JSON: the time, the columns, the state */
    const char *image;           /* what the image says of itself; NULL: nothing */
    bool image_is_said;          /* in CSV */
};

struct trace_paths {
    const char *csv, *vcd, *json, *uart; /* NULL: not wanted */
    const char *image;                   /* what the image says of itself; NULL: nothing */
};

/* Opens what is wanted. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int trace_open(struct trace *trace, const struct trace_paths *paths,
               const struct world_class *class);

/* Its observer's functions; user is the trace. */
void trace_restart(void *user);
void trace_pin(void *user, int64_t t_ns, enum board_pin pin, bool level);
void trace_row(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
               const struct telemetry *telemetry);

/* Completes the files of a finished run. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int trace_commit(struct trace *trace, const struct run *run, const struct run_setup *setup);

/* Throws away what was not committed. */
void trace_abandon(struct trace *trace);

#endif
