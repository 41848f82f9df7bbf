/* SPDX-License-Identifier: MIT */
/* The commands of fistab, one file each, and the options that they share. */
#ifndef FUZZY51_COMMAND_H
#define FUZZY51_COMMAND_H

#include <argp.h>

#include "infer.h"
#include "law.h"
#include "table.h"

/* Each gets its own name as argv[0], the rest of the command line after it, and returns an exit
 * status. */
int cmd_eval(int argc, char **argv);
int cmd_check(int argc, char **argv);
int cmd_table(int argc, char **argv);
int cmd_plot(int argc, char **argv);
int cmd_convert(int argc, char **argv);

/* Their options, for argp and for what is made from them: manual page and completion. */
extern const struct argp eval_argp, check_argp, table_argp, plot_argp, convert_argp;

/* --samples=N and --exact; a child parser whose input is a struct infer_options. */
extern const struct argp infer_argp;

/* --grid, --nodes, --levels and those of infer_argp; a child parser whose input is a struct
 * grid_options. */
struct grid_options {
    struct table_options table;
    size_t inputs; /* how many numbers --grid has; 0: not given */
};
#define GRID_OPTIONS_DEFAULT {.table = {.levels = 100}}
extern const struct argp grid_argp;

/* A whole number of MIN..MAX, or a usage message about OPTION and exit. */
long option_integer(const char *text, long min, long max, const char *option,
                    struct argp_state *state);

/* Adds a law of monotony, or ends with a usage message about OPTION. */
void option_law(const char *text, const char *option, struct laws *laws, struct argp_state *state);

/* What is left of a command's line, its one FILE: a usage message and exit where there is none, or
 * two. ARGP_ERR_UNKNOWN for every other KEY. */
error_t option_file(int key, char *argument, const char **file, struct argp_state *state);

/* Reads FILE, and holds --grid and LAWS, which OPTION brought, against its inputs and outputs.
 * EXIT_FINE; or EXIT_INPUT or EXIT_USAGE after a message, and there is no FIS to free. */
int options_read_fis(const char *file, const struct grid_options *grid, const struct laws *laws,
                     const char *option, struct fis *fis);

#endif
