/* SPDX-License-Identifier: MIT */
/* The help, the manual page and the bash completion of a tool, all from the tables that argp reads
 * the command line by: so they name every option, and no other. */
#ifndef FUZZY51_MANUAL_H
#define FUZZY51_MANUAL_H

#include <argp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct manual_command {
    const char *name; /* NULL: the tool has no commands, these are its own options */
    const struct argp *argp;
    const char *help; /* what the command does, one line that begins with a verb */
};

struct manual {
    const char *program;
    const char *brief; /* one line */
    const char *usage; /* what follows the program's name; of a tool with commands */
    const char
        *about; /* paragraphs, apart by empty lines; those that begin with blanks stay as is */
    const struct manual_command *command;
    size_t commands;
};

/* Prints the help of a tool with commands: usage, the commands, and what it is about. */
void manual_help(FILE *out, const struct manual *manual);

/* Takes OPTION if it is --man (prints the manual page, as roff) or --completion (prints the bash
 * completion); and of a tool with commands, --help and --version. Returns false if it is another
 * one; else STATUS is the exit status. */
bool manual_option(const struct manual *manual, const char *option, int *status);

#endif
