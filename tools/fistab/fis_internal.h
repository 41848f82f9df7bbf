/* Between the two halves of the reader: what the file says of its own counts. */
#ifndef FUZZY51_FIS_INTERNAL_H
#define FUZZY51_FIS_INTERNAL_H

#include "fis.h"

#define NOT_DECLARED SIZE_MAX

struct declared {
    int system_line;
    int rules_line;
    size_t inputs;
    size_t outputs;
    size_t rules;
    size_t input_sets[FIS_VARIABLES_MAX];
    size_t output_sets[FIS_VARIABLES_MAX];
};

/* Checks that the parts make a system, and brings them into one shape: trailing zeros of old
 * parameter lists cut off. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int fis_validate(struct fis *fis, const struct declared *declared);

#endif
