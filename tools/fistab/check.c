/* SPDX-License-Identifier: MIT */
/* The named checks. */
#include "check.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"
#include "gaps.h"
#include "shape.h"
#include "zones.h"

struct checker {
    const struct fis *fis;
    struct findings *findings;
    struct zones *zones; /* of each input; NULL: too many to look at */
    bool *never;         /* of each rule: it cannot fire */
};

#define FOUND_ERROR(c, line, ...)                                                                  \
    ((c)->findings->errors++, diag_error((c)->fis->file, line, __VA_ARGS__))
#define FOUND_WARNING(c, line, ...)                                                                \
    ((c)->findings->warnings++, diag_warning((c)->fis->file, line, __VA_ARGS__))

/* --- words ----------------------------------------------------------------------------------- */

struct text {
    char buffer[500];
    size_t used;
};

__attribute__((format(printf, 2, 3))) static void append(struct text *text, const char *format, ...)
{
    va_list arguments;
    int length;

    va_start(arguments, format);
    length =
        vsnprintf(text->buffer + text->used, sizeof text->buffer - text->used, format, arguments);
    va_end(arguments);
    if (length > 0) {
        text->used += (size_t)length;
    }
    if (text->used >= sizeof text->buffer) {
        text->used = sizeof text->buffer - 1;
    }
}

/* "4", "4 to 5" */
static void append_stretch(struct text *text, double low, double high)
{
    append(text, "%.6g", low);
    if (high > low) {
        append(text, " to %.6g", high);
    }
}

/* --- sets ------------------------------------------------------------------------------------ */

/* Does SET have a point in its variable's range where it, or its negation, is above 0? */
static bool set_is_there(const struct variable *variable, const struct set *set, bool negated)
{
    double x[SHAPE_KINKS_MAX + 2];
    size_t count = shape_kinks(set, x);

    x[count++] = variable->min;
    x[count++] = variable->max;
    for (size_t i = 0; i < count; i++) {
        /* at the kink and on either side of it, as there may be a step */
        double step = 1e-9 * (variable->max - variable->min);
        for (int side = -1; side <= 1; side++) {
            double at = x[i] + side * step;
            double mu;
            if (at < variable->min || at > variable->max) {
                continue;
            }
            mu = set_degree(set, at);
            if (negated ? mu < 1 : mu > 0) {
                return true;
            }
        }
    }
    return false;
}

static void check_set_outside(struct checker *c, const struct variable *variable)
{
    for (size_t k = 0; k < variable->sets; k++) {
        const struct set *set = &variable->set[k];
        if (!mf_is_sugeno(set->kind) && !set_is_there(variable, set, false)) {
            FOUND_WARNING(
                c, set->line,
                "(set_outside) '%s' is 0 everywhere from %g to %g, the range of '%s'; move it "
                "or widen the range",
                set->name, variable->min, variable->max, variable->name);
        }
    }
}

static void check_set_unused(struct checker *c, const struct variable *variable, size_t term_index)
{
    bool *used = calloc(variable->sets + 1, sizeof *used);

    if (used == NULL) {
        return;
    }
    for (size_t r = 0; r < c->fis->rules; r++) {
        used[abs(c->fis->rule[r].term[term_index])] = true;
    }
    for (size_t k = 0; k < variable->sets; k++) {
        if (!used[k + 1]) {
            FOUND_WARNING(c, variable->set[k].line,
                          "(set_unused) no rule names '%s' of '%s'; write one, or remove the set",
                          variable->set[k].name, variable->name);
        }
    }
    free(used);
}

static bool rules_ask(const struct fis *fis, size_t input)
{
    for (size_t r = 0; r < fis->rules; r++) {
        if (fis->rule[r].term[input] != 0) {
            return true;
        }
    }
    return false;
}

/* Is it part of a Sugeno output's plane? */
static bool planes_use(const struct fis *fis, size_t input)
{
    for (size_t o = 0; o < fis->outputs; o++) {
        for (size_t k = 0; k < fis->output[o].sets; k++) {
            if (fis->output[o].set[k].kind == MF_LINEAR &&
                fis->output[o].set[k].parameter[input] != 0) {
                return true;
            }
        }
    }
    return false;
}

static void check_input_unused(struct checker *c, size_t i)
{
    if (!rules_ask(c->fis, i) && !planes_use(c->fis, i)) {
        FOUND_WARNING(c, c->fis->input[i].line,
                      "(input_unused) no rule asks about '%s'; remove the input",
                      c->fis->input[i].name);
    }
}

static void check_set_hole(struct checker *c, size_t i)
{
    const struct variable *input = &c->fis->input[i];
    const struct zone *widest = NULL;

    if (c->zones == NULL || !rules_ask(c->fis, i)) {
        return;
    }
    for (size_t z = 0; z < c->zones[i].count; z++) {
        const struct zone *zone = &c->zones[i].zone[z];
        bool covered = false;
        for (size_t k = 0; k < input->sets; k++) {
            covered = covered || zone->state[k] & ZONE_ABOVE_0;
        }
        if (!covered && (widest == NULL || zone->high - zone->low > widest->high - widest->low)) {
            widest = zone;
        }
    }
    if (widest != NULL) {
        struct text text = {.used = 0};
        append_stretch(&text, widest->low, widest->high);
        FOUND_WARNING(c, input->line,
                      "(set_hole) no set of '%s' covers %s; let its neighbours overlap there",
                      input->name, text.buffer);
    }
}

/* --- rules ----------------------------------------------------------------------------------- */

/* Why RULE cannot fire; NULL if it can. */
static const char *never_fires(const struct fis *fis, const struct rule *rule)
{
    size_t conditions = 0;
    size_t possible = 0;

    if (rule->weight == 0) {
        return "its weight is 0";
    }
    for (size_t i = 0; i < fis->inputs; i++) {
        const struct set *set = fis_set(&fis->input[i], rule->term[i]);
        if (set == NULL) {
            continue;
        }
        conditions++;
        possible += set_is_there(&fis->input[i], set, rule->term[i] < 0);
    }
    if (rule->is_or && conditions == 0) {
        return "it joins no condition with or";
    }
    if (rule->is_or ? possible == 0 : possible < conditions) {
        return "a condition of it holds nowhere in the range";
    }
    return NULL;
}

static void check_rule_never(struct checker *c)
{
    for (size_t r = 0; r < c->fis->rules; r++) {
        const char *why = never_fires(c->fis, &c->fis->rule[r]);

        c->never[r] = why != NULL;
        if (why != NULL) {
            FOUND_WARNING(c, c->fis->rule[r].line, "(rule_never) this rule never fires: %s", why);
        }
    }
}

static void check_rule_empty(struct checker *c)
{
    for (size_t r = 0; r < c->fis->rules; r++) {
        const struct rule *rule = &c->fis->rule[r];
        bool sets = false;
        for (size_t o = 0; o < c->fis->outputs; o++) {
            sets = sets || rule->term[c->fis->inputs + o] != 0;
        }
        if (!sets) {
            FOUND_WARNING(c, rule->line,
                          "(rule_empty) this rule sets no output; give it one, or remove it");
        }
    }
}

/* With one condition or none, and and or are the same but for "always" and "never". */
static bool joins_with_or(const struct rule *rule)
{
    return rule->is_or && rule_conditions(rule) != 1;
}

static int by_conditions(const void *a, const void *b)
{
    const struct rule *x = *(const struct rule *const *)a;
    const struct rule *y = *(const struct rule *const *)b;

    for (size_t i = 0; i < x->inputs; i++) {
        if (x->term[i] != y->term[i]) {
            return x->term[i] < y->term[i] ? -1 : 1;
        }
        if (x->hedges[i] != y->hedges[i]) {
            return x->hedges[i] < y->hedges[i] ? -1 : 1;
        }
    }
    if (joins_with_or(x) != joins_with_or(y)) {
        return joins_with_or(x) ? 1 : -1;
    }
    return 0;
}

static int by_conditions_then_line(const void *a, const void *b)
{
    const struct rule *x = *(const struct rule *const *)a;
    const struct rule *y = *(const struct rule *const *)b;
    int order = by_conditions(a, b);

    return order != 0 ? order : (x->line > y->line) - (x->line < y->line);
}

static void compare_rules(struct checker *c, const struct rule *first, const struct rule *second)
{
    bool same = true;

    for (size_t o = 0; o < c->fis->outputs; o++) {
        int before = first->term[c->fis->inputs + o];
        int now = second->term[c->fis->inputs + o];

        same = same && before == now &&
               first->hedges[c->fis->inputs + o] == second->hedges[c->fis->inputs + o];
        if (before != 0 && now != 0 && before != now) {
            FOUND_ERROR(c, second->line,
                        "(rule_contradiction) same conditions as the rule of line %d, but another "
                        "outcome for '%s'; remove one",
                        first->line, c->fis->output[o].name);
            return;
        }
    }
    if (same) {
        FOUND_WARNING(c, second->line,
                      "(rule_twice) this rule stands already on line %d; remove one", first->line);
    }
}

static void check_rule_pairs(struct checker *c)
{
    size_t rules = c->fis->rules;
    const struct rule **sorted = malloc((rules + 1) * sizeof *sorted);
    size_t count = 0;

    if (sorted == NULL) {
        return;
    }
    for (size_t r = 0; r < rules; r++) {
        if (c->fis->rule[r].weight > 0) {
            sorted[count++] = &c->fis->rule[r];
        }
    }
    qsort(sorted, count, sizeof *sorted, by_conditions_then_line);
    for (size_t k = 1; k < count; k++) {
        if (by_conditions(&sorted[k - 1], &sorted[k]) == 0) {
            compare_rules(c, sorted[k - 1], sorted[k]);
        }
    }
    free(sorted);
}

/* --- gaps ------------------------------------------------------------------------------------ */

/* "distance_m is 4 to 5 (normal) and closing_mps is 20 to 35 (medium, large)" */
static void describe_box(const struct checker *c, const struct box *box, struct text *text)
{
    for (size_t i = 0; i < c->fis->inputs; i++) {
        const struct variable *input = &c->fis->input[i];
        const struct zone *low = &c->zones[i].zone[box->from[i]];
        const struct zone *high = &c->zones[i].zone[box->to[i]];
        const char *between = " (";

        if (low->low == input->min && high->high == input->max) {
            continue;
        }
        append(text, "%s%s is ", text->used == 0 ? " where " : " and ", input->name);
        append_stretch(text, low->low, high->high);
        for (size_t k = 0; k < input->sets; k++) {
            bool there = false;
            for (size_t z = box->from[i]; z <= box->to[i]; z++) {
                there = there || c->zones[i].zone[z].state[k] & ZONE_ABOVE_0;
            }
            if (there) {
                append(text, "%s%s", between, input->set[k].name);
                between = ", ";
            }
        }
        append(text, "%s", between[0] == ',' ? ")" : "");
    }
    if (text->used == 0) {
        append(text, " anywhere");
    }
}

static void check_rule_gap(struct checker *c, size_t o, bool *counts)
{
    const struct variable *output = &c->fis->output[o];
    struct text where = {.used = 0};
    struct text more = {.used = 0};
    struct gaps gaps;

    for (size_t r = 0; r < c->fis->rules; r++) {
        int term = c->fis->rule[r].term[c->fis->inputs + o];
        const struct set *set = fis_set(output, term);
        counts[r] = set != NULL && !c->never[r] &&
                    (mf_is_sugeno(set->kind) || set_is_there(output, set, term < 0));
    }
    gaps = gaps_find(c->fis, c->zones, counts);
    if (gaps.no_memory || gaps.incomplete) {
        FOUND_WARNING(
            c, output->line,
            "(rule_gap) too many combinations to look for gaps in the rules for '%s'; use "
            "fewer sets or inputs",
            output->name);
    }
    if (gaps.places == 0) {
        return;
    }
    describe_box(c, &gaps.box, &where);
    if (gaps.places > 1) {
        append(&more, ", and elsewhere");
    }
    if (gaps.is_thin) {
        FOUND_WARNING(c, output->line,
                      "(rule_gap) no rule for '%s' fires%s%s; add a rule, or let the sets overlap",
                      output->name, where.buffer, more.buffer);
    } else {
        FOUND_ERROR(c, output->line,
                    "(rule_gap) no rule for '%s' fires%s%s; add a rule, or let the sets overlap",
                    output->name, where.buffer, more.buffer);
    }
}

static void check_rule_gaps(struct checker *c)
{
    bool *counts = calloc(c->fis->rules + 1, sizeof *counts);

    if (counts != NULL && c->zones != NULL) {
        for (size_t o = 0; o < c->fis->outputs; o++) {
            check_rule_gap(c, o, counts);
        }
    }
    free(counts);
}

/* --- all ------------------------------------------------------------------------------------- */

static void make_zones(struct checker *c)
{
    c->zones = calloc(c->fis->inputs, sizeof *c->zones);
    for (size_t i = 0; c->zones != NULL && i < c->fis->inputs; i++) {
        if (zones_make(&c->fis->input[i], &c->zones[i]) == ZONES_MADE) {
            continue;
        }
        FOUND_WARNING(c, c->fis->input[i].line,
                      "(rule_gap) '%s' has too many sets to look for gaps; use fewer",
                      c->fis->input[i].name);
        while (i-- > 0) {
            zones_free(&c->zones[i]);
        }
        free(c->zones);
        c->zones = NULL;
    }
}

void check_fis(const struct fis *fis, struct findings *findings)
{
    struct checker c = {.fis = fis, .findings = findings};

    c.never = calloc(fis->rules + 1, sizeof *c.never);
    if (c.never == NULL) {
        findings->errors++;
        diag_error(fis->file, 0, "out of memory");
        return;
    }
    make_zones(&c);
    for (size_t i = 0; i < fis->inputs; i++) {
        check_set_outside(&c, &fis->input[i]);
        check_input_unused(&c, i);
        check_set_unused(&c, &fis->input[i], i);
        check_set_hole(&c, i);
    }
    for (size_t o = 0; o < fis->outputs; o++) {
        check_set_outside(&c, &fis->output[o]);
        check_set_unused(&c, &fis->output[o], fis->inputs + o);
    }
    check_rule_never(&c);
    check_rule_empty(&c);
    check_rule_pairs(&c);
    check_rule_gaps(&c);
    for (size_t i = 0; c.zones != NULL && i < fis->inputs; i++) {
        zones_free(&c.zones[i]);
    }
    free(c.zones);
    free(c.never);
}
