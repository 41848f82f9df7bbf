/* SPDX-License-Identifier: MIT */
/* Shows a run while it goes on: road, gap, brake and state, or a yard from above, redrawn in the
 * terminal at the pace of real time; plain lines when the output is no terminal. */
#ifndef FUZZY51_LIVE_H
#define FUZZY51_LIVE_H

#include "run.h"
#include "yard.h"

#include <stdbool.h>
#include <stdio.h>

struct live {
    const char *title;
    const struct world_class *class;
    FILE *out;
    bool is_terminal, is_utf8;
    bool is_yard;
    int drawn; /* lines of the picture to draw over */
    int width;
    double view_m; /* the road's length on the screen */
    struct yard yard;
    double begin_s; /* of real time */
    int64_t next_ns;
};

void live_begin(struct live *live, const struct scenario *scenario, const struct world_class *class,
                FILE *out);

/* Its observer's function; user is the live. Waits until real time has come to T_NS. */
void live_row(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
              const struct telemetry *telemetry);

/* Leaves the terminal as it was; also after live_row was interrupted. */
void live_end(struct live *live);

#endif
