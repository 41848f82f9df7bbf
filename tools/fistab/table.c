/* SPDX-License-Identifier: MIT */
/* Sampling a system on a grid. */
#include "table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"

size_t table_default_dim(size_t inputs)
{
    static const size_t dim[TABLE_INPUTS_MAX] = {100, 100, 20, 10};
    return dim[inputs - 1];
}

double table_axis_value(const struct table *table, size_t input, size_t index)
{
    const struct variable *variable = &table->fis->input[input];
    size_t dim = table->dims[input];
    double span = variable->max - variable->min;

    if (!table->options.nodes) {
        return variable->min + span * (2 * (double)index + 1) / (2 * (double)dim);
    }
    return index + 1 == dim ? variable->max
                            : variable->min + span * (double)index / (double)(dim - 1);
}

void table_coordinates(const struct table *table, size_t cell, size_t *at)
{
    for (size_t i = table->inputs; i-- > 0;) {
        at[i] = cell % table->dims[i];
        cell /= table->dims[i];
    }
}

int table_round(double levels)
{
    return (int)floor(levels + 0.5 + TABLE_HALF_WITHIN);
}

int table_rounded(const struct table *table, double levels)
{
    return table->options.half_down ? (int)ceil(levels - 0.5 - TABLE_HALF_WITHIN)
                                    : table_round(levels);
}

/* "distance_m = 3, closing_mps = 10" */
static const char *point_text(const struct fis *fis, const double *x, char *buffer, size_t size)
{
    size_t used = 0;

    for (size_t i = 0; i < fis->inputs && used < size; i++) {
        int length = snprintf(buffer + used, size - used, "%s%s = %.6g", i == 0 ? "" : ", ",
                              fis->input[i].name, x[i]);
        used += length > 0 ? (size_t)length : 0;
    }
    return buffer;
}

static int sample_cell(struct table *table, struct engine *engine, size_t cell)
{
    const struct fis *fis = table->fis;
    double x[TABLE_INPUTS_MAX];
    double y[FIS_VARIABLES_MAX];
    size_t at[TABLE_INPUTS_MAX];
    char buffer[400];

    table_coordinates(table, cell, at);
    for (size_t i = 0; i < table->inputs; i++) {
        x[i] = table_axis_value(table, i, at[i]);
    }
    engine_eval(engine, x, y);
    for (size_t o = 0; o < table->outputs; o++) {
        const struct variable *output = &fis->output[o];
        double levels = (y[o] - output->min) / (output->max - output->min) * table->options.levels;

        if (!engine_fired(engine, o)) {
            return diag_error(
                fis->file, output->line,
                "(rule_gap) no rule for '%s' fires at %s; a table has no holes, add a rule",
                output->name, point_text(fis, x, buffer, sizeof buffer));
        }
        if (levels < -1e-9 || levels > table->options.levels + 1e-9) {
            return diag_error(
                fis->file, output->line,
                "(output_range) '%s' is %.6g at %s, outside its range of %g to %g; widen the range",
                output->name, y[o], point_text(fis, x, buffer, sizeof buffer), output->min,
                output->max);
        }
        table->surface[o][cell] = fmin(fmax(levels, 0), table->options.levels);
        table->cell[o][cell] = table_rounded(table, table->surface[o][cell]);
    }
    return EXIT_FINE;
}

static int set_dims(struct table *table)
{
    const char *file = table->fis->file;

    table->cells = 1;
    for (size_t i = 0; i < table->inputs; i++) {
        size_t dim =
            table->options.dims[i] != 0 ? table->options.dims[i] : table_default_dim(table->inputs);

        if (table->options.nodes && dim < 2) {
            return diag_error(file, 0, "a grid of nodes needs at least 2 along each input");
        }
        if (dim > TABLE_CELLS_MAX / table->cells) {
            return diag_error(file, 0, "a grid of more than %d cells is beyond fistab's limit",
                              TABLE_CELLS_MAX);
        }
        table->dims[i] = dim;
        table->cells *= dim;
    }
    return EXIT_FINE;
}

static bool allocate(struct table *table)
{
    table->surface = calloc(table->outputs, sizeof *table->surface);
    table->cell = calloc(table->outputs, sizeof *table->cell);
    if (table->surface == NULL || table->cell == NULL) {
        return false;
    }
    for (size_t o = 0; o < table->outputs; o++) {
        table->surface[o] = malloc(table->cells * sizeof **table->surface);
        table->cell[o] = malloc(table->cells * sizeof **table->cell);
        if (table->surface[o] == NULL || table->cell[o] == NULL) {
            return false;
        }
    }
    return true;
}

int table_make(const struct fis *fis, const struct table_options *options, struct table *table)
{
    struct engine *engine = NULL;
    int status;

    memset(table, 0, sizeof *table);
    table->fis = fis;
    table->options = *options;
    table->inputs = fis->inputs;
    table->outputs = fis->outputs;
    if (fis->inputs > TABLE_INPUTS_MAX) {
        return diag_error(fis->file, 0, "%zu inputs; a table has at most %d", fis->inputs,
                          TABLE_INPUTS_MAX);
    }
    for (size_t o = 0; o < fis->outputs; o++) {
        if (fis->output[o].min == fis->output[o].max) {
            return diag_error(fis->file, fis->output[o].line,
                              "the range of '%s' is [%g %g]; a table needs a range that its values "
                              "fill",
                              fis->output[o].name, fis->output[o].min, fis->output[o].max);
        }
    }
    status = set_dims(table);
    if (status == EXIT_FINE && !allocate(table)) {
        status = diag_error(fis->file, 0, "out of memory");
    }
    if (status == EXIT_FINE && (engine = engine_create(fis, &options->infer)) == NULL) {
        status = EXIT_INPUT;
    }
    for (size_t cell = 0; status == EXIT_FINE && cell < table->cells; cell++) {
        status = sample_cell(table, engine, cell);
    }
    engine_free(engine);
    if (status != EXIT_FINE) {
        table_free(table);
    }
    return status;
}

void table_free(struct table *table)
{
    for (size_t o = 0; o < table->outputs; o++) {
        if (table->surface != NULL) {
            free(table->surface[o]);
        }
        if (table->cell != NULL) {
            free(table->cell[o]);
        }
    }
    free(table->surface);
    free(table->cell);
    memset(table, 0, sizeof *table);
}
