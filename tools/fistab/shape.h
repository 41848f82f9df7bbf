/* SPDX-License-Identifier: MIT */
/* What is known of the curve of a membership function besides its values: where it bends. */
#ifndef FUZZY51_SHAPE_H
#define FUZZY51_SHAPE_H

#include <stdbool.h>
#include <stddef.h>

#include "fis.h"

enum { SHAPE_KINKS_MAX = FIS_PARAMETERS_MAX / 2 + 32 };

/* Points between which the set is smooth and either rises, falls or is level all the way; more of
 * them where a steep curve would else hide between two. KINK has room for SHAPE_KINKS_MAX. Returns
 * how many; they are in no order and may repeat. */
size_t shape_kinks(const struct set *set, double *kink);

/* Straight between its kinks? */
bool shape_is_linear(const struct set *set);

/* Where F, which rises and then falls between LEFT and RIGHT, has its maximum. An end if it only
 * falls or rises. Good to about 1e-11 of RIGHT - LEFT where F is smooth. */
double shape_peak(double (*f)(double x, const void *context), const void *context, double left,
                  double right);

#endif
