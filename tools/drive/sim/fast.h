/* SPDX-License-Identifier: MIT */
/* The engine `fast`: our own MCS-52 (mcs52.h), in this process. */
#ifndef FUZZY51_FAST_H
#define FUZZY51_FAST_H

#include "sim.h"

struct mcs52;

extern const struct sim_engine fast_engine;

/* For a SIM of this engine. The chip itself, for who wants to look into it or to change it. */
struct mcs52 *fast_chip(struct sim *sim);

/* From now on a reset by the watchdog does not end the run: the chip starts again, and times go on.
 */
void fast_outlive_resets(struct sim *sim);

/* How many resets there were since then. */
int fast_resets(const struct sim *sim);

#endif
