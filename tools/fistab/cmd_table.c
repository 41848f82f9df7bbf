/* fistab table: a system as a table of integers. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "diag.h"
#include "header.h"
#include "table.h"

enum { KEY_NAME = 0x200, KEY_GRID, KEY_NODES, KEY_LEVELS, KEY_CSV, KEY_ENCODING };

struct arguments {
    struct table_options table;
    size_t grid_inputs; /* how many numbers --grid has; 0: not given */
    const char *file;
    const char *name;
    const char *header_path;
    const char *csv_path;
};

static const struct argp_option options[] = {
    {"output", 'o', "FILE.h", 0,
     "Write the header to FILE.h; stdout if neither this nor --csv is given", 0},
    {"csv", KEY_CSV, "FILE", 0, "Write the same numbers to FILE, one line a cell", 0},
    {"name", KEY_NAME, "NAME", 0,
     "Prefix of the header's symbols; the name of FILE.fis if not given", 0},
    {"grid", KEY_GRID, "RxC...", 0,
     "Cells along each input; 100, 100x100, 20x20x20 or 10x10x10x10 if not given", 0},
    {"nodes", KEY_NODES, NULL, 0,
     "Sample from end to end, for tables that the firmware interpolates", 0},
    {"levels", KEY_LEVELS, "N", 0,
     "What the high end of an output's range becomes, 1..255; 100 if not given", 0},
    {"encoding", KEY_ENCODING, "plain", 0, "How the header stores the table", 0},
    {0},
};

static void parse_grid(struct arguments *a, const char *text, struct argp_state *state)
{
    const char *at = text;
    char *end;

    for (a->grid_inputs = 0;; at = end + 1) {
        long dim = strtol(at, &end, 10);
        if (end == at || dim < 1 || dim > TABLE_CELLS_MAX || (*end != 'x' && *end != '\0') ||
            a->grid_inputs == TABLE_INPUTS_MAX)
            argp_error(state, "--grid=%s: give one number an input, as in --grid=100x100", text);
        a->table.dims[a->grid_inputs++] = (size_t)dim;
        if (*end == '\0')
            return;
    }
}

static bool is_identifier(const char *name)
{
    size_t length = strlen(name);

    if (length == 0 || length > 40 || isdigit((unsigned char)name[0]))
        return false;
    for (; *name != '\0'; name++)
        if (!isalnum((unsigned char)*name) && *name != '_')
            return false;
    return true;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    struct arguments *a = state->input;

    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &a->table.infer;
        return 0;
    case 'o':
        a->header_path = argument;
        return 0;
    case KEY_CSV:
        a->csv_path = argument;
        return 0;
    case KEY_NAME:
        if (!is_identifier(argument))
            argp_error(state, "--name=%s: give a C identifier of at most 40 characters", argument);
        a->name = argument;
        return 0;
    case KEY_GRID:
        parse_grid(a, argument, state);
        return 0;
    case KEY_NODES:
        a->table.nodes = true;
        return 0;
    case KEY_LEVELS:
        a->table.levels = (int)option_integer(argument, 1, 255, "--levels", state);
        return 0;
    case KEY_ENCODING:
        if (strcmp(argument, "plain") != 0)
            argp_error(state, "--encoding=%s: there is only plain", argument);
        return 0;
    case ARGP_KEY_ARG:
        if (a->file != NULL)
            argp_usage(state);
        a->file = argument;
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_usage(state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&infer_argp, 0, NULL, 0}, {0}};
static const struct argp argp = {
    options,    parse,
    "FILE.fis", "Samples FILE.fis on a grid and writes the table as a C header or as CSV.",
    children,   NULL,
    NULL};

/* "dir/gap-rate.fis" -> "gap_rate" */
static void name_from_file(const char *path, char *name, size_t size)
{
    const char *slash = strrchr(path, '/');
    const char *stem = slash != NULL ? slash + 1 : path;
    size_t length = strcspn(stem, ".");
    size_t used = 0;

    if (isdigit((unsigned char)stem[0]) || length == 0)
        name[used++] = 't';
    for (size_t i = 0; i < length && used + 1 < size; i++)
        name[used++] = isalnum((unsigned char)stem[i]) ? stem[i] : '_';
    name[used] = '\0';
}

static uint8_t *bytes_of(const struct table *table, size_t output)
{
    uint8_t *byte = malloc(table->cells);

    for (size_t cell = 0; byte != NULL && cell < table->cells; cell++)
        byte[cell] = (uint8_t)table->cell[output][cell];
    return byte;
}

/* One array [rows][columns]... an output. */
static int write_plain(FILE *out, const struct table *table, const char *name)
{
    struct header_array array[FIS_VARIABLES_MAX] = {0};
    char suffix[FIS_VARIABLES_MAX][8];
    uint8_t *byte[FIS_VARIABLES_MAX] = {0};
    struct header_options header = {.name = name, .array = array, .arrays = table->outputs};
    int status = EXIT_FINE;

    for (size_t o = 0; o < table->outputs; o++) {
        byte[o] = bytes_of(table, o);
        if (byte[o] == NULL)
            status = diag_error(NULL, 0, "out of memory");
        snprintf(suffix[o], sizeof suffix[o], "out%d", (int)o + 1);
        array[o].suffix = suffix[o];
        memcpy(array[o].dims, table->dims, sizeof array[o].dims);
        array[o].dimensions = table->inputs;
        array[o].byte = byte[o];
    }
    if (status == EXIT_FINE)
        header_write(out, table, &header);
    for (size_t o = 0; o < table->outputs; o++)
        free(byte[o]);
    return status;
}

/* Both files are made whole before either gets its name. */
static int write_files(const struct arguments *a, const struct table *table)
{
    struct outfile header = {0};
    struct outfile csv = {0};
    bool to_stdout = a->header_path == NULL && a->csv_path == NULL;
    char name[48];
    int status = EXIT_FINE;

    name_from_file(a->file, name, sizeof name);
    if (a->header_path != NULL)
        status = outfile_open(&header, a->header_path);
    if (status == EXIT_FINE && a->csv_path != NULL)
        status = outfile_open(&csv, a->csv_path);
    if (status == EXIT_FINE && (to_stdout || header.stream != NULL))
        status = write_plain(to_stdout ? stdout : header.stream, table,
                             a->name != NULL ? a->name : name);
    if (status == EXIT_FINE && csv.stream != NULL)
        csv_write(csv.stream, table);
    if (status == EXIT_FINE && csv.stream != NULL)
        status = outfile_commit(&csv);
    if (status == EXIT_FINE && header.stream != NULL)
        status = outfile_commit(&header);
    outfile_abandon(&header);
    outfile_abandon(&csv);
    if (status == EXIT_FINE && fflush(stdout) != 0)
        status = diag_error("stdout", 0, "cannot write");
    return status;
}

int cmd_table(int argc, char **argv)
{
    struct arguments a = {.table = {.infer = {.samples = INFER_SAMPLES}, .levels = 100}};
    struct table table;
    struct fis fis;
    int status;

    argp_parse(&argp, argc, argv, 0, NULL, &a);
    status = fis_read(a.file, &fis);
    if (status != EXIT_FINE)
        return status;
    if (a.grid_inputs != 0 && a.grid_inputs != fis.inputs) {
        diag_error(a.file, 0, "--grid has %zu numbers, but the system has %zu inputs",
                   a.grid_inputs, fis.inputs);
        status = EXIT_USAGE;
    }
    if (status == EXIT_FINE)
        status = table_make(&fis, &a.table, &table);
    if (status == EXIT_FINE) {
        status = write_files(&a, &table);
        table_free(&table);
    }
    fis_free(&fis);
    return status;
}
