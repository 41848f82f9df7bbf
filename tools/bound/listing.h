/* SPDX-License-Identifier: MIT */
/* Reads the linker's map and listings (.rst): the names of functions, the source line of each
 * instruction, and the comments that say how many rounds a loop has. */
#ifndef FUZZY51_LISTING_H
#define FUZZY51_LISTING_H

#include "hexfile.h"

#include <stdint.h>

enum { LISTING_NO_BOUND = -1, LISTING_MOST_ROUNDS = 1000000 };

struct listing {
    char *names[HEX_CODE_SIZE];  /* as C knows them; NULL: nothing begins here */
    char *places[HEX_CODE_SIZE]; /* "FILE:LINE"; NULL: not compiled here */
    long rounds[HEX_CODE_SIZE];  /* of the loop whose condition stands on that line */
};

void listing_init(struct listing *listing);
void listing_free(struct listing *listing);

/* Adds one .rst or .map file of the image HEX. The words "rounds: N", N in 1..LISTING_MOST_ROUNDS,
 * on a source line say that the loop on this line has at most N rounds each time that it is
 * entered. Returns EXIT_FINE, or EXIT_INPUT after a message. The listing of another image is an
 * error: the linker overwrites a module's listing each time that it links the module. */
int listing_read(struct listing *listing, const struct hexfile *hex, const char *path);

/* The address of the function NAME, or -1. */
long listing_find(const struct listing *listing, const char *name);

/* The name of the function at ADDRESS, or the address as text if it has no name. The text is valid
 * until the eighth next call. */
const char *listing_name(const struct listing *listing, uint16_t address);

#endif
