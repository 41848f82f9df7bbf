/* SPDX-License-Identifier: MIT */
/* The table as a C header and as CSV. */
#include "header.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "crc.h"

struct writer {
    FILE *out;
    const struct table *table;
    const struct header_options *options;
    char lower[64];
    char upper[64];
};

bool header_reciprocal(unsigned long span_milli, unsigned long cells, unsigned *mul,
                       unsigned *shift)
{
    if (span_milli == 0 || span_milli > 0xFFFF) {
        return false;
    }
    for (*shift = 0; *shift < 16; ++*shift) {
        unsigned long long scaled = (unsigned long long)cells << (16 + *shift);
        unsigned long long candidate = (scaled + span_milli - 1) / span_milli;
        unsigned long offset = 0;

        if (candidate > 0xFFFF) {
            return false;
        }
        *mul = (unsigned)candidate;
        while (offset <= span_milli &&
               offset * candidate >> (16 + *shift) == offset * cells / span_milli) {
            offset++;
        }
        if (offset > span_milli) {
            return true;
        }
    }
    return false;
}

/* Thousandths of VALUE if it is a whole number of them that a long holds on the chip. */
static bool milli(double value, long *thousandths)
{
    double scaled = value * 1000;
    double whole = nearbyint(scaled);

    if (fabs(whole) > 2147483647.0 || fabs(scaled - whole) > 1e-6) {
        return false;
    }
    *thousandths = (long)whole;
    return true;
}

/* A name from the file, unable to end the comment that it stands in. */
static void put_text(FILE *out, const char *text)
{
    for (; *text != '\0'; text++) {
        putc((unsigned char)*text < ' ' || *text == '*' ? '.' : *text, out);
    }
}

static void put_quoted(FILE *out, const char *text)
{
    putc('"', out);
    for (; *text != '\0'; text++) {
        if (*text == '"' || *text == '\\') {
            putc('\\', out);
        }
        putc((unsigned char)*text < ' ' ? '.' : *text, out);
    }
    putc('"', out);
}

static const char *file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

/* "Mamdani: and min, or max, implication min, aggregation max, centroid of 101 samples." */
static void write_output_methods(const struct writer *w, const struct block *block,
                                 const struct variable *output)
{
    const struct infer_options *infer = &w->table->options.infer;
    bool is_mamdani = output->type == FIS_MAMDANI;

    fprintf(w->out, "%s: and %s, or %s", fis_type_words[output->type],
            tnorm_name[block->and_method].fis, snorm_name[block->or_method].fis);
    if (is_mamdani) {
        fprintf(w->out, ", implication %s, aggregation %s", tnorm_name[block->imp_method].fis,
                snorm_name[output->agg_method].fis);
    }
    fprintf(w->out, ", %s", fis_defuzz_words[output->defuzz_method]);
    if (is_mamdani && infer->exact) {
        fprintf(w->out, ", integrated exactly");
    } else if (is_mamdani) {
        fprintf(w->out, " of %zu %s", infer_samples(infer, output),
                output->midpoints != 0 ? "midpoints" : "samples");
    }
    fprintf(w->out, ".\n");
}

static bool same_methods(const struct variable *a, const struct variable *b)
{
    return a->type == b->type && a->agg_method == b->agg_method &&
           a->defuzz_method == b->defuzz_method && a->midpoints == b->midpoints;
}

static bool same_operators(const struct block *a, const struct block *b)
{
    return a->and_method == b->and_method && a->or_method == b->or_method &&
           a->imp_method == b->imp_method;
}

/* The operators of the rules that set OUTPUT; NULL where they differ. */
static const struct block *operators_of(const struct fis *fis, size_t output)
{
    const struct block *found = NULL;

    for (size_t r = 0; r < fis->rules; r++) {
        const struct block *block = &fis->block[fis->rule[r].block];

        if (fis->rule[r].term[fis->inputs + output] == 0) {
            continue;
        }
        if (found != NULL && !same_operators(found, block)) {
            return NULL;
        }
        found = block;
    }
    return found != NULL ? found : &fis->block[0];
}

static void write_methods(const struct writer *w)
{
    const struct fis *fis = w->table->fis;
    const struct table_options *options = &w->table->options;
    bool same = true;

    for (size_t o = 1; o < fis->outputs; o++) {
        const struct block *first = operators_of(fis, 0), *other = operators_of(fis, o);

        same = same && same_methods(&fis->output[0], &fis->output[o]) && first != NULL &&
               other != NULL && same_operators(first, other);
    }
    for (size_t o = 0; o < (same ? 1 : fis->outputs); o++) {
        const struct block *block = operators_of(fis, o);

        fprintf(w->out, " * ");
        if (!same) {
            fprintf(w->out, "output %zu: ", o + 1);
        }
        if (block == NULL) {
            fprintf(w->out, "rule blocks with other operators, ");
            block = &fis->block[0];
        }
        write_output_methods(w, block, &fis->output[o]);
    }
    fprintf(w->out, " * %s; value = round(%d * (output - min) / (max - min)), half %s",
            options->nodes ? "Sampled at nodes from end to end" : "Sampled at cell centres",
            options->levels, options->half_down ? "down" : "up");
    fprintf(w->out, ".\n * Repair: %s.\n",
            w->options->repair != NULL ? w->options->repair : "none");
}

static void write_comment(const struct writer *w)
{
    const struct fis *fis = w->table->fis;

    fprintf(w->out, "/* Made by fistab (fuzzy51 " FUZZY51_VERSION ") from ");
    put_text(w->out, file_name(fis->file));
    fprintf(w->out, ", CRC-32 0x%08lX; do not edit.\n", (unsigned long)fis->crc32);
    write_methods(w);
    for (size_t i = 0; i < w->table->inputs; i++) {
        fprintf(w->out, " * input %zu, ", i + 1);
        put_text(w->out, fis->input[i].name);
        fprintf(w->out, ": %.10g to %.10g in %zu %s\n", fis->input[i].min, fis->input[i].max,
                w->table->dims[i], w->table->options.nodes ? "nodes" : "cells");
    }
    for (size_t o = 0; o < w->table->outputs; o++) {
        fprintf(w->out, " * output %zu, ", o + 1);
        put_text(w->out, fis->output[o].name);
        fprintf(w->out, ": 0 means %.10g, %d means %.10g\n", fis->output[o].min,
                w->table->options.levels, fis->output[o].max);
    }
    fprintf(w->out, " */\n");
}

static void write_range(const struct writer *w, const char *kind, size_t number,
                        const struct variable *variable)
{
    long min, span;

    if (milli(variable->min, &min) && milli(variable->max - variable->min, &span)) {
        fprintf(w->out, "#define %s_%s%zu_MIN_MILLI %ldL\n", w->upper, kind, number, min);
        fprintf(w->out, "#define %s_%s%zu_SPAN_MILLI %ldUL\n", w->upper, kind, number, span);
    } else {
        fprintf(
            w->out,
            "/* %s%zu: its range is not in whole thousandths, so no MIN_MILLI and SPAN_MILLI. */\n",
            kind, number);
    }
}

static void write_input(const struct writer *w, size_t i)
{
    const struct variable *input = &w->table->fis->input[i];
    size_t dim = w->table->dims[i];
    size_t cells = w->table->options.nodes ? dim - 1 : dim;
    long min, span;
    unsigned mul, shift;

    fprintf(w->out, "\n");
    if (w->table->options.nodes) {
        fprintf(w->out, "#define %s_IN%zu_NODES %zu\n", w->upper, i + 1, dim);
    }
    fprintf(w->out, "#define %s_IN%zu_CELLS %zu\n", w->upper, i + 1, cells);
    write_range(w, "IN", i + 1, input);
    if (!milli(input->min, &min) || !milli(input->max - input->min, &span)) {
        return;
    }
    if (header_reciprocal((unsigned long)span, cells, &mul, &shift)) {
        fprintf(w->out, "/* cell = ((x_milli - MIN_MILLI) * MUL) >> (16 + SHIFT), proved for every "
                        "x_milli */\n");
        fprintf(w->out, "#define %s_IN%zu_MUL %uU\n", w->upper, i + 1, mul);
        fprintf(w->out, "#define %s_IN%zu_SHIFT %u\n", w->upper, i + 1, shift);
    } else {
        fprintf(w->out, "/* IN%zu: no MUL and SHIFT of 16 bits is exact over this span. */\n",
                i + 1);
    }
}

static size_t array_bytes(const struct header_array *array)
{
    size_t bytes = 1;
    for (size_t d = 0; d < array->dimensions; d++) {
        bytes *= array->dims[d];
    }
    return bytes;
}

/* One dimension of an initializer, with braces around each row as compilers like them. */
static const uint8_t *write_braces(FILE *out, const struct header_array *array, size_t dimension,
                                   const uint8_t *byte)
{
    bool is_row = dimension + 1 == array->dimensions;

    putc('{', out);
    for (size_t i = 0; i < array->dims[dimension]; i++) {
        if (!is_row) {
            fprintf(out, "\n%*s", (int)(4 * (dimension + 1)), "");
        } else if (i > 0 && i % 20 == 0) {
            fprintf(out, "\n%*s", (int)(4 * dimension + 1), "");
        }
        if (is_row) {
            fprintf(out, "%u,", *byte++);
        } else {
            byte = write_braces(out, array, dimension + 1, byte);
        }
    }
    fprintf(out, dimension == 0 ? "\n};\n" : "},");
    return byte;
}

static void write_array(const struct writer *w, const struct header_array *array)
{
    fprintf(w->out, "static const uint8_t __code %s_%s", w->lower, array->suffix);
    for (size_t d = 0; d < array->dimensions; d++) {
        fprintf(w->out, "[%zu]", array->dims[d]);
    }
    fprintf(w->out, " = ");
    write_braces(w->out, array, 0, array->byte);
}

void header_write(FILE *out, const struct table *table, const struct header_options *options)
{
    struct writer w = {.out = out, .table = table, .options = options};
    size_t bytes = 0;
    uint16_t crc = 0xFFFF;

    for (size_t i = 0; options->name[i] != '\0' && i + 1 < sizeof w.lower; i++) {
        w.lower[i] = (char)tolower((unsigned char)options->name[i]);
        w.upper[i] = (char)toupper((unsigned char)options->name[i]);
    }
    for (size_t i = 0; i < options->arrays; i++) {
        bytes += array_bytes(&options->array[i]);
        crc = crc16_update(crc, options->array[i].byte, array_bytes(&options->array[i]));
    }
    write_comment(&w);
    fprintf(out, "#define %s_SOURCE ", w.upper);
    put_quoted(out, file_name(table->fis->file));
    fprintf(out, "\n#define %s_SOURCE_CRC32 0x%08lXUL\n", w.upper,
            (unsigned long)table->fis->crc32);
    fprintf(out, "#define %s_INPUTS %zu\n", w.upper, table->inputs);
    fprintf(out, "#define %s_OUTPUTS %zu\n", w.upper, table->outputs);
    fprintf(out, "#define %s_LEVELS %d\n", w.upper, table->options.levels);
    fprintf(out, "#define %s_IS_NODES %d\n", w.upper, table->options.nodes);
    for (size_t i = 0; i < table->inputs; i++) {
        write_input(&w, i);
    }
    fprintf(out, "\n");
    for (size_t o = 0; o < table->outputs; o++) {
        write_range(&w, "OUT", o + 1, &table->fis->output[o]);
    }
    fprintf(out, "\n#define %s_PACKED %d\n", w.upper, options->packed);
    fprintf(out, "#define %s_BYTES %zu\n", w.upper, bytes);
    fprintf(out, "#define %s_CRC16 0x%04X\n", w.upper, crc);
    for (size_t i = 0; i < options->macros; i++) {
        fprintf(out, "#define %s_%s %zu\n", w.upper, options->macro[i].suffix,
                options->macro[i].value);
    }
    fprintf(out, "\n#ifdef %s_DATA\n", w.upper);
    for (size_t i = 0; i < options->arrays; i++) {
        write_array(&w, &options->array[i]);
    }
    fprintf(out, "#endif\n");
}

static void put_csv_name(FILE *out, const char *name)
{
    putc('"', out);
    for (; *name != '\0'; name++) {
        if (*name == '"') {
            putc('"', out);
        }
        putc(*name, out);
    }
    putc('"', out);
}

void csv_write(FILE *out, const struct table *table)
{
    size_t at[TABLE_INPUTS_MAX];

    for (size_t i = 0; i < table->inputs; i++) {
        put_csv_name(out, table->fis->input[i].name);
        putc(',', out);
    }
    for (size_t o = 0; o < table->outputs; o++) {
        put_csv_name(out, table->fis->output[o].name);
        putc(o + 1 == table->outputs ? '\n' : ',', out);
    }
    for (size_t cell = 0; cell < table->cells; cell++) {
        table_coordinates(table, cell, at);
        for (size_t i = 0; i < table->inputs; i++) {
            fprintf(out, "%.10g,", table_axis_value(table, i, at[i]));
        }
        for (size_t o = 0; o < table->outputs; o++) {
            fprintf(out, "%d%c", table->cell[o][cell], o + 1 == table->outputs ? '\n' : ',');
        }
    }
}

void csv_write_changes(FILE *out, const struct table *table)
{
    size_t at[TABLE_INPUTS_MAX];

    for (size_t i = 0; i < table->inputs; i++) {
        fprintf(out, "cell%zu,", i + 1);
    }
    for (size_t i = 0; i < table->inputs; i++) {
        put_csv_name(out, table->fis->input[i].name);
        putc(',', out);
    }
    fprintf(out, "output,surface,before,after\n");
    for (size_t o = 0; o < table->outputs; o++) {
        for (size_t cell = 0; cell < table->cells; cell++) {
            double surface = table->surface[o][cell];

            if (table_rounded(table, surface) == table->cell[o][cell]) {
                continue;
            }
            table_coordinates(table, cell, at);
            for (size_t i = 0; i < table->inputs; i++) {
                fprintf(out, "%zu,", at[i]);
            }
            for (size_t i = 0; i < table->inputs; i++) {
                fprintf(out, "%.10g,", table_axis_value(table, i, at[i]));
            }
            put_csv_name(out, table->fis->output[o].name);
            fprintf(out, ",%.10g,%d,%d\n", surface, table_rounded(table, surface),
                    table->cell[o][cell]);
        }
    }
}
