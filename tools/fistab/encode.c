/* SPDX-License-Identifier: MIT */
/* Plain and packed arrays for the header. */
#include "encode.h"

#include <stdlib.h>
#include <string.h>

#include "diag.h"
#include "header.h"
#include "pack.h"

static uint8_t *bytes_of(const struct table *table, size_t output)
{
    uint8_t *byte = malloc(table->cells);

    for (size_t cell = 0; byte != NULL && cell < table->cells; cell++) {
        byte[cell] = (uint8_t)table->cell[output][cell];
    }
    return byte;
}

/* One array [rows][columns]... an output. */
static int write_plain(FILE *out, const struct table *table, struct header_options header)
{
    struct header_array array[FIS_VARIABLES_MAX] = {0};
    char suffix[FIS_VARIABLES_MAX][8];
    uint8_t *byte[FIS_VARIABLES_MAX] = {0};
    int status = EXIT_FINE;

    for (size_t o = 0; o < table->outputs; o++) {
        byte[o] = bytes_of(table, o);
        if (byte[o] == NULL) {
            status = diag_error(NULL, 0, "out of memory");
        }
        snprintf(suffix[o], sizeof suffix[o], "out%d", (int)o + 1);
        array[o].suffix = suffix[o];
        memcpy(array[o].dims, table->dims, sizeof array[o].dims);
        array[o].dimensions = table->inputs;
        array[o].byte = byte[o];
    }
    header.array = array;
    header.arrays = table->outputs;
    if (status == EXIT_FINE) {
        header_write(out, table, &header);
    }
    for (size_t o = 0; o < table->outputs; o++) {
        free(byte[o]);
    }
    return status;
}

static int write_packed(FILE *out, const struct table *table, struct header_options header)
{
    const char *file = table->fis->file;
    struct pack pack;
    char why[PACK_WHY_BYTES];

    if (table->inputs != 2 || table->outputs != 1) {
        return diag_error(
            file, 0,
            "a packed table has two inputs and one output, this system %zu and %zu; use plain",
            table->inputs, table->outputs);
    }
    if (pack_table(&pack, table->cell[0], table->dims[0], table->dims[1], why) != 0) {
        return diag_error(file, 0, "the table does not pack: %s; use --encoding=plain", why);
    }

    const struct header_array array = {
        .suffix = "out1", .dims = {pack.count}, .dimensions = 1, .byte = pack.bytes};
    const struct header_macro macro[] = {
        {"STRIP_CELLS", pack.strip_cells}, {"FIRST_ROW", pack.first_row},
        {"BLOCKS", pack.blocks},           {"RUNS_AT", pack.runs_at},
        {"PAGES_AT", pack.pages_at},       {"STARTS_AT", pack.starts_at},
        {"BASES_AT", pack.bases_at},       {"SHAPES_AT", pack.shapes_at},
    };
    header.packed = true;
    header.array = &array;
    header.arrays = 1;
    header.macro = macro;
    header.macros = sizeof macro / sizeof macro[0];
    header_write(out, table, &header);
    pack_free(&pack);
    return EXIT_FINE;
}

int encode_write(FILE *out, const struct table *table, const char *name, const char *repair,
                 bool packed)
{
    struct header_options header = {.name = name, .repair = repair};

    return packed ? write_packed(out, table, header) : write_plain(out, table, header);
}
