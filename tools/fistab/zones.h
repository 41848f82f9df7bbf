/* SPDX-License-Identifier: MIT */
/* The range of an input, cut where one of its sets becomes 0 or stops being 1: within a zone, each
 * set is either 0, or 1, or between, all the way. So what holds at one point of each zone holds
 * everywhere. */
#ifndef FUZZY51_ZONES_H
#define FUZZY51_ZONES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "fis.h"

enum { ZONE_ABOVE_0 = 1, ZONE_BELOW_1 = 2 };

struct zone {
    double low, high; /* equal for a zone of one point */
    uint8_t *state;   /* of each set: ZONE_ABOVE_0 if above 0 here, ZONE_BELOW_1 if below 1 */
};

struct zones {
    struct zone *zone;
    size_t count;
    uint8_t *states;
};

enum zones_status { ZONES_MADE, ZONES_TOO_MANY, ZONES_NO_MEMORY };

/* Works out the zones of INPUT; to be freed unless the result is other than ZONES_MADE. */
enum zones_status zones_make(const struct variable *input, struct zones *zones);
void zones_free(struct zones *zones);

/* Is a term of a rule, set TERM or not set -TERM, above 0 in ZONE? Not for 0. */
bool zone_holds(const struct zone *zone, int term);

#endif
