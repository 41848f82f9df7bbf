/* SPDX-License-Identifier: MIT */
/* fistab check: what is wrong with a system, before it becomes a table. */
#include <stdio.h>
#include <stdlib.h>

#include "check.h"
#include "command.h"
#include "diag.h"

enum { KEY_MONOTONE = 0x300, KEY_COVERAGE };

struct arguments {
    struct grid_options grid;
    struct laws laws;
    const char *file;
    bool coverage;
};

static const struct argp_option options[] = {
    {"monotone", KEY_MONOTONE, "SPEC", 0,
     "The table must obey SPEC: -1,+2 falls with input 1 and rises with input 2; 2:-1 is for "
     "output 2 "
     "alone",
     0},
    {"coverage", KEY_COVERAGE, NULL, 0, "Print for each rule in how much of the table it fires", 0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    struct arguments *a = state->input;

    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &a->grid;
        return 0;
    case KEY_MONOTONE:
        option_law(argument, "--monotone", &a->laws, state);
        return 0;
    case KEY_COVERAGE:
        a->coverage = true;
        return 0;
    default:
        return option_file(key, argument, &a->file, state);
    }
}

static const struct argp_child children[] = {{&grid_argp, 0, NULL, 0}, {0}};
const struct argp check_argp = {
    options,
    parse,
    "FILE.fis",
    "Says what is wrong with FILE. The errors rule_gap, rule_contradiction, output_range and "
    "monotone "
    "prevent a table; the warnings set_hole, set_outside, set_unused, input_unused, rule_never, "
    "rule_twice and rule_empty do not. Prints nothing, and ends with status 0, if all is well.",
    children,
    NULL,
    NULL};

/* How much of the grid each rule fires in, and where it is the strongest. */
static int print_coverage(const struct table *table)
{
    const struct fis *fis = table->fis;
    struct engine *engine = engine_create(fis, &table->options.infer);
    size_t *fires = calloc(2 * fis->rules + 1, sizeof *fires);
    size_t *leads;
    double x[TABLE_INPUTS_MAX], y[FIS_VARIABLES_MAX];
    size_t at[TABLE_INPUTS_MAX];
    int status = EXIT_FINE;

    if (engine == NULL || fires == NULL) {
        status = diag_error(fis->file, 0, "out of memory");
    }
    leads = fires + (fires != NULL ? fis->rules : 0);
    for (size_t cell = 0; status == EXIT_FINE && cell < table->cells; cell++) {
        size_t best = 0;

        table_coordinates(table, cell, at);
        for (size_t i = 0; i < table->inputs; i++) {
            x[i] = table_axis_value(table, i, at[i]);
        }
        engine_eval(engine, x, y);
        for (size_t r = 0; r < fis->rules; r++) {
            fires[r] += engine_strength(engine, r) > 0;
            if (engine_strength(engine, r) > engine_strength(engine, best)) {
                best = r;
            }
        }
        if (fis->rules > 0) {
            leads[best]++;
        }
    }
    for (size_t r = 0; status == EXIT_FINE && r < fis->rules; r++) {
        printf("%s:%d: rule %zu fires in %.1f %% of the table, is the strongest in %.1f %%\n",
               fis->file, fis->rule[r].line, r + 1, 100.0 * (double)fires[r] / (double)table->cells,
               100.0 * (double)leads[r] / (double)table->cells);
    }
    engine_free(engine);
    free(fires);
    return status;
}

static int check_table(const struct arguments *a, const struct fis *fis, struct findings *findings)
{
    struct table table;

    bool can_be_table = fis->inputs <= TABLE_INPUTS_MAX;

    for (size_t o = 0; o < fis->outputs; o++) {
        can_be_table = can_be_table && fis->output[o].min < fis->output[o].max;
    }
    if (!can_be_table && !a->laws.any && !a->coverage) {
        return EXIT_FINE; /* no table to look at */
    }
    if (table_make(fis, &a->grid.table, &table) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (a->laws.any) {
        check_monotone(&table, &a->laws, findings);
    }
    if (a->coverage) {
        print_coverage(&table);
    }
    table_free(&table);
    return EXIT_FINE;
}

int cmd_check(int argc, char **argv)
{
    struct arguments a = {.grid = GRID_OPTIONS_DEFAULT};
    struct findings findings = {0, 0};
    struct fis fis;
    int status;

    argp_parse(&check_argp, argc, argv, 0, NULL, &a);
    status = options_read_fis(a.file, &a.grid, &a.laws, "--monotone", &fis);
    if (status != EXIT_FINE) {
        return status;
    }
    check_fis(&fis, &findings);
    if (findings.errors == 0) {
        status = check_table(&a, &fis, &findings);
    }
    if (findings.errors + findings.warnings > 0) {
        status = EXIT_INPUT;
    }
    fis_free(&fis);
    return status;
}
