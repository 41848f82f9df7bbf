/* SPDX-License-Identifier: MIT */
/* Listens to the controller's serial line: keeps all that it said, and reads its CSV lines, whose
 * columns are named by a header line. */
#ifndef FUZZY51_SHOW_TELEMETRY_H
#define FUZZY51_SHOW_TELEMETRY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { TELEMETRY_FIELDS = 16, TELEMETRY_FIELD_SIZE = 16, TELEMETRY_LINE = 128 };

struct telemetry {
    char *log; /* all bytes, ended by a 0 */
    size_t length, capacity;
    char names[TELEMETRY_FIELDS][TELEMETRY_FIELD_SIZE];
    char values[TELEMETRY_FIELDS][TELEMETRY_FIELD_SIZE]; /* of the last line; empty before */
    int fields;
    char line[TELEMETRY_LINE];
    size_t line_length;
    int64_t begun_ns;     /* when the first byte of the line being received came */
    int64_t begun_for_ns; /* the time of what that line tells */
    int64_t line_ns;      /* the same of the last whole line */
    int64_t line_for_ns;  /* its measurement, or line_ns where there was no new one */
};

void telemetry_init(struct telemetry *telemetry);
void telemetry_free(struct telemetry *telemetry);

/* Bytes that came in until T_NS, when the last measurement was over at MEASURED_NS. Calls
 * LINE_DONE, if any, after each CSV line. */
void telemetry_take(struct telemetry *telemetry, int64_t t_ns, int64_t measured_ns,
                    const char *bytes, size_t size,
                    void (*line_done)(void *user, const struct telemetry *telemetry), void *user);

/* The last value of the column of that name; "" when there is none yet. */
const char *telemetry_value(const struct telemetry *telemetry, const char *name);

#endif
