/* fistab eval: outputs of a system at points. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "diag.h"

struct arguments {
    struct infer_options infer;
    const char *file;
    char **point;
    size_t numbers;
};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    struct arguments *a = state->input;

    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &a->infer;
        return 0;
    case ARGP_KEY_ARG:
        if (a->file == NULL)
            a->file = argument;
        else
            a->point[a->numbers++] = argument;
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_usage(state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&infer_argp, 0, NULL, 0}, {0}};
static const struct argp argp = {NULL,
                                 parse,
                                 "FILE.fis [X1 X2 ...]",
                                 "Prints the outputs of FILE.fis at the point X1 X2 ..., or at "
                                 "each point that a line of stdin gives: "
                                 "numbers between blanks or commas; empty lines and lines that "
                                 "begin with % or # are passed over.\v"
                                 "One line a point, outputs separated by a blank. Where no rule "
                                 "fires, the output is the middle of its "
                                 "range, as MATLAB has it, with a warning on stderr.",
                                 children,
                                 NULL,
                                 NULL};

/* A finite number that is all of TEXT. */
static bool read_number(const char *text, double *number)
{
    char *end;

    *number = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*number) && fabs(*number) <= FIS_NUMBER_MAX;
}

static void eval_point(struct engine *engine, const struct fis *fis, const double *x,
                       const char *file, int line)
{
    double y[FIS_VARIABLES_MAX];

    for (size_t i = 0; i < fis->inputs; i++)
        if (x[i] < fis->input[i].min || x[i] > fis->input[i].max)
            diag_warning(file, line, "%s = %g is outside its range of %g to %g", fis->input[i].name,
                         x[i], fis->input[i].min, fis->input[i].max);
    engine_eval(engine, x, y);
    for (size_t o = 0; o < fis->outputs; o++) {
        if (!engine_fired(engine, o))
            diag_warning(file, line,
                         "no rule fires for '%s'; the answer is the middle of its range",
                         fis->output[o].name);
        printf("%.10g%c", y[o], o + 1 == fis->outputs ? '\n' : ' ');
    }
}

static int eval_arguments(struct engine *engine, const struct fis *fis, const struct arguments *a)
{
    double x[FIS_VARIABLES_MAX];

    if (a->numbers != fis->inputs)
        return diag_error(a->file, 0, "the system has %zu inputs, but %zu numbers are given",
                          fis->inputs, a->numbers);
    for (size_t i = 0; i < a->numbers; i++)
        if (!read_number(a->point[i], &x[i]))
            return diag_error(NULL, 0, "'%s' is not a number", a->point[i]);
    eval_point(engine, fis, x, a->file, 0);
    return EXIT_FINE;
}

static int eval_line(struct engine *engine, const struct fis *fis, char *text, int line)
{
    double x[FIS_VARIABLES_MAX];
    size_t numbers = 0;
    char *rest = NULL;

    for (char *word = strtok_r(text, " \t\r\n,;", &rest); word != NULL;
         word = strtok_r(NULL, " \t\r\n,;", &rest)) {
        if (numbers == 0 && (*word == '%' || *word == '#'))
            return EXIT_FINE;
        if (numbers == fis->inputs)
            return diag_error("stdin", line, "more than %zu numbers; the system has so many inputs",
                              fis->inputs);
        if (!read_number(word, &x[numbers]))
            return diag_error("stdin", line, "'%s' is not a number", word);
        numbers++;
    }
    if (numbers == 0)
        return EXIT_FINE;
    if (numbers != fis->inputs)
        return diag_error("stdin", line, "%zu numbers, but the system has %zu inputs", numbers,
                          fis->inputs);
    eval_point(engine, fis, x, "stdin", line);
    return EXIT_FINE;
}

static int eval_stdin(struct engine *engine, const struct fis *fis)
{
    char *text = NULL;
    size_t room = 0;
    int status = EXIT_FINE;

    for (int line = 1; status == EXIT_FINE && getline(&text, &room, stdin) >= 0; line++)
        status = eval_line(engine, fis, text, line);
    free(text);
    return status;
}

/* A negative number is no option: "--" goes before the first one. */
static char **guard_numbers(int *argc, char **argv)
{
    char **guarded = malloc(((size_t)*argc + 2) * sizeof *guarded);
    bool done = false;
    int count = 0;

    if (guarded == NULL)
        return argv;
    for (int i = 0; i < *argc; i++) {
        if (strcmp(argv[i], "--") == 0)
            done = true;
        if (!done && argv[i][0] == '-' &&
            (isdigit((unsigned char)argv[i][1]) || argv[i][1] == '.')) {
            guarded[count++] = "--";
            done = true;
        }
        guarded[count++] = argv[i];
    }
    guarded[count] = NULL;
    *argc = count;
    return guarded;
}

int cmd_eval(int argc, char **argv)
{
    struct arguments a = {.infer = {.samples = INFER_SAMPLES}};
    char **guarded = guard_numbers(&argc, argv);
    struct engine *engine = NULL;
    struct fis fis;
    int status;

    a.point = calloc((size_t)argc, sizeof *a.point);
    if (a.point == NULL)
        return diag_error(NULL, 0, "out of memory");
    argp_parse(&argp, argc, guarded, 0, NULL, &a);
    status = fis_read(a.file, &fis);
    if (status == EXIT_FINE) {
        engine = engine_create(&fis, &a.infer);
        if (engine == NULL)
            status = EXIT_INPUT;
        else if (a.numbers > 0)
            status = eval_arguments(engine, &fis, &a);
        else
            status = eval_stdin(engine, &fis);
        engine_free(engine);
        fis_free(&fis);
    }
    if (fflush(stdout) != 0 || ferror(stdout))
        status = diag_error("stdout", 0, "cannot write: %s", strerror(errno));
    free(a.point);
    if (guarded != argv)
        free(guarded);
    return status;
}
