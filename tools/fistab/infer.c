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
    double *mu;      /* at the samples; only where the engine samples */
    size_t from, to; /* samples outside [from, to) are 0 */
};

/* One clause of a rule's right side: rule RULE feeds consequent CONSEQUENT. */
struct clause {
    size_t rule;
    size_t consequent;
};

struct output_plan {
    const struct variable *variable;
    struct consequent *consequent;
    size_t consequents;
    struct clause *clause; /* in the order of the rules */
    size_t clauses;
    double *x; /* the samples */
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

/* --- setting up ---------------------------------------------------------------------------------
 */

static size_t find_consequent(struct output_plan *plan, const struct set *set, bool negated)
{
    size_t i;

    for (i = 0; i < plan->consequents; i++) {
        if (plan->consequent[i].set == set && plan->consequent[i].negated == negated) {
            return i;
        }
    }
    plan->consequent[i].set = set;
    plan->consequent[i].negated = negated;
    plan->consequents++;
    return i;
}

static bool plan_clauses(const struct fis *fis, struct output_plan *plan, size_t output)
{
    plan->variable = &fis->output[output];
    plan->clause = calloc(fis->rules + 1, sizeof *plan->clause);
    plan->consequent = calloc(2 * plan->variable->sets + 1, sizeof *plan->consequent);
    if (plan->clause == NULL || plan->consequent == NULL) {
        return false;
    }
    for (size_t r = 0; r < fis->rules; r++) {
        int term = fis->rule[r].term[fis->inputs + output];
        const struct set *set = fis_set(plan->variable, term);
        if (set == NULL) {
            continue;
        }
        plan->clause[plan->clauses].rule = r;
        plan->clause[plan->clauses].consequent = find_consequent(plan, set, term < 0);
        plan->clauses++;
    }
    return true;
}

static bool sample_consequents(struct output_plan *plan, size_t samples)
{
    const struct variable *variable = plan->variable;

    plan->x = malloc(samples * sizeof *plan->x);
    if (plan->x == NULL) {
        return false;
    }
    /* In this order of operations as MATLAB's linspace, to the last bit. */
    for (size_t k = 0; k < samples; k++) {
        plan->x[k] =
            variable->min + (double)k * (variable->max - variable->min) / (double)(samples - 1);
    }
    plan->x[samples - 1] = variable->max;

    for (size_t i = 0; i < plan->consequents; i++) {
        struct consequent *c = &plan->consequent[i];

        c->mu = malloc(samples * sizeof *c->mu);
        if (c->mu == NULL) {
            return false;
        }
        for (size_t k = 0; k < samples; k++) {
            double mu = mf_degree(c->set->kind, c->set->parameter, c->set->parameters, plan->x[k]);
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
    size_t sets = 0;

    for (size_t o = 0; o < fis->outputs; o++) {
        sets += 2 * fis->output[o].sets;
    }
    return fis->type == FIS_MAMDANI && !options->exact && sets * options->samples > 64U << 20;
}

static bool allocate(struct engine *e)
{
    const struct fis *fis = e->fis;
    size_t consequents = 0;

    e->plan = calloc(fis->outputs, sizeof *e->plan);
    e->degree = calloc(fis->inputs, sizeof *e->degree);
    e->x = malloc(fis->inputs * sizeof *e->x);
    e->strength = calloc(fis->rules + 1, sizeof *e->strength);
    e->aggregate = calloc(e->options.samples, sizeof *e->aggregate);
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
        if (fis->type == FIS_MAMDANI && !e->options.exact &&
            !sample_consequents(&e->plan[o], e->options.samples)) {
            return false;
        }
        if (e->plan[o].consequents > consequents) {
            consequents = e->plan[o].consequents;
        }
    }
    e->term_of = calloc(consequents + 1, sizeof *e->term_of);
    return e->term_of != NULL;
}

struct engine *engine_create(const struct fis *fis, const struct infer_options *options)
{
    struct engine *engine;

    if (too_large(fis, options)) {
        diag_error(fis->file, 0,
                   "%zu samples of so many output sets are beyond fistab's limit; take fewer",
                   options->samples);
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

/* --- a point ------------------------------------------------------------------------------------
 */

/* An input that has not moved since the last point keeps its degrees: in a table most have not. */
static void fuzzify(struct engine *e, const double *x)
{
    for (size_t i = 0; i < e->fis->inputs; i++) {
        const struct variable *input = &e->fis->input[i];

        if (x[i] == e->x[i]) {
            continue;
        }
        e->x[i] = x[i];
        for (size_t k = 0; k < input->sets; k++) {
            const struct set *set = &input->set[k];
            e->degree[i][k] = mf_degree(set->kind, set->parameter, set->parameters, x[i]);
        }
    }
}

/* A condition that is not used counts as 1 for and, as 0 for or: MATLAB's rule, also where a rule
 * has no condition at all. */
static double firing_strength(const struct engine *e, const struct rule *rule)
{
    const struct fis *fis = e->fis;
    double strength = rule->is_or ? 0 : 1;

    for (size_t i = 0; i < fis->inputs; i++) {
        int term = rule->term[i];
        double degree;

        if (term == 0) {
            continue;
        }
        degree = e->degree[i][abs(term) - 1];
        if (term < 0) {
            degree = 1 - degree;
        }
        if (rule->is_or) {
            strength = fis->or_method == OR_PROBOR ? strength + degree - strength * degree
                                                   : fmax(strength, degree);
        } else {
            strength = fis->and_method == AND_PROD ? strength * degree : fmin(strength, degree);
        }
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

static bool eval_sugeno(const struct engine *e, const struct output_plan *plan, const double *x,
                        double *y)
{
    double sum = 0;
    double weights = 0;

    for (size_t i = 0; i < plan->clauses; i++) {
        double strength = e->strength[plan->clause[i].rule];
        if (strength == 0) {
            continue;
        }
        sum += strength * sugeno_value(e->fis, plan->consequent[plan->clause[i].consequent].set, x);
        weights += strength;
    }
    if (weights == 0) {
        return false;
    }
    *y = e->fis->defuzz_method == DEFUZZ_WTSUM ? sum : sum / weights;
    return true;
}

/* The clauses that fire, as terms. With max as aggregation, rules with the same consequent are one
 * term with the largest strength: max(min(a, m), min(b, m)) = min(max(a, b), m), product likewise.
 */
static size_t collect_terms(struct engine *e, const struct output_plan *plan)
{
    bool merge = e->fis->agg_method == AGG_MAX;
    size_t terms = 0;

    if (merge) {
        memset(e->term_of, 0xFF, plan->consequents * sizeof *e->term_of);
    }
    for (size_t i = 0; i < plan->clauses; i++) {
        size_t c = plan->clause[i].consequent;
        double strength = e->strength[plan->clause[i].rule];
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
        e->term[at].consequent = c;
        e->term[at].strength = strength;
        terms++;
    }
    return terms;
}

static void aggregate(const struct fis *fis, const struct consequent *c, double strength,
                      double *out)
{
    bool product = fis->imp_method == IMP_PROD;
    /* Where a set is cut at a sample, rounding must not take the sample off the plateau: the mean
     * of maxima would move. 16 roundings: what a sample, its set and the strength of a rule make
     * where sets are no narrower than a quarter of a range that holds 0. */
    double level = strength * (1 - 16 * DBL_EPSILON);

    /* One plain loop for each case: the compiler makes vector code of them. */
    switch (fis->agg_method) {
    case AGG_MAX:
        for (size_t k = c->from; k < c->to; k++) {
            double mu = product ? strength * c->mu[k] : level < c->mu[k] ? strength : c->mu[k];
            out[k] = out[k] > mu ? out[k] : mu;
        }
        break;
    case AGG_SUM:
        for (size_t k = c->from; k < c->to; k++) {
            out[k] += product ? strength * c->mu[k] : level < c->mu[k] ? strength : c->mu[k];
        }
        break;
    case AGG_PROBOR:
        for (size_t k = c->from; k < c->to; k++) {
            double mu = product ? strength * c->mu[k] : level < c->mu[k] ? strength : c->mu[k];
            out[k] = out[k] + mu - out[k] * mu; /* MATLAB's order: ties stay ties */
        }
        break;
    }
}

static bool eval_mamdani(struct engine *e, const struct output_plan *plan, double *y)
{
    size_t terms = collect_terms(e, plan);
    size_t samples = e->options.samples;

    if (terms == 0) {
        return false;
    }
    if (e->options.exact) {
        return exact_defuzz(e->fis, plan->variable, e->term, terms, y);
    }
    memset(e->aggregate, 0, samples * sizeof *e->aggregate);
    for (size_t i = 0; i < terms; i++) {
        aggregate(e->fis, &plan->consequent[e->term[i].consequent], e->term[i].strength,
                  e->aggregate);
    }
    return defuzz(e->fis->defuzz_method, plan->x, e->aggregate, samples, y);
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

        e->fired[o] =
            fis->type == FIS_SUGENO ? eval_sugeno(e, plan, x, &y[o]) : eval_mamdani(e, plan, &y[o]);
        if (!e->fired[o]) {
            y[o] = (plan->variable->min + plan->variable->max) / 2;
            without++;
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
