/* SPDX-License-Identifier: MIT */
/* The warning: the driver should act now. Portable.
 *
 *   state   a reason   no reason                  no target
 *   OFF     ON         OFF                        OFF
 *   ON      ON         OFF after half a second    OFF
 *
 * A reason is what brake.c finds: the target closes at WARNING_MMPS or more and, one second ahead
 * at that speed (0.8 s and the time that a reading takes), would be braked for with WARNING_PCT or
 * more, or STOP would come. A reading that is not believed is no reason. */
#ifndef FUZZY51_WARNING_H
#define FUZZY51_WARNING_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"
#include "range.h"

#define WARNING_MMPS          300U
#define WARNING_PCT           60U
#define WARNING_CALM_READINGS RANGE_READINGS(50U)

/*@ assigns \nothing; */
void warning_init(void);

/* Once a reading; asks target_worth. Returns whether the warning is on. */
/*@ assigns \nothing;
    ensures has_reason ==> \result; */
bool warning_take(bool has_reason);

#endif
