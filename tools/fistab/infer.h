/* SPDX-License-Identifier: MIT */
/* Evaluates a fuzzy system at a point: a .fis as MATLAB's evalfis does, FLL and FCL as fuzzylite
 * does.
 *
 * A Mamdani output is sampled at evenly spaced points: for a .fis 101 of them, both ends of the
 * range included, unless told otherwise. Centroid is sum(x*mu)/sum(mu) over them. What does not
 * depend on the point, the output sets at the samples, is worked out once; a point then costs only
 * the rules that fire. */
#ifndef FUZZY51_INFER_H
#define FUZZY51_INFER_H

#include <stdbool.h>
#include <stddef.h>

#include "fis.h"

enum { INFER_SAMPLES = 101, INFER_SAMPLES_MAX = 100001 };

struct infer_options {
    size_t samples; /* 2..INFER_SAMPLES_MAX; 0: as the file says, or MATLAB's INFER_SAMPLES */
    bool exact;     /* integrate instead of sampling, see exact.h */
};

/* How many samples OUTPUT, a Mamdani one, is taken at. */
size_t infer_samples(const struct infer_options *options, const struct variable *output);

struct engine;

/* An evaluator of FIS, which must outlive it. NULL after a message: too large, or out of memory. */
struct engine *engine_create(const struct fis *fis, const struct infer_options *options);
void engine_free(struct engine *engine);

/* Outputs Y of the inputs X, as many as the system has. An output for which no rule fires is what
 * the file gives as its default, or else the middle of its range. Returns how many outputs are such
 * a middle. */
size_t engine_eval(struct engine *engine, const double *x, double *y);

/* After engine_eval: did a rule fire for this output, or does the file give a default? */
bool engine_fired(const struct engine *engine, size_t output);

/* After engine_eval: how strongly rule fired, 0..1, its weight included. */
double engine_strength(const struct engine *engine, size_t rule);

#endif
