/* SPDX-License-Identifier: MIT */
/* Options that several commands share. */
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>

#include "command.h"
#include "diag.h"

enum { KEY_SAMPLES = 0x100, KEY_EXACT, KEY_GRID, KEY_NODES, KEY_LEVELS, KEY_HALF_DOWN };

long option_integer(const char *text, long min, long max, const char *option,
                    struct argp_state *state)
{
    char *end;
    long number;

    errno = 0;
    number = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || number < min || number > max) {
        argp_error(state, "%s=%s: give a whole number from %ld to %ld", option, text, min, max);
    }
    return number;
}

void option_law(const char *text, const char *option, struct laws *laws, struct argp_state *state)
{
    if (!laws_add(laws, text)) {
        argp_error(state,
                   "%s=%s: give a sign and an input each, as in %s=-1,+2, once, or once for each "
                   "output, as in %s=2:-1",
                   option, text, option, option);
    }
}

static error_t parse_infer(int key, char *argument, struct argp_state *state)
{
    struct infer_options *options = state->input;

    switch (key) {
    case KEY_SAMPLES:
        options->samples =
            (size_t)option_integer(argument, 2, INFER_SAMPLES_MAX, "--samples", state);
        return 0;
    case KEY_EXACT:
        options->exact = true;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option infer_option[] = {
    {"samples", KEY_SAMPLES, "N", 0,
     "Sample Mamdani outputs at N points; MATLAB's 101 if not given", 1},
    {"exact", KEY_EXACT, NULL, 0,
     "Integrate Mamdani outputs instead: exactly, or to 1e-9 of the range", 1},
    {0},
};

const struct argp infer_argp = {infer_option, parse_infer, NULL, NULL, NULL, NULL, NULL};

static void parse_grid_text(struct grid_options *options, const char *text,
                            struct argp_state *state)
{
    const char *at = text;
    char *end;

    for (options->inputs = 0;; at = end + 1) {
        long dim = strtol(at, &end, 10);
        if (end == at || !isdigit((unsigned char)*at) || dim < 1 || (*end != 'x' && *end != '\0') ||
            options->inputs == TABLE_INPUTS_MAX) {
            argp_error(state, "--grid=%s: give a number for each input, as in --grid=100x100",
                       text);
        }
        if (dim > TABLE_CELLS_MAX) {
            argp_error(state, "--grid=%s: a grid has at most %d cells", text, TABLE_CELLS_MAX);
        }
        options->table.dims[options->inputs++] = (size_t)dim;
        if (*end == '\0') {
            return;
        }
    }
}

static error_t parse_grid(int key, char *argument, struct argp_state *state)
{
    struct grid_options *options = state->input;

    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->table.infer;
        return 0;
    case KEY_GRID:
        parse_grid_text(options, argument, state);
        return 0;
    case KEY_NODES:
        options->table.nodes = true;
        return 0;
    case KEY_HALF_DOWN:
        options->table.half_down = true;
        return 0;
    case KEY_LEVELS:
        options->table.levels = (int)option_integer(argument, 1, 255, "--levels", state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option grid_option[] = {
    {"grid", KEY_GRID, "RxC...", 0,
     "Cells along each input; 100, 100x100, 20x20x20 or 10x10x10x10 if not given", 1},
    {"nodes", KEY_NODES, NULL, 0,
     "Sample from end to end, for tables that the firmware interpolates", 1},
    {"levels", KEY_LEVELS, "N", 0,
     "What the high end of an output's range becomes, 1..255; 100 if not given", 1},
    {"half-down", KEY_HALF_DOWN, NULL, 0,
     "Round a value half way between two integers down; up if not given", 1},
    {0},
};

static const struct argp_child grid_children[] = {{&infer_argp, 0, NULL, 0}, {0}};
const struct argp grid_argp = {grid_option, parse_grid, NULL, NULL, grid_children, NULL, NULL};

error_t option_file(int key, char *argument, const char **file, struct argp_state *state)
{
    switch (key) {
    case ARGP_KEY_ARG:
        if (*file != NULL) {
            argp_error(state, "one FILE at a time; '%s' is one too many", argument);
        }
        *file = argument;
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_usage(state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static int grid_check(const struct grid_options *options, const struct fis *fis)
{
    if (options->inputs == 0 || options->inputs == fis->inputs) {
        return EXIT_FINE;
    }
    diag_error(fis->file, 0, "--grid has %zu numbers, but the system has %zu inputs",
               options->inputs, fis->inputs);
    return EXIT_USAGE;
}

int options_read_fis(const char *file, const struct grid_options *grid, const struct laws *laws,
                     const char *option, struct fis *fis)
{
    int status = fis_read(file, fis);

    if (status != EXIT_FINE) {
        return status;
    }
    status = grid_check(grid, fis);
    if (status == EXIT_FINE) {
        status = laws_check(laws, fis, option);
    }
    if (status != EXIT_FINE) {
        fis_free(fis);
    }
    return status;
}
