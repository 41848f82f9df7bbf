/* SPDX-License-Identifier: MIT */
/* Flips that come to the same: sets of them, and the states of the chip that they have led to. */
#ifndef FUZZY51_FLIP_CLASSES_H
#define FUZZY51_FLIP_CLASSES_H

#include "mcs52.h"
#include "plan.h"

#include <stddef.h>
#include <stdint.h>

enum { CLASS_NONE /* of all flips that have no effect */, CLASS_UNKNOWN /* of none */ };

struct classes;

struct classes *classes_create(void);
void classes_free(struct classes *classes);

/* A new class of flips like FIRST. It has to be settled by one of the next three. */
uint32_t classes_add(struct classes *classes, const struct fault_case *first);

/* CLASS has no effect any more. */
void classes_end(struct classes *classes, uint32_t class);

/* At the end of the present slot the chip of CLASS is in STATE. Returns the class of all that are;
 * CLASS is a part of it from now on. */
uint32_t classes_stay(struct classes *classes, uint32_t class, const struct mcs52_snapshot *state);

/* The same, but its outputs did something else in this slot, hash EDGES: it is followed no further.
 */
uint32_t classes_leave(struct classes *classes, uint32_t class, const struct mcs52_snapshot *state,
                       uint64_t edges);

/* The next slot begins: those that stayed are the old ones. State I of them and its class, or NULL
 * when there are no more. */
void classes_turn(struct classes *classes);
const struct mcs52_snapshot *classes_old(const struct classes *classes, size_t i, uint32_t *class);

/* CLASS is the last one that was added, and a part of another. */
void classes_forget(struct classes *classes, uint32_t class);

/* The class that CLASS is a part of in the end; their number. */
uint32_t classes_root(struct classes *classes, uint32_t class);
size_t classes_count(const struct classes *classes);

/* Adds to PLAN the first flip of each class that has to be flown; its tag is the class. No more
 * slots after that. */
void classes_plan(struct classes *classes, struct plan *plan);

#endif
