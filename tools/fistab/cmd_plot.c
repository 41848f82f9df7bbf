/* SPDX-License-Identifier: MIT */
/* fistab plot: a system as a picture, drawn by gnuplot. */
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command.h"
#include "diag.h"
#include "plot.h"

enum { KEY_SETS = 0x300, KEY_AXES, NOT_THERE = 127 };

struct arguments {
    struct plot_options plot;
    const char *file;
    const char *output;
};

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "The picture: FILE.svg or FILE.png", 0},
    {"sets", KEY_SETS, NULL, 0, "Only the sets, no surface", 0},
    {"axes", KEY_AXES, "I,J", 0,
     "The inputs that span the surface; 1,2 if not given. The others stay in the middle of their "
     "range",
     0},
    {0},
};

static void parse_axes(struct arguments *a, const char *text, struct argp_state *state)
{
    char *end;
    unsigned long first = strtoul(text, &end, 10), second = 0;

    if (*end == ',') {
        second = strtoul(end + 1, &end, 10);
    }
    if (*end != '\0' || first < 1 || second < 1 || first == second || first > FIS_VARIABLES_MAX ||
        second > FIS_VARIABLES_MAX) {
        argp_error(state, "--axes=%s: give two inputs, as in --axes=1,2", text);
    }
    a->plot.axis[0] = first - 1;
    a->plot.axis[1] = second - 1;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    struct arguments *a = state->input;

    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &a->plot.infer;
        return 0;
    case 'o':
        a->output = argument;
        return 0;
    case KEY_SETS:
        a->plot.sets_only = true;
        return 0;
    case KEY_AXES:
        parse_axes(a, argument, state);
        return 0;
    case ARGP_KEY_END: {
        const char *ending = a->output != NULL ? strrchr(a->output, '.') : NULL;

        if (ending == NULL ||
            (strcasecmp(ending, ".svg") != 0 && strcasecmp(ending, ".png") != 0)) {
            argp_error(state, "give the picture a name: -o FILE.svg or -o FILE.png");
        }
        a->plot.png = strcasecmp(ending, ".png") == 0;
        return 0;
    }
    default:
        return option_file(key, argument, &a->file, state);
    }
}

static const struct argp_child children[] = {{&infer_argp, 0, NULL, 0}, {0}};
const struct argp plot_argp = {
    options,
    parse,
    "FILE.fis -o FILE.svg|FILE.png",
    "Draws the surface of FILE.fis and the sets of its variables by gnuplot.",
    children,
    NULL,
    NULL};

/* Starts gnuplot with its output going to PICTURE; SCRIPT is where it reads. -1 if not. */
static pid_t start_gnuplot(FILE *picture, FILE **script)
{
    int ends[2];
    pid_t child;

    if (pipe(ends) != 0) {
        return -1;
    }
    child = fork();
    if (child == 0) {
        dup2(ends[0], STDIN_FILENO);
        dup2(fileno(picture), STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        execlp("gnuplot", "gnuplot", "-d", "-", (char *)NULL);
        _exit(NOT_THERE);
    }
    close(ends[0]);
    *script = child > 0 ? fdopen(ends[1], "w") : NULL;
    if (*script == NULL) {
        close(ends[1]);
    }
    return child;
}

static int draw(const struct arguments *a, const struct fis *fis, FILE *picture)
{
    FILE *script = NULL;
    pid_t child;
    int status, result = EXIT_FINE;

    /* If gnuplot is gone, writing fails and its exit status says why. */
    signal(SIGPIPE, SIG_IGN);
    child = start_gnuplot(picture, &script);
    if (child < 0) {
        return diag_error(a->output, 0, "cannot start gnuplot: %s", strerror(errno));
    }
    if (script != NULL) {
        result = plot_write(script, fis, &a->plot);
        fclose(script);
    }
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    if (result != EXIT_FINE) {
        return result;
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_THERE) {
        return diag_error(
            a->output, 0,
            "gnuplot is not there; install the package gnuplot-nox (tools/deps.sh demo)");
    }
    if (script == NULL || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        return diag_error(a->output, 0, "gnuplot failed; see its message above");
    }
    return EXIT_FINE;
}

static int check_axes(const struct arguments *a, const struct fis *fis)
{
    for (int i = 0; i < 2 && fis->inputs > 1; i++) {
        if (a->plot.axis[i] < fis->inputs) {
            continue;
        }
        diag_error(a->file, 0, "--axes names input %zu, but the system has %zu inputs",
                   a->plot.axis[i] + 1, fis->inputs);
        return EXIT_USAGE;
    }
    return EXIT_FINE;
}

int cmd_plot(int argc, char **argv)
{
    struct arguments a = {.plot = {.axis = {0, 1}}};
    struct outfile out;
    struct fis fis;
    int status;

    argp_parse(&plot_argp, argc, argv, 0, NULL, &a);
    if (outfile_check((const char *const[]){a.output}, 1, a.file) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    status = fis_read(a.file, &fis);
    if (status != EXIT_FINE) {
        return status;
    }
    status = check_axes(&a, &fis);
    if (status == EXIT_FINE) {
        status = outfile_open(&out, a.output);
        if (status == EXIT_FINE) {
            status = draw(&a, &fis, out.stream);
            if (status == EXIT_FINE) {
                status = outfile_commit(&out);
            } else {
                outfile_abandon(&out);
            }
        }
    }
    fis_free(&fis);
    return status;
}
