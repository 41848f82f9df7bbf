/* SPDX-License-Identifier: MIT */
/* One number from a sampled set. */
#ifndef FUZZY51_DEFUZZ_H
#define FUZZY51_DEFUZZ_H

#include <stdbool.h>
#include <stddef.h>

#include "fis.h"

/* Y from MU at the ascending points X, COUNT of both, by the method of OUTPUT. Returns false, and
 * leaves Y, where MU is 0 everywhere.
 *
 * As MATLAB's defuzz does it:
 *   centroid  sum(x*mu)/sum(mu)
 *   bisector  the first point where the running sum of mu reaches half of the whole
 *   mom       the mean of the points with the largest mu
 *   som, lom  of these points the one with the smallest, the largest absolute value; of two alike
 *             the left one
 * As fuzzylite 6 does it, where OUTPUT has midpoints; only centroid is the same:
 *   bisector  between the two points that meet when stripes are added from both ends
 *   mom       the middle of the first plateau of the largest mu
 *   som, lom  the first, the last point of the largest mu */
bool defuzz(const struct variable *output, const double *x, const double *mu, size_t count,
            double *y);

#endif
