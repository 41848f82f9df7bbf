/* SPDX-License-Identifier: MIT */
/* How a window of the drive is searched; what space.c and search.c share. */
#ifndef FUZZY51_FLIP_SEARCH_H
#define FUZZY51_FLIP_SEARCH_H

#include "board.h"
#include "classes.h"
#include "fair.h"
#include "plan.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SPOTS = (MCS52_RAM_BYTES + 128) * 8 };

/* A bit, and since when its flips wait for its next use. */
struct spot {
    enum where where;
    uint8_t address, bit;
    uint64_t waits_from; /* cycles up to this one are in a class */
    uint32_t samples;    /* the first one of this bit, counted from 1; 0: none */
};

/* Flips of one bit, at POINTS cycles, that are one class. */
struct use {
    uint32_t spot, points, class;
};

/* A flip by chance, flown by itself. */
struct sample {
    uint32_t spot, class;
    uint64_t cycle;
    uint32_t next; /* of the same bit, as in struct spot */
};

struct space {
    uint32_t first_register_spot; /* those of RAM come first */
    struct spot spots[SPOTS];
    uint32_t spot_count;
    struct use *uses;
    size_t use_count, use_capacity;
    struct classes *classes;
    struct sample *samples;
    long sample_count;
};

struct search;

/* CODE: the image that the chips of FAIR run. */
struct search *search_create(struct space *space, const struct fair *fair,
                             const struct board *board, const uint8_t *code);

/* Puts all flips of the spots from START on, for WINDOW_MC, into classes. Returns false when the
 * replay of the drive is not the drive. */
bool search_window(struct search *search, struct mcs52 *start, uint64_t window_mc);

void search_free(struct search *search);

#endif
