/* SPDX-License-Identifier: MIT */
/* Mamdani and Sugeno inference. */
#include "infer.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "defuzz.h"
#include "diag.h"
#include "exact.h"

/* One set of one output that rules name, plain or negated. */
struct consequent {
    const struct set *set;
    bool negated;
    enum tnorm imp_method;
    double *mu;      /* at the samples; only where the engine samples */
    size_t from, to; /* samples outside [from, to) are 0 */
};

/* One outcome of a rule: rule RULE feeds consequent CONSEQUENT. */
struct clause {
    size_t rule;
    size_t consequent;
    hedges_t hedges; /* on the rule's strength */
};

struct output_plan {
    const struct variable *variable;
    struct consequent *consequent;
    size_t consequents;
    struct clause *clause; /* in the order of the rules */
    size_t clauses;
    size_t samples;
    double *x; /* where the samples are */
};

struct engine {
    const struct fis *fis;
    struct infer_options options;
    struct output_plan *plan;
    double **degree;         /* of each input's sets, at the point x */
    double *x;               /* the point the degrees are for */
    double *strength;        /* of each rule */
    double *aggregate;       /* workspace: the output set at the samples */
    struct exact_term *term; /* workspace: the clauses of one output that fire */
    size_t *term_of;         /* workspace: consequent -> its term, when they merge */
    bool *fired;
};

/* --- setting up ------------------------------------------------------------------------------ */

static size_t find_consequent(struct output_plan *plan, const struct set *set, bool negated,
                              enum tnorm imp_method)
{
    size_t i;

    for (i = 0; i < plan->consequents; i++) {
        const struct consequent *c = &plan->consequent[i];

        if (c->set == set && c->negated == negated && c->imp_method == imp_method) {
            return i;
        }
    }
    plan->consequent[i].set = set;
    plan->consequent[i].negated = negated;
    plan->consequent[i].imp_method = imp_method;
    plan->consequents++;
    return i;
}

static bool plan_clauses(const struct fis *fis, struct output_plan *plan, size_t output)
{
    plan->variable = &fis->output[output];
    plan->clause = calloc(fis->rules + 1, sizeof *plan->clause);
    plan->consequent = calloc(fis->rules + 1, sizeof *plan->consequent);
    if (plan->clause == NULL || plan->consequent == NULL) {
        return false;
    }
    for (size_t r = 0; r < fis->rules; r++) {
        const struct rule *rule = &fis->rule[r];
        int term = rule->term[fis->inputs + output];
        const struct set *set = fis_set(plan->variable, term);

        if (set == NULL) {
            continue;
        }
        plan->clause[plan->clauses].rule = r;
        plan->clause[plan->clauses].hedges = rule->hedges[fis->inputs + output];
        plan->clause[plan->clauses].consequent =
            find_consequent(plan, set, term < 0, fis->block[rule->block].imp_method);
        plan->clauses++;
    }
    return true;
}

/* Samples from end to end, in the same order of operations as MATLAB's linspace, to the last bit;
 * or, for a file of fuzzylite's, in the middle of stripes of the range, as fuzzylite does. */
static void place_samples(const struct output_plan *plan)
{
    const struct variable *variable = plan->variable;
    double span = variable->max - variable->min, count = (double)plan->samples;

    for (size_t k = 0; k < plan->samples; k++) {
        plan->x[k] = variable->midpoints > 0 ? variable->min + ((double)k + 0.5) * (span / count)
                                             : variable->min + (double)k * span / (count - 1);
    }
    if (variable->midpoints == 0) {
        plan->x[plan->samples - 1] = variable->max;
    }
}

static bool sample_consequents(struct output_plan *plan)
{
    size_t samples = plan->samples;

    plan->x = malloc(samples * sizeof *plan->x);
    if (plan->x == NULL) {
        return false;
    }
    place_samples(plan);

    for (size_t i = 0; i < plan->consequents; i++) {
        struct consequent *c = &plan->consequent[i];

        c->mu = malloc(samples * sizeof *c->mu);
        if (c->mu == NULL) {
            return false;
        }
        for (size_t k = 0; k < samples; k++) {
            double mu = set_degree(c->set, plan->x[k]);
            c->mu[k] = c->negated ? 1 - mu : mu;
        }
        for (c->to = samples; c->to > 0 && c->mu[c->to - 1] == 0; c->to--)
            ;
        for (c->from = 0; c->from < c->to && c->mu[c->from] == 0; c->from++)
            ;
    }
    return true;
}

static bool too_large(const struct fis *fis, const struct infer_options *options)
{
    size_t numbers = 0;

    for (size_t o = 0; o < fis->outputs; o++) {
        if (fis->output[o].type == FIS_MAMDANI) {
            numbers +=
                2 * fis->output[o].sets * fis->blocks * infer_samples(options, &fis->output[o]);
        }
    }
    return !options->exact && numbers > 64U << 20;
}

static bool allocate(struct engine *e)
{
    const struct fis *fis = e->fis;
    size_t consequents = 0, samples = 1;

    for (size_t o = 0; o < fis->outputs; o++) {
        size_t count = infer_samples(&e->options, &fis->output[o]);
        samples = count > samples ? count : samples;
    }
    e->plan = calloc(fis->outputs, sizeof *e->plan);
    e->degree = calloc(fis->inputs, sizeof *e->degree);
    e->x = malloc(fis->inputs * sizeof *e->x);
    e->strength = calloc(fis->rules + 1, sizeof *e->strength);
    e->aggregate = calloc(samples, sizeof *e->aggregate);
    e->term = calloc(fis->rules + 1, sizeof *e->term);
    e->fired = calloc(fis->outputs, sizeof *e->fired);
    if (e->plan == NULL || e->degree == NULL || e->x == NULL || e->strength == NULL ||
        e->aggregate == NULL || e->term == NULL || e->fired == NULL) {
        return false;
    }
    for (size_t i = 0; i < fis->inputs; i++) {
        e->x[i] = NAN; /* differs from every point */
        e->degree[i] = calloc(fis->input[i].sets + 1, sizeof **e->degree);
        if (e->degree[i] == NULL) {
            return false;
        }
    }
    for (size_t o = 0; o < fis->outputs; o++) {
        if (!plan_clauses(fis, &e->plan[o], o)) {
            return false;
        }
        e->plan[o].samples = infer_samples(&e->options, &fis->output[o]);
        if (fis->output[o].type == FIS_MAMDANI && !e->options.exact &&
            !sample_consequents(&e->plan[o])) {
            return false;
        }
        if (e->plan[o].consequents > consequents) {
            consequents = e->plan[o].consequents;
        }
    }
    e->term_of = calloc(consequents + 1, sizeof *e->term_of);
    return e->term_of != NULL;
}

size_t infer_samples(const struct infer_options *options, const struct variable *output)
{
    if (options->samples != 0) {
        return options->samples;
    }
    return output->midpoints != 0 ? output->midpoints : INFER_SAMPLES;
}

struct engine *engine_create(const struct fis *fis, const struct infer_options *options)
{
    struct engine *engine;

    if (too_large(fis, options)) {
        diag_error(fis->file, 0,
                   "%zu samples of so many output sets are beyond fistab's limit; take fewer",
                   infer_samples(options, &fis->output[0]));
        return NULL;
    }
    engine = calloc(1, sizeof *engine);
    if (engine != NULL) {
        engine->fis = fis;
        engine->options = *options;
        if (allocate(engine)) {
            return engine;
        }
        engine_free(engine);
    }
    diag_error(fis->file, 0, "out of memory");
    return NULL;
}

void engine_free(struct engine *e)
{
    if (e == NULL) {
        return;
    }
    for (size_t o = 0; e->plan != NULL && o < e->fis->outputs; o++) {
        for (size_t i = 0; i < e->plan[o].consequents; i++) {
            free(e->plan[o].consequent[i].mu);
        }
        free(e->plan[o].consequent);
        free(e->plan[o].clause);
        free(e->plan[o].x);
    }
    for (size_t i = 0; e->degree != NULL && i < e->fis->inputs; i++) {
        free(e->degree[i]);
    }
    free(e->plan);
    free(e->degree);
    free(e->x);
    free(e->strength);
    free(e->aggregate);
    free(e->term);
    free(e->term_of);
    free(e->fired);
    free(e);
}

/* --- a point --------------------------------------------------------------------------------- */

/* An input that has not moved since the last point keeps its degrees: in a table most have not. */
static void fuzzify(struct engine *e, const double *x)
{
    for (size_t i = 0; i < e->fis->inputs; i++) {
        const struct variable *input = &e->fis->input[i];
        double value = input->lock_range ? fmin(fmax(x[i], input->min), input->max) : x[i];

        if (value == e->x[i]) {
            continue;
        }
        e->x[i] = value;
        for (size_t k = 0; k < input->sets; k++) {
            const struct set *set = &input->set[k];
            e->degree[i][k] = set_degree(set, value);
        }
    }
}

/* A condition that is not used counts as 1 for and, as 0 for or: MATLAB's rule, also where a rule
 * has no condition at all. */
static double firing_strength(const struct engine *e, const struct rule *rule)
{
    const struct fis *fis = e->fis;
    const struct block *block = &fis->block[rule->block];
    double strength = rule->is_or ? 0 : 1;

    for (size_t i = 0; i < fis->inputs; i++) {
        int term = rule->term[i];
        double degree;

        if (term == 0) {
            continue;
        }
        degree = condition_degree(term, rule->hedges[i], e->degree[i][abs(term) - 1]);
        strength = rule->is_or ? snorm(block->or_method, strength, degree)
                               : tnorm(block->and_method, strength, degree);
        if (strength == 0 && !rule->is_or) {
            break;
        }
    }
    return strength * rule->weight;
}

static double sugeno_value(const struct fis *fis, const struct set *set, const double *x)
{
    double value = set->parameter[set->parameters - 1];

    if (set->kind == MF_LINEAR) {
        for (size_t i = 0; i < fis->inputs; i++) {
            value += set->parameter[i] * x[i];
        }
    }
    return value;
}

/* How strongly a clause speaks for its set; 0: its rule does not fire. */
static double clause_strength(const struct engine *e, const struct clause *clause)
{
    double strength = e->strength[clause->rule];

    return strength == 0 ? 0 : hedges_apply(clause->hedges, strength);
}

/* A rule whose outcome is 0 counts in the weights as any other: the mean is over all that fire. */
static bool eval_sugeno(const struct engine *e, const struct output_plan *plan, double *y)
{
    double sum = 0;
    double weights = 0;

    for (size_t i = 0; i < plan->clauses; i++) {
        double strength = clause_strength(e, &plan->clause[i]);
        const struct set *set = plan->consequent[plan->clause[i].consequent].set;

        if (strength == 0) {
            continue;
        }
        sum += strength * sugeno_value(e->fis, set, e->x);
        weights += strength;
    }
    if (weights == 0) {
        return false;
    }
    *y = plan->variable->defuzz_method == DEFUZZ_WTSUM ? sum : sum / weights;
    return true;
}

/* The clauses that fire, as terms. With max as aggregation, rules with the same consequent are one
 * term with the largest strength: max(min(a, m), min(b, m)) = min(max(a, b), m), and so with every
 * implication, as none of them falls when a strength rises. */
static size_t collect_terms(struct engine *e, const struct output_plan *plan)
{
    bool merge = plan->variable->agg_method == SNORM_MAX;
    size_t terms = 0;

    if (merge) {
        memset(e->term_of, 0xFF, plan->consequents * sizeof *e->term_of);
    }
    for (size_t i = 0; i < plan->clauses; i++) {
        size_t c = plan->clause[i].consequent;
        double strength = clause_strength(e, &plan->clause[i]);
        size_t at = terms;

        if (strength == 0) {
            continue;
        }
        if (merge && e->term_of[c] != SIZE_MAX) {
            at = e->term_of[c];
            e->term[at].strength = fmax(e->term[at].strength, strength);
            continue;
        }
        if (merge) {
            e->term_of[c] = at;
        }
        e->term[at].set = plan->consequent[c].set;
        e->term[at].negated = plan->consequent[c].negated;
        e->term[at].imp_method = plan->consequent[c].imp_method;
        e->term[at].consequent = c;
        e->term[at].strength = strength;
        terms++;
    }
    return terms;
}

/* One plain loop for each of the usual cases: the compiler makes vector code of them. */
static void aggregate(enum snorm agg_method, const struct consequent *c, double strength,
                      double *out)
{
    bool product = c->imp_method == TNORM_PROD;
    bool usual = product || c->imp_method == TNORM_MIN;
    /* Where a set is cut at a sample, rounding must not take the sample off the plateau: the mean
     * of maxima would move. 16 roundings: what a sample, its set and the strength of a rule make
     * where sets are no narrower than a quarter of a range that holds 0. */
    double level = strength * (1 - 16 * DBL_EPSILON);

    if (usual && agg_method == SNORM_MAX) {
        for (size_t k = c->from; k < c->to; k++) {
            double mu = product ? strength * c->mu[k] : level < c->mu[k] ? strength : c->mu[k];
            out[k] = out[k] > mu ? out[k] : mu;
        }
    } else if (usual && agg_method == SNORM_SUM) {
        for (size_t k = c->from; k < c->to; k++) {
            out[k] += product ? strength * c->mu[k] : level < c->mu[k] ? strength : c->mu[k];
        }
    } else if (usual && agg_method == SNORM_PROBOR) {
        for (size_t k = c->from; k < c->to; k++) {
            double mu = product ? strength * c->mu[k] : level < c->mu[k] ? strength : c->mu[k];
            out[k] = out[k] + mu - out[k] * mu; /* MATLAB's order: ties stay ties */
        }
    } else {
        for (size_t k = c->from; k < c->to; k++) {
            out[k] = snorm(agg_method, out[k], tnorm(c->imp_method, strength, c->mu[k]));
        }
    }
}

static bool eval_mamdani(struct engine *e, const struct output_plan *plan, double *y)
{
    size_t terms = collect_terms(e, plan);

    if (terms == 0) {
        return false;
    }
    if (e->options.exact) {
        return exact_defuzz(plan->variable, e->term, terms, y);
    }
    memset(e->aggregate, 0, plan->samples * sizeof *e->aggregate);
    for (size_t i = 0; i < terms; i++) {
        aggregate(plan->variable->agg_method, &plan->consequent[e->term[i].consequent],
                  e->term[i].strength, e->aggregate);
    }
    return defuzz(plan->variable, plan->x, e->aggregate, plan->samples, y);
}

size_t engine_eval(struct engine *e, const double *x, double *y)
{
    const struct fis *fis = e->fis;
    size_t without = 0;

    fuzzify(e, x);
    for (size_t r = 0; r < fis->rules; r++) {
        e->strength[r] = firing_strength(e, &fis->rule[r]);
    }
    for (size_t o = 0; o < fis->outputs; o++) {
        const struct output_plan *plan = &e->plan[o];

        e->fired[o] = plan->variable->type == FIS_SUGENO ? eval_sugeno(e, plan, &y[o])
                                                         : eval_mamdani(e, plan, &y[o]);
        if (!e->fired[o] && !isnan(plan->variable->default_value)) {
            y[o] = plan->variable->default_value;
            e->fired[o] = true;
        } else if (!e->fired[o]) {
            y[o] = (plan->variable->min + plan->variable->max) / 2;
            without++;
        }
        if (plan->variable->lock_range) {
            y[o] = fmin(fmax(y[o], plan->variable->min), plan->variable->max);
        }
    }
    return without;
}

bool engine_fired(const struct engine *engine, size_t output)
{
    return engine->fired[output];
}

double engine_strength(const struct engine *engine, size_t rule)
{
    return engine->strength[rule];
}
