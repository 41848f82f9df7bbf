/* SPDX-License-Identifier: MIT */
/* The rules of FLL and FCL files, which are sentences: if ... then ... */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "diag.h"
#include "read.h"

/* What is read of one condition or outcome: VARIABLE is [HEDGE...] SET. */
struct clause {
    size_t variable;
    int set; /* from 1; 0: `any` */
    hedges_t hedges;
    unsigned hedge_count;
};

struct sentence {
    struct scan *scan;
    struct fis *fis;
    struct rule *rule;
    char connective; /* of the conditions: 'a' for and, 'o' for or, '\0' until there is one */
    bool has_any;
};

#define FAIL(s, ...) SCAN_FAIL((s)->scan, __VA_ARGS__)

static bool same_word(const struct scan *scan, const char *word, const char *keyword)
{
    return (scan->free_form ? strcasecmp(word, keyword) : strcmp(word, keyword)) == 0;
}

/* Takes the word KEYWORD if it stands next. */
static bool take_keyword(struct sentence *s, const char *keyword)
{
    struct scan before = *s->scan;

    if (scan_name(s->scan) && same_word(s->scan, s->scan->word, keyword)) {
        return true;
    }
    s->scan->at = before.at;
    s->scan->line = before.line;
    return false;
}

static int expect_keyword(struct sentence *s, const char *keyword)
{
    return take_keyword(s, keyword)
               ? EXIT_FINE
               : FAIL(s, "expected '%s' in a rule, found %s", keyword, scan_found(s->scan));
}

static bool find_variable(const struct variable *list, size_t count, const char *name,
                          size_t *index)
{
    for (*index = 0; *index < count; ++*index) {
        if (strcmp(list[*index].name, name) == 0) {
            return true;
        }
    }
    return false;
}

static int find_set(const struct variable *variable, const char *name)
{
    for (size_t k = 0; k < variable->sets; k++) {
        if (strcmp(variable->set[k].name, name) == 0) {
            return (int)k + 1;
        }
    }
    return 0;
}

static enum hedge find_hedge(const struct scan *scan, const char *word)
{
    int hedge = HEDGE_NOT;

    while (hedge_words[hedge] != NULL && !same_word(scan, word, hedge_words[hedge])) {
        hedge++;
    }
    return hedge_words[hedge] != NULL ? (enum hedge)hedge : 0;
}

/* A hedge acts on what stands right of it, so the last one read comes first in the chain. */
static int add_hedge(struct sentence *s, struct clause *clause, enum hedge hedge)
{
    if (++clause->hedge_count > HEDGES_MAX) {
        return FAIL(s, "more than %d hedges in one place, fistab's limit", HEDGES_MAX);
    }
    clause->hedges = clause->hedges << HEDGE_BITS | (hedges_t)hedge;
    return EXIT_FINE;
}

/* What follows the variable's name: is [HEDGE...] SET, or is any. */
static int take_set_name(struct sentence *s, const struct variable *variable, struct clause *clause)
{
    struct scan *scan = s->scan;

    if (expect_keyword(s, "is") != EXIT_FINE) {
        return EXIT_INPUT;
    }
    for (;;) {
        enum hedge hedge;

        if (!scan_name(scan)) {
            return FAIL(s, "expected a set of '%s', found %s", variable->name, scan_found(scan));
        }
        /* In FCL a set may have a name that differs from a hedge only in capitals. */
        clause->set = scan->free_form ? find_set(variable, scan->word) : 0;
        hedge = clause->set == 0 ? find_hedge(scan, scan->word) : 0;
        if (hedge == 0) {
            break;
        }
        if (add_hedge(s, clause, hedge) != EXIT_FINE) {
            return EXIT_INPUT;
        }
    }
    if (clause->set == 0) {
        clause->set = find_set(variable, scan->word);
    }
    if (clause->set == 0 && same_word(scan, scan->word, "any")) {
        return clause->hedge_count == 0
                   ? EXIT_FINE
                   : not_supported(scan, "a hedge before 'any'", "leave the condition out");
    }
    if (clause->set == 0) {
        return FAIL(s,
                    "'%s' has no set '%.60s', and there is no such hedge; hedges are not, very, "
                    "extremely, somewhat, seldom and any",
                    variable->name, scan->word);
    }
    return EXIT_FINE;
}

static int take_condition(struct sentence *s)
{
    struct clause clause = {0};
    struct fis *fis = s->fis;
    struct rule *rule = s->rule;
    int *term;
    size_t output;

    while (take_keyword(s, "not")) { /* IEC 61131-7: NOT x IS y */
        if (*s->scan->at == '(' || add_hedge(s, &clause, HEDGE_NOT) != EXIT_FINE) {
            return not_supported(s->scan, "'not' before a parenthesis", "negate the sets in it");
        }
    }
    if (!scan_name(s->scan)) {
        return FAIL(s, "expected an input in a rule, found %s", scan_found(s->scan));
    }
    if (!find_variable(fis->input, fis->inputs, s->scan->word, &clause.variable)) {
        if (find_variable(fis->output, fis->outputs, s->scan->word, &output)) {
            return FAIL(s,
                        "a condition on the output '%s' (chained rules): fistab does not support "
                        "this; make two systems, and give the second this output as an input",
                        fis->output[output].name);
        }
        return FAIL(s, "there is no input '%.60s'; define it above the rules", s->scan->word);
    }
    if (take_set_name(s, &fis->input[clause.variable], &clause) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (clause.set == 0) {
        s->has_any = true;
        return EXIT_FINE;
    }
    term = &rule->term[clause.variable];
    if (*term != 0) {
        return FAIL(s,
                    "two conditions on '%s' in one rule: fistab does not support this; give '%s' a "
                    "set that means both",
                    fis->input[clause.variable].name, fis->input[clause.variable].name);
    }
    *term = clause.set;
    for (hedges_t hedges = clause.hedges; hedges != 0; hedges >>= HEDGE_BITS) {
        *term = (hedges & ((1U << HEDGE_BITS) - 1)) == HEDGE_NOT ? -*term : *term;
    }
    /* A lone `not` needs no chain. */
    rule->hedges[clause.variable] = clause.hedges == HEDGE_NOT ? 0 : clause.hedges;
    return EXIT_FINE;
}

static int take_connective(struct sentence *s, char connective)
{
    if (s->connective != '\0' && s->connective != connective) {
        return FAIL(s,
                    "both 'and' and 'or' in one rule: fistab does not support this; write a rule "
                    "for each part");
    }
    s->connective = connective;
    return EXIT_FINE;
}

/* Conditions joined by `and`, or by `or`. Parentheses change nothing as long as all are joined by
 * the same word, since every norm is associative. */
static int take_conditions(struct sentence *s)
{
    int depth = 0;

    for (;;) {
        while (scan_char(s->scan, '(')) {
            depth++;
        }
        if (take_condition(s) != EXIT_FINE) {
            return EXIT_INPUT;
        }
        while (scan_char(s->scan, ')')) {
            if (depth-- == 0) {
                return FAIL(s, "a ')' without a '(' in a rule");
            }
        }
        if (take_keyword(s, "and")) {
            if (take_connective(s, 'a') != EXIT_FINE) {
                return EXIT_INPUT;
            }
        } else if (take_keyword(s, "or")) {
            if (take_connective(s, 'o') != EXIT_FINE) {
                return EXIT_INPUT;
            }
        } else {
            return depth == 0 ? EXIT_FINE : FAIL(s, "a '(' without a ')' in a rule");
        }
    }
}

/* An outcome's hedges act on the rule's strength, and on that of the outcomes behind it: so it is
 * in fuzzylite. EARLIER is the chain of those in front. */
static int take_outcome(struct sentence *s, struct clause *earlier)
{
    struct clause clause = {0};
    struct fis *fis = s->fis;
    size_t at;

    if (!scan_name(s->scan)) {
        return FAIL(s, "expected an output in a rule, found %s", scan_found(s->scan));
    }
    if (!find_variable(fis->output, fis->outputs, s->scan->word, &clause.variable)) {
        return FAIL(s, "there is no output '%.60s'; define it above the rules", s->scan->word);
    }
    if (take_set_name(s, &fis->output[clause.variable], &clause) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (clause.set == 0) {
        return FAIL(s, "'any' has no meaning behind 'then'; name a set");
    }
    for (hedges_t hedges = clause.hedges; hedges != 0; hedges >>= HEDGE_BITS) {
        if ((hedges & ((1U << HEDGE_BITS) - 1)) == HEDGE_NOT) {
            return not_supported(s->scan, "'not' behind 'then'",
                                 "define a set that means what is left");
        }
    }
    if (earlier->hedge_count + clause.hedge_count > HEDGES_MAX) {
        return FAIL(s, "more than %d hedges behind 'then', fistab's limit", HEDGES_MAX);
    }
    if (clause.hedge_count > 0) {
        earlier->hedges |= clause.hedges << earlier->hedge_count * HEDGE_BITS;
        earlier->hedge_count += clause.hedge_count;
    }
    at = fis->inputs + clause.variable;
    if (s->rule->term[at] != 0) {
        return FAIL(s, "the rule sets '%s' twice; write two rules",
                    fis->output[clause.variable].name);
    }
    s->rule->term[at] = clause.set;
    s->rule->hedges[at] = earlier->hedges;
    return EXIT_FINE;
}

static int take_weight(struct sentence *s)
{
    double *weight = &s->rule->weight;

    if (scan_number(s->scan, weight) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (!(*weight >= 0 && *weight <= 1)) {
        return FAIL(s, "a rule's weight is from 0 to 1, not %g", *weight);
    }
    return EXIT_FINE;
}

int read_rule(struct scan *scan, struct fis *fis, size_t block)
{
    struct sentence s = {.scan = scan, .fis = fis};
    struct clause hedges = {0};

    s.rule = add_rule(scan, fis, fis->inputs + fis->outputs);
    if (s.rule == NULL) {
        return EXIT_INPUT;
    }
    s.rule->block = block;
    s.rule->inputs = fis->inputs;
    s.rule->outputs = fis->outputs;
    if (expect_keyword(&s, "if") != EXIT_FINE || take_conditions(&s) != EXIT_FINE ||
        expect_keyword(&s, "then") != EXIT_FINE) {
        return EXIT_INPUT;
    }
    s.rule->is_or = s.connective == 'o';
    if (s.has_any && s.rule->is_or) { /* always 1: the same as no condition, joined by and */
        memset(s.rule->term, 0, fis->inputs * sizeof *s.rule->term);
        memset(s.rule->hedges, 0, fis->inputs * sizeof *s.rule->hedges);
        s.rule->is_or = false;
    }
    do {
        if (take_outcome(&s, &hedges) != EXIT_FINE) {
            return EXIT_INPUT;
        }
    } while (take_keyword(&s, "and") || (scan->free_form && scan_char(scan, ',')));
    return take_keyword(&s, "with") ? take_weight(&s) : EXIT_FINE;
}
