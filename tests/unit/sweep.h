/* SPDX-License-Identifier: MIT */
/* How many steps a sweep over all inputs takes at a time: 1, all of them. Coverage asks only which
 * lines and branches are reached, and takes more (tests/coverage/rules.mk). */
#ifndef FUZZY51_SWEEP_H
#define FUZZY51_SWEEP_H

#ifndef SWEEP
#define SWEEP 1
#endif

#endif
