/* The part of the self-test at boot that takes long, in slices. Portable. */
#ifndef FUZZY51_SELFTEST_H
#define FUZZY51_SELFTEST_H

#include <stdint.h>

enum selftest { SELFTEST_RUNNING, SELFTEST_PASSED, SELFTEST_FAILED };

/* One more slice of the table's check sum, at most 840 mc; enum selftest. */
uint8_t selftest_table(void);

#endif
