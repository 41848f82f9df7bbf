/* SPDX-License-Identifier: MIT */
/* Defuzzification of a sampled set. */
#include "defuzz.h"

#include <math.h>

static double centroid(const double *x, const double *mu, size_t count, double area)
{
    double moment = 0;

    for (size_t k = 0; k < count; k++) {
        moment += x[k] * mu[k];
    }
    /* Rounding must not carry it out of the range where mu is near the smallest number there is. */
    return fmin(fmax(moment / area, x[0]), x[count - 1]);
}

static double bisector(const double *x, const double *mu, size_t count, double area)
{
    double sum = 0;
    size_t k;

    for (k = 0; k + 1 < count; k++) {
        sum += mu[k];
        if (sum >= area / 2) {
            break;
        }
    }
    return x[k];
}

static double of_maximum(enum fis_defuzz method, const double *x, const double *mu, size_t count)
{
    double largest = 0;
    double sum = 0;
    size_t points = 0;
    double smallest_x = INFINITY;
    double largest_x = 0;

    for (size_t k = 0; k < count; k++) {
        largest = fmax(largest, mu[k]);
    }
    for (size_t k = 0; k < count; k++) {
        if (mu[k] != largest) {
            continue;
        }
        sum += x[k];
        points++;
        if (points == 1 || fabs(x[k]) < fabs(smallest_x)) {
            smallest_x = x[k];
        }
        if (points == 1 || fabs(x[k]) > fabs(largest_x)) {
            largest_x = x[k];
        }
    }
    if (method == DEFUZZ_SOM) {
        return smallest_x;
    }
    return method == DEFUZZ_LOM ? largest_x : sum / (double)points;
}

/* --- fuzzylite's ways ------------------------------------------------------------------------ */

/* Values nearer than this are the same to fuzzylite 6. */
#define FUZZYLITE_SAME 1e-6

/* Adds stripes from both ends, always at the side that has less area, until none is left. */
static double fuzzylite_bisector(const double *x, const double *mu, size_t count)
{
    size_t left = 0, right = count;
    double left_area = 0, right_area = 0;
    double at_left = x[0], at_right = x[count - 1];

    while (left < right) {
        if (left_area <= right_area || fabs(left_area - right_area) < FUZZYLITE_SAME) {
            at_left = x[left];
            left_area += mu[left++];
        } else {
            at_right = x[--right];
            right_area += mu[right];
        }
    }
    return (left_area * at_right + right_area * at_left) / (left_area + right_area);
}

/* The middle of the first plateau, its left end, or the right end of the last one. */
static double fuzzylite_maximum(enum fis_defuzz method, const double *x, const double *mu,
                                size_t count)
{
    double largest = -1;
    size_t first = 0, last = 0, last_of_all = 0;
    bool on_plateau = false;

    for (size_t k = 0; k < count; k++) {
        if (mu[k] > largest && mu[k] - largest >= FUZZYLITE_SAME) {
            largest = mu[k];
            first = last = k;
            on_plateau = true;
        } else if (fabs(mu[k] - largest) < FUZZYLITE_SAME) {
            last = on_plateau ? k : last;
        } else {
            on_plateau = false;
        }
        if (fabs(mu[k] - largest) < FUZZYLITE_SAME) {
            last_of_all = k;
        }
    }
    if (method == DEFUZZ_SOM) {
        return x[first];
    }
    return method == DEFUZZ_LOM ? x[last_of_all] : (x[first] + x[last]) / 2;
}

bool defuzz(const struct variable *output, const double *x, const double *mu, size_t count,
            double *y)
{
    enum fis_defuzz method = output->defuzz_method;
    bool fuzzylite = output->midpoints > 0;
    double area = 0;

    for (size_t k = 0; k < count; k++) {
        area += mu[k];
    }
    if (area == 0) {
        return false;
    }
    if (method == DEFUZZ_CENTROID) {
        *y = centroid(x, mu, count, area);
    } else if (method == DEFUZZ_BISECTOR) {
        *y = fuzzylite ? fuzzylite_bisector(x, mu, count) : bisector(x, mu, count, area);
    } else {
        *y = fuzzylite ? fuzzylite_maximum(method, x, mu, count) : of_maximum(method, x, mu, count);
    }
    return true;
}
