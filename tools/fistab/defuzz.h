/* One number from a sampled set, as MATLAB's defuzz does it. */
#ifndef FUZZY51_DEFUZZ_H
#define FUZZY51_DEFUZZ_H

#include <stdbool.h>
#include <stddef.h>

#include "fis.h"

/* Y from MU at the ascending points X, COUNT of both. Returns false, and leaves Y, where MU is 0
 * everywhere.
 * centroid: sum(x*mu)/sum(mu). bisector: the first point where the running sum of mu reaches half
 * of the whole. mom: mean of the points with the largest mu. som, lom: of these the one with the
 * smallest, the largest absolute value; of two alike the left one. */
bool defuzz(enum fis_defuzz method, const double *x, const double *mu, size_t count, double *y);

#endif
