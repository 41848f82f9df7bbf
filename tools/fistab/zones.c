/* SPDX-License-Identifier: MIT */
/* Zones of an input. */
#include "zones.h"

#include <stdlib.h>
#include <string.h>

#include "shape.h"

enum { STATES_MAX = 4 << 20 };

struct list {
    double *x;
    size_t count, room;
    bool failed;
};

static void push(struct list *list, double x)
{
    if (list->count == list->room) {
        size_t room = list->room == 0 ? 64 : 2 * list->room;
        double *bigger = realloc(list->x, room * sizeof *bigger);

        if (bigger == NULL) {
            list->failed = true;
            return;
        }
        list->x = bigger;
        list->room = room;
    }
    list->x[list->count++] = x;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

static size_t sort_unique(double *x, size_t count)
{
    size_t kept = 0;

    qsort(x, count, sizeof *x, by_value);
    for (size_t i = 0; i < count; i++) {
        if (kept == 0 || x[i] > x[kept - 1]) {
            x[kept++] = x[i];
        }
    }
    return kept;
}

static uint8_t state_at(const struct set *set, double x)
{
    double mu = set_degree(set, x);
    return (uint8_t)((mu > 0 ? ZONE_ABOVE_0 : 0) | (mu < 1 ? ZONE_BELOW_1 : 0));
}

/* Where the state of SET changes between LEFT and RIGHT, between which it changes once. */
static double change(const struct set *set, double left, double right)
{
    uint8_t state = state_at(set, left);

    for (int i = 0; i < 100; i++) {
        double middle = left + (right - left) / 2;
        if (state_at(set, middle) == state) {
            left = middle;
        } else {
            right = middle;
        }
    }
    return right;
}

/* Between kinks a set rises or falls all the way, so its state changes at most twice; 0,
 * between, 1. */
static void add_changes(struct list *list, const struct set *set, double min, double max)
{
    double kink[SHAPE_KINKS_MAX + 2];
    size_t kinks = shape_kinks(set, kink);

    kink[kinks++] = min;
    kink[kinks++] = max;
    kinks = sort_unique(kink, kinks);
    for (size_t i = 0; i + 1 < kinks; i++) {
        double width = kink[i + 1] - kink[i];
        double at[3] = {kink[i] + 1e-9 * width, kink[i] + width / 2, kink[i + 1] - 1e-9 * width};

        if (kink[i] < min || kink[i + 1] > max) {
            continue;
        }
        if (state_at(set, kink[i]) != state_at(set, at[0])) {
            push(list, kink[i]);
        }
        for (int k = 0; k < 2; k++) {
            if (state_at(set, at[k]) != state_at(set, at[k + 1])) {
                push(list, change(set, at[k], at[k + 1]));
            }
        }
        if (state_at(set, kink[i + 1]) != state_at(set, at[2])) {
            push(list, kink[i + 1]);
        }
    }
}

/* Adds a zone, or widens the last one if nothing differs. */
static void add_zone(struct zones *zones, const struct variable *input, double low, double high)
{
    struct zone *zone = &zones->zone[zones->count];
    double x = low + (high - low) / 2;

    zone->low = low;
    zone->high = high;
    zone->state = zones->states + zones->count * input->sets;
    for (size_t k = 0; k < input->sets; k++) {
        zone->state[k] = state_at(&input->set[k], x);
    }
    if (zones->count > 0 && memcmp(zone->state, zone[-1].state, input->sets) == 0) {
        zone[-1].high = high;
    } else {
        zones->count++;
    }
}

enum zones_status zones_make(const struct variable *input, struct zones *zones)
{
    struct list cut = {0};
    enum zones_status status = ZONES_NO_MEMORY;

    memset(zones, 0, sizeof *zones);
    push(&cut, input->min);
    push(&cut, input->max);
    for (size_t k = 0; k < input->sets && !cut.failed; k++) {
        add_changes(&cut, &input->set[k], input->min, input->max);
    }
    if (cut.failed) {
        goto done;
    }
    cut.count = sort_unique(cut.x, cut.count);
    if (2 * cut.count * input->sets > STATES_MAX) {
        status = ZONES_TOO_MANY;
        goto done;
    }
    zones->zone = malloc(2 * cut.count * sizeof *zones->zone);
    zones->states = malloc(2 * cut.count * input->sets + 1);
    if (zones->zone == NULL || zones->states == NULL) {
        zones_free(zones);
        goto done;
    }
    for (size_t i = 0; i < cut.count; i++) {
        add_zone(zones, input, cut.x[i], cut.x[i]);
        if (i + 1 < cut.count) {
            add_zone(zones, input, cut.x[i], cut.x[i + 1]);
        }
    }
    status = ZONES_MADE;
done:
    free(cut.x);
    return status;
}

void zones_free(struct zones *zones)
{
    free(zones->zone);
    free(zones->states);
    memset(zones, 0, sizeof *zones);
}

bool zone_holds(const struct zone *zone, int term)
{
    return term > 0 ? zone->state[term - 1] & ZONE_ABOVE_0 : zone->state[-term - 1] & ZONE_BELOW_1;
}
