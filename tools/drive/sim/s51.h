/* SPDX-License-Identifier: MIT */
/* The engine `s51`: uCsim's simulator as a process in lockstep, with exact times.
 *
 * s51 runs free and blocks only in its own reading of a value change dump, from a FIFO: it halts at
 * each sync time until it is told the next one. A variable that the dump sets at each sync comes
 * back in the dump that s51 writes; when it has been read, every pin change before it has been,
 * too. So results depend on no clock and no scheduler. Times are nanoseconds since reset. */
#ifndef FUZZY51_S51_H
#define FUZZY51_S51_H

#include "sim.h"

#include <stddef.h>

/* Versions that are known to keep time, as messages name them. */
#define S51_VERSIONS "0.6.4 (Debian 12) or 0.8.15 (Debian 13)"

/* Whether this version is known to keep time. */
bool s51_is_known(const char *version);

/* Asks s51 for its version. Returns EXIT_FINE, or EXIT_USAGE after a message. */
int s51_version(char *version, size_t size);

/* s51 looks for serial bytes in each cycle only while some are on their way, as that costs half its
 * speed. */
extern const struct sim_engine s51_engine;

#endif
