/* SPDX-License-Identifier: MIT */
/* Numbers on a command line that argp reads: the number TEXT of --OPTION. Outside of LOW..HIGH, or
 * when it is no number, a message says what to give, and the program ends. */
#ifndef FUZZY51_NUMBER_H
#define FUZZY51_NUMBER_H

#include <argp.h>

/* A whole number. */
long parse_count(struct argp_state *state, const char *option, const char *text, long low,
                 long high);

/* A hexadecimal one, such as 7F. */
long parse_hex(struct argp_state *state, const char *option, const char *text, long low, long high);

/* A number that may have decimals. */
double parse_number(struct argp_state *state, const char *option, const char *text, double low,
                    double high);

#endif
