/* SPDX-License-Identifier: MIT */
/* Reads a .fis file: sections and keys into struct fis. What the sections mean together is checked
 * at the end, so their order does not matter. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"
#include "read.h"

#define NOT_DECLARED SIZE_MAX

/* The counts that the file itself gives, to hold against what it has. */
struct declared {
    int system_line;
    int rules_line;
    size_t inputs;
    size_t outputs;
    size_t rules;
    size_t input_sets[FIS_VARIABLES_MAX];
    size_t output_sets[FIS_VARIABLES_MAX];
};

enum section { SECTION_NONE, SECTION_SYSTEM, SECTION_VARIABLE, SECTION_RULES };

struct parser {
    struct scan *scan;
    struct fis *fis;
    struct declared declared;
    enum section section;
    struct variable *variable; /* of this section */
    size_t *sets_declared;
    bool is_fuzzylite; /* written by it, as the version says */
    unsigned seen;     /* keys of this section so far, one bit each */
    /* methods of the whole system, and the lines that give them */
    struct block block;
    int type_line;
    enum fis_type type;
    enum snorm agg_method;
    int agg_line;
    enum fis_defuzz defuzz_method;
    int defuzz_line;
};

/* A key of a section, and the function that takes its value. */
struct key {
    const char *name;
    int (*take)(struct parser *p, const char *name);
};

#define FAIL(parser, ...) SCAN_FAIL((parser)->scan, __VA_ARGS__)

/* --- values ---------------------------------------------------------------------------------- */

/* "a, b or c", of COUNT words without the one at HIDDEN */
static const char *choices(const char *const *words, size_t count, size_t hidden, char *buffer,
                           size_t size)
{
    size_t used = 0;

    buffer[0] = '\0';
    for (size_t i = 1; i < count && used < size; i++) {
        const char *before = i == 1 ? "" : i + 1 == count ? " or " : ", ";

        if (i != hidden) {
            used += (size_t)snprintf(buffer + used, size - used, "%s%s", before, words[i]);
        }
    }
    return buffer;
}

/* Takes one of COUNT words in quotes, but not the one at HIDDEN; METHOD becomes its number.
 * WORDS[0] is empty, for a value ''. */
static int take_word(struct parser *p, const char *key, const char *const *words, size_t count,
                     size_t hidden, int *method)
{
    char *word;
    char buffer[240];

    if (scan_quoted(p->scan, &word) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    for (size_t i = 0; i < count; i++) {
        if ((i == 0 || i != hidden) && strcmp(word, words[i]) == 0) {
            free(word);
            *method = (int)i;
            return EXIT_FINE;
        }
    }
    FAIL(p, "%s '%s' is unknown; use %s", key, word,
         choices(words, count, hidden, buffer, sizeof buffer));
    free(word);
    return EXIT_INPUT;
}

static int take_list_word(struct parser *p, const char *key, const char *const *words, int *method)
{
    size_t count = 0;

    while (words[count] != NULL) {
        count++;
    }
    return take_word(p, key, words, count, 0, method);
}

static int take_norm(struct parser *p, const char *key, const struct norm_name *norms,
                     size_t hidden, int *method, int *line)
{
    const char *words[16];
    size_t count = 0;

    for (; norms[count].fis != NULL; count++) {
        words[count] = norms[count].fis;
    }
    *line = p->scan->line;
    return take_word(p, key, words, count, hidden, method);
}

static int take_count(struct parser *p, const char *key, size_t limit, size_t *count)
{
    double number;

    if (scan_number(p->scan, &number) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!(number >= 0 && number == floor(number))) {
        return FAIL(p, "%s=%g is no count; write a whole number from 0 on", key, number);
    }
    if (number > (double)limit) {
        return FAIL(p, "%s=%g is more than fistab's limit of %zu", key, number, limit);
    }
    *count = (size_t)number;
    return EXIT_FINE;
}

static int take_name(struct parser *p, char **name)
{
    free(*name);
    *name = NULL;
    return scan_quoted(p->scan, name);
}

/* --- [System] -------------------------------------------------------------------------------- */

static int take_system_name(struct parser *p, const char *name)
{
    (void)name;
    return take_name(p, &p->fis->name);
}

static int take_type(struct parser *p, const char *name)
{
    static const char *const others[][2] = {
        {"tsukamoto", "Tsukamoto inference"},
        {"inverse tsukamoto", "inverse Tsukamoto inference"},
        {"hybrid", "a hybrid system, with Mamdani and Sugeno outputs in one .fis"},
        {"mamdanitype2", "a type-2 system"},
        {"sugenotype2", "a type-2 system"}};
    const char *at = p->scan->at + strspn(p->scan->at, " \t");
    int type = 0;

    p->type_line = p->scan->line;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        size_t length = strlen(others[i][0]);

        if (*at != '\0' && strncmp(at + 1, others[i][0], length) == 0 && at[1 + length] == *at) {
            return not_supported(p->scan, others[i][1],
                                 i == 2 ? "give it as FLL or FCL, or as two systems"
                                        : "make it a Mamdani or a Sugeno system");
        }
    }
    if (take_list_word(p, name, fis_type_words, &type) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    p->type = (enum fis_type)type;
    return EXIT_FINE;
}

/* MATLAB's 1.0, 2.0 and 3.0 do not differ in what fistab reads. fuzzylite writes its own version,
 * 5 or 6. */
static int take_version(struct parser *p, const char *name)
{
    (void)name;
    p->is_fuzzylite = strtod(p->scan->at, NULL) >= 4;
    p->scan->at += strlen(p->scan->at);
    return EXIT_FINE;
}

static int take_inputs(struct parser *p, const char *name)
{
    return take_count(p, name, FIS_VARIABLES_MAX, &p->declared.inputs);
}

static int take_outputs(struct parser *p, const char *name)
{
    return take_count(p, name, FIS_VARIABLES_MAX, &p->declared.outputs);
}

static int take_rules(struct parser *p, const char *name)
{
    return take_count(p, name, FIS_RULES_MAX, &p->declared.rules);
}

static int take_and(struct parser *p, const char *name)
{
    int method = 0;
    int status = take_norm(p, name, tnorm_name, 0, &method, &p->block.and_line);

    p->block.and_method = (enum tnorm)method;
    return status;
}

static int take_or(struct parser *p, const char *name)
{
    int method = 0;
    /* a plain sum may exceed 1 */
    int status = take_norm(p, name, snorm_name, SNORM_SUM, &method, &p->block.or_line);

    p->block.or_method = (enum snorm)method;
    return status;
}

static int take_imp(struct parser *p, const char *name)
{
    int method = 0;
    int status = take_norm(p, name, tnorm_name, 0, &method, &p->block.imp_line);

    p->block.imp_method = (enum tnorm)method;
    return status;
}

static int take_agg(struct parser *p, const char *name)
{
    int method = 0;
    int status = take_norm(p, name, snorm_name, 0, &method, &p->agg_line);

    p->agg_method = (enum snorm)method;
    return status;
}

static int take_defuzz(struct parser *p, const char *name)
{
    int method = 0;

    p->defuzz_line = p->scan->line;
    if (take_list_word(p, name, fis_defuzz_words, &method) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    p->defuzz_method = (enum fis_defuzz)method;
    return EXIT_FINE;
}

static const struct key system_key[] = {
    {"Name", take_system_name}, {"Type", take_type},           {"Version", take_version},
    {"NumInputs", take_inputs}, {"NumOutputs", take_outputs},  {"NumRules", take_rules},
    {"AndMethod", take_and},    {"OrMethod", take_or},         {"ImpMethod", take_imp},
    {"AggMethod", take_agg},    {"DefuzzMethod", take_defuzz}, {NULL, NULL}};

static int unknown_system_key(struct parser *p)
{
    char known[256] = "";

    for (const struct key *key = system_key; key->name != NULL; key++) {
        snprintf(known + strlen(known), sizeof known - strlen(known), " %s", key->name);
    }
    return FAIL(p, "[System] has no key '%s' in MATLAB's format; its keys are:%s", p->scan->word,
                known);
}

/* --- [InputN] and [OutputN] ------------------------------------------------------------------ */

static int take_variable_name(struct parser *p, const char *name)
{
    (void)name;
    return take_name(p, &p->variable->name);
}

static int take_sets(struct parser *p, const char *name)
{
    return take_count(p, name, FIS_SETS_MAX, p->sets_declared);
}

static int range_form(struct parser *p)
{
    return FAIL(p, "a range is written Range=[0 10]");
}

static int take_range(struct parser *p, const char *name)
{
    struct variable *variable = p->variable;

    (void)name;
    if (!scan_char(p->scan, '[')) {
        return range_form(p);
    }
    if (scan_number(p->scan, &variable->min) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    scan_char(p->scan, ',');
    if (scan_number(p->scan, &variable->max) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!scan_char(p->scan, ']')) {
        return range_form(p);
    }
    if (!isfinite(variable->min) || !isfinite(variable->max)) {
        return FAIL(p, "Range=[%g %g] has no end; write two finite numbers", variable->min,
                    variable->max);
    }
    if (variable->min > variable->max) {
        return FAIL(p, "Range=[%g %g] is empty; write the smaller end first", variable->min,
                    variable->max);
    }
    return EXIT_FINE;
}

static int set_form(struct parser *p)
{
    return FAIL(p, "a set is written MF1='name':'trimf',[0 1 2]");
}

static int take_parameters(struct parser *p, struct set *set)
{
    if (!scan_char(p->scan, '[')) {
        return set_form(p);
    }
    while (!scan_char(p->scan, ']')) {
        double number;

        if (set->parameters > 0) {
            scan_char(p->scan, ',');
        }
        if (set->parameters == FIS_PARAMETERS_MAX) {
            return FAIL(p, "more than %d numbers in one set, fistab's limit", FIS_PARAMETERS_MAX);
        }
        if (scan_number(p->scan, &number) != EXIT_FINE) {
            return EXIT_INPUT;
        }
        if (!fis_grow((void **)&set->parameter, &set->parameters, set->parameters,
                      sizeof *set->parameter)) {
            return FAIL(p, "out of memory");
        }
        set->parameter[set->parameters - 1] = number;
    }
    return EXIT_FINE;
}

/* The kind of set that 'kind' names, one of MATLAB's or one that fuzzylite writes. */
static int take_kind(struct parser *p, struct set *set, const char *kind)
{
    set->kind = mf_kind_by_name(kind);
    if (set->kind != MF_UNKNOWN) {
        return take_parameters(p, set);
    }
    if (strcmp(kind, "function") == 0) {
        return not_supported(p->scan, "'function', a custom function of fuzzylite's",
                             "use one of the membership functions, or constant and linear");
    }
    if (mf_is_fuzzylite_fis(kind)) {
        double parameter[FIS_PARAMETERS_MAX + 2];
        const char *fault = NULL;
        size_t count;

        if (take_parameters(p, set) != EXIT_FINE) {
            return EXIT_INPUT;
        }
        count = set->parameters;
        memcpy(parameter, set->parameter, count * sizeof *parameter);
        set->kind = mf_from_fuzzylite(kind, parameter, &count, &fault);
        if (fault != NULL) {
            return FAIL(p, "'%s' takes %s", kind, fault);
        }
        while (set->parameters < count) {
            if (!fis_grow((void **)&set->parameter, &set->parameters, set->parameters,
                          sizeof *set->parameter)) {
                return FAIL(p, "out of memory");
            }
        }
        set->parameters = count;
        memcpy(set->parameter, parameter, count * sizeof *parameter);
        return EXIT_FINE;
    }
    return FAIL(p,
                "'%s' is not a membership function that fistab knows; use trimf, trapmf, gaussmf, "
                "gauss2mf, gbellmf, sigmf, dsigmf, psigmf, zmf, smf, pimf, linzmf, linsmf, pwlmf, "
                "fuzzylite's rampmf, rectmf, discretemf, binarymf, concavemf, cosinemf, spikemf, "
                "or for Sugeno outputs constant, linear",
                kind);
}

/* MFk='name':'kind',[numbers], the key already read; NUMBER is k. */
static int take_set(struct parser *p, long number)
{
    struct variable *variable = p->variable;
    struct set *set;
    char *kind;
    int status;

    if (number < 1 || number > FIS_SETS_MAX) {
        return FAIL(p, "MF%ld: sets are numbered from 1 to fistab's limit of %d", number,
                    FIS_SETS_MAX);
    }
    if (!fis_grow((void **)&variable->set, &variable->sets, (size_t)number - 1, sizeof *set)) {
        return FAIL(p, "out of memory");
    }
    set = &variable->set[number - 1];
    if (set->line != 0) {
        return FAIL(p, "MF%ld is defined twice, first on line %d; remove one", number, set->line);
    }
    set->line = p->scan->line;
    set->height = 1;
    if (scan_quoted(p->scan, &set->name) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!scan_char(p->scan, ':')) {
        return strchr(set->name, '\'') == NULL
                   ? set_form(p)
                   : FAIL(
                         p,
                         "two quotes '' are one quote inside a name, so this name reads \"%.40s\"; "
                         "write one quote at its end",
                         set->name);
    }
    if (scan_quoted(p->scan, &kind) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    status = scan_char(p->scan, ',') ? take_kind(p, set, kind) : set_form(p);
    free(kind);
    return status;
}

/* fuzzylite adds keys of its own. They are read over where their value changes nothing. */
static int take_fuzzylite_key(struct parser *p)
{
    static const char *const harmless[][2] = {{"Enabled", "1"},      {"Default", "nan"},
                                              {"LockRange", "0"},    {"LockValueInRange", "0"},
                                              {"LockPrevious", "0"}, {"LockValid", "0"}};

    for (size_t i = 0; i < sizeof harmless / sizeof harmless[0]; i++) {
        const char *key = harmless[i][0];
        const char *value = harmless[i][1];

        if (strcmp(p->scan->word, key) != 0) {
            continue;
        }
        if (scan_word(p->scan) && strcmp(p->scan->word, value) == 0 && scan_end(p->scan)) {
            return EXIT_FINE;
        }
        return FAIL(p, "%s is fuzzylite's, not MATLAB's; fistab reads only %s=%s here", key, key,
                    value);
    }
    return FAIL(p,
                "a variable has no key '%s' in MATLAB's format; its keys are: Name Range NumMFs "
                "MF1 MF2 and so on",
                p->scan->word);
}

static const struct key variable_key[] = {
    {"Name", take_variable_name}, {"Range", take_range}, {"NumMFs", take_sets}, {NULL, NULL}};

static int take_other_variable_key(struct parser *p)
{
    const char *word = p->scan->word;
    char *end;
    long number;

    if (strncmp(word, "MF", 2) == 0 && word[2] >= '0' && word[2] <= '9') {
        number = strtol(word + 2, &end, 10);
        if (*end == '\0') {
            return take_set(p, number);
        }
    }
    return take_fuzzylite_key(p);
}

/* --- [Rules] --------------------------------------------------------------------------------- */

/* fuzzylite and Octave write a hedge as the part of a set's number behind the point. */
static int take_hedge(struct parser *p, double number, hedges_t *hedges)
{
    static const struct {
        int hundredths;
        hedges_t hedges;
    } same[] = {{5, HEDGE_SOMEWHAT}, {20, HEDGE_VERY}, {40, HEDGE_VERY | HEDGE_VERY << HEDGE_BITS}};
    double part = (fabs(number) - floor(fabs(number))) * 100;

    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        if (fabs(part - same[i].hundredths) < 1e-6) {
            *hedges = same[i].hedges;
            return EXIT_FINE;
        }
    }
    if (fabs(part - 30) < 1e-6 || fabs(part - 1) < 1e-6 || fabs(part - 99) < 1e-6) {
        return FAIL(p,
                    "%g in a rule is a hedge that fuzzylite and Octave take for different things; "
                    "write the system in FLL, where it has a name",
                    number);
    }
    return FAIL(p,
                "%g in a rule: a set has a whole number, and .05 (somewhat), .2 (very) or .4 (very "
                "very) behind it as a hedge",
                number);
}

static int take_rule_number(struct parser *p, int *term, hedges_t *hedges)
{
    double number;

    *hedges = 0;
    if (scan_number(p->scan, &number) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (fabs(number) > FIS_SETS_MAX) {
        return FAIL(p, "there is no set %g; sets go to fistab's limit of %d", number, FIS_SETS_MAX);
    }
    if (number != floor(number) && take_hedge(p, number, hedges) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    *term = (int)number; /* towards 0 */
    if (*hedges != 0 && *term == 0) {
        return FAIL(p, "%g in a rule is a hedge without a set", number);
    }
    if (*hedges != 0 && *term < 0) { /* `not` comes last */
        *hedges |=
            *hedges >> HEDGE_BITS != 0 ? HEDGE_NOT << 2 * HEDGE_BITS : HEDGE_NOT << HEDGE_BITS;
    }
    return EXIT_FINE;
}

static int rule_form(struct parser *p)
{
    return FAIL(
        p, "a rule is written '1 2, 3 (1) : 1': sets of the inputs, sets of the outputs, (weight), "
           "1 = and or 2 = or");
}

/* `1 2, 3 (1) : 1`. How many inputs and outputs there must be is known only after the whole file.
 */
static int take_rule(struct parser *p)
{
    struct rule *rule;
    int term[2 * FIS_VARIABLES_MAX];
    hedges_t hedges[2 * FIS_VARIABLES_MAX];
    size_t terms = 0;
    size_t inputs = 0;
    double number;

    for (;;) {
        if (scan_char(p->scan, ',')) {
            if (inputs != 0 || terms == 0) {
                return rule_form(p);
            }
            inputs = terms;
        } else if (scan_char(p->scan, '(')) {
            break;
        } else if (*p->scan->at == '\0' || *p->scan->at == ')' || *p->scan->at == ':') {
            return rule_form(p);
        } else if (terms == 2 * FIS_VARIABLES_MAX) {
            return FAIL(p, "a rule has more than %d numbers, fistab's limit",
                        2 * FIS_VARIABLES_MAX);
        } else {
            if (take_rule_number(p, &term[terms], &hedges[terms]) != EXIT_FINE) {
                return EXIT_INPUT;
            }
            terms++;
        }
    }
    if (inputs == 0 || inputs == terms) {
        return rule_form(p);
    }
    rule = add_rule(p->scan, p->fis, terms);
    if (rule == NULL) {
        return EXIT_INPUT;
    }
    rule->inputs = inputs;
    rule->outputs = terms - inputs;
    memcpy(rule->term, term, terms * sizeof *rule->term);
    memcpy(rule->hedges, hedges, terms * sizeof *rule->hedges);

    if (scan_number(p->scan, &rule->weight) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!(rule->weight >= 0 && rule->weight <= 1)) {
        return FAIL(p, "a rule's weight is from 0 to 1, not %g", rule->weight);
    }
    if (!scan_char(p->scan, ')') || !scan_char(p->scan, ':')) {
        return rule_form(p);
    }
    if (scan_number(p->scan, &number) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (number != 1 && number != 2) {
        return FAIL(p, "a rule ends in ': 1' for and, ': 2' for or, not %g", number);
    }
    rule->is_or = number == 2;
    return EXIT_FINE;
}

/* --- sections -------------------------------------------------------------------------------- */

static int open_variable(struct parser *p, struct variable **list, size_t *count, size_t *declared,
                         long number)
{
    if (number < 1 || number > FIS_VARIABLES_MAX) {
        return FAIL(p, "[%s]: variables are numbered from 1 to fistab's limit of %d", p->scan->word,
                    FIS_VARIABLES_MAX);
    }
    if (!fis_grow((void **)list, count, (size_t)number - 1, sizeof **list)) {
        return FAIL(p, "out of memory");
    }
    p->variable = &(*list)[number - 1];
    p->sets_declared = &declared[number - 1];
    if (p->variable->line != 0) {
        return FAIL(p, "[%s] is there twice, first on line %d; remove one", p->scan->word,
                    p->variable->line);
    }
    p->variable->line = p->scan->line;
    p->variable->default_value = NAN;
    /* Until there is a Range, the range is an impossible one. */
    p->variable->min = INFINITY;
    p->variable->max = -INFINITY;
    p->section = SECTION_VARIABLE;
    return EXIT_FINE;
}

/* "Input", with a number or without: "Inputs" and "Input-1" are no such section. */
static bool is_variable(const char *word, const char *kind)
{
    size_t length = strlen(kind);

    return strncmp(word, kind, length) == 0 &&
           word[length + strspn(word + length, "0123456789")] == '\0';
}

static int open_section(struct parser *p)
{
    struct fis *fis = p->fis;
    const char *word = p->scan->word;

    if (!scan_word(p->scan) || !scan_char(p->scan, ']')) {
        return FAIL(p, "a section is written [System], [Input1], [Output1] or [Rules]");
    }
    p->seen = 0;
    if (strcmp(word, "System") == 0 || strcmp(word, "Rules") == 0) {
        int *line = word[0] == 'S' ? &p->declared.system_line : &p->declared.rules_line;
        if (*line != 0) {
            return FAIL(p, "[%s] is there twice, first on line %d; remove one", word, *line);
        }
        *line = p->scan->line;
        p->section = word[0] == 'S' ? SECTION_SYSTEM : SECTION_RULES;
        return EXIT_FINE;
    }
    if (is_variable(word, "Input")) {
        return open_variable(p, &fis->input, &fis->inputs, p->declared.input_sets,
                             strtol(word + strlen("Input"), NULL, 10));
    }
    if (is_variable(word, "Output")) {
        return open_variable(p, &fis->output, &fis->outputs, p->declared.output_sets,
                             strtol(word + strlen("Output"), NULL, 10));
    }
    if (strncmp(word, "Lower", 5) == 0 || strncmp(word, "Upper", 5) == 0) {
        return FAIL(p,
                    "[%s] is part of a type-2 system, which fistab does not support; make it a "
                    "type-1 system",
                    word);
    }
    return FAIL(p, "there is no section [%s]; there are [System], [Input1], [Output1] and [Rules]",
                word);
}

/* Takes Key=value of a section with KEYS; OTHER takes or refuses any other key. */
static int take_key(struct parser *p, const struct key *keys, int (*other)(struct parser *p))
{
    const struct key *key = keys;

    while (key->name != NULL && strcmp(p->scan->word, key->name) != 0) {
        key++;
    }
    if (key->name != NULL) {
        unsigned bit = 1U << (key - keys);

        if (p->seen & bit) {
            return FAIL(p, "%s is there twice in this section; remove one", key->name);
        }
        p->seen |= bit;
    }
    if (!scan_char(p->scan, '=')) {
        return FAIL(p, "expected '=' after '%s'", p->scan->word);
    }
    return key->name != NULL ? key->take(p, key->name) : other(p);
}

static int take_line(struct parser *p)
{
    if (scan_char(p->scan, '[')) {
        return open_section(p);
    }
    if (p->section == SECTION_RULES) {
        return take_rule(p);
    }
    if (!scan_word(p->scan)) {
        return FAIL(p, "expected Key=value, found '%.40s'", p->scan->at);
    }
    if (p->section == SECTION_SYSTEM) {
        return take_key(p, system_key, unknown_system_key);
    }
    if (p->section == SECTION_VARIABLE) {
        return take_key(p, variable_key, take_other_variable_key);
    }
    return FAIL(p, "a .fis file begins with [System], not '%s'", p->scan->word);
}

/* --- the whole ------------------------------------------------------------------------------- */

static int check_variables(const struct parser *p, const char *what, const struct variable *list,
                           size_t count, size_t declared, const size_t *declared_sets)
{
    const char *file = p->fis->file;

    if (count == 0) {
        return diag_error(file, 0, "there is no [%s1] section", what);
    }
    for (size_t i = 0; i < count; i++) {
        if (list[i].line == 0) {
            return diag_error(file, 0, "[%s%zu] is missing; number the sections from 1 on", what,
                              i + 1);
        }
    }
    if (declared != NOT_DECLARED && declared != count) {
        return diag_error(file, p->declared.system_line,
                          "Num%ss=%zu, but the file has %zu [%sN] sections", what, declared, count,
                          what);
    }
    for (size_t i = 0; i < count; i++) {
        const struct variable *variable = &list[i];

        if (variable->name == NULL) {
            return diag_error(file, variable->line, "[%s%zu] has no Name", what, i + 1);
        }
        if (isinf(variable->min)) {
            return diag_error(file, variable->line, "[%s%zu] has no Range", what, i + 1);
        }
        if (declared_sets[i] != NOT_DECLARED && declared_sets[i] != variable->sets) {
            return diag_error(file, variable->line, "NumMFs=%zu, but [%s%zu] has MF1 to MF%zu",
                              declared_sets[i], what, i + 1, variable->sets);
        }
        for (size_t k = 0; k < variable->sets; k++) {
            if (variable->set[k].line == 0) {
                return diag_error(file, variable->line, "MF%zu of '%s' is missing", k + 1,
                                  variable->name);
            }
        }
    }
    return EXIT_FINE;
}

static int check_rule(const struct fis *fis, const struct rule *rule, bool is_fuzzylite)
{
    if (rule->inputs != fis->inputs || rule->outputs != fis->outputs) {
        return diag_error(fis->file, rule->line,
                          "this rule has %zu inputs and %zu outputs, the system %zu and %zu; "
                          "write 0 for one that is not used",
                          rule->inputs, rule->outputs, fis->inputs, fis->outputs);
    }
    if (is_fuzzylite && rule_conditions(rule) == 0) {
        return diag_error(
            fis->file, rule->line,
            "a rule without a condition: fuzzylite writes one for a chained rule, and "
            "ignores it when it reads the file; use its FLL file");
    }
    for (size_t i = 0; i < rule->inputs + rule->outputs; i++) {
        bool is_output = i >= rule->inputs;
        const struct variable *variable =
            is_output ? &fis->output[i - rule->inputs] : &fis->input[i];
        int term = rule->term[i];

        if ((size_t)abs(term) > variable->sets) {
            return diag_error(fis->file, rule->line,
                              "this rule names set %d of '%s', which has %zu", abs(term),
                              variable->name, variable->sets);
        }
        if (is_output && rule->hedges[i] != 0) {
            return diag_error(
                fis->file, rule->line,
                "a hedge on an output: fuzzylite hedges the strength of the rule, "
                "Octave the set; write the system in FLL, or define a set of its own");
        }
        if (term < 0 && is_output && variable->type == FIS_SUGENO) {
            return diag_error(fis->file, rule->line,
                              "'not' (%d) has no meaning for a Sugeno output", term);
        }
    }
    return EXIT_FINE;
}

/* The methods of the system go to each output. */
static int check_methods(struct parser *p)
{
    const char *file = p->fis->file;
    bool weighted = p->defuzz_method == DEFUZZ_WTAVER || p->defuzz_method == DEFUZZ_WTSUM;
    bool mamdani = p->type == FIS_MAMDANI;

    if (p->type == 0) {
        return diag_error(file, p->type_line,
                          "Type is empty; write Type='mamdani' or Type='sugeno'");
    }
    if (p->defuzz_method == 0) {
        return diag_error(
            file, p->defuzz_line,
            "DefuzzMethod is empty, but the rules need it; write for instance DefuzzMethod='%s'",
            mamdani ? "centroid" : "wtaver");
    }
    if (mamdani == weighted) {
        return diag_error(file, p->defuzz_line, "DefuzzMethod '%s' is not for Type '%s'; use %s",
                          fis_defuzz_words[p->defuzz_method], fis_type_words[p->type],
                          mamdani ? "centroid, bisector, mom, lom or som" : "wtaver or wtsum");
    }
    for (size_t o = 0; o < p->fis->outputs; o++) {
        struct variable *output = &p->fis->output[o];

        output->type = p->type;
        output->agg_method = p->agg_method;
        output->agg_line = p->agg_line;
        output->defuzz_method = p->defuzz_method;
    }
    return EXIT_FINE;
}

static int check_system(struct parser *p)
{
    struct fis *fis = p->fis;
    const struct declared *declared = &p->declared;
    int *line[] = {&p->block.and_line, &p->block.or_line, &p->block.imp_line,
                   &p->agg_line,       &p->type_line,     &p->defuzz_line};

    if (declared->system_line == 0) {
        return diag_error(fis->file, 0, "there is no [System] section; is this a .fis file?");
    }
    for (size_t i = 0; i < sizeof line / sizeof line[0]; i++) {
        *line[i] = *line[i] != 0 ? *line[i] : declared->system_line;
    }
    if (check_methods(p) != EXIT_FINE ||
        check_variables(p, "Input", fis->input, fis->inputs, declared->inputs,
                        declared->input_sets) != EXIT_FINE ||
        check_variables(p, "Output", fis->output, fis->outputs, declared->outputs,
                        declared->output_sets) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (declared->rules != NOT_DECLARED && declared->rules != fis->rules) {
        return diag_error(fis->file, declared->system_line, "NumRules=%zu, but [Rules] has %zu",
                          declared->rules, fis->rules);
    }
    for (size_t i = 0; i < fis->rules; i++) {
        if (check_rule(fis, &fis->rule[i], p->is_fuzzylite) != EXIT_FINE) {
            return EXIT_INPUT;
        }
    }
    if (add_block(p->scan, fis) == NULL) {
        return EXIT_INPUT;
    }
    fis->block[0] = p->block;
    return EXIT_FINE;
}

int read_fis(struct scan *scan, struct fis *fis)
{
    /* What MATLAB's readfis takes where the file says nothing. */
    struct parser p = {
        .scan = scan,
        .fis = fis,
        .type = FIS_MAMDANI,
        .block = {.and_method = TNORM_MIN, .or_method = SNORM_MAX, .imp_method = TNORM_MIN},
        .agg_method = SNORM_MAX,
        .defuzz_method = DEFUZZ_CENTROID};

    memset(&p.declared, 0xFF, sizeof p.declared); /* every count NOT_DECLARED */
    p.declared.system_line = p.declared.rules_line = 0;
    while (scan_line(scan, "%")) {
        if (take_line(&p) != EXIT_FINE) {
            return EXIT_INPUT;
        }
        if (!scan_end(scan)) {
            return FAIL(&p, "'%.40s' at the end of the line has no meaning here", scan->at);
        }
    }
    return check_system(&p);
}
