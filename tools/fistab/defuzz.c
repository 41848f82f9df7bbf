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

bool defuzz(enum fis_defuzz method, const double *x, const double *mu, size_t count, double *y)
{
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
        *y = bisector(x, mu, count, area);
    } else {
        *y = of_maximum(method, x, mu, count);
    }
    return true;
}
