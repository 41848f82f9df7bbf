/* SPDX-License-Identifier: MIT */
/* For tests: a small system from words, and its outputs. */
#ifndef FUZZY51_FIS_TEXT_H
#define FUZZY51_FIS_TEXT_H

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

#include "common/diag.h"
#include "fistab/infer.h"

static struct fis fis; /* of the test that runs */

/* Reads the text that FORMAT makes. */
__attribute__((format(printf, 1, 2), unused)) static void given(const char *format, ...)
{
    static char text[8192];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fis_free(&fis);
    TEST_ASSERT_EQUAL(EXIT_FINE, fis_parse("test.fis", text, strlen(text), &fis));
}

/* Evaluates it with SAMPLES samples (0: exactly). Returns how many outputs have no rule that fires.
 */
__attribute__((unused)) static size_t eval(size_t samples, const double *x, double *y)
{
    struct infer_options options = {.samples = samples != 0 ? samples : 2, .exact = samples == 0};
    struct engine *engine = engine_create(&fis, &options);
    size_t without;

    TEST_ASSERT_NOT_NULL(engine);
    without = engine_eval(engine, x, y);
    engine_free(engine);
    return without;
}

/* The first output at X1, X2, where a rule must fire. */
__attribute__((unused)) static double output(size_t samples, double x1, double x2)
{
    double x[FIS_VARIABLES_MAX] = {x1, x2};
    double y[FIS_VARIABLES_MAX];

    TEST_ASSERT_EQUAL(0, eval(samples, x, y));
    return y[0];
}

#define METHODS(and_, or_, imp_, agg_, defuzz_)                                                    \
    "AndMethod='" and_ "'\nOrMethod='" or_ "'\nImpMethod='" imp_ "'\nAggMethod='" agg_             \
    "'\nDefuzzMethod='" defuzz_ "'\n"

#endif
