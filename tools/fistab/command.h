/* The commands of fistab, one file each, and the options that they share. */
#ifndef FUZZY51_COMMAND_H
#define FUZZY51_COMMAND_H

#include <argp.h>

#include "infer.h"
#include "law.h"

/* Each gets its own name as argv[0], the rest of the command line after it, and returns an exit
 * status. */
int cmd_eval(int argc, char **argv);
int cmd_table(int argc, char **argv);

/* --samples=N and --exact; a child parser whose input is a struct infer_options. */
extern const struct argp infer_argp;

/* A whole number of MIN..MAX, or a usage message about OPTION and exit. */
long option_integer(const char *text, long min, long max, const char *option,
                    struct argp_state *state);

/* A law of monotony, or a usage message about OPTION and exit. */
void option_law(const char *text, const char *option, struct law *law, struct argp_state *state);

#endif
