/* SPDX-License-Identifier: MIT */
/* Search for gaps between rules. */
#include "gaps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VISITS_MAX = 100 << 20 }; /* of a rule in a zone: about a second */

struct search {
    const struct fis *fis;
    const struct zones *zones;
    int *last;               /* of each rule: the last input that it has a condition on; -1: none */
    size_t **alive;          /* for each input: the rules that may still fire */
    size_t **next;           /* the same in the zone that is looked at next */
    struct box box;          /* where to look, and on the way down where we are */
    const struct box *known; /* gaps inside of this one are not counted; NULL: none */
    struct gaps found;
    double size;    /* of found.box */
    size_t covered; /* boxes with a rule */
    size_t visits;
};

/* Share of the whole that a box takes; the thin directions of a thin one left out. */
static double size_of(const struct search *s, const struct box *box, bool *is_thin)
{
    double size = 1;

    *is_thin = false;
    for (size_t i = 0; i < s->fis->inputs; i++) {
        const struct variable *input = &s->fis->input[i];
        double width = s->zones[i].zone[box->to[i]].high - s->zones[i].zone[box->from[i]].low;
        if (width > 0) {
            size *= width / (input->max - input->min);
        } else {
            *is_thin = true;
        }
    }
    return size;
}

static bool is_inside(const struct search *s, const struct box *part, const struct box *whole)
{
    for (size_t i = 0; i < s->fis->inputs; i++) {
        if (part->from[i] < whole->from[i] || part->to[i] > whole->to[i]) {
            return false;
        }
    }
    return true;
}

static void note_gap(struct search *s)
{
    bool is_thin;
    double size = size_of(s, &s->box, &is_thin);

    if (s->known != NULL && is_inside(s, &s->box, s->known)) {
        return;
    }

    if (s->found.places++ == 0 || is_thin < s->found.is_thin ||
        (is_thin == s->found.is_thin && size > s->size)) {
        s->found.box = s->box;
        s->found.is_thin = is_thin;
        s->size = size;
    }
}

/* The rules of FROM that may still fire after input I is in ZONE, into TO. Returns their number, or
 * SIZE_MAX if one fires for certain. */
static size_t filter(struct search *s, size_t i, const struct zone *zone, const size_t *from,
                     size_t count, size_t *to)
{
    size_t kept = 0;

    s->visits += count;
    for (size_t k = 0; k < count; k++) {
        const struct rule *rule = &s->fis->rule[from[k]];
        bool is_last = s->last[from[k]] <= (int)i;
        bool holds = rule->term[i] != 0 && zone_holds(zone, rule->term[i]);

        if (rule->is_or ? holds : is_last && (holds || rule->term[i] == 0)) {
            return SIZE_MAX;
        }
        if (rule->is_or ? !is_last : holds || rule->term[i] == 0) {
            to[kept++] = from[k];
        }
    }
    return kept;
}

static bool has_condition(const struct search *s, size_t i, const size_t *rule, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        if (s->fis->rule[rule[k]].term[i] != 0) {
            return true;
        }
    }
    return false;
}

/* COUNT and OTHER_COUNT may be SIZE_MAX: a rule fires for certain. */
static bool same_rules(const size_t *rule, size_t count, const size_t *other, size_t other_count)
{
    return count == other_count &&
           (count == SIZE_MAX || memcmp(rule, other, count * sizeof *rule) == 0);
}

static void descend(struct search *s, size_t i, size_t count);

/* Goes on behind input I with KEPT rules in alive[i + 1]. */
static void go_on(struct search *s, size_t i, size_t kept)
{
    if (kept == SIZE_MAX) {
        s->covered++;
    } else if (kept == 0) {
        note_gap(s);
    } else {
        descend(s, i + 1, kept);
    }
}

/* Goes through the zones of inputs I and later, with COUNT rules in alive[i] that may fire. */
static void descend(struct search *s, size_t i, size_t count)
{
    size_t from = s->box.from[i];
    size_t to = s->box.to[i];
    size_t *rules;
    size_t kept;

    if (s->visits > VISITS_MAX) {
        s->found.incomplete = true;
        return;
    }
    if (count == 0) {
        note_gap(s);
        return;
    }
    if (!has_condition(s, i, s->alive[i],
                       count)) { /* as good as one zone; there is a later input with one */
        memcpy(s->alive[i + 1], s->alive[i], count * sizeof **s->alive);
        descend(s, i + 1, count);
        return;
    }
    /* Neighbouring zones that leave the same rules are looked at as one. */
    s->box.from[i] = from;
    kept = filter(s, i, &s->zones[i].zone[from], s->alive[i], count, s->alive[i + 1]);
    for (size_t z = from; z <= to; z++) {
        size_t more = 0;

        if (z < to) {
            more = filter(s, i, &s->zones[i].zone[z + 1], s->alive[i], count, s->next[i + 1]);
            if (same_rules(s->alive[i + 1], kept, s->next[i + 1], more)) {
                continue;
            }
        }
        s->box.to[i] = z;
        go_on(s, i, kept);
        rules = s->alive[i + 1];
        s->alive[i + 1] = s->next[i + 1];
        s->next[i + 1] = rules;
        kept = more;
        s->box.from[i] = z + 1;
    }
    s->box.from[i] = from;
    s->box.to[i] = to;
}

/* Searches BOX. */
static void look(struct search *s, const struct box *box, const bool *counts)
{
    size_t alive = 0;

    s->box = *box;
    s->covered = 0;
    for (size_t r = 0; r < s->fis->rules; r++) {
        if (!counts[r]) {
            continue;
        }
        if (s->last[r] >= 0) {
            s->alive[0][alive++] = r;
        } else if (!s->fis->rule[r].is_or) { /* no condition, and: always */
            s->covered = 1;
            return;
        }
    }
    descend(s, 0, alive);
}

/* Widens the box found, zone by zone, as long as there is no rule in the new part; then counts the
 * gaps beside it. */
static void grow(struct search *s, const struct box *all, const bool *counts)
{
    struct gaps found = s->found;

    for (size_t i = 0; i < 2 * s->fis->inputs; i++) {
        size_t input = i / 2;
        bool up = i % 2 == 1;

        for (;;) {
            struct box slab = found.box;
            if (up ? slab.to[input] == all->to[input] : slab.from[input] == 0) {
                break;
            }
            slab.from[input] = slab.to[input] = up ? slab.to[input] + 1 : slab.from[input] - 1;
            look(s, &slab, counts);
            if (s->covered > 0 || s->found.incomplete) {
                break;
            }
            if (up) {
                found.box.to[input]++;
            } else {
                found.box.from[input]--;
            }
        }
    }
    s->known = &found.box;
    s->found.places = 0;
    look(s, all, counts);
    found.places = 1 + s->found.places;
    s->known = NULL;
    s->found = found;
}

static bool allocate(struct search *s)
{
    s->last = malloc((s->fis->rules + 1) * sizeof *s->last);
    s->alive = calloc(s->fis->inputs + 1, sizeof *s->alive);
    s->next = calloc(s->fis->inputs + 1, sizeof *s->next);
    if (s->last == NULL || s->alive == NULL || s->next == NULL) {
        return false;
    }
    for (size_t i = 0; i <= s->fis->inputs; i++) {
        s->alive[i] = malloc((s->fis->rules + 1) * sizeof **s->alive);
        s->next[i] = malloc((s->fis->rules + 1) * sizeof **s->next);
        if (s->alive[i] == NULL || s->next[i] == NULL) {
            return false;
        }
    }
    for (size_t r = 0; r < s->fis->rules; r++) {
        s->last[r] = -1;
        for (size_t i = 0; i < s->fis->inputs; i++) {
            if (s->fis->rule[r].term[i] != 0) {
                s->last[r] = (int)i;
            }
        }
    }
    return true;
}

struct gaps gaps_find(const struct fis *fis, const struct zones *zones, const bool *counts)
{
    struct search s = {.fis = fis, .zones = zones};
    struct box all;

    for (size_t i = 0; i < fis->inputs; i++) {
        all.from[i] = 0;
        all.to[i] = zones[i].count - 1;
    }
    if (allocate(&s)) {
        look(&s, &all, counts);
        if (s.found.places > 0 && !s.found.incomplete) {
            grow(&s, &all, counts);
        }
    } else {
        s.found.no_memory = true;
    }
    for (size_t i = 0; s.alive != NULL && i <= fis->inputs; i++) {
        free(s.alive[i]);
        free(s.next != NULL ? s.next[i] : NULL);
    }
    free(s.alive);
    free(s.next);
    free(s.last);
    return s.found;
}
