/* SPDX-License-Identifier: MIT */
#include "pace.h"

static const int64_t max_pause_ns = 1000000000;
static const int64_t margin_ns = 2000000; /* that a trigger may come earlier than ever */

void pace_note(struct pace *pace, int64_t t_ns)
{
    int64_t pause_ns = t_ns - pace->last_ns;

    /* A pause of more than a second says nothing about the pace. */
    if (pace->last_ns > 0 && pause_ns < max_pause_ns &&
        (pace->pause_ns == 0 || pause_ns < pace->pause_ns)) {
        pace->pause_ns = pause_ns;
    }
    pace->last_ns = t_ns;
}

int64_t pace_next_ns(const struct pace *pace, int64_t t_ns)
{
    int64_t next_ns = pace->last_ns + pace->pause_ns - margin_ns;

    return next_ns > t_ns ? next_ns : t_ns;
}
