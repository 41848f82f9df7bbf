/* SPDX-License-Identifier: MIT */
/* A law of monotony, as --monotone and --repair name it: "-1,+2" falls with input 1 and rises with
 * input 2; an input that it does not name is free. */
#ifndef FUZZY51_FISTAB_LAW_H
#define FUZZY51_FISTAB_LAW_H

#include <stdbool.h>
#include <stddef.h>

#include "fis.h"

struct law {
    const char *text;                 /* as given; NULL: no law */
    int direction[FIS_VARIABLES_MAX]; /* an input each: -1, +1 or 0 */
};

/* Reads TEXT, which must outlive the law. False if it is no such law: then LAW is not to be used.
 */
bool law_parse(const char *text, struct law *law);

/* Does the law name only inputs that FIS has? EXIT_FINE, or EXIT_USAGE after a message on OPTION.
 */
int law_check(const struct law *law, const struct fis *fis, const char *option);

#endif
