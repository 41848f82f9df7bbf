/* SPDX-License-Identifier: MIT */
/* Reads an FLL file, fuzzylite's own language: lines "key: value", in blocks that begin with
 * InputVariable, OutputVariable or RuleBlock. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"
#include "read.h"

/* What fuzzylite 6 takes where a defuzzifier has no number behind it. */
enum { MIDPOINTS_DEFAULT = 100 };

enum block_kind { BLOCK_ENGINE, BLOCK_INPUT, BLOCK_OUTPUT, BLOCK_RULES };

struct reader {
    struct scan *scan;
    struct fis *fis;
    enum block_kind kind;
    bool is_open;              /* an "Engine:" or a block was read */
    struct variable *variable; /* of this block */
    struct block *block;
};

#define FAIL(r, ...) SCAN_FAIL((r)->scan, __VA_ARGS__)

/* --- values ---------------------------------------------------------------------------------- */

/* The rest of the line without blanks at its ends, as a copy. */
static int take_text(struct reader *r, char **text)
{
    char *at = r->scan->at + strspn(r->scan->at, " \t");
    size_t length = strlen(at);

    while (length > 0 && (at[length - 1] == ' ' || at[length - 1] == '\t')) {
        length--;
    }
    free(*text);
    *text = strndup(at, length);
    r->scan->at = at + strlen(at);
    return *text != NULL ? EXIT_FINE : FAIL(r, "out of memory");
}

static int ignore(struct reader *r)
{
    r->scan->at += strlen(r->scan->at);
    return EXIT_FINE;
}

static int take_boolean(struct reader *r, bool *value)
{
    if (!scan_name(r->scan) ||
        (strcmp(r->scan->word, "true") != 0 && strcmp(r->scan->word, "false") != 0)) {
        return FAIL(r, "expected true or false");
    }
    *value = strcmp(r->scan->word, "true") == 0;
    return EXIT_FINE;
}

static int take_enabled(struct reader *r)
{
    bool enabled = true;

    if (take_boolean(r, &enabled) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    return enabled ? EXIT_FINE
                   : not_supported(r->scan, "'enabled: false'", "remove the block from the file");
}

/* --- variables ------------------------------------------------------------------------------- */

static int take_range(struct reader *r)
{
    struct variable *variable = r->variable;

    if (scan_number(r->scan, &variable->min) != EXIT_FINE ||
        scan_number(r->scan, &variable->max) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!isfinite(variable->min) || !isfinite(variable->max)) {
        return FAIL(r, "the range has no end; write two finite numbers");
    }
    return EXIT_FINE;
}

static int take_lock_range(struct reader *r)
{
    return take_boolean(r, &r->variable->lock_range);
}

/* term: NAME CLASS NUMBER... */
static int take_term(struct reader *r)
{
    struct set *set = add_set(r->scan, r->variable);
    double parameter[FIS_PARAMETERS_MAX];
    size_t count = 0;
    char class[sizeof r->scan->word];

    if (set == NULL) {
        return EXIT_INPUT;
    }
    if (!scan_name(r->scan) || (set->name = strdup(r->scan->word)) == NULL || !scan_name(r->scan)) {
        return FAIL(r, "a term is written 'term: near Triangle 0 1 2'");
    }
    strcpy(class, r->scan->word);
    if (strcmp(class, "Function") == 0) { /* its text is no list of numbers */
        return take_fuzzylite_set(r->scan, set, class, parameter, 0);
    }
    while (!scan_end(r->scan)) {
        if (count == FIS_PARAMETERS_MAX) {
            return FAIL(r, "more than %d numbers in one set, fistab's limit", FIS_PARAMETERS_MAX);
        }
        if (scan_number(r->scan, &parameter[count]) != EXIT_FINE) {
            return EXIT_INPUT;
        }
        count++;
    }
    return take_fuzzylite_set(r->scan, set, class, parameter, count);
}

/* --- outputs --------------------------------------------------------------------------------- */

/* Nan and a number are all that "default:" takes; a C library reads both. */
static int take_default(struct reader *r)
{
    char *end;

    if (!scan_name(r->scan)) {
        return FAIL(r, "expected a number or nan behind 'default:'");
    }
    r->variable->default_value = strtod(r->scan->word, &end);
    if (*end != '\0' || isinf(r->variable->default_value)) {
        return FAIL(r, "expected a number or nan behind 'default:', found '%.60s'", r->scan->word);
    }
    return EXIT_FINE;
}

static int take_lock_previous(struct reader *r)
{
    bool lock = false;

    if (take_boolean(r, &lock) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    return lock ? not_supported(r->scan, "'lock-previous: true', a memory of the last output",
                                "give a 'default:' in its place")
                : EXIT_FINE;
}

/* The number of the norm whose FLL name stands next; -1 after a message. */
static int take_norm(struct reader *r, const struct norm_name *names, const char *key)
{
    char known[300] = "";

    if (!scan_name(r->scan)) {
        return 0; /* no value is the same as "none" */
    }
    for (int i = 0; names[i].fis != NULL; i++) {
        if (strcmp(r->scan->word, names[i].fll) == 0) {
            return i;
        }
        snprintf(known + strlen(known), sizeof known - strlen(known), " %s", names[i].fll);
    }
    FAIL(r, "%s: '%.60s' is unknown; there are:%s", key, r->scan->word, known);
    return -1;
}

static int take_aggregation(struct reader *r)
{
    int norm = take_norm(r, snorm_name, "aggregation");

    r->variable->agg_method = norm > 0 ? (enum snorm)norm : SNORM_NONE;
    r->variable->agg_line = r->scan->line;
    return norm < 0 ? EXIT_INPUT : EXIT_FINE;
}

static int take_midpoints(struct reader *r)
{
    double number = MIDPOINTS_DEFAULT;

    if (!scan_end(r->scan) && scan_number(r->scan, &number) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!(number >= 1 && number <= FIS_MIDPOINTS_MAX && number == floor(number))) {
        return FAIL(r, "a defuzzifier's resolution is a whole number from 1 to %d",
                    FIS_MIDPOINTS_MAX);
    }
    r->variable->midpoints = (size_t)number;
    return EXIT_FINE;
}

/* defuzzifier: Centroid 200, or WeightedAverage TakagiSugeno */
static int take_defuzzifier(struct reader *r)
{
    static const struct {
        const char *name;
        enum fis_defuzz method;
    } names[] = {{"Centroid", DEFUZZ_CENTROID},     {"Bisector", DEFUZZ_BISECTOR},
                 {"MeanOfMaximum", DEFUZZ_MOM},     {"LargestOfMaximum", DEFUZZ_LOM},
                 {"SmallestOfMaximum", DEFUZZ_SOM}, {"WeightedAverage", DEFUZZ_WTAVER},
                 {"WeightedSum", DEFUZZ_WTSUM}};

    if (!scan_name(r->scan)) {
        return FAIL(r, "expected a defuzzifier, as in 'defuzzifier: Centroid 100'");
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(r->scan->word, names[i].name) != 0) {
            continue;
        }
        r->variable->defuzz_method = names[i].method;
        r->variable->type = i < 5 ? FIS_MAMDANI : FIS_SUGENO;
        if (i < 5) {
            return take_midpoints(r);
        }
        if (!scan_name(r->scan) || strcmp(r->scan->word, "Automatic") == 0 ||
            strcmp(r->scan->word, "TakagiSugeno") == 0) {
            return EXIT_FINE;
        }
        return strcmp(r->scan->word, "Tsukamoto") == 0
                   ? not_supported(r->scan, "Tsukamoto inference",
                                   "use TakagiSugeno with Constant and Linear terms")
                   : FAIL(r, "'%.60s' is unknown here; use TakagiSugeno", r->scan->word);
    }
    return FAIL(r,
                "defuzzifier: '%.60s' is unknown; use Centroid, Bisector, MeanOfMaximum, "
                "LargestOfMaximum, SmallestOfMaximum, WeightedAverage or WeightedSum",
                r->scan->word);
}

/* --- rule blocks ----------------------------------------------------------------------------- */

static int take_conjunction(struct reader *r)
{
    int norm = take_norm(r, tnorm_name, "conjunction");

    r->block->and_method = norm > 0 ? (enum tnorm)norm : TNORM_NONE;
    r->block->and_line = r->scan->line;
    return norm < 0 ? EXIT_INPUT : EXIT_FINE;
}

static int take_disjunction(struct reader *r)
{
    int norm = take_norm(r, snorm_name, "disjunction");

    r->block->or_method = norm > 0 ? (enum snorm)norm : SNORM_NONE;
    r->block->or_line = r->scan->line;
    if (norm == SNORM_SUM) {
        return FAIL(r, "disjunction: UnboundedSum may exceed 1; use BoundedSum or AlgebraicSum");
    }
    return norm < 0 ? EXIT_INPUT : EXIT_FINE;
}

static int take_implication(struct reader *r)
{
    int norm = take_norm(r, tnorm_name, "implication");

    r->block->imp_method = norm > 0 ? (enum tnorm)norm : TNORM_NONE;
    r->block->imp_line = r->scan->line;
    return norm < 0 ? EXIT_INPUT : EXIT_FINE;
}

static int take_activation(struct reader *r)
{
    if (!scan_name(r->scan) || strcmp(r->scan->word, "none") == 0 ||
        strcmp(r->scan->word, "General") == 0) {
        return EXIT_FINE;
    }
    return FAIL(r,
                "the activation '%.60s': fistab does not support this; with 'General' every rule "
                "fires as strongly as its conditions hold",
                r->scan->word);
}

static int take_rule(struct reader *r)
{
    return read_rule(r->scan, r->fis, r->fis->blocks - 1);
}

/* --- lines ----------------------------------------------------------------------------------- */

struct key {
    const char *name;
    int (*take)(struct reader *r);
};

static const struct key engine_key[] = {{"description", ignore}, {NULL, NULL}};
static const struct key input_key[] = {{"description", ignore}, {"enabled", take_enabled},
                                       {"range", take_range},   {"lock-range", take_lock_range},
                                       {"term", take_term},     {NULL, NULL}};
static const struct key output_key[] = {{"description", ignore},
                                        {"enabled", take_enabled},
                                        {"range", take_range},
                                        {"lock-range", take_lock_range},
                                        {"aggregation", take_aggregation},
                                        {"accumulation", take_aggregation}, /* until fuzzylite 5 */
                                        {"defuzzifier", take_defuzzifier},
                                        {"default", take_default},
                                        {"lock-previous", take_lock_previous},
                                        {"lock-valid", take_lock_previous},
                                        {"term", take_term},
                                        {NULL, NULL}};
static const struct key rules_key[] = {{"description", ignore},
                                       {"enabled", take_enabled},
                                       {"conjunction", take_conjunction},
                                       {"disjunction", take_disjunction},
                                       {"implication", take_implication},
                                       {"activation", take_activation},
                                       {"rule", take_rule},
                                       {NULL, NULL}};

static int open_variable(struct reader *r, struct variable **list, size_t *count)
{
    r->variable = add_variable(r->scan, list, count);
    if (r->variable == NULL || take_text(r, &r->variable->name) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    for (size_t i = 0; i + 1 < *count; i++) {
        if (strcmp((*list)[i].name, r->variable->name) == 0) {
            return FAIL(r, "'%s' is defined twice, first on line %d; rename one", (*list)[i].name,
                        (*list)[i].line);
        }
    }
    return r->variable->name[0] != '\0' ? EXIT_FINE : FAIL(r, "the variable has no name");
}

/* One that begins a block; false if KEY is none of these. */
static bool is_block(struct reader *r, const char *key, int *status)
{
    r->is_open = true;
    if (strcmp(key, "Engine") == 0) {
        r->kind = BLOCK_ENGINE;
        *status = take_text(r, &r->fis->name);
    } else if (strcmp(key, "InputVariable") == 0) {
        r->kind = BLOCK_INPUT;
        *status = r->fis->rules > 0 ? FAIL(r, "a variable below the rules; move it above them")
                                    : open_variable(r, &r->fis->input, &r->fis->inputs);
    } else if (strcmp(key, "OutputVariable") == 0) {
        r->kind = BLOCK_OUTPUT;
        *status = r->fis->rules > 0 ? FAIL(r, "a variable below the rules; move it above them")
                                    : open_variable(r, &r->fis->output, &r->fis->outputs);
    } else if (strcmp(key, "RuleBlock") == 0) {
        r->kind = BLOCK_RULES;
        r->block = add_block(r->scan, r->fis);
        *status = r->block != NULL ? ignore(r) : EXIT_INPUT;
    } else {
        return false;
    }
    return true;
}

static int take_line(struct reader *r)
{
    static const struct key *const keys_of[] = {[BLOCK_ENGINE] = engine_key,
                                                [BLOCK_INPUT] = input_key,
                                                [BLOCK_OUTPUT] = output_key,
                                                [BLOCK_RULES] = rules_key};
    bool was_open = r->is_open;
    char known[200] = "";
    char key[sizeof r->scan->word];
    int status;

    if (!scan_name(r->scan) || !scan_char(r->scan, ':')) {
        return FAIL(r, "expected 'key: value', found '%.40s'", r->scan->at);
    }
    strcpy(key, r->scan->word);
    if (is_block(r, key, &status)) {
        return status;
    }
    if (!was_open) {
        return FAIL(r, "an FLL file begins with 'Engine:', not with '%.60s:'", key);
    }
    for (const struct key *at = keys_of[r->kind]; at->name != NULL; at++) {
        if (strcmp(key, at->name) == 0) {
            return at->take(r);
        }
        snprintf(known + strlen(known), sizeof known - strlen(known), " %s", at->name);
    }
    return FAIL(r, "there is no key '%.60s' here; there are:%s", key, known);
}

static int check_outputs(const struct fis *fis)
{
    if (fis->inputs == 0 || fis->outputs == 0) {
        return diag_error(fis->file, 0, "there is no %s",
                          fis->inputs == 0 ? "InputVariable" : "OutputVariable");
    }
    for (size_t o = 0; o < fis->outputs; o++) {
        if (fis->output[o].type == 0) {
            return diag_error(fis->file, fis->output[o].line,
                              "'%s' has no defuzzifier; write for instance 'defuzzifier: Centroid'",
                              fis->output[o].name);
        }
    }
    return EXIT_FINE;
}

int read_fll(struct scan *scan, struct fis *fis)
{
    struct reader r = {.scan = scan, .fis = fis};

    while (scan_line(scan, "#")) {
        if (take_line(&r) != EXIT_FINE) {
            return EXIT_INPUT;
        }
        if (!scan_end(scan)) {
            return FAIL(&r, "%s at the end of the line has no meaning here", scan_found(scan));
        }
    }
    return check_outputs(fis);
}
