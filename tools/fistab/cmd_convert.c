/* SPDX-License-Identifier: MIT */
/* fistab convert: a system in another format as a .fis. */
#include <errno.h>
#include <string.h>

#include "command.h"
#include "diag.h"
#include "write_fis.h"

struct arguments {
    const char *file;
    const char *output;
};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    struct arguments *a = state->input;

    if (key == 'o') {
        a->output = argument;
        return 0;
    }
    return option_file(key, argument, &a->file, state);
}

static const struct argp_option options[] = {
    {"output", 'o', "FILE.fis", 0, "Write to FILE.fis; to stdout if not given", 0}, {0}};
const struct argp convert_argp = {
    options,
    parse,
    "FILE",
    "Writes the system in FILE, an FLL, FCL or .fis file, as a .fis in MATLAB's format.\v"
    "A feature that a .fis cannot have is refused, with its name in the message. fuzzylite takes a "
    "Mamdani output at midpoints, MATLAB at 101 points from end to end: so the .fis gives slightly "
    "other numbers, and the same where both integrate exactly.\n\n"
    "Example: fistab convert heater.fll -o heater.fis",
    NULL,
    NULL,
    NULL};

static int write_output(const struct arguments *a, const struct fis *fis)
{
    struct outfile out;
    int status;

    if (a->output == NULL) {
        status = write_fis(stdout, fis);
        return fflush(stdout) == 0 ? status
                                   : diag_error("stdout", 0, "cannot write: %s", strerror(errno));
    }
    status = outfile_open(&out, a->output);
    if (status != EXIT_FINE) {
        return status;
    }
    status = write_fis(out.stream, fis);
    if (status == EXIT_FINE) {
        return outfile_commit(&out);
    }
    outfile_abandon(&out);
    return status;
}

int cmd_convert(int argc, char **argv)
{
    struct arguments a = {0};
    struct fis fis;
    int status;

    argp_parse(&convert_argp, argc, argv, 0, NULL, &a);
    if (outfile_check((const char *const[]){a.output}, 1, a.file) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    status = fis_read(a.file, &fis);
    if (status != EXIT_FINE) {
        return status;
    }
    status = write_output(&a, &fis);
    fis_free(&fis);
    return status;
}
