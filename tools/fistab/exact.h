/* Defuzzification of the continuous output set, not of samples of it. */
#ifndef FUZZY51_EXACT_H
#define FUZZY51_EXACT_H

#include <stdbool.h>
#include <stddef.h>

#include "fis.h"

/* One set of an output, cut or scaled by the strength of the rule that says so. */
struct exact_term {
    const struct set *set;
    bool negated;
    double strength;
    size_t consequent; /* the evaluator's own number of it */
};

#endif
