/* SPDX-License-Identifier: MIT */
/* Turns a table's integers into the arrays of its header, plain or packed. */
#ifndef FUZZY51_ENCODE_H
#define FUZZY51_ENCODE_H

#include <stdbool.h>
#include <stdio.h>

#include "table.h"

/* Writes the header of TABLE to OUT. NAME is the prefix of its symbols, REPAIR what its comment
 * says of a repair (NULL: none). PACKED stores it as pack.h says. Returns EXIT_FINE, or EXIT_INPUT
 * after a message: the table does not pack, or memory is short. */
int encode_write(FILE *out, const struct table *table, const char *name, const char *repair,
                 bool packed);

#endif
