/* SPDX-License-Identifier: MIT */
/* What one lamp can tell: off, on, a quick flicker, or a number of blinks to count. */
#ifndef FUZZY51_LAMP_H
#define FUZZY51_LAMP_H

#include <stdbool.h>
#include <stdint.h>

/* The patterns. 2..9 means a number of blinks: each is lit for a quarter of a second and dark for a
 * quarter; after the last one the lamp stays dark for one second. */
#define LAMP_OFF     0U
#define LAMP_ON      1U
#define LAMP_FLICKER 255U /* five times a second */

/* Returns whether the lamp is lit now. Call it each 1/100 s. `pattern` is LAMP_OFF, LAMP_ON,
 * LAMP_FLICKER or 2..9; a new pattern starts at once with light. */
/*@ assigns \nothing;
    ensures pattern == LAMP_OFF ==> !\result;
    ensures pattern == LAMP_ON ==> \result; */
bool lamp_tick(uint8_t pattern);

#endif
