/* SPDX-License-Identifier: MIT */
/* fistab: fuzzy inference systems to tables for small chips. */
#include <stdio.h>
#include <string.h>

#include "command.h"
#include "diag.h"
#include "manual.h"

static int (*const run[])(int argc, char **argv) = {cmd_eval, cmd_check, cmd_table, cmd_plot,
                                                    cmd_convert};
static const struct manual_command command[] = {
    {"eval", &eval_argp, "print the outputs of a system at points"},
    {"check", &check_argp, "say what is wrong with a system"},
    {"table", &table_argp, "write a system as a C header, or as CSV"},
    {"plot", &plot_argp, "draw a system: its surface and its sets"},
    {"convert", &convert_argp, "write an FLL or FCL file as a .fis"},
};
enum { COMMANDS = sizeof command / sizeof command[0] };

static const struct manual manual = {
    .program = "fistab",
    .brief = "fuzzy inference systems to tables for small chips",
    .usage = "COMMAND FILE [OPTION...]",
    .about = "FILE describes a fuzzy system: a .fis of MATLAB's, an .fll of fuzzylite's or an .fcl "
             "of IEC "
             "61131-7. Examples:\n"
             "\n"
             "  fistab check heater.fis\n"
             "  fistab eval heater.fis 18.5 -0.2\n"
             "  fistab table heater.fis --grid=32x32 -o heater.h\n"
             "  fistab plot heater.fis -o heater.svg",
    .command = command,
    .commands = COMMANDS,
};

int main(int argc, char **argv)
{
    int status;

    argp_program_version = "fuzzy51 " FUZZY51_VERSION;
    argp_err_exit_status = EXIT_USAGE;
    if (argc < 2) {
        manual_help(stderr, &manual);
        return EXIT_USAGE;
    }
    for (int i = 0; i < COMMANDS; i++) {
        static char name[32];

        if (strcmp(argv[1], command[i].name) != 0) {
            continue;
        }
        snprintf(name, sizeof name, "fistab %s", command[i].name);
        argv[1] = name;
        return run[i](argc - 1, argv + 1);
    }
    if (manual_option(&manual, argv[1], &status)) {
        return status;
    }
    diag_error(NULL, 0, "there is no command '%s'; see `fistab --help`", argv[1]);
    return EXIT_USAGE;
}
