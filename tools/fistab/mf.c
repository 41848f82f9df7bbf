/* SPDX-License-Identifier: MIT */
/* Membership functions, each as MATLAB's toolbox or fuzzylite documents it. */
#include "mf.h"

#include <math.h>
#include <string.h>

static const struct {
    const char *name;
    size_t parameters;
} type[] = {
    [MF_TRIMF] = {"trimf", 3},
    [MF_TRAPMF] = {"trapmf", 4},
    [MF_GAUSSMF] = {"gaussmf", 2},
    [MF_GAUSS2MF] = {"gauss2mf", 4},
    [MF_GBELLMF] = {"gbellmf", 3},
    [MF_SIGMF] = {"sigmf", 2},
    [MF_DSIGMF] = {"dsigmf", 4},
    [MF_PSIGMF] = {"psigmf", 4},
    [MF_ZMF] = {"zmf", 2},
    [MF_SMF] = {"smf", 2},
    [MF_PIMF] = {"pimf", 4},
    [MF_LINZMF] = {"linzmf", 2},
    [MF_LINSMF] = {"linsmf", 2},
    [MF_PWLMF] = {"pwlmf", 0},
    [MF_CONCAVEMF] = {"concavemf", 2},
    [MF_COSINEMF] = {"cosinemf", 2},
    [MF_SPIKEMF] = {"spikemf", 2},
    [MF_CONSTANT] = {"constant", 1},
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
    case MF_COSINEMF:
    case MF_SPIKEMF:
        return p[1] > 0 ? NULL : "[centre width] with a width above 0";
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

/* fuzzylite's Concave: 1 from END on, and on the other side a hyperbola that is 1/2 at
 * INFLECTION. */
static double concave(double x, double inflection, double end)
{
    double far = inflection <= end ? end - x : x - end;

    if (far <= 0) {
        return 1;
    }
    return fabs(end - inflection) / (fabs(end - inflection) + far);
}

static double cosine(double x, double centre, double width)
{
    if (fabs(x - centre) > width / 2) {
        return 0;
    }
    return (1 + cos(2 * M_PI * (x - centre) / width)) / 2;
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
    case MF_CONCAVEMF:
        return concave(x, p[0], p[1]);
    case MF_COSINEMF:
        return cosine(x, p[0], p[1]);
    case MF_SPIKEMF:
        /* 10 / width may be infinite, and infinity times 0 is no number. */
        return x == p[0] ? 1 : exp(-fabs(10 / p[1] * (x - p[0])));
    default:
        return 0;
    }
}

/* --- fuzzylite's names ----------------------------------------------------------------------- */

/* A row says where each of our parameters comes from in fuzzylite's list. */
static const struct {
    const char *class;
    enum mf_kind kind;
    unsigned char from[4];
} fuzzylite_class[] = {
    {"Triangle", MF_TRIMF, {0, 1, 2}},
    {"Trapezoid", MF_TRAPMF, {0, 1, 2, 3}},
    {"Gaussian", MF_GAUSSMF, {1, 0}},
    {"GaussianProduct", MF_GAUSS2MF, {1, 0, 3, 2}},
    {"Bell", MF_GBELLMF, {1, 2, 0}},
    {"Sigmoid", MF_SIGMF, {1, 0}},
    {"SigmoidDifference", MF_DSIGMF, {1, 0, 2, 3}},
    {"SigmoidProduct", MF_PSIGMF, {1, 0, 2, 3}},
    {"ZShape", MF_ZMF, {0, 1}},
    {"SShape", MF_SMF, {0, 1}},
    {"PiShape", MF_PIMF, {0, 1, 2, 3}},
    {"Concave", MF_CONCAVEMF, {0, 1}},
    {"Cosine", MF_COSINEMF, {0, 1}},
    {"Spike", MF_SPIKEMF, {0, 1}},
    {"Constant", MF_CONSTANT, {0}},
};

/* The classes of two parameters that become other functions. */
static const struct {
    const char *class, *fis;
} two[] = {{"Ramp", "rampmf"}, {"Rectangle", "rectmf"}, {"Binary", "binarymf"}};
enum { RAMP, RECTANGLE, BINARY, TWOS };

static enum mf_kind ramp_from(double *p, const char **fault)
{
    double start = p[0], end = p[1];

    *fault = start != end ? NULL : "two different numbers, start and end";
    p[0] = fmin(start, end);
    p[1] = fmax(start, end);
    return start < end ? MF_LINSMF : MF_LINZMF;
}

/* A step: all from START on in DIRECTION, which is another number or infinite. */
static enum mf_kind binary_from(double *p, const char **fault)
{
    double start = p[0], direction = p[1];
    bool up = direction > start;

    *fault = direction != start ? NULL : "start and direction, which is larger or smaller";
    p[0] = p[1] = up ? start : -INFINITY;
    p[2] = p[3] = up ? INFINITY : start;
    return MF_TRAPMF;
}

enum mf_kind mf_from_fuzzylite(const char *class, double *p, size_t *count, const char **fault)
{
    *fault = NULL;
    if (strcmp(class, "Discrete") == 0 || strcmp(class, "discretemf") == 0) {
        return MF_PWLMF;
    }
    if (strcmp(class, "Linear") == 0) {
        return MF_LINEAR;
    }
    for (int i = 0; i < TWOS; i++) {
        if (strcmp(class, two[i].class) != 0 && strcmp(class, two[i].fis) != 0) {
            continue;
        }
        if (*count != 2) {
            *fault = "2 numbers";
        } else if (i == RAMP) {
            return ramp_from(p, fault);
        } else if (i == BINARY) {
            *count = 4;
            return binary_from(p, fault);
        } else {
            *count = 4;
            p[2] = p[3] = p[1];
            p[1] = p[0];
        }
        return MF_TRAPMF;
    }
    for (size_t i = 0; i < sizeof fuzzylite_class / sizeof fuzzylite_class[0]; i++) {
        enum mf_kind kind = fuzzylite_class[i].kind;
        double ours[4];

        if (strcmp(class, fuzzylite_class[i].class) != 0) {
            continue;
        }
        for (size_t k = 0; k < *count && *count == type[kind].parameters; k++) {
            ours[k] = p[fuzzylite_class[i].from[k]];
        }
        if (*count == type[kind].parameters) {
            memcpy(p, ours, *count * sizeof *p);
        }
        if (kind == MF_TRAPMF && *count == 4) { /* with one infinite end it is open to that side */
            p[1] = p[0] == -INFINITY ? p[0] : p[1];
            p[2] = p[3] == INFINITY ? p[3] : p[2];
        }
        return kind;
    }
    return MF_UNKNOWN;
}

bool mf_is_fuzzylite_fis(const char *name)
{
    for (int i = 0; i < TWOS; i++) {
        if (strcmp(name, two[i].fis) == 0) {
            return true;
        }
    }
    return strcmp(name, "discretemf") == 0;
}

size_t mf_parameters_of_class(const char *class)
{
    for (int i = 0; i < TWOS; i++) {
        if (strcmp(class, two[i].class) == 0) {
            return 2;
        }
    }
    for (size_t i = 0; i < sizeof fuzzylite_class / sizeof fuzzylite_class[0]; i++) {
        if (strcmp(class, fuzzylite_class[i].class) == 0) {
            return type[fuzzylite_class[i].kind].parameters;
        }
    }
    return 0;
}
