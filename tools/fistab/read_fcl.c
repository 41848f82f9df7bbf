/* SPDX-License-Identifier: MIT */
/* Reads an FCL file, the Fuzzy Control Language of IEC 61131-7, with the functions and methods that
 * fuzzylite adds. The ends of lines mean nothing, a missing ; is no error, and capitals do not
 * matter in keywords. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "diag.h"
#include "read.h"

/* What fuzzylite 6 takes for a METHOD that integrates. */
enum { MIDPOINTS = 100 };

struct reader {
    struct scan *scan;
    struct fis *fis;
    struct variable *variable; /* of this FUZZIFY or DEFUZZIFY */
    bool has_range;
    enum snorm agg_method; /* ACCU of a rule block, which is for all outputs */
    int agg_line;
};

struct key {
    const char *name;
    int (*take)(struct reader *r);
};

#define FAIL(r, ...) SCAN_FAIL((r)->scan, __VA_ARGS__)

/* --- values ---------------------------------------------------------------------------------- */

/* The value of a key begins with : or := */
static int expect_colon(struct reader *r)
{
    if (!scan_char(r->scan, ':')) {
        return FAIL(r, "expected ':' or ':=', found %s", scan_found(r->scan));
    }
    scan_char(r->scan, '=');
    return EXIT_FINE;
}

static int take_text(struct reader *r, char **text)
{
    if (!scan_name(r->scan)) {
        return FAIL(r, "expected a name, found %s", scan_found(r->scan));
    }
    *text = strdup(r->scan->word);
    return *text != NULL ? EXIT_FINE : FAIL(r, "out of memory");
}

/* Index of the next name in COUNT words, whatever the capitals; -1 after a message. */
static int take_choice(struct reader *r, const char *key, const char *const *words, size_t count)
{
    char known[200] = "";

    if (expect_colon(r) != EXIT_FINE) {
        return -1;
    }
    if (!scan_name(r->scan)) {
        FAIL(r, "%s: expected a name, found %s", key, scan_found(r->scan));
        return -1;
    }
    for (size_t i = 0; i < count; i++) {
        if (strcasecmp(r->scan->word, words[i]) == 0) {
            return (int)i;
        }
        snprintf(known + strlen(known), sizeof known - strlen(known), " %s", words[i]);
    }
    FAIL(r, "%s: '%.60s' is unknown; there are:%s", key, r->scan->word, known);
    return -1;
}

static int take_norm(struct reader *r, const char *key, const struct norm_name *names)
{
    const char *words[16];
    size_t count = 0;

    for (; names[count].fis != NULL; count++) {
        words[count] = names[count].fcl;
    }
    return take_choice(r, key, words, count);
}

/* RANGE := (0 .. 10), also (0..10) */
static int take_range(struct reader *r)
{
    struct variable *variable = r->variable;
    const char *from;
    char *dots, *end;

    if (expect_colon(r) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!scan_char(r->scan, '(') || (dots = strstr(r->scan->at, "..")) == NULL) {
        return FAIL(r, "a range is written RANGE := (0 .. 10);");
    }
    from = r->scan->at;
    variable->min = strtod(from, &end);
    if (end == from || end > dots + 1 || end + strspn(end, " \t") < dots) {
        return FAIL(r, "a range is written RANGE := (0 .. 10);");
    }
    r->scan->at = dots + 2;
    if (scan_number(r->scan, &variable->max) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!scan_char(r->scan, ')')) {
        return FAIL(r, "a range is written RANGE := (0 .. 10);");
    }
    if (!isfinite(variable->min) || !isfinite(variable->max) ||
        fabs(variable->min) > FIS_NUMBER_MAX) {
        return FAIL(r, "the range has no end; write two finite numbers");
    }
    r->has_range = true;
    return EXIT_FINE;
}

static bool number_follows(struct reader *r)
{
    const char *at;

    scan_char(r->scan, ',');
    scan_char(r->scan, '\0'); /* skips blanks only: the text ends there */
    at = r->scan->at;
    at += *at == '-' || *at == '+';
    return isdigit((unsigned char)*at) || *at == '.' || strncasecmp(at, "inf", 3) == 0;
}

/* (x, y) (x, y) ... as numbers */
static int take_points(struct reader *r, double *parameter, size_t *count)
{
    while (scan_char(r->scan, '(')) {
        if (*count + 2 > FIS_PARAMETERS_MAX) {
            return FAIL(r, "more than %d numbers in one set, fistab's limit", FIS_PARAMETERS_MAX);
        }
        if (scan_number(r->scan, &parameter[*count]) != EXIT_FINE) {
            return EXIT_INPUT;
        }
        if (!scan_char(r->scan, ',')) {
            return FAIL(r, "a point is written (x, y), found %s", scan_found(r->scan));
        }
        if (scan_number(r->scan, &parameter[*count + 1]) != EXIT_FINE) {
            return EXIT_INPUT;
        }
        if (!scan_char(r->scan, ')')) {
            return FAIL(r, "a point is written (x, y), found %s", scan_found(r->scan));
        }
        *count += 2;
    }
    return EXIT_FINE;
}

/* TERM near := (0, 1) (5, 0);   TERM near := Triangle 0 2 5;   TERM slow := 20; */
static int take_term(struct reader *r)
{
    struct set *set = add_set(r->scan, r->variable);
    double parameter[FIS_PARAMETERS_MAX];
    char class[sizeof r->scan->word] = "Constant";
    size_t count = 0;

    if (set == NULL || take_text(r, &set->name) != EXIT_FINE || expect_colon(r) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    scan_char(r->scan, '\0');
    if (*r->scan->at == '(') {
        strcpy(class, "Discrete");
        if (take_points(r, parameter, &count) != EXIT_FINE) {
            return EXIT_INPUT;
        }
    } else if (!number_follows(r)) {
        if (!scan_name(r->scan)) {
            return FAIL(r, "expected a function or a number, found %s", scan_found(r->scan));
        }
        strcpy(class, r->scan->word);
    }
    while (number_follows(r)) {
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

static int take_enabled(struct reader *r)
{
    static const char *const words[] = {"TRUE", "FALSE"};
    int choice = take_choice(r, "ENABLED", words, 2);

    if (choice == 1) {
        return not_supported(r->scan, "'ENABLED : FALSE'", "remove the block from the file");
    }
    return choice == 0 ? EXIT_FINE : EXIT_INPUT;
}

/* --- DEFUZZIFY ------------------------------------------------------------------------------- */

static int take_accu(struct reader *r)
{
    int norm = take_norm(r, "ACCU", snorm_name);

    r->variable->agg_method = norm > 0 ? (enum snorm)norm : SNORM_NONE;
    r->variable->agg_line = r->scan->line;
    return norm < 0 ? EXIT_INPUT : EXIT_FINE;
}

static int take_method(struct reader *r)
{
    static const char *const words[] = {"COG", "COA", "MM", "RM", "LM", "COGS", "COGSS"};
    static const enum fis_defuzz method[] = {DEFUZZ_CENTROID, DEFUZZ_BISECTOR, DEFUZZ_MOM,
                                             DEFUZZ_LOM,      DEFUZZ_SOM,      DEFUZZ_WTAVER,
                                             DEFUZZ_WTSUM};
    int choice = take_choice(r, "METHOD", words, sizeof words / sizeof words[0]);

    if (choice < 0) {
        return EXIT_INPUT;
    }
    r->variable->defuzz_method = method[choice];
    r->variable->type = choice < 5 ? FIS_MAMDANI : FIS_SUGENO;
    r->variable->midpoints = choice < 5 ? MIDPOINTS : 0;
    return EXIT_FINE;
}

static int refuse_memory(struct reader *r, const char *what)
{
    return not_supported(r->scan, what, "give a number as DEFAULT in its place");
}

/* DEFAULT := 0; or DEFAULT := nan | NC; */
static int take_default(struct reader *r)
{
    char *end;

    if (expect_colon(r) != EXIT_FINE || !scan_name(r->scan)) {
        return FAIL(r, "a default is written DEFAULT := 0;");
    }
    r->variable->default_value = strtod(r->scan->word, &end);
    if (strcasecmp(r->scan->word, "NC") == 0 || scan_char(r->scan, '|')) {
        return refuse_memory(r, "'NC', a memory of the last output");
    }
    if (*end != '\0' || isinf(r->variable->default_value)) {
        return FAIL(r, "expected a number or nan behind DEFAULT, found '%.60s'", r->scan->word);
    }
    return EXIT_FINE;
}

static int take_lock(struct reader *r)
{
    static const char *const words[] = {"PREVIOUS", "RANGE"};
    int choice = take_choice(r, "LOCK", words, 2);

    if (choice == 0 || (choice == 1 && scan_char(r->scan, '|'))) {
        return refuse_memory(r, "'LOCK : PREVIOUS', a memory of the last output");
    }
    r->variable->lock_range = choice == 1;
    return choice == 1 ? EXIT_FINE : EXIT_INPUT;
}

/* --- RULEBLOCK ------------------------------------------------------------------------------- */

static struct block *this_block(struct reader *r)
{
    return &r->fis->block[r->fis->blocks - 1];
}

static int take_and(struct reader *r)
{
    int norm = take_norm(r, "AND", tnorm_name);

    this_block(r)->and_method = norm > 0 ? (enum tnorm)norm : TNORM_NONE;
    this_block(r)->and_line = r->scan->line;
    return norm < 0 ? EXIT_INPUT : EXIT_FINE;
}

static int take_or(struct reader *r)
{
    int norm = take_norm(r, "OR", snorm_name);

    this_block(r)->or_method = norm > 0 ? (enum snorm)norm : SNORM_NONE;
    this_block(r)->or_line = r->scan->line;
    if (norm == SNORM_SUM) {
        return FAIL(r, "OR: SUM may exceed 1; use BSUM or ASUM");
    }
    return norm < 0 ? EXIT_INPUT : EXIT_FINE;
}

static int take_act(struct reader *r)
{
    int norm = take_norm(r, "ACT", tnorm_name);

    this_block(r)->imp_method = norm > 0 ? (enum tnorm)norm : TNORM_NONE;
    this_block(r)->imp_line = r->scan->line;
    return norm < 0 ? EXIT_INPUT : EXIT_FINE;
}

/* IEC 61131-7 has ACCU here, fuzzylite in DEFUZZIFY. */
static int take_common_accu(struct reader *r)
{
    int norm = take_norm(r, "ACCU", snorm_name);

    if (norm > 0 && r->agg_method != SNORM_NONE && r->agg_method != (enum snorm)norm) {
        return FAIL(r, "another ACCU than on line %d; write ACCU into each DEFUZZIFY in its place",
                    r->agg_line);
    }
    r->agg_method = norm > 0 ? (enum snorm)norm : r->agg_method;
    r->agg_line = r->scan->line;
    return norm < 0 ? EXIT_INPUT : EXIT_FINE;
}

/* RULE 1 : IF ... ; the number or name is optional */
static int take_rule(struct reader *r)
{
    if (!scan_char(r->scan, ':')) {
        if (!scan_name(r->scan) || !scan_char(r->scan, ':')) {
            return FAIL(r, "a rule is written RULE 1 : IF x IS near THEN y IS low;");
        }
    }
    return read_rule(r->scan, r->fis, r->fis->blocks - 1);
}

/* --- blocks ---------------------------------------------------------------------------------- */

static const struct key fuzzify_key[] = {
    {"RANGE", take_range}, {"ENABLED", take_enabled}, {"TERM", take_term}, {NULL, NULL}};
static const struct key defuzzify_key[] = {
    {"RANGE", take_range}, {"ENABLED", take_enabled}, {"TERM", take_term}, {"METHOD", take_method},
    {"ACCU", take_accu},   {"DEFAULT", take_default}, {"LOCK", take_lock}, {NULL, NULL}};
static const struct key rules_key[] = {
    {"AND", take_and},         {"OR", take_or},     {"ACT", take_act}, {"ACCU", take_common_accu},
    {"ENABLED", take_enabled}, {"RULE", take_rule}, {NULL, NULL}};

static void skip_semicolons(struct reader *r)
{
    while (scan_char(r->scan, ';')) {
    }
}

/* Takes keys until END. */
static int take_keys(struct reader *r, const struct key *keys, const char *end)
{
    for (;;) {
        const struct key *key = keys;
        char known[200] = "";

        skip_semicolons(r);
        if (!scan_name(r->scan)) {
            return FAIL(r, "expected %s, found %s", end, scan_found(r->scan));
        }
        if (strcasecmp(r->scan->word, end) == 0) {
            return EXIT_FINE;
        }
        for (; key->name != NULL && strcasecmp(r->scan->word, key->name) != 0; key++) {
            snprintf(known + strlen(known), sizeof known - strlen(known), " %s", key->name);
        }
        if (key->name == NULL) {
            return FAIL(r, "there is no '%.60s' here; there are:%s %s", r->scan->word, known, end);
        }
        if (key->take(r) != EXIT_FINE) {
            return EXIT_INPUT;
        }
    }
}

static int find_variable(struct reader *r, struct variable *list, size_t count, const char *section)
{
    if (!scan_name(r->scan)) {
        return FAIL(r, "expected the name of a variable, found %s", scan_found(r->scan));
    }
    for (size_t i = 0; i < count; i++) {
        if (strcmp(list[i].name, r->scan->word) == 0) {
            r->variable = &list[i];
            r->variable->line = r->scan->line;
            r->variable->agg_line = r->scan->line;
            r->has_range = false;
            return r->variable->sets == 0 ? EXIT_FINE
                                          : FAIL(r, "a second block for '%s'", list[i].name);
        }
    }
    return FAIL(r, "'%.60s' does not stand in %s", r->scan->word, section);
}

/* IEC 61131-7 has no RANGE for inputs: they go from the outermost point to the other. */
static int derive_range(struct reader *r)
{
    struct variable *variable = r->variable;
    bool known = variable->sets > 0;
    double min = INFINITY, max = -INFINITY;

    for (size_t k = 0; k < variable->sets; k++) {
        const struct set *set = &variable->set[k];

        known = known && (set->kind == MF_PWLMF || set->kind == MF_CONSTANT) && set->parameters > 0;
        for (size_t i = 0; known && i < set->parameters; i += 2) {
            min = fmin(min, set->parameter[i]);
            max = fmax(max, set->parameter[i]);
        }
    }
    if (!known) {
        return FAIL(r, "'%s' has no RANGE; write for instance RANGE := (0 .. 10);", variable->name);
    }
    variable->min = min;
    variable->max = max;
    return EXIT_FINE;
}

static int take_fuzzify(struct reader *r)
{
    if (find_variable(r, r->fis->input, r->fis->inputs, "VAR_INPUT") != EXIT_FINE ||
        take_keys(r, fuzzify_key, "END_FUZZIFY") != EXIT_FINE) {
        return EXIT_INPUT;
    }
    return r->has_range ? EXIT_FINE : derive_range(r);
}

static int take_defuzzify(struct reader *r)
{
    if (find_variable(r, r->fis->output, r->fis->outputs, "VAR_OUTPUT") != EXIT_FINE ||
        take_keys(r, defuzzify_key, "END_DEFUZZIFY") != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (r->variable->type == 0) {
        return FAIL(r, "'%s' has no METHOD; write for instance METHOD : COG;", r->variable->name);
    }
    return r->has_range ? EXIT_FINE : derive_range(r);
}

/* The name of the block stands on its line, and may be missing. */
static int take_rule_block(struct reader *r)
{
    r->scan->at += strspn(r->scan->at, " \t");
    if (!isspace((unsigned char)*r->scan->at)) {
        const char *word = r->scan->at;
        size_t length = strcspn(word, " \t\r\n:;");
        size_t blanks = strspn(word + length, " \t");

        if (word[length + blanks] != ':' && strncasecmp(word, "RULE", 4) != 0) {
            r->scan->at += length;
        }
    }
    if (add_block(r->scan, r->fis) == NULL) {
        return EXIT_INPUT;
    }
    return take_keys(r, rules_key, "END_RULEBLOCK");
}

/* temperature, pressure : REAL; */
static int take_variables(struct reader *r, struct variable **list, size_t *count)
{
    for (;;) {
        struct variable *variable;

        skip_semicolons(r);
        if (!scan_name(r->scan)) {
            return FAIL(r, "expected END_VAR, found %s", scan_found(r->scan));
        }
        if (strcasecmp(r->scan->word, "END_VAR") == 0) {
            return EXIT_FINE;
        }
        for (size_t i = 0; i < r->fis->inputs + r->fis->outputs; i++) {
            const struct variable *other =
                i < r->fis->inputs ? &r->fis->input[i] : &r->fis->output[i - r->fis->inputs];
            if (strcmp(other->name, r->scan->word) == 0) {
                return FAIL(r, "'%s' is defined twice, first on line %d; rename one", other->name,
                            other->line);
            }
        }
        variable = add_variable(r->scan, list, count);
        if (variable == NULL || (variable->name = strdup(r->scan->word)) == NULL) {
            return FAIL(r, "out of memory");
        }
        if (scan_char(r->scan, ',')) {
            continue;
        }
        if (!scan_char(r->scan, ':') || !scan_name(r->scan)) {
            return FAIL(r, "a variable is written 'name : REAL;'");
        }
    }
}

static int take_inputs(struct reader *r)
{
    return take_variables(r, &r->fis->input, &r->fis->inputs);
}

static int take_outputs(struct reader *r)
{
    return take_variables(r, &r->fis->output, &r->fis->outputs);
}

static const struct key section_key[] = {
    {"VAR_INPUT", take_inputs},    {"VAR_OUTPUT", take_outputs},   {"FUZZIFY", take_fuzzify},
    {"DEFUZZIFY", take_defuzzify}, {"RULEBLOCK", take_rule_block}, {NULL, NULL}};

/* --- the whole ------------------------------------------------------------------------------- */

static int check_variables(const struct reader *r)
{
    struct fis *fis = r->fis;

    if (fis->inputs == 0 || fis->outputs == 0) {
        return diag_error(fis->file, 0, "there is no variable in %s",
                          fis->inputs == 0 ? "VAR_INPUT" : "VAR_OUTPUT");
    }
    for (size_t i = 0; i < fis->inputs; i++) {
        if (fis->input[i].sets == 0 && fis->input[i].min == fis->input[i].max) {
            return diag_error(fis->file, fis->input[i].line, "there is no FUZZIFY %s",
                              fis->input[i].name);
        }
    }
    for (size_t o = 0; o < fis->outputs; o++) {
        struct variable *output = &fis->output[o];

        if (output->type == 0) {
            return diag_error(fis->file, output->line, "there is no DEFUZZIFY %s", output->name);
        }
        if (output->agg_method == SNORM_NONE) {
            output->agg_method = r->agg_method;
        }
    }
    return EXIT_FINE;
}

int read_fcl(struct scan *scan, struct fis *fis)
{
    struct reader r = {.scan = scan, .fis = fis};

    scan_free_form(scan);
    if (!scan_name(scan) || strcasecmp(scan->word, "FUNCTION_BLOCK") != 0) {
        return FAIL(&r, "an FCL file begins with FUNCTION_BLOCK");
    }
    scan->at += strspn(scan->at, " \t");
    fis->name = strndup(scan->at, strcspn(scan->at, "\r\n"));
    if (fis->name == NULL) {
        return FAIL(&r, "out of memory");
    }
    scan->at += strcspn(scan->at, "\r\n");
    if (take_keys(&r, section_key, "END_FUNCTION_BLOCK") != EXIT_FINE) {
        return EXIT_INPUT;
    }
    skip_semicolons(&r);
    if (*scan->at != '\0') {
        return FAIL(&r, "a second FUNCTION_BLOCK or other text: fistab does not support this; give "
                        "it a file of its own");
    }
    return check_variables(&r);
}
