/* SPDX-License-Identifier: MIT */
/* What the tuned law does at the first reading of a target. */
#ifndef FUZZY51_LAW_TUNED_H
#define FUZZY51_LAW_TUNED_H

/* A target that shows up at most so far inside the table, right after a clear road, came driving:
 * its closing speed is at least what brought it here (up to 13 m/s). One further inside cut in. */
#define LAW_TUNED_FIRST_MM 800U
#define LAW_TUNED_LATE_MM  1600U /* the same where one reading more may have passed */

/* One reading may be a stray one, so it brakes no harder than this: 25 m/s3 on a brake of 8 m/s2
 * with a lag of 0.2 s. */
#define LAW_TUNED_FIRST_PCT 57U

#endif
