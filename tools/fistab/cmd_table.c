/* SPDX-License-Identifier: MIT */
/* fistab table: a system as a table of integers. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "command.h"
#include "diag.h"
#include "encode.h"
#include "header.h"
#include "repair.h"
#include "table.h"

enum { KEY_NAME = 0x200, KEY_CSV, KEY_ENCODING, KEY_REPAIR, KEY_CHANGES, KEY_TARGET };

struct arguments {
    struct grid_options grid;
    const char *file;
    const char *name;
    const char *header_path;
    const char *csv_path;
    const char *changes_path;
    struct laws laws; /* what --repair asks for */
    bool packed;
    bool any_c; /* --target=c */
};

static const struct argp_option options[] = {
    {"output", 'o', "FILE.h", 0,
     "Write the header to FILE.h; stdout if neither this nor --csv is given", 0},
    {"csv", KEY_CSV, "FILE", 0, "Write the same numbers to FILE, one line a cell", 0},
    {"name", KEY_NAME, "NAME", 0,
     "Prefix of the header's symbols; the name of FILE.fis if not given", 0},
    {"encoding", KEY_ENCODING, "plain|packed", 0,
     "How the header stores the table; packed is small, for two inputs and one output", 0},
    {"target", KEY_TARGET, "lut|c", 0,
     "What reads the header: firmware/lib/lut.c of this project, with its limits, or any C "
     "program; "
     "lut if not given",
     0},
    {"repair", KEY_REPAIR, "SPEC", 0,
     "Take the nearest table that obeys SPEC: -1,+2 falls with input 1 and rises with input 2; "
     "2:-1 "
     "is for output 2 alone",
     0},
    {"changes", KEY_CHANGES, "FILE", 0,
     "Write the cells that --repair changed to FILE, one line a cell", 0},
    {0},
};

static bool is_identifier(const char *name)
{
    size_t length = strlen(name);

    if (length == 0 || length > 40 || isdigit((unsigned char)name[0])) {
        return false;
    }
    for (; *name != '\0'; name++) {
        if (!isalnum((unsigned char)*name) && *name != '_') {
            return false;
        }
    }
    return true;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    struct arguments *a = state->input;

    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &a->grid;
        return 0;
    case 'o':
        a->header_path = argument;
        return 0;
    case KEY_CSV:
        a->csv_path = argument;
        return 0;
    case KEY_NAME:
        if (!is_identifier(argument)) {
            argp_error(state, "--name=%s: give a C identifier of at most 40 characters", argument);
        }
        a->name = argument;
        return 0;
    case KEY_ENCODING:
        a->packed = strcmp(argument, "packed") == 0;
        if (!a->packed && strcmp(argument, "plain") != 0) {
            argp_error(state, "--encoding=%s: give plain or packed", argument);
        }
        return 0;
    case KEY_REPAIR:
        option_law(argument, "--repair", &a->laws, state);
        return 0;
    case KEY_TARGET:
        a->any_c = strcmp(argument, "c") == 0;
        if (!a->any_c && strcmp(argument, "lut") != 0) {
            argp_error(state, "--target=%s: give lut or c", argument);
        }
        return 0;
    case KEY_CHANGES:
        a->changes_path = argument;
        return 0;
    case ARGP_KEY_END:
        if (a->grid.table.half_down && a->laws.any) {
            argp_error(state, "--half-down and --repair: choose one, a repair starts from half up");
        }
        if (a->changes_path != NULL && !a->laws.any) {
            argp_error(state, "--changes lists what --repair changed; give --repair=SPEC too");
        }
        return 0;
    default:
        return option_file(key, argument, &a->file, state);
    }
}

static const struct argp_child children[] = {{&grid_argp, 0, NULL, 0}, {0}};
const struct argp table_argp = {
    options,  parse,
    "FILE",   "Samples the system in FILE on a grid and writes the table as a C header or as CSV.",
    children, NULL,
    NULL};

/* "dir/gap-rate.fis" -> "gap_rate" */
static void name_from_file(const char *path, char *name, size_t size)
{
    const char *slash = strrchr(path, '/');
    const char *stem = slash != NULL ? slash + 1 : path;
    size_t length = strcspn(stem, ".");
    size_t used = 0;

    if (isdigit((unsigned char)stem[0]) || length == 0) {
        name[used++] = 't';
    }
    for (size_t i = 0; i < length && used + 1 < size; i++) {
        name[used++] = isalnum((unsigned char)stem[i]) ? stem[i] : '_';
    }
    name[used] = '\0';
}

/* Repairs the outputs that have a law, and says on stderr what that changed; SUMMARY gets it for
 * the header. */
static int repair(const struct arguments *a, struct table *table, char *summary, size_t size)
{
    size_t used = (size_t)snprintf(summary, size, "%s", a->laws.text);

    for (size_t o = 0; o < table->outputs; o++) {
        const char *name = table->fis->output[o].name;
        const struct law *law = laws_of(&a->laws, o);
        struct repair_report report;

        if (law->text == NULL) {
            continue;
        }
        if (repair_output(table, o, law, &report) != 0) {
            return diag_error(a->file, 0, "out of memory");
        }
        if (report.broken_after != 0) {
            return diag_error(a->file, 0,
                              "the repair of '%s' left %zu broken pairs: a fault in fistab", name,
                              report.broken_after);
        }
        fprintf(stderr,
                "%s: '%s' broke %s between %zu pairs of neighbours; repaired by changing %zu of "
                "%zu cells by at most "
                "%d; the squares to the surface sum to %.3f, %.3f before\n",
                a->file, name, law->text, report.broken_before, report.changed, table->cells,
                report.largest, report.squares_after, report.squares_before);
        if (used < size) {
            used += (size_t)snprintf(summary + used, size - used,
                                     "; %zu of %zu cells of output %zu changed by at most %d",
                                     report.changed, table->cells, o + 1, report.largest);
        }
    }
    return EXIT_FINE;
}

/* What firmware/lib/lut.c can look up. An 8051 has 65,536 bytes for its program and the table; the
 * least program takes some hundred of them. */
enum { LUT_INPUTS_MAX = 3, LUT_CELLS_MAX = 256, LUT_BYTES_MAX = 65000 };

static int check_target(const struct arguments *a, const struct table *table)
{
    const char *advice = "; give --target=c for a header that your own C indexes";
    size_t outputs_max = table->inputs == LUT_INPUTS_MAX ? 2 : 1;

    if (a->any_c) {
        return EXIT_FINE;
    }
    if (table->inputs > LUT_INPUTS_MAX) {
        return diag_error(a->file, 0, "%zu inputs, but the firmware's look-up takes at most %d%s",
                          table->inputs, LUT_INPUTS_MAX, advice);
    }
    if (table->outputs > outputs_max) {
        return diag_error(a->file, 0,
                          "%zu outputs, but the firmware's look-up takes %zu of a table with %zu "
                          "inputs; make a system for each output, or%s",
                          table->outputs, outputs_max, table->inputs, advice + 1);
    }
    for (size_t i = 0; i < table->inputs; i++) {
        if (table->dims[i] > LUT_CELLS_MAX) {
            return diag_error(
                a->file, 0,
                "%zu cells along '%s', but the firmware's look-up takes at most %d, as "
                "an index is one byte; give a smaller --grid, or%s",
                table->dims[i], table->fis->input[i].name, LUT_CELLS_MAX, advice + 1);
        }
    }
    if (!a->packed && table->cells * table->outputs > LUT_BYTES_MAX) {
        return diag_error(a->file, 0,
                          "a table of %zu bytes leaves no room for a program in an 8051's 65,536; "
                          "give a smaller --grid, or%s",
                          table->cells * table->outputs, advice + 1);
    }
    return EXIT_FINE;
}

static int write_header(FILE *out, const struct arguments *a, const struct table *table,
                        const char *repaired)
{
    char name[48];

    if (check_target(a, table) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    name_from_file(a->file, name, sizeof name);
    return encode_write(out, table, a->name != NULL ? a->name : name, repaired, a->packed);
}

/* All files are made whole before any gets its name. */
static int write_files(const struct arguments *a, const struct table *table, const char *repaired)
{
    const char *const path[] = {a->csv_path, a->changes_path, a->header_path};
    enum { CSV, CHANGES, HEADER, FILES };
    struct outfile out[FILES] = {0};
    int status = EXIT_FINE;

    for (int i = 0; i < FILES && status == EXIT_FINE; i++) {
        if (path[i] != NULL) {
            status = outfile_open(&out[i], path[i]);
        }
    }
    if (status == EXIT_FINE && out[HEADER].stream != NULL) {
        status = write_header(out[HEADER].stream, a, table, repaired);
    } else if (status == EXIT_FINE && a->csv_path == NULL) {
        status = write_header(stdout, a, table, repaired);
    }
    if (status == EXIT_FINE && out[CSV].stream != NULL) {
        csv_write(out[CSV].stream, table);
    }
    if (status == EXIT_FINE && out[CHANGES].stream != NULL) {
        csv_write_changes(out[CHANGES].stream, table);
    }
    for (int i = 0; i < FILES && status == EXIT_FINE; i++) {
        if (out[i].stream != NULL) {
            status = outfile_flush(&out[i]);
        }
    }
    for (int i = 0; i < FILES && status == EXIT_FINE; i++) {
        if (out[i].stream != NULL) {
            status = outfile_commit(&out[i]);
        }
    }
    for (int i = 0; i < FILES; i++) {
        outfile_abandon(&out[i]);
    }
    if (status == EXIT_FINE && fflush(stdout) != 0) {
        status = diag_error("stdout", 0, "cannot write");
    }
    return status;
}

int cmd_table(int argc, char **argv)
{
    struct arguments a = {.grid = GRID_OPTIONS_DEFAULT};
    struct findings findings = {0, 0};
    char repaired[4000];
    struct table table;
    struct fis fis;
    int status;

    argp_parse(&table_argp, argc, argv, 0, NULL, &a);
    if (outfile_check((const char *const[]){a.csv_path, a.changes_path, a.header_path}, 3,
                      a.file) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    status = options_read_fis(a.file, &a.grid, &a.laws, "--repair", &fis);
    if (status != EXIT_FINE) {
        return status;
    }
    check_fis(&fis, &findings);
    if (findings.errors > 0) {
        status = EXIT_INPUT;
    }
    if (status == EXIT_FINE) {
        status = table_make(&fis, &a.grid.table, &table);
    }
    if (status == EXIT_FINE) {
        if (a.laws.any) {
            status = repair(&a, &table, repaired, sizeof repaired);
        }
        if (status == EXIT_FINE) {
            status = write_files(&a, &table, a.laws.any ? repaired : NULL);
        }
        table_free(&table);
    }
    fis_free(&fis);
    return status;
}
