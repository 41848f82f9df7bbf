/* SPDX-License-Identifier: MIT */
/* A system as a .fis file. */
#include "write_fis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"

/* --- what a .fis cannot say ------------------------------------------------------------------ */

static int lacks(const struct fis *fis, int line, const char *feature, const char *advice)
{
    return diag_error(fis->file, line, "%s: a .fis cannot say this; %s", feature, advice);
}

/* All blocks that have rules must agree in the operators. Returns the first of them. */
static const struct block *common_block(const struct fis *fis)
{
    const struct block *first = &fis->block[fis->rules > 0 ? fis->rule[0].block : 0];

    for (size_t r = 0; r < fis->rules; r++) {
        const struct block *block = &fis->block[fis->rule[r].block];

        if (block->and_method != first->and_method || block->or_method != first->or_method ||
            block->imp_method != first->imp_method) {
            lacks(fis, fis->rule[r].line, "rule blocks with different operators",
                  "make a system for each block");
            return NULL;
        }
    }
    return first;
}

static int check_outputs(const struct fis *fis)
{
    for (size_t o = 0; o < fis->outputs; o++) {
        const struct variable *first = &fis->output[0], *output = &fis->output[o];

        if (output->type != first->type) {
            return lacks(fis, output->line, "Mamdani and Sugeno outputs in one system",
                         "make a system for each");
        }
        if (output->agg_method != first->agg_method ||
            output->defuzz_method != first->defuzz_method) {
            return lacks(fis, output->line, "outputs with different methods",
                         "make a system for each");
        }
        if (!isnan(output->default_value)) {
            return lacks(fis, output->line, "a default value", "add a rule for the points without");
        }
    }
    return EXIT_FINE;
}

static int check_variables(const struct fis *fis, const struct variable *list, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (list[i].lock_range) {
            diag_warning(fis->file, list[i].line,
                         "'%s' was kept within its range (lock-range); in the .fis it is not",
                         list[i].name);
        }
        for (size_t k = 0; k < list[i].sets; k++) {
            if (list[i].set[k].height != 1) {
                return lacks(fis, list[i].set[k].line, "a height other than 1",
                             "draw the set by Discrete");
            }
        }
    }
    return EXIT_FINE;
}

/* --- text ------------------------------------------------------------------------------------ */

/* With as many digits as it takes to read the same number again. */
static void put_number(FILE *out, double number)
{
    char text[40];

    snprintf(text, sizeof text, "%.15g", number);
    if (strtod(text, NULL) != number) {
        snprintf(text, sizeof text, "%.17g", number);
    }
    fputs(isinf(number) ? (number > 0 ? "Inf" : "-Inf") : text, out);
}

static void put_quoted(FILE *out, const char *text)
{
    putc('\'', out);
    for (; *text != '\0'; text++) {
        if (*text == '\'') {
            putc('\'', out);
        }
        putc(*text, out);
    }
    putc('\'', out);
}

static void write_variable(FILE *out, const char *section, size_t number,
                           const struct variable *variable)
{
    fprintf(out, "\n[%s%zu]\nName=", section, number);
    put_quoted(out, variable->name);
    fprintf(out, "\nRange=[");
    put_number(out, variable->min);
    putc(' ', out);
    put_number(out, variable->max);
    fprintf(out, "]\nNumMFs=%zu\n", variable->sets);
    for (size_t k = 0; k < variable->sets; k++) {
        const struct set *set = &variable->set[k];

        fprintf(out, "MF%zu=", k + 1);
        put_quoted(out, set->name);
        /* fuzzylite reads our pwlmf under its own name */
        fprintf(out, ":'%s',[", set->kind == MF_PWLMF ? "discretemf" : mf_name(set->kind));
        for (size_t i = 0; i < set->parameters; i++) {
            if (i > 0) {
                putc(' ', out);
            }
            put_number(out, set->parameter[i]);
        }
        fprintf(out, "]\n");
    }
}

/* The part behind the point that stands for a chain of hedges; NULL if none does. */
static const char *hedge_part(hedges_t hedges)
{
    static const struct {
        hedges_t hedges;
        const char *part;
    } known[] = {{0, ""},
                 {HEDGE_VERY, ".2"},
                 {HEDGE_SOMEWHAT, ".05"},
                 {HEDGE_VERY << HEDGE_BITS | HEDGE_VERY, ".4"}};

    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        hedges_t last = HEDGE_NOT;

        for (hedges_t rest = known[i].hedges; rest != 0; rest >>= HEDGE_BITS) {
            last <<= HEDGE_BITS;
        }
        if (hedges == known[i].hedges || hedges == (known[i].hedges | last)) {
            return known[i].part;
        }
    }
    return NULL;
}

static int write_rule(FILE *out, const struct fis *fis, const struct rule *rule, bool *has_hedges)
{
    for (size_t i = 0; i < rule->inputs + rule->outputs; i++) {
        const char *part = hedge_part(rule->hedges[i]);

        if (part == NULL || (i >= rule->inputs && rule->hedges[i] != 0)) {
            return lacks(fis, rule->line,
                         i >= rule->inputs ? "a hedge on an output" : "hedges such as these",
                         "define a set of its own");
        }
        *has_hedges = *has_hedges || *part != '\0';
        fprintf(out, "%s%d%s", i == 0 ? "" : i == rule->inputs ? ", " : " ", rule->term[i], part);
    }
    fprintf(out, " (");
    put_number(out, rule->weight);
    fprintf(out, ") : %d\n", rule->is_or ? 2 : 1);
    return EXIT_FINE;
}

/* What MATLAB does not read, and the others do. */
static void warn_of_additions(const struct fis *fis, const struct block *block, bool has_hedges)
{
    bool more = block->and_method > TNORM_PROD || block->imp_method > TNORM_PROD ||
                block->or_method > SNORM_PROBOR || fis->output[0].agg_method > SNORM_SUM;

    for (size_t v = 0; v < fis->inputs + fis->outputs; v++) {
        const struct variable *variable =
            v < fis->inputs ? &fis->input[v] : &fis->output[v - fis->inputs];

        for (size_t k = 0; k < variable->sets; k++) {
            more =
                more || (variable->set[k].kind >= MF_PWLMF && !mf_is_sugeno(variable->set[k].kind));
        }
    }
    if (more) {
        diag_warning(fis->file, 0,
                     "the .fis has functions or operators that fuzzylite and fistab read, but not "
                     "MATLAB");
    }
    if (has_hedges) {
        diag_warning(
            fis->file, 0,
            "the .fis has hedges, which fuzzylite, Octave and fistab read, but not MATLAB");
    }
}

int write_fis(FILE *out, const struct fis *fis)
{
    const struct block *block = common_block(fis);
    const struct variable *first = &fis->output[0];
    bool has_hedges = false;

    if (block == NULL || check_outputs(fis) != EXIT_FINE ||
        check_variables(fis, fis->input, fis->inputs) != EXIT_FINE ||
        check_variables(fis, fis->output, fis->outputs) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    fprintf(out, "[System]\nName=");
    put_quoted(out, fis->name != NULL ? fis->name : "");
    fprintf(out, "\nType='%s'\nVersion=2.0\nNumInputs=%zu\nNumOutputs=%zu\nNumRules=%zu\n",
            fis_type_words[first->type], fis->inputs, fis->outputs, fis->rules);
    /* Operators that no rule needs may be missing elsewhere, but not in MATLAB. */
    fprintf(out, "AndMethod='%s'\nOrMethod='%s'\nImpMethod='%s'\nAggMethod='%s'\n",
            tnorm_name[block->and_method != 0 ? block->and_method : TNORM_MIN].fis,
            snorm_name[block->or_method != 0 ? block->or_method : SNORM_MAX].fis,
            tnorm_name[block->imp_method != 0 ? block->imp_method : TNORM_MIN].fis,
            snorm_name[first->agg_method != 0 ? first->agg_method : SNORM_MAX].fis);
    fprintf(out, "DefuzzMethod='%s'\n", fis_defuzz_words[first->defuzz_method]);
    for (size_t i = 0; i < fis->inputs; i++) {
        write_variable(out, "Input", i + 1, &fis->input[i]);
    }
    for (size_t o = 0; o < fis->outputs; o++) {
        write_variable(out, "Output", o + 1, &fis->output[o]);
    }
    fprintf(out, "\n[Rules]\n");
    for (size_t r = 0; r < fis->rules; r++) {
        if (write_rule(out, fis, &fis->rule[r], &has_hedges) != EXIT_FINE) {
            return EXIT_INPUT;
        }
    }
    warn_of_additions(fis, block, has_hedges);
    return EXIT_FINE;
}
