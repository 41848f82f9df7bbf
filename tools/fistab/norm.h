/* SPDX-License-Identifier: MIT */
/* Norms: how two degrees of membership become one. A t-norm joins conditions by `and`, and cuts an
 * output set to the strength of its rule (implication). An s-norm joins conditions by `or`, and
 * joins the sets that several rules give to one output (aggregation).
 *
 * The formulas are those of Klement, Mesiar and Pap, Triangular Norms (2000), which fuzzylite uses
 * too. MATLAB has min, prod, max, probor and, for aggregation, sum. */
#ifndef FUZZY51_NORM_H
#define FUZZY51_NORM_H

#include <math.h>
#include <stddef.h>

enum tnorm {
    TNORM_NONE, /* the file leaves it empty */
    TNORM_MIN,
    TNORM_PROD,
    TNORM_BOUNDED_DIFFERENCE,
    TNORM_DRASTIC_PRODUCT,
    TNORM_EINSTEIN_PRODUCT,
    TNORM_HAMACHER_PRODUCT,
    TNORM_NILPOTENT_MINIMUM,
};

enum snorm {
    SNORM_NONE,
    SNORM_MAX,
    SNORM_PROBOR, /* algebraic sum */
    SNORM_SUM,    /* not bounded by 1; for aggregation only */
    SNORM_BOUNDED_SUM,
    SNORM_NORMALIZED_SUM,
    SNORM_DRASTIC_SUM,
    SNORM_EINSTEIN_SUM,
    SNORM_HAMACHER_SUM,
    SNORM_NILPOTENT_MAXIMUM,
};

/* The names of a norm in the three file formats. A name is NULL where the format has none. */
struct norm_name {
    const char *fis;
    const char *fll;
    const char *fcl;
};

/* By the value of the enum; the entry of 0 is empty, and an entry with fis == NULL ends the list.
 */
extern const struct norm_name tnorm_name[];
extern const struct norm_name snorm_name[];

/* A and B are degrees of 0..1. Returns a degree of 0..1. */
static inline double tnorm(enum tnorm norm, double a, double b)
{
    switch (norm) {
    case TNORM_PROD:
        return a * b;
    case TNORM_BOUNDED_DIFFERENCE:
        return fmax(0, a + b - 1);
    case TNORM_DRASTIC_PRODUCT:
        return fmax(a, b) == 1 ? fmin(a, b) : 0;
    case TNORM_EINSTEIN_PRODUCT:
        return a * b / (2 - (a + b - a * b));
    case TNORM_HAMACHER_PRODUCT:
        return a + b == 0 ? 0 : fmin(1, a * b / (a + b - a * b));
    case TNORM_NILPOTENT_MINIMUM:
        return a + b > 1 ? fmin(a, b) : 0;
    default:
        return fmin(a, b);
    }
}

/* A and B are degrees of 0..1, or larger ones where SNORM_SUM made them. */
static inline double snorm(enum snorm norm, double a, double b)
{
    switch (norm) {
    case SNORM_PROBOR:
        return a + b - a * b;
    case SNORM_SUM:
        return a + b;
    case SNORM_BOUNDED_SUM:
        return fmin(1, a + b);
    case SNORM_NORMALIZED_SUM:
        return (a + b) / fmax(1, a + b);
    case SNORM_DRASTIC_SUM:
        return fmin(a, b) == 0 ? fmax(a, b) : 1;
    case SNORM_EINSTEIN_SUM:
        return fmin(1, (a + b) / (1 + a * b)); /* rounding must not exceed 1 */
    case SNORM_HAMACHER_SUM:
        return a * b == 1 ? 1 : fmin(1, fmax(0, (a + b - 2 * a * b) / (1 - a * b)));
    case SNORM_NILPOTENT_MAXIMUM:
        return a + b < 1 ? fmax(a, b) : 1;
    default:
        return fmax(a, b);
    }
}

#endif
