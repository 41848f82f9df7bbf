/* SPDX-License-Identifier: MIT */
/* Sweeps over all inputs. How many steps one takes at a time: 1, all of them. Coverage and mutants
 * take more (tests/coverage/rules.mk, tests/mutants/rules.mk). */
#ifndef FUZZY51_SWEEP_H
#define FUZZY51_SWEEP_H

#ifndef SWEEP
#define SWEEP 1
#endif

/* What STEP came to is wrong: fails, and says at which one. */
#define SWEEP_FAIL(step, text)                                                                     \
    do {                                                                                           \
        TEST_ASSERT_EQUAL_INT_MESSAGE(0, step, text);                                              \
        TEST_FAIL_MESSAGE(text);                                                                   \
    } while (0)

#endif
