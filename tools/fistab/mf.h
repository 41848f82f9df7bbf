/* Membership functions: MATLAB's by name and formula, and one of our own, pwlmf. */
#ifndef FUZZY51_MF_H
#define FUZZY51_MF_H

#include <stdbool.h>
#include <stddef.h>

enum mf_kind {
    MF_TRIMF,
    MF_TRAPMF,
    MF_GAUSSMF,
    MF_GAUSS2MF,
    MF_GBELLMF,
    MF_SIGMF,
    MF_DSIGMF,
    MF_PSIGMF,
    MF_ZMF,
    MF_SMF,
    MF_PIMF,
    MF_LINZMF,
    MF_LINSMF,
    MF_PWLMF,    /* x1 y1 x2 y2 ...: straight lines from point to point, level beyond the ends */
    MF_CONSTANT, /* Sugeno output: c */
    MF_LINEAR,   /* Sugeno output: a1*x1 + ... + an*xn + c */
    MF_UNKNOWN,
};

/* MF_UNKNOWN if there is none of that name. */
enum mf_kind mf_kind_by_name(const char *name);
const char *mf_name(enum mf_kind kind);

/* How many parameters a set takes in a system of INPUTS inputs; 0 = any even number from 4 on. */
size_t mf_parameters(enum mf_kind kind, size_t inputs);

/* True for the two kinds that only a Sugeno output has. */
bool mf_is_sugeno(enum mf_kind kind);

/* NULL if the parameters (of the right number) make a set, else what they should be. */
const char *mf_fault(enum mf_kind kind, const double *p, size_t count);

/* Degree of membership of X, 0..1. Not for Sugeno kinds. */
double mf_degree(enum mf_kind kind, const double *p, size_t count, double x);

#endif
