/* SPDX-License-Identifier: MIT */
/* Checks that what a file describes makes a system. */
#include <math.h>
#include <stdlib.h>

#include "diag.h"
#include "read.h"

static int validate_set(const struct fis *fis, const struct variable *variable, struct set *set)
{
    bool is_output = variable->type != 0;
    bool wants_sugeno = variable->type == FIS_SUGENO;
    size_t wanted = mf_parameters(set->kind, fis->inputs);
    const char *name = mf_name(set->kind);
    const char *fault;

    if (mf_is_sugeno(set->kind) && !wants_sugeno) {
        return diag_error(fis->file, set->line, "'%s' is for %s only", name,
                          is_output && fis->format != FORMAT_FIS ? "outputs with a weighted method"
                                                                 : "Sugeno outputs");
    }
    if (!mf_is_sugeno(set->kind) && wants_sugeno) {
        if (fis->format != FORMAT_FIS) {
            return diag_error(fis->file, set->line,
                              "Tsukamoto inference ('%s' under a weighted method): fistab does not "
                              "support this; use Constant or Linear, or the method Centroid",
                              name);
        }
        return diag_error(fis->file, set->line,
                          "a Sugeno output has sets 'constant' and 'linear', not '%s'", name);
    }
    if (wanted == 0) {
        if (set->parameters < 4 || set->parameters % 2 != 0) {
            return diag_error(fis->file, set->line,
                              "'%s' takes points x1 y1 x2 y2 ..., two or more", name);
        }
    } else {
        /* Files of MATLAB 4 fill every list with zeros to one length. */
        while (fis->format == FORMAT_FIS && set->parameters > wanted &&
               set->parameter[set->parameters - 1] == 0) {
            set->parameters--;
        }
        if (set->parameters != wanted) {
            return diag_error(fis->file, set->line, "'%s' takes %zu numbers here, not %zu", name,
                              wanted, set->parameters);
        }
    }
    fault = mf_fault(set->kind, set->parameter, set->parameters);
    if (fault != NULL) {
        return diag_error(fis->file, set->line, "'%s' wants %s", name, fault);
    }
    return EXIT_FINE;
}

static int validate_variables(const struct fis *fis, struct variable *list, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct variable *variable = &list[i];

        /* A Sugeno output may have a range without width: nothing but a table needs one. */
        if (variable->type == FIS_SUGENO ? variable->min > variable->max
                                         : !(variable->min < variable->max)) {
            return diag_error(
                fis->file, variable->line,
                "the range of '%s' is empty; write two numbers, the smaller one first",
                variable->name);
        }
        for (size_t k = 0; k < variable->sets; k++) {
            if (validate_set(fis, variable, &variable->set[k]) != EXIT_FINE) {
                return EXIT_INPUT;
            }
        }
    }
    return EXIT_FINE;
}

static int missing_method(const struct fis *fis, int line, const char *const key[3],
                          const char *const example[3])
{
    const char *quote = fis->format == FORMAT_FIS ? "'" : "";

    return diag_error(fis->file, line,
                      "%s is empty, but the rules need it; write for instance %s%s%s%s%s",
                      key[fis->format], key[fis->format], fis->format == FORMAT_FIS ? "=" : ": ",
                      quote, example[fis->format], quote);
}

/* What the rule needs of its block. */
static int validate_operators(const struct fis *fis, const struct rule *rule)
{
    static const char *const and_key[] = {"AndMethod", "conjunction", "AND"};
    static const char *const or_key[] = {"OrMethod", "disjunction", "OR"};
    static const char *const imp_key[] = {"ImpMethod", "implication", "ACT"};
    static const char *const min[] = {"min", "Minimum", "MIN"};
    static const char *const max[] = {"max", "Maximum", "MAX"};
    const struct block *block = &fis->block[rule->block];
    bool joins = rule_conditions(rule) > 1;

    if (joins && rule->is_or && block->or_method == SNORM_NONE) {
        return missing_method(fis, block->or_line, or_key, max);
    }
    if (joins && !rule->is_or && block->and_method == TNORM_NONE) {
        return missing_method(fis, block->and_line, and_key, min);
    }
    for (size_t o = 0; o < fis->outputs; o++) {
        if (rule->term[fis->inputs + o] != 0 && fis->output[o].type == FIS_MAMDANI &&
            block->imp_method == TNORM_NONE) {
            return missing_method(fis, block->imp_line, imp_key, min);
        }
    }
    return EXIT_FINE;
}

static int validate_outputs(const struct fis *fis)
{
    static const char *const key[] = {"AggMethod", "aggregation", "ACCU"};
    static const char *const max[] = {"max", "Maximum", "MAX"};

    for (size_t o = 0; o < fis->outputs; o++) {
        const struct variable *output = &fis->output[o];

        if (output->type == FIS_MAMDANI && output->agg_method == SNORM_NONE) {
            return missing_method(fis, output->agg_line, key, max);
        }
    }
    return EXIT_FINE;
}

int fis_validate(struct fis *fis)
{
    if (validate_variables(fis, fis->input, fis->inputs) != EXIT_FINE ||
        validate_variables(fis, fis->output, fis->outputs) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    for (size_t i = 0; i < fis->rules; i++) {
        if (validate_operators(fis, &fis->rule[i]) != EXIT_FINE) {
            return EXIT_INPUT;
        }
    }
    return validate_outputs(fis);
}
