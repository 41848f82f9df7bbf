/* SPDX-License-Identifier: MIT */
/* fistab eval: outputs of a system at points. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "diag.h"

enum { KEY_RULES = 0x400 };

struct session {
    const struct fis *fis;
    struct engine *engine;
    bool rules; /* to be printed */
};

struct arguments {
    struct infer_options infer;
    bool rules;
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
    case KEY_RULES:
        a->rules = true;
        return 0;
    case ARGP_KEY_ARG:
        if (a->file == NULL) {
            a->file = argument;
        } else {
            a->point[a->numbers++] = argument;
        }
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_usage(state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    {"rules", KEY_RULES, NULL, 0,
     "Below each point, print the rules that fire, as lines that begin with %", 0},
    {0},
};
static const struct argp_child children[] = {{&infer_argp, 0, NULL, 0}, {0}};
const struct argp eval_argp = {options,
                               parse,
                               "FILE [X1 X2 ...]",
                               "Prints the outputs of the system in FILE at the point X1 X2 ..., "
                               "or at each point that a line of stdin gives. The numbers of a "
                               "line stand between blanks or commas; empty lines, and lines that "
                               "begin with % or #, are ignored.\v"
                               "There is one line a point, with a blank between the outputs. "
                               "Where no rule fires, the output is the middle of its range, as "
                               "in MATLAB, with a warning on stderr; or the default value that "
                               "an FLL or FCL file gives.\n\n"
                               "Example: fistab eval tables/brake.fis 3 10",
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

/* The word that acts last stands first. */
static void print_hedges(hedges_t hedges)
{
    if (hedges != 0) {
        print_hedges(hedges >> HEDGE_BITS);
        printf("%s ", hedge_words[hedges & ((1U << HEDGE_BITS) - 1)]);
    }
}

/* Term INDEX of RULE, an input or an output VARIABLE: "distance_m is not near" */
static void print_term(const struct variable *variable, const struct rule *rule, size_t index,
                       const char *before)
{
    int term = rule->term[index];

    if (term == 0) {
        return;
    }
    printf("%s%s is ", before, variable->name);
    if (rule->hedges[index] != 0) {
        print_hedges(rule->hedges[index]);
    } else if (term < 0) {
        printf("not ");
    }
    printf("%s", fis_set(variable, term)->name);
}

/* "% 0.625 brake.fis:51: if distance_m is near and closing_mps is small then brake_pct is ..." */
static void print_rules(const struct session *s)
{
    const struct fis *fis = s->fis;

    for (size_t r = 0; r < fis->rules; r++) {
        const struct rule *rule = &fis->rule[r];
        const char *joint = " if ";

        if (engine_strength(s->engine, r) == 0) {
            continue;
        }
        printf("%% %.3g %s:%d:", engine_strength(s->engine, r), fis->file, rule->line);
        for (size_t i = 0; i < fis->inputs; i++) {
            print_term(&fis->input[i], rule, i, joint);
            if (rule->term[i] != 0) {
                joint = rule->is_or ? " or " : " and ";
            }
        }
        joint = " then ";
        for (size_t o = 0; o < fis->outputs; o++) {
            print_term(&fis->output[o], rule, fis->inputs + o, joint);
            if (rule->term[fis->inputs + o] != 0) {
                joint = ", ";
            }
        }
        putchar('\n');
    }
}

static void eval_point(const struct session *s, const double *x, const char *file, int line)
{
    const struct fis *fis = s->fis;
    double y[FIS_VARIABLES_MAX];

    for (size_t i = 0; i < fis->inputs; i++) {
        if (x[i] < fis->input[i].min || x[i] > fis->input[i].max) {
            diag_warning(file, line, "%s = %g is outside its range of %g to %g", fis->input[i].name,
                         x[i], fis->input[i].min, fis->input[i].max);
        }
    }
    engine_eval(s->engine, x, y);
    for (size_t o = 0; o < fis->outputs; o++) {
        if (!engine_fired(s->engine, o)) {
            diag_warning(file, line,
                         "no rule fires for '%s'; the answer is the middle of its range",
                         fis->output[o].name);
        }
        printf("%.10g%c", y[o], o + 1 == fis->outputs ? '\n' : ' ');
    }
    if (s->rules) {
        print_rules(s);
    }
}

static int eval_arguments(const struct session *s, const struct arguments *a)
{
    size_t inputs = s->fis->inputs;
    double x[FIS_VARIABLES_MAX];

    if (a->numbers != inputs) {
        diag_error(a->file, 0, "give %zu number%s, one for each input, not %zu", inputs,
                   inputs == 1 ? "" : "s", a->numbers);
        return EXIT_USAGE;
    }
    for (size_t i = 0; i < a->numbers; i++) {
        if (!read_number(a->point[i], &x[i])) {
            diag_error(NULL, 0, "'%s' is not a number; write one such as 12.5", a->point[i]);
            return EXIT_USAGE;
        }
    }
    eval_point(s, x, a->file, 0);
    return EXIT_FINE;
}

static int eval_line(const struct session *s, char *text, int line)
{
    size_t inputs = s->fis->inputs;
    double x[FIS_VARIABLES_MAX];
    size_t numbers = 0;
    char *rest = NULL;

    for (char *word = strtok_r(text, " \t\r\n,;", &rest); word != NULL;
         word = strtok_r(NULL, " \t\r\n,;", &rest)) {
        if (numbers == 0 && (*word == '%' || *word == '#')) {
            return EXIT_FINE;
        }
        if (numbers == inputs) {
            return diag_error("stdin", line, "more than %zu numbers, one for each input", inputs);
        }
        if (!read_number(word, &x[numbers])) {
            return diag_error("stdin", line, "'%s' is not a number; write one such as 12.5", word);
        }
        numbers++;
    }
    if (numbers == 0) {
        return EXIT_FINE;
    }
    if (numbers != inputs) {
        return diag_error("stdin", line, "give %zu number%s, one for each input, not %zu", inputs,
                          inputs == 1 ? "" : "s", numbers);
    }
    eval_point(s, x, "stdin", line);
    return EXIT_FINE;
}

static int eval_stdin(const struct session *s)
{
    char *text = NULL;
    size_t room = 0;
    int status = EXIT_FINE;

    for (int line = 1; status == EXIT_FINE && getline(&text, &room, stdin) >= 0; line++) {
        status = eval_line(s, text, line);
    }
    free(text);
    return status;
}

/* A negative number is no option. A blank in front tells so, which strtod() passes over. */
static void guard_numbers(int argc, char **argv, char **made)
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        double number;

        if (argv[i][0] != '-' || !read_number(argv[i], &number)) {
            continue;
        }
        made[i] = malloc(strlen(argv[i]) + 2);
        if (made[i] != NULL) {
            sprintf(made[i], " %s", argv[i]);
            argv[i] = made[i];
        }
    }
}

int cmd_eval(int argc, char **argv)
{
    struct arguments a = {0};
    char **made = calloc((size_t)argc, sizeof *made);
    struct fis fis;
    struct session session = {.fis = &fis};
    int status;

    a.point = calloc((size_t)argc, sizeof *a.point);
    if (a.point == NULL || made == NULL) {
        return diag_error(NULL, 0, "out of memory");
    }
    guard_numbers(argc, argv, made);
    argp_parse(&eval_argp, argc, argv, 0, NULL, &a);
    status = fis_read(a.file, &fis);
    if (status == EXIT_FINE) {
        session.engine = engine_create(&fis, &a.infer);
        session.rules = a.rules;
        if (session.engine == NULL) {
            status = EXIT_INPUT;
        } else if (a.numbers > 0) {
            status = eval_arguments(&session, &a);
        } else {
            status = eval_stdin(&session);
        }
        engine_free(session.engine);
        fis_free(&fis);
    }
    if (fflush(stdout) != 0 || ferror(stdout)) {
        status = diag_error("stdout", 0, "cannot write: %s", strerror(errno));
    }
    for (int i = 0; i < argc; i++) {
        free(made[i]);
    }
    free(made);
    free(a.point);
    return status;
}
