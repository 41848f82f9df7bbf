/* SPDX-License-Identifier: MIT */
#include "number.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>

static bool read_whole(const char *text, int base, long low, long high, long *value)
{
    char *end;

    errno = 0;
    *value = strtol(text, &end, base);
    return errno == 0 && end != text && *end == '\0' && *value >= low && *value <= high;
}

long parse_count(struct argp_state *state, const char *option, const char *text, long low,
                 long high)
{
    long value;

    if (!read_whole(text, 10, low, high, &value)) {
        argp_error(state, "--%s=%s: give a whole number in %ld..%ld", option, text, low, high);
    }
    return value;
}

long parse_hex(struct argp_state *state, const char *option, const char *text, long low, long high)
{
    long value;

    if (!read_whole(text, 16, low, high, &value)) {
        argp_error(state, "--%s=%s: give a hexadecimal number in %lX..%lX", option, text,
                   (unsigned long)low, (unsigned long)high);
    }
    return value;
}

double parse_number(struct argp_state *state, const char *option, const char *text, double low,
                    double high)
{
    char *end;
    double value = strtod(text, &end);

    if (end == text || *end != '\0' || !(value >= low && value <= high)) {
        argp_error(state, "--%s=%s: give a number in %g..%g", option, text, low, high);
    }
    return value;
}
