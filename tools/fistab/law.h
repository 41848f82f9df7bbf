/* SPDX-License-Identifier: MIT */
/* Laws of monotony, as --monotone and --repair name them: "-1,+2" falls with input 1 and rises with
 * input 2; an input that it does not name is free. "2:-1" is a law for output 2 alone; one without
 * an output is for all outputs that have none of their own. */
#ifndef FUZZY51_LAW_H
#define FUZZY51_LAW_H

#include <stdbool.h>
#include <stddef.h>

#include "fis.h"

struct law {
    const char *text;                 /* "-1,+2"; NULL: no law */
    int direction[FIS_VARIABLES_MAX]; /* an input each: -1, +1 or 0 */
};

struct laws {
    bool any;
    char text[400]; /* all that was given, with blanks between */
    struct law common;
    struct law output[FIS_VARIABLES_MAX];
};

/* Adds what TEXT says, which must outlive LAWS. False if it is no law, or the second one for the
 * same outputs. */
bool laws_add(struct laws *laws, const char *text);

/* The law for output OUTPUT, from 0; its text is NULL if it has none. */
const struct law *laws_of(const struct laws *laws, size_t output);

/* Do the laws name only inputs and outputs that FIS has? EXIT_FINE, or EXIT_USAGE after a message
 * on OPTION. */
int laws_check(const struct laws *laws, const struct fis *fis, const char *option);

#endif
