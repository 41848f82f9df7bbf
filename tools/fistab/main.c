/* SPDX-License-Identifier: MIT */
/* fistab: fuzzy inference systems to tables for small chips. */
#include <stdio.h>
#include <string.h>

#include "command.h"
#include "diag.h"

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *help;
} command[] = {
    {"eval", cmd_eval, "outputs of a system at points"},
    {"check", cmd_check, "what is wrong with a system"},
    {"table", cmd_table, "a system as a C header, or as CSV"},
    {"plot", cmd_plot, "a system as a picture: its surface and its sets"},
};
enum { COMMANDS = sizeof command / sizeof command[0] };

static void print_help(FILE *out)
{
    fprintf(out, "Usage: fistab COMMAND FILE.fis [OPTION...]\n\n");
    for (int i = 0; i < COMMANDS; i++) {
        fprintf(out, "  %-7s %s\n", command[i].name, command[i].help);
    }
    fprintf(out, "\n`fistab COMMAND --help` tells the options.\n");
}

int main(int argc, char **argv)
{
    argp_program_version = "fuzzy51 " FUZZY51_VERSION;
    argp_err_exit_status = EXIT_USAGE;
    if (argc < 2) {
        print_help(stderr);
        return EXIT_USAGE;
    }
    for (int i = 0; i < COMMANDS; i++) {
        static char name[32];

        if (strcmp(argv[1], command[i].name) != 0) {
            continue;
        }
        snprintf(name, sizeof name, "fistab %s", command[i].name);
        argv[1] = name;
        return command[i].run(argc - 1, argv + 1);
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-?") == 0) {
        print_help(stdout);
        return EXIT_FINE;
    }
    if (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0) {
        puts(argp_program_version);
        return EXIT_FINE;
    }
    diag_error(NULL, 0, "there is no command '%s'; see `fistab --help`", argv[1]);
    return EXIT_USAGE;
}
