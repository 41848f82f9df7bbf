/* SPDX-License-Identifier: MIT */
/* The pace of a controller's triggers: when the next one is to be expected. */
#ifndef FUZZY51_PACE_H
#define FUZZY51_PACE_H

#include <stdint.h>

struct pace {
    int64_t last_ns, pause_ns; /* the last trigger's end; the shortest pause so far */
};

/* A trigger ends at T_NS. */
void pace_note(struct pace *pace, int64_t t_ns);

/* The time after T_NS before which no trigger is expected; T_NS when one may come at any time. */
int64_t pace_next_ns(const struct pace *pace, int64_t t_ns);

#endif
