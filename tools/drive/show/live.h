/* SPDX-License-Identifier: MIT */
/* Shows a run while it goes on: the world's picture, redrawn in the terminal at the pace of real
 * time; plain lines when the output is no terminal. */
#ifndef FUZZY51_LIVE_H
#define FUZZY51_LIVE_H

#include "picture.h"
#include "run.h"

#include <stdbool.h>
#include <stdio.h>

struct live {
    const struct scenario *scenario;
    const struct world_class *class;
    FILE *out;
    bool is_terminal;
    struct picture picture;
    double begin_s; /* of real time */
    int64_t next_ns;
};

void live_begin(struct live *live, const struct scenario *scenario, FILE *out);

/* Its observer's function; user is the live. Waits until real time has come to T_NS. */
void live_row(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
              const struct telemetry *telemetry);

/* Leaves the terminal as it was; also after live_row was interrupted. */
void live_end(struct live *live);

#endif
