/* SPDX-License-Identifier: MIT */
/* How many steps a sweep over all inputs takes at a time: 1, all of them. Coverage and mutants
 * take more (tests/coverage/rules.mk, tests/mutants/rules.mk). */
#ifndef FUZZY51_SWEEP_H
#define FUZZY51_SWEEP_H

#ifndef SWEEP
#define SWEEP 1
#endif

#endif
