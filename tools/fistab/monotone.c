/* SPDX-License-Identifier: MIT */
/* The check `monotone`: a table's integers against a law. */
#include <stdio.h>
#include <stdlib.h>

#include "check.h"
#include "diag.h"

/* Two cells of which the law orders the values, the wrong way round. */
struct worst {
    size_t before, after; /* the value should not fall from BEFORE to AFTER */
    int drop;
};

static size_t stride_of(const struct table *table, size_t input)
{
    size_t stride = 1;
    for (size_t i = input + 1; i < table->inputs; i++) {
        stride *= table->dims[i];
    }
    return stride;
}

/* Pairs of neighbours along INPUT that break the law. */
static size_t broken_pairs(const struct table *table, const int *value, size_t input, int direction)
{
    size_t stride = stride_of(table, input);
    size_t broken = 0;

    for (size_t cell = 0; cell < table->cells; cell++) {
        if (cell / stride % table->dims[input] + 1 == table->dims[input]) {
            continue;
        }
        broken +=
            direction > 0 ? value[cell + stride] < value[cell] : value[cell + stride] > value[cell];
    }
    return broken;
}

/* TOP[cell] becomes the cell with the largest value among those that the law puts at or before
 * CELL: a running maximum along each ordered input in turn. */
static void carry_tops(const struct table *table, const int *value, size_t input, int direction,
                       size_t *top)
{
    size_t stride = stride_of(table, input);

    for (size_t k = 0; k < table->cells; k++) {
        size_t cell = direction > 0 ? k : table->cells - 1 - k;
        size_t at = cell / stride % table->dims[input];
        size_t previous = direction > 0 ? cell - stride : cell + stride;

        if (direction > 0 ? at == 0 : at + 1 == table->dims[input]) {
            continue;
        }
        if (value[top[previous]] > value[top[cell]]) {
            top[cell] = top[previous];
        }
    }
}

static int find_worst(const struct table *table, const int *value, const struct law *law,
                      struct worst *worst)
{
    size_t *top = malloc(table->cells * sizeof *top);

    worst->drop = 0;
    if (top == NULL) {
        return diag_error(table->fis->file, 0, "out of memory");
    }
    for (size_t cell = 0; cell < table->cells; cell++) {
        top[cell] = cell;
    }
    for (size_t i = 0; i < table->inputs; i++) {
        if (law->direction[i] != 0) {
            carry_tops(table, value, i, law->direction[i], top);
        }
    }
    for (size_t cell = 0; cell < table->cells; cell++) {
        if (value[top[cell]] - value[cell] > worst->drop) {
            worst->drop = value[top[cell]] - value[cell];
            worst->before = top[cell];
            worst->after = cell;
        }
    }
    free(top);
    return EXIT_FINE;
}

/* "distance_m = 4.98, closing_mps = 29.925" */
static void describe_cell(const struct table *table, size_t cell, char *buffer, size_t size)
{
    size_t at[TABLE_INPUTS_MAX];
    size_t used = 0;

    table_coordinates(table, cell, at);
    for (size_t i = 0; i < table->inputs && used < size; i++) {
        int length = snprintf(buffer + used, size - used, "%s%s = %.6g", i == 0 ? "" : ", ",
                              table->fis->input[i].name, table_axis_value(table, i, at[i]));
        used += length > 0 ? (size_t)length : 0;
    }
}

void check_monotone(const struct table *table, const struct laws *laws, struct findings *findings)
{
    char before[300], after[300], only[16];

    for (size_t o = 0; o < table->outputs; o++) {
        const struct variable *output = &table->fis->output[o];
        const struct law *law = laws_of(laws, o);
        const int *value = table->cell[o];
        struct worst worst;
        size_t broken = 0;

        if (law->text == NULL) {
            continue;
        }
        if (find_worst(table, value, law, &worst) != EXIT_FINE) {
            findings->errors++;
            return;
        }
        if (worst.drop == 0) {
            continue;
        }
        for (size_t i = 0; i < table->inputs; i++) {
            if (law->direction[i] != 0) {
                broken += broken_pairs(table, value, i, law->direction[i]);
            }
        }
        describe_cell(table, worst.before, before, sizeof before);
        describe_cell(table, worst.after, after, sizeof after);
        only[0] = '\0';
        if (law != &laws->common) {
            snprintf(only, sizeof only, "%d:", (int)o + 1);
        }
        findings->errors++;
        diag_error(table->fis->file, output->line,
                   "(monotone) '%s' breaks %s between %zu pairs of neighbours; worst, it is %d at "
                   "%s but %d at %s; "
                   "`fistab table --repair=%s%s` mends the table",
                   output->name, law->text, broken, value[worst.before], before, value[worst.after],
                   after, only, law->text);
    }
}
