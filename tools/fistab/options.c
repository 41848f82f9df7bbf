/* Options that several commands share. */
#include <errno.h>
#include <stdlib.h>

#include "command.h"

enum { KEY_SAMPLES = 0x100, KEY_EXACT };

long option_integer(const char *text, long min, long max, const char *option,
                    struct argp_state *state)
{
    char *end;
    long number;

    errno = 0;
    number = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || number < min || number > max)
        argp_error(state, "%s=%s: give a whole number from %ld to %ld", option, text, min, max);
    return number;
}

void option_law(const char *text, const char *option, struct law *law, struct argp_state *state)
{
    if (!law_parse(text, law))
        argp_error(state, "%s=%s: give a sign and an input each, as in %s=-1,+2", option, text,
                   option);
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
