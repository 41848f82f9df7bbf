/* SPDX-License-Identifier: MIT */
/* What the linker's listings (.rst) and its map say of addresses: names of functions, the source
 * line that an instruction comes from, and how often a loop goes round. */
#ifndef FUZZY51_LISTING_H
#define FUZZY51_LISTING_H

#include "hexfile.h"

#include <stdint.h>

enum { LISTING_NO_BOUND = -1 };

struct listing {
    char *names[HEX_CODE_SIZE];  /* as C knows them; NULL: nothing begins here */
    char *places[HEX_CODE_SIZE]; /* "FILE:LINE"; NULL: not compiled here */
    long rounds[HEX_CODE_SIZE];  /* of the loop whose condition stands on that line */
};

void listing_init(struct listing *listing);
void listing_free(struct listing *listing);

/* Adds one .rst or .map file of the image HEX. A source line that holds the words "rounds: N" says
 * that the loop it belongs to goes round at most N times each time it is entered. Returns
 * EXIT_FINE, or EXIT_INPUT after a message: a listing of another image among them, for linking a
 * module again, into whatever, writes its listing anew. */
int listing_read(struct listing *listing, const struct hexfile *hex, const char *path);

/* The address of the function NAME, or -1. */
long listing_find(const struct listing *listing, const char *name);

/* What to call the code at ADDRESS: its function's name, else its address. The text lasts until the
 * eighth next call. */
const char *listing_name(const struct listing *listing, uint16_t address);

#endif
