/* SPDX-License-Identifier: MIT */
/* Membership functions: MATLAB's by name and formula, three of fuzzylite's, and one of our own,
 * pwlmf. */
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
    MF_PWLMF,     /* x1 y1 x2 y2 ...: straight lines from point to point, level beyond the ends */
    MF_CONCAVEMF, /* fuzzylite's Concave: inflection, end */
    MF_COSINEMF,  /* fuzzylite's Cosine: centre, width */
    MF_SPIKEMF,   /* fuzzylite's Spike: centre, width */
    MF_CONSTANT,  /* Sugeno output: c */
    MF_LINEAR,    /* Sugeno output: a1*x1 + ... + an*xn + c */
    MF_UNKNOWN,
};

/* The kind of that name in a .fis file; MF_UNKNOWN if there is none. */
enum mf_kind mf_kind_by_name(const char *name);
const char *mf_name(enum mf_kind kind);

/* How many parameters a set takes in a system of INPUTS inputs; 0 = any even number from 4 on. */
size_t mf_parameters(enum mf_kind kind, size_t inputs);

/* True for the two kinds that only a Sugeno output has. */
bool mf_is_sugeno(enum mf_kind kind);

/* NULL if the parameters (of the right number) make a set, else what they should be. */
const char *mf_fault(enum mf_kind kind, const double *p, size_t count);

/* fuzzylite has functions under other names and with other parameters. This one finds the kind for
 * CLASS, the name in an FLL or FCL file, or the name that fuzzylite writes into a .fis (rampmf),
 * and brings the *COUNT parameters P into our order; P has room for two more. Returns MF_UNKNOWN if
 * fuzzylite has no such function, or one that is no membership function. *FAULT is NULL, or what
 * the parameters should be. */
enum mf_kind mf_from_fuzzylite(const char *class, double *p, size_t *count, const char **fault);

/* Is NAME one of the functions that fuzzylite writes into a .fis and that become other functions?
 */
bool mf_is_fuzzylite_fis(const char *name);

/* How many parameters CLASS takes in an FLL or FCL file; 0: no fixed number, or no such class. */
size_t mf_parameters_of_class(const char *class);

/* Degree of membership of X, 0..1. Not for Sugeno kinds. */
double mf_degree(enum mf_kind kind, const double *p, size_t count, double x);

#endif
