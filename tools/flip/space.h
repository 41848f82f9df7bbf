/* SPDX-License-Identifier: MIT */
/* All of the fault space: each bit at each cycle of a window, without flying each.
 *
 * The drive without a fault is replayed, chip only, instruction by instruction. Before each
 * instruction each bit that is looked at is flipped, and the instruction is run with it. When the
 * chip is then as without the fault but for that same bit, the flip is the same as one before the
 * next instruction: it waits for its next use. Otherwise the flip has had its use: it goes on to
 * the end of the slot, where what is alike becomes one class. A class that is as without the fault
 * had no effect. One whose output pins did something else has to be flown with the world: its first
 * flip stands for all.
 *
 * Exact but for this: within a slot, two runs are alike when their outputs have the same edges in
 * the same order, so an edge may be SPACE_SLOT_MC early or late. */
#ifndef FUZZY51_FLIP_SPACE_H
#define FUZZY51_FLIP_SPACE_H

#include "board.h"
#include "fair.h"
#include "options.h"
#include "plan.h"

#include <stdint.h>
#include <stdio.h>

enum { SPACE_SLOT_MC = 128, SPACE_TAIL_SLOTS = 512 };

struct space;

/* Looks at the bits that ARGUMENTS name, in its window from each of its instants on, and adds to
 * PLAN what has to be flown. Returns NULL after a message. */
struct space *space_search(const struct fair *fair, const struct board *board,
                           const struct hexfile *hex, const struct arguments *arguments,
                           struct plan *plan);

/* When PLAN is flown: for each bit, at how many cycles a flip comes to what. Says on stderr how
 * many runs that took, and how many of the samples came to what their class did. */
void space_print(FILE *out, struct space *space, const struct plan *plan);

void space_free(struct space *space);

#endif
