/* SPDX-License-Identifier: MIT */
/* Defuzzification of the continuous output set, not of samples of it.
 *
 * The range is cut where any set bends or meets its rule's strength; between cuts straight sets are
 * integrated as the polygon that they are, crossings of the aggregation included, others
 * adaptively. The methods are the limits of MATLAB's for ever more samples: centroid: integral of
 * x*mu over integral of mu. bisector: where the integral of mu reaches half of the whole; the left
 * end if it does so over a stretch. mom: the middle, by length, of where mu is largest; the mean of
 * the points if these have no length. som, lom: of these points the one with the smallest, the
 * largest absolute value; of two alike the left one. At a vertical edge mu is the larger side's. */
#ifndef FUZZY51_EXACT_H
#define FUZZY51_EXACT_H

#include <stdbool.h>
#include <stddef.h>

#include "fis.h"

/* One set of an output, cut or scaled by the strength of the rule that says so. */
struct exact_term {
    const struct set *set;
    bool negated;
    enum tnorm imp_method;
    double strength;   /* above 0 */
    size_t consequent; /* the evaluator's own number of it */
};

/* Y of the COUNT terms, 1 or more, aggregated as OUTPUT says over its range: within 1e-9 of the
 * range. Returns false, and leaves Y, where the set has no area. */
bool exact_defuzz(const struct variable *output, const struct exact_term *term, size_t count,
                  double *y);

#endif
