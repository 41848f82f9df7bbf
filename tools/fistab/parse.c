/* Reads a .fis file: sections and keys into struct fis. What the parts mean together is checked by
 * fis_validate() afterwards, so the order of sections does not matter. */
#include "fis.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "crc.h"
#include "diag.h"
#include "fis_internal.h"
#include "scan.h"

const char *const fis_type_words[] = {"", "mamdani", "sugeno", NULL};
const char *const fis_and_words[] = {"", "min", "prod", NULL};
const char *const fis_or_words[] = {"", "max", "probor", NULL};
const char *const fis_imp_words[] = {"", "min", "prod", NULL};
const char *const fis_agg_words[] = {"", "max", "sum", "probor", NULL};
const char *const fis_defuzz_words[] = {"",    "centroid", "bisector", "mom", "lom",
                                        "som", "wtaver",   "wtsum",    NULL};

enum section { SECTION_NONE, SECTION_SYSTEM, SECTION_VARIABLE, SECTION_RULES };

struct parser {
    struct scan scan;
    struct fis *fis;
    struct declared *declared;
    enum section section;
    struct variable *variable;
    size_t *sets_declared;
    unsigned seen; /* keys of this section so far, one bit each */
};

#define FAIL(parser, ...) diag_error((parser)->scan.file, (parser)->scan.line, __VA_ARGS__)

/* Makes room for element INDEX (from 0) of an array of ITEM bytes each, zeroed. */
static int grow(struct parser *p, void **array, size_t *count, size_t index, size_t item)
{
    size_t room = *count == 0 ? 0 : 8;
    char *bigger;

    if (index < *count) {
        return EXIT_FINE;
    }
    while (room < *count) {
        room *= 2;
    }
    if (index >= room) {
        room = room == 0 ? 8 : room;
        while (room <= index) {
            room *= 2;
        }
        bigger = realloc(*array, room * item);
        if (bigger == NULL) {
            return FAIL(p, "out of memory");
        }
        *array = bigger;
    }
    memset((char *)*array + *count * item, 0, (index + 1 - *count) * item);
    *count = index + 1;
    return EXIT_FINE;
}

/* "a, b or c" of a method's words. */
static const char *choices(const char *const *words, char *buffer, size_t size)
{
    buffer[0] = '\0';
    for (size_t i = 1; words[i] != NULL; i++) {
        size_t used = strlen(buffer);
        snprintf(buffer + used, size - used, "%s%s",
                 i == 1         ? ""
                 : words[i + 1] ? ", "
                                : " or ",
                 words[i]);
    }
    return buffer;
}

/* An empty string leaves the method unset, as fuzzylite writes it. */
static int take_method(struct parser *p, const char *key, const char *const *words, int *method)
{
    char *word;
    char buffer[80];

    if (scan_quoted(&p->scan, &word) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    for (*method = 0; words[*method] != NULL; (*method)++) {
        if (strcmp(word, words[*method]) == 0) {
            break;
        }
    }
    if (words[*method] == NULL) {
        FAIL(p, "%s '%s' is not one of MATLAB's that fistab knows: use %s", key, word,
             choices(words, buffer, sizeof buffer));
        free(word);
        return EXIT_INPUT;
    }
    free(word);
    return EXIT_FINE;
}

static int take_count(struct parser *p, const char *key, size_t limit, size_t *count)
{
    double number;

    if (scan_number(&p->scan, &number) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!(number >= 0 && number == floor(number))) {
        return FAIL(p, "%s=%g is no count", key, number);
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
    return scan_quoted(&p->scan, name);
}

/* Index of the key in KEYS; -1 for another one. A key given twice is an error: -2. */
static int find_key(struct parser *p, const char *const *keys)
{
    for (int i = 0; keys[i] != NULL; i++) {
        if (strcmp(p->scan.word, keys[i]) != 0) {
            continue;
        }
        if (p->seen & 1U << i) {
            FAIL(p, "%s stands twice in this section; remove one", keys[i]);
            return -2;
        }
        p->seen |= 1U << i;
        return i;
    }
    return -1;
}

static int no_system_key(struct parser *p, const char *const *keys)
{
    char known[256] = "";

    for (; *keys != NULL; keys++) {
        snprintf(known + strlen(known), sizeof known - strlen(known), " %s", *keys);
    }
    return FAIL(p, "[System] has no key '%s' in MATLAB's format; its keys are:%s", p->scan.word,
                known);
}

static int parse_system(struct parser *p)
{
    static const char *const keys[] = {"Name",       "Type",      "Version",      "NumInputs",
                                       "NumOutputs", "NumRules",  "AndMethod",    "OrMethod",
                                       "ImpMethod",  "AggMethod", "DefuzzMethod", NULL};
    struct fis *fis = p->fis;
    int key = find_key(p, keys);
    int method = 0;
    int status;

    if (key == -2) {
        return EXIT_INPUT;
    }
    if (!scan_char(&p->scan, '=')) {
        return FAIL(p, "expected '=' after '%s'", p->scan.word);
    }
    switch (key) {
    case 0:
        return take_name(p, &fis->name);
    case 1:
        status = take_method(p, "Type", fis_type_words, &method);
        fis->type = (enum fis_type)method;
        return status;
    case 2: /* 1.0, 2.0 and 3.0 do not differ in what fistab reads; fuzzylite puts its own here */
        p->scan.at += strlen(p->scan.at);
        return EXIT_FINE;
    case 3:
        return take_count(p, keys[key], FIS_VARIABLES_MAX, &p->declared->inputs);
    case 4:
        return take_count(p, keys[key], FIS_VARIABLES_MAX, &p->declared->outputs);
    case 5:
        return take_count(p, keys[key], FIS_RULES_MAX, &p->declared->rules);
    case 6:
        status = take_method(p, keys[key], fis_and_words, &method);
        fis->and_method = (enum fis_and)method;
        return status;
    case 7:
        status = take_method(p, keys[key], fis_or_words, &method);
        fis->or_method = (enum fis_or)method;
        return status;
    case 8:
        status = take_method(p, keys[key], fis_imp_words, &method);
        fis->imp_method = (enum fis_imp)method;
        return status;
    case 9:
        status = take_method(p, keys[key], fis_agg_words, &method);
        fis->agg_method = (enum fis_agg)method;
        return status;
    case 10:
        status = take_method(p, keys[key], fis_defuzz_words, &method);
        fis->defuzz_method = (enum fis_defuzz)method;
        return status;
    default:
        return no_system_key(p, keys);
    }
}

static int parse_range(struct parser *p)
{
    struct variable *variable = p->variable;

    if (!scan_char(&p->scan, '[')) {
        return FAIL(p, "a range is written Range=[0 10]");
    }
    if (scan_number(&p->scan, &variable->min) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    scan_char(&p->scan, ',');
    if (scan_number(&p->scan, &variable->max) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!scan_char(&p->scan, ']')) {
        return FAIL(p, "a range is written Range=[0 10]");
    }
    if (!isfinite(variable->min) || !isfinite(variable->max)) {
        return FAIL(p, "Range=[%g %g] has no end; write two finite numbers", variable->min,
                    variable->max);
    }
    if (!(variable->min < variable->max)) {
        return FAIL(p, "Range=[%g %g] is empty; write the smaller end first", variable->min,
                    variable->max);
    }
    return EXIT_FINE;
}

static int parse_parameters(struct parser *p, struct set *set)
{
    size_t room = 0;

    if (!scan_char(&p->scan, '[')) {
        return FAIL(p, "a set is written MF1='name':'trimf',[0 1 2]");
    }
    while (!scan_char(&p->scan, ']')) {
        double *bigger;

        if (set->parameters > 0) {
            scan_char(&p->scan, ',');
        }
        if (set->parameters == FIS_PARAMETERS_MAX) {
            return FAIL(p, "more than %d numbers in one set, fistab's limit", FIS_PARAMETERS_MAX);
        }
        if (set->parameters == room) {
            room = room == 0 ? 4 : 2 * room;
            bigger = realloc(set->parameter, room * sizeof *bigger);
            if (bigger == NULL) {
                return FAIL(p, "out of memory");
            }
            set->parameter = bigger;
        }
        if (scan_number(&p->scan, &set->parameter[set->parameters]) != EXIT_FINE) {
            return EXIT_INPUT;
        }
        set->parameters++;
    }
    return EXIT_FINE;
}

/* What to write for a membership function that there is not; fuzzylite's have equals. */
static const char *replacement(const char *kind)
{
    if (strcmp(kind, "rampmf") == 0) {
        return "linsmf for a ramp up, linzmf for one down";
    }
    if (strcmp(kind, "discretemf") == 0) {
        return "pwlmf, with the same numbers";
    }
    if (strcmp(kind, "rectmf") == 0) {
        return "trapmf,[a a b b]";
    }
    return "trimf, trapmf, gaussmf, gauss2mf, gbellmf, sigmf, dsigmf, psigmf, zmf, smf, pimf, "
           "linzmf, linsmf, pwlmf, or for Sugeno outputs constant, linear";
}

/* MFk='name':'kind',[numbers], the key already read; NUMBER is k. */
static int parse_set(struct parser *p, long number)
{
    struct variable *variable = p->variable;
    struct set *set;
    char *kind;

    if (number < 1 || number > FIS_SETS_MAX) {
        return FAIL(p, "MF%ld: sets are numbered from 1 to fistab's limit of %d", number,
                    FIS_SETS_MAX);
    }
    if (grow(p, (void **)&variable->set, &variable->sets, (size_t)number - 1, sizeof *set) !=
        EXIT_FINE) {
        return EXIT_INPUT;
    }
    set = &variable->set[number - 1];
    if (set->line != 0) {
        return FAIL(p, "MF%ld stands twice; the first is on line %d", number, set->line);
    }
    set->line = p->scan.line;
    if (scan_quoted(&p->scan, &set->name) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!scan_char(&p->scan, ':')) {
        return FAIL(p, "a set is written MF1='name':'trimf',[0 1 2]");
    }
    if (scan_quoted(&p->scan, &kind) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    set->kind = mf_kind_by_name(kind);
    if (set->kind == MF_UNKNOWN) {
        FAIL(p, "'%s' is not a membership function of MATLAB's that fistab knows; use %s", kind,
             replacement(kind));
        free(kind);
        return EXIT_INPUT;
    }
    free(kind);
    if (!scan_char(&p->scan, ',')) {
        return FAIL(p, "a set is written MF1='name':'trimf',[0 1 2]");
    }
    return parse_parameters(p, set);
}

/* fuzzylite adds keys of its own; with the values that change nothing they are let pass. */
static int parse_foreign_key(struct parser *p)
{
    static const char *const harmless[][2] = {{"Enabled", "1"},      {"Default", "nan"},
                                              {"LockRange", "0"},    {"LockValueInRange", "0"},
                                              {"LockPrevious", "0"}, {"LockValid", "0"}};

    for (size_t i = 0; i < sizeof harmless / sizeof harmless[0]; i++) {
        const char *key = harmless[i][0];
        const char *value = harmless[i][1];

        if (strcmp(p->scan.word, key) != 0) {
            continue;
        }
        if (scan_word(&p->scan) && strcmp(p->scan.word, value) == 0 && scan_end(&p->scan)) {
            return EXIT_FINE;
        }
        return FAIL(p, "%s is fuzzylite's, not MATLAB's; only %s=%s can be read", key, key, value);
    }
    return FAIL(p,
                "a variable has no key '%s' in MATLAB's format; its keys are: Name Range NumMFs "
                "MF1 MF2 and so on",
                p->scan.word);
}

static int parse_variable(struct parser *p)
{
    static const char *const keys[] = {"Name", "Range", "NumMFs", NULL};
    int key = find_key(p, keys);
    char *end;
    long number;

    if (key == -2) {
        return EXIT_INPUT;
    }
    if (!scan_char(&p->scan, '=')) {
        return FAIL(p, "expected '=' after '%s'", p->scan.word);
    }
    switch (key) {
    case 0:
        return take_name(p, &p->variable->name);
    case 1:
        return parse_range(p);
    case 2:
        return take_count(p, keys[key], FIS_SETS_MAX, p->sets_declared);
    default:
        break;
    }
    if (strncmp(p->scan.word, "MF", 2) == 0 && p->scan.word[2] >= '0' && p->scan.word[2] <= '9') {
        number = strtol(p->scan.word + 2, &end, 10);
        if (*end == '\0') {
            return parse_set(p, number);
        }
    }
    return parse_foreign_key(p);
}

static int take_rule_number(struct parser *p, int *term)
{
    double number;

    if (scan_number(&p->scan, &number) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (number != floor(number)) {
        return FAIL(
            p, "%g in a rule is a hedge of Octave's or an error; MATLAB has whole numbers here",
            number);
    }
    if (fabs(number) > FIS_SETS_MAX) {
        return FAIL(p, "there is no set %g; sets go to fistab's limit of %d", number, FIS_SETS_MAX);
    }
    *term = (int)number;
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
static int parse_rule(struct parser *p)
{
    struct fis *fis = p->fis;
    struct rule *rule;
    int term[2 * FIS_VARIABLES_MAX];
    size_t terms = 0;
    size_t inputs = 0;
    double number;

    for (;;) {
        if (scan_char(&p->scan, ',')) {
            if (inputs != 0 || terms == 0) {
                return rule_form(p);
            }
            inputs = terms;
        } else if (scan_char(&p->scan, '(')) {
            break;
        } else if (*p->scan.at == '\0' || *p->scan.at == ')' || *p->scan.at == ':') {
            return rule_form(p);
        } else if (terms == 2 * FIS_VARIABLES_MAX) {
            return FAIL(p, "a rule has more than %d numbers, fistab's limit",
                        2 * FIS_VARIABLES_MAX);
        } else {
            if (take_rule_number(p, &term[terms]) != EXIT_FINE) {
                return EXIT_INPUT;
            }
            terms++;
        }
    }
    if (inputs == 0 || inputs == terms) {
        return rule_form(p);
    }
    if (fis->rules == FIS_RULES_MAX) {
        return FAIL(p, "more than %d rules, fistab's limit", FIS_RULES_MAX);
    }
    if (grow(p, (void **)&fis->rule, &fis->rules, fis->rules, sizeof *rule) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    rule = &fis->rule[fis->rules - 1];
    rule->line = p->scan.line;
    rule->inputs = inputs;
    rule->outputs = terms - inputs;
    rule->term = malloc(terms * sizeof *rule->term);
    if (rule->term == NULL) {
        return FAIL(p, "out of memory");
    }
    memcpy(rule->term, term, terms * sizeof *rule->term);

    if (scan_number(&p->scan, &rule->weight) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!(rule->weight >= 0 && rule->weight <= 1)) {
        return FAIL(p, "a rule's weight is from 0 to 1, not %g", rule->weight);
    }
    if (!scan_char(&p->scan, ')') || !scan_char(&p->scan, ':')) {
        return rule_form(p);
    }
    if (scan_number(&p->scan, &number) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (number != 1 && number != 2) {
        return FAIL(p, "a rule ends in ': 1' for and, ': 2' for or, not %g", number);
    }
    rule->is_or = number == 2;
    return EXIT_FINE;
}

static int open_variable(struct parser *p, struct variable **list, size_t *count, size_t *declared,
                         long number)
{
    if (number < 1 || number > FIS_VARIABLES_MAX) {
        return FAIL(p, "[%s]: variables are numbered from 1 to fistab's limit of %d", p->scan.word,
                    FIS_VARIABLES_MAX);
    }
    if (grow(p, (void **)list, count, (size_t)number - 1, sizeof **list) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    p->variable = &(*list)[number - 1];
    p->sets_declared = &declared[number - 1];
    if (p->variable->line != 0) {
        return FAIL(p, "[%s] stands twice; the first is on line %d", p->scan.word,
                    p->variable->line);
    }
    p->variable->line = p->scan.line;
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

static int parse_section(struct parser *p)
{
    struct fis *fis = p->fis;
    const char *word = p->scan.word;
    int status = EXIT_FINE;

    if (!scan_word(&p->scan) || !scan_char(&p->scan, ']')) {
        return FAIL(p, "a section is written [System], [Input1], [Output1] or [Rules]");
    }
    p->seen = 0;
    if (strcmp(word, "System") == 0 || strcmp(word, "Rules") == 0) {
        int *line = word[0] == 'S' ? &p->declared->system_line : &p->declared->rules_line;
        if (*line != 0) {
            return FAIL(p, "[%s] stands twice; the first is on line %d", word, *line);
        }
        *line = p->scan.line;
        p->section = word[0] == 'S' ? SECTION_SYSTEM : SECTION_RULES;
    } else if (is_variable(word, "Input")) {
        status = open_variable(p, &fis->input, &fis->inputs, p->declared->input_sets,
                               strtol(word + strlen("Input"), NULL, 10));
    } else if (is_variable(word, "Output")) {
        status = open_variable(p, &fis->output, &fis->outputs, p->declared->output_sets,
                               strtol(word + strlen("Output"), NULL, 10));
    } else {
        return FAIL(p,
                    "there is no section [%s]; there are [System], [Input1], [Output1] and [Rules]",
                    word);
    }
    return status;
}

static int parse_line(struct parser *p)
{
    if (scan_char(&p->scan, '[')) {
        return parse_section(p);
    }
    if (p->section == SECTION_RULES) {
        return parse_rule(p);
    }
    if (!scan_word(&p->scan)) {
        return FAIL(p, "expected Key=value, found '%.40s'", p->scan.at);
    }
    if (p->section == SECTION_SYSTEM) {
        return parse_system(p);
    }
    if (p->section == SECTION_VARIABLE) {
        return parse_variable(p);
    }
    return FAIL(p, "a .fis file begins with [System], not '%s'", p->scan.word);
}

int fis_parse(const char *file, const char *text, size_t length, struct fis *fis)
{
    struct declared declared;
    struct parser p = {.fis = fis, .declared = &declared};
    int status;

    memset(fis, 0, sizeof *fis);
    /* What MATLAB's readfis takes where the file says nothing. */
    fis->type = FIS_MAMDANI;
    fis->and_method = AND_MIN;
    fis->or_method = OR_MAX;
    fis->imp_method = IMP_MIN;
    fis->agg_method = AGG_MAX;
    fis->defuzz_method = DEFUZZ_CENTROID;
    memset(&declared, 0xFF, sizeof declared); /* every count NOT_DECLARED */
    declared.system_line = declared.rules_line = 0;
    status = scan_open(&p.scan, file, text, length);
    if (status == EXIT_FINE && (fis->file = strdup(file)) == NULL) {
        status = diag_error(file, 0, "out of memory");
    }
    while (status == EXIT_FINE && scan_line(&p.scan)) {
        status = parse_line(&p);
        if (status == EXIT_FINE && !scan_end(&p.scan)) {
            status = FAIL(&p, "'%.40s' at the end of the line has no meaning here", p.scan.at);
        }
    }
    scan_close(&p.scan);
    if (status == EXIT_FINE) {
        status = fis_validate(fis, &declared);
    }
    if (status != EXIT_FINE) {
        fis_free(fis);
    } else {
        fis->crc32 = crc32_update(0, text, length);
    }
    return status;
}
