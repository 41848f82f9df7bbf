/* SPDX-License-Identifier: MIT */
/* Where drives with different faults meet: from there on they are the same, so one of them is
 * enough. */
#ifndef FUZZY51_FLIP_MEET_H
#define FUZZY51_FLIP_MEET_H

#include <stddef.h>
#include <stdint.h>

/* What has come by, in memory that all processes share. */
struct meet;

struct meet *meet_create(void);

/* Case INDEX of the plan comes by at KEY. Returns the case that did so first; that may be INDEX. */
size_t meet_at(struct meet *meet, uint64_t key, size_t index);

#endif
