/* SPDX-License-Identifier: MIT */
#include "random.h"

#include <math.h>

void random_seed(struct random *random, uint64_t seed)
{
    random->state = seed;
}

/* splitmix64 (Steele, Lea, Flood 2014). */
static uint64_t next(struct random *random)
{
    uint64_t z = random->state += 0x9E3779B97F4A7C15u;

    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

double random_uniform(struct random *random)
{
    return (double)(next(random) >> 11) * 0x1p-53;
}

/* Box and Muller's transform. */
double random_normal(struct random *random)
{
    double radius = sqrt(-2 * log(1 - random_uniform(random)));

    return radius * cos(2 * M_PI * random_uniform(random));
}
