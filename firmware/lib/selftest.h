/* SPDX-License-Identifier: MIT */
/* The part of the self-test at start that takes long: the table's check sum, slice by slice. */
#ifndef FUZZY51_SELFTEST_H
#define FUZZY51_SELFTEST_H

#include <stdint.h>

enum selftest { SELFTEST_RUNNING, SELFTEST_PASSED, SELFTEST_FAILED };

/* Sums up one more slice of the table, at most 840 mc, and returns enum selftest: RUNNING until the
 * last slice, then PASSED if the sum is that of the table's header, else FAILED. Must not be called
 * again after PASSED or FAILED. */
/*@ assigns \nothing;
    ensures \result == SELFTEST_RUNNING || \result == SELFTEST_PASSED ||
            \result == SELFTEST_FAILED; */
uint8_t selftest_table(void);

#endif
