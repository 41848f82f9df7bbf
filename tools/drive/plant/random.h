/* SPDX-License-Identifier: MIT */
/* A small deterministic source of random numbers: the same seed gives the same run everywhere. */
#ifndef FUZZY51_RANDOM_H
#define FUZZY51_RANDOM_H

#include <stdint.h>

struct random {
    uint64_t state;
};

void random_seed(struct random *random, uint64_t seed);

/* Uniform in [0, 1). */
double random_uniform(struct random *random);

/* Normal with mean 0 and standard deviation 1; uses two numbers. */
double random_normal(struct random *random);

#endif
