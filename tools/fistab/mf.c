/* Membership functions, each as MATLAB's toolbox documents it. */
#include "mf.h"

#include <math.h>
#include <string.h>

static const struct {
    const char *name;
    size_t parameters;
} type[] = {
    [MF_TRIMF] = {"trimf", 3},       [MF_TRAPMF] = {"trapmf", 4},   [MF_GAUSSMF] = {"gaussmf", 2},
    [MF_GAUSS2MF] = {"gauss2mf", 4}, [MF_GBELLMF] = {"gbellmf", 3}, [MF_SIGMF] = {"sigmf", 2},
    [MF_DSIGMF] = {"dsigmf", 4},     [MF_PSIGMF] = {"psigmf", 4},   [MF_ZMF] = {"zmf", 2},
    [MF_SMF] = {"smf", 2},           [MF_PIMF] = {"pimf", 4},       [MF_LINZMF] = {"linzmf", 2},
    [MF_LINSMF] = {"linsmf", 2},     [MF_PWLMF] = {"pwlmf", 0},     [MF_CONSTANT] = {"constant", 1},
    [MF_LINEAR] = {"linear", 0},
};

enum mf_kind mf_kind_by_name(const char *name)
{
    enum mf_kind kind = 0;
    while (kind < MF_UNKNOWN && strcmp(name, type[kind].name) != 0) {
        kind++;
    }
    return kind;
}

const char *mf_name(enum mf_kind kind)
{
    return type[kind].name;
}

size_t mf_parameters(enum mf_kind kind, size_t inputs)
{
    return kind == MF_LINEAR ? inputs + 1 : type[kind].parameters;
}

bool mf_is_sugeno(enum mf_kind kind)
{
    return kind == MF_CONSTANT || kind == MF_LINEAR;
}

static const char *pwl_fault(const double *p, size_t count)
{
    for (size_t i = 0; i < count; i += 2) {
        if (!isfinite(p[i])) {
            return "finite x";
        }
        if (!(p[i + 1] >= 0 && p[i + 1] <= 1)) {
            return "every y within 0..1";
        }
        if (i >= 2 && p[i] < p[i - 2]) {
            return "x that never falls";
        }
        if (i >= 4 && p[i] == p[i - 4]) {
            return "at most two points at one x";
        }
    }
    return NULL;
}

const char *mf_fault(enum mf_kind kind, const double *p, size_t count)
{
    if (kind == MF_PWLMF) {
        return pwl_fault(p, count);
    }
    /* A trapezoid may be open to one side, as [-Inf -Inf 2 3] or [2 3 Inf Inf]; nothing else may.
     */
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(p[i]) && !(kind == MF_TRAPMF && ((i < 2 && p[0] == p[1] && p[i] < 0) ||
                                                       (i >= 2 && p[2] == p[3] && p[i] > 0)))) {
            return "finite numbers";
        }
    }
    switch (kind) {
    case MF_TRIMF:
        return p[0] <= p[1] && p[1] <= p[2] ? NULL : "[a b c] with a <= b <= c";
    case MF_TRAPMF:
        return p[0] <= p[1] && p[2] <= p[3] ? NULL : "[a b c d] with a <= b and c <= d";
    case MF_GAUSSMF:
        return p[0] != 0 ? NULL : "[sigma c] with sigma other than 0";
    case MF_GAUSS2MF:
        return p[0] != 0 && p[2] != 0 ? NULL : "[sigma1 c1 sigma2 c2] with sigmas other than 0";
    case MF_GBELLMF:
        return p[0] != 0 ? NULL : "[a b c] with a other than 0";
    case MF_LINZMF:
    case MF_LINSMF:
        return p[0] <= p[1] ? NULL : "[a b] with a <= b";
    default:
        return NULL;
    }
}

/* 0 below A, 1 from B on; vertical at B where A equals B. */
static double ramp_up(double x, double a, double b)
{
    if (x >= b) {
        return 1;
    }
    return x > a ? (x - a) / (b - a) : 0;
}

static double ramp_down(double x, double c, double d)
{
    if (x <= c) {
        return 1;
    }
    return x < d ? (d - x) / (d - c) : 0;
}

static double gauss(double x, double sigma, double centre)
{
    double t = (x - centre) / sigma;
    return exp(-t * t / 2);
}

static double sigmoid(double x, double slope, double centre)
{
    return 1 / (1 + exp(-slope * (x - centre)));
}

static double spline_up(double x, double a, double b)
{
    double t;

    if (a >= b) {
        return x >= (a + b) / 2;
    }
    if (x <= a) {
        return 0;
    }
    if (x >= b) {
        return 1;
    }
    t = (x - a) / (b - a);
    return t <= 0.5 ? 2 * t * t : 1 - 2 * (1 - t) * (1 - t);
}

static double spline_down(double x, double a, double b)
{
    double t;

    if (a >= b) {
        return x <= (a + b) / 2;
    }
    if (x <= a) {
        return 1;
    }
    if (x >= b) {
        return 0;
    }
    t = (x - a) / (b - a);
    return t <= 0.5 ? 1 - 2 * t * t : 2 * (1 - t) * (1 - t);
}

/* At a step, two points at one x, the larger of both counts: shoulders are closed, as trapmf's. */
static double pwl(double x, const double *p, size_t count)
{
    size_t i;

    if (x < p[0]) {
        return p[1];
    }
    for (i = 2; i < count; i += 2) {
        if (x < p[i]) {
            break;
        }
    }
    /* point i-2 is the last one at or left of x */
    if (x == p[i - 2]) {
        return i >= 4 && p[i - 4] == x ? fmax(p[i - 3], p[i - 1]) : p[i - 1];
    }
    if (i >= count) {
        return p[count - 1];
    }
    return p[i - 1] + (p[i + 1] - p[i - 1]) * (x - p[i - 2]) / (p[i] - p[i - 2]);
}

double mf_degree(enum mf_kind kind, const double *p, size_t count, double x)
{
    switch (kind) {
    case MF_TRIMF:
        return fmin(ramp_up(x, p[0], p[1]), ramp_down(x, p[1], p[2]));
    case MF_TRAPMF:
        return fmin(ramp_up(x, p[0], p[1]), ramp_down(x, p[2], p[3]));
    case MF_GAUSSMF:
        return gauss(x, p[0], p[1]);
    case MF_GAUSS2MF:
        return (x <= p[1] ? gauss(x, p[0], p[1]) : 1) * (x >= p[3] ? gauss(x, p[2], p[3]) : 1);
    case MF_GBELLMF: {
        double t = (x - p[2]) / p[0];
        return 1 / (1 + pow(t * t, p[1]));
    }
    case MF_SIGMF:
        return sigmoid(x, p[0], p[1]);
    case MF_DSIGMF:
        return fabs(sigmoid(x, p[0], p[1]) - sigmoid(x, p[2], p[3]));
    case MF_PSIGMF:
        return sigmoid(x, p[0], p[1]) * sigmoid(x, p[2], p[3]);
    case MF_ZMF:
        return spline_down(x, p[0], p[1]);
    case MF_SMF:
        return spline_up(x, p[0], p[1]);
    case MF_PIMF:
        return spline_up(x, p[0], p[1]) * spline_down(x, p[2], p[3]);
    case MF_LINZMF: /* MATLAB documents 0 at the step of [a a], other than for trapmf */
        return p[0] == p[1] ? x < p[0] : ramp_down(x, p[0], p[1]);
    case MF_LINSMF:
        return ramp_up(x, p[0], p[1]);
    case MF_PWLMF:
        return pwl(x, p, count);
    default:
        return 0;
    }
}
