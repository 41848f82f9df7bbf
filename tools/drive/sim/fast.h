/* SPDX-License-Identifier: MIT */
/* The engine `fast`: our own MCS-52 (mcs52.h), in this process. */
#ifndef FUZZY51_FAST_H
#define FUZZY51_FAST_H

#include "sim.h"

extern const struct sim_engine fast_engine;

#endif
