/* SPDX-License-Identifier: MIT */
/* Kinks and peaks of membership functions. */
#include "shape.h"

#include <math.h>

struct list {
    double *kink;
    size_t count;
};

static void add(struct list *list, double x)
{
    if (isfinite(x)) {
        list->kink[list->count++] = x;
    }
}

bool shape_is_linear(const struct set *set)
{
    switch (set->kind) {
    case MF_TRIMF:
    case MF_TRAPMF:
    case MF_LINZMF:
    case MF_LINSMF:
    case MF_PWLMF:
        return true;
    default:
        return false;
    }
}

/* Slope of F at X from four points around it; the error is of the fourth order in STEP. */
static double slope(double (*f)(double, const void *), const void *context, double x, double step)
{
    return 8 * (f(x + step, context) - f(x - step, context)) -
           (f(x + 2 * step, context) - f(x - 2 * step, context));
}

double shape_peak(double (*f)(double x, const void *context), const void *context, double left,
                  double right)
{
    double step = (right - left) / 1024;

    for (int i = 0; i < 60; i++) {
        double middle = (left + right) / 2;
        if (slope(f, context, middle, step) > 0) {
            left = middle;
        } else {
            right = middle;
        }
    }
    return (left + right) / 2;
}

static double degree(double x, const void *context)
{
    const struct set *set = context;
    return set_degree(set, x);
}

static void add_gauss(struct list *list, double sigma, double centre)
{
    add(list, centre);
    for (double far = 1.5; far < 10; far *= 2.5) {
        add(list, centre - far * sigma);
        add(list, centre + far * sigma);
    }
}

static void add_sigmoid(struct list *list, double a, double centre)
{
    add(list, centre);
    if (a == 0) {
        return;
    }
    for (double far = 2.5; far < 30; far *= 3.2) {
        add(list, centre - far / a);
        add(list, centre + far / a);
    }
}

static void add_bell(struct list *list, double a, double b, double centre)
{
    add(list, centre);
    add(list, centre - a);
    add(list, centre + a);
    if (b == 0) {
        return;
    }
    for (double far = 1.5; far < 30; far *= 4) { /* where the power in it is e to the far */
        for (int side = -1; side <= 1; side += 2) {
            add(list, centre + side * a * exp(far / (2 * b)));
            add(list, centre + side * a * exp(-far / (2 * b)));
        }
    }
}

static void add_spline(struct list *list, double a, double b)
{
    add(list, a);
    add(list, (a + b) / 2);
    add(list, b);
}

/* Where G, which has one sign left and the other one right of it, changes it. */
static double sign_change(double (*g)(double x, const double *p), const double *p, double left,
                          double right)
{
    bool sign = g(left, p) > 0;

    for (int i = 0; i < 200; i++) {
        double middle = left + (right - left) / 2;
        if ((g(middle, p) > 0) == sign) {
            left = middle;
        } else {
            right = middle;
        }
    }
    return left;
}

/* Slope of the logarithm of a product of two sigmoids; it falls from left to right. */
static double product_slope(double x, const double *p)
{
    return p[0] / (1 + exp(p[0] * (x - p[1]))) + p[2] / (1 + exp(p[2] * (x - p[3])));
}

/* Logarithm of the slope of a sigmoid. */
static double log_slope(double x, double a, double centre)
{
    double z = fabs(a * (x - centre));
    return log(fabs(a)) - z - 2 * log1p(exp(-z));
}

/* Which of two sigmoids is the steeper one, as the sign. */
static double steeper(double x, const double *p)
{
    return log_slope(x, p[0], p[1]) - log_slope(x, p[2], p[3]);
}

/* Both sigmoids and the tops that their product or difference may have between and beside them.
 * Beyond 800 over the slope a sigmoid is 0 or 1 to the last bit. */
static void add_two_sigmoids(struct list *list, const struct set *set)
{
    const double *p = set->parameter;
    double left, right, zero;

    add_sigmoid(list, p[0], p[1]);
    add_sigmoid(list, p[2], p[3]);
    if (p[0] == 0 || p[2] == 0) {
        return;
    }
    left = fmin(p[1] - 800 / fabs(p[0]), p[3] - 800 / fabs(p[2]));
    right = fmax(p[1] + 800 / fabs(p[0]), p[3] + 800 / fabs(p[2]));
    if (set->kind == MF_PSIGMF) {
        add(list, sign_change(product_slope, p, left, right));
    } else if (p[0] == p[2]) {
        add(list, (p[1] + p[3]) / 2);
    } else {
        zero = (p[0] * p[1] - p[2] * p[3]) / (p[0] - p[2]);
        add(list, zero);
        add(list, sign_change(steeper, p, fmin(left, zero), zero));
        add(list, sign_change(steeper, p, zero, fmax(right, zero)));
    }
}

size_t shape_kinks(const struct set *set, double *kink)
{
    const double *p = set->parameter;
    struct list list = {kink, 0};

    switch (set->kind) {
    case MF_TRAPMF:
        if (p[1] > p[2] &&
            p[3] >
                p[0]) { /* shoulders crossed: a lower triangle with its top where the sides meet */
            add(&list,
                (p[0] * (p[3] - p[2]) + p[3] * (p[1] - p[0])) / ((p[1] - p[0]) + (p[3] - p[2])));
        }
        /* fall through */
    case MF_TRIMF:
    case MF_LINZMF:
    case MF_LINSMF:
        for (size_t i = 0; i < set->parameters; i++) {
            add(&list, p[i]);
        }
        break;
    case MF_PWLMF:
        for (size_t i = 0; i < set->parameters; i += 2) {
            add(&list, p[i]);
        }
        break;
    case MF_GAUSSMF:
        add_gauss(&list, p[0], p[1]);
        break;
    case MF_GAUSS2MF:
        add_gauss(&list, p[0], p[1]);
        add_gauss(&list, p[2], p[3]);
        if (p[1] > p[3]) { /* the two sides overlap: a product of two bells, a bell again */
            add(&list, p[3] + (p[1] - p[3]) / (1 + (p[0] / p[2]) * (p[0] / p[2])));
        }
        break;
    case MF_GBELLMF:
        add_bell(&list, p[0], p[1], p[2]);
        break;
    case MF_SIGMF:
        add_sigmoid(&list, p[0], p[1]);
        break;
    case MF_DSIGMF:
    case MF_PSIGMF:
        add_two_sigmoids(&list, set);
        break;
    case MF_ZMF:
    case MF_SMF:
        add_spline(&list, p[0], p[1]);
        break;
    case MF_PIMF:
        add_spline(&list, p[0], p[1]);
        add_spline(&list, p[2], p[3]);
        if (p[1] > p[2]) {
            add(&list, shape_peak(degree, set, fmax(p[0], p[2]), fmin(p[1], p[3])));
        }
        break;
    default:
        break;
    }
    return list.count;
}
