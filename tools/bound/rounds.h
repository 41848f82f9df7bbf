/* SPDX-License-Identifier: MIT */
/* How often a loop can turn, where the program itself counts with constants, as in
 * `for (i = 0; i < 10; i++)`; and what is known of the loops of SDCC's library. */
#ifndef FUZZY51_ROUNDS_H
#define FUZZY51_ROUNDS_H

#include "graph.h"

/* The most times that the loop of these nodes goes back to its HEADER, each time that it is
 * entered; -1 if the values that are known do not tell. FUNCTION is settled. The loop is taken
 * round by round with all that is known before it, until no way back to the header can be gone. */
long rounds_count(const struct flow *flow, const struct function *function, const int *members,
                  int count, int header);

/* The same for each loop of the function NAME of SDCC's library, whose loops stop at what the data
 * say; -1 if nothing is known of it. */
long rounds_of_library(const char *name);

#endif
