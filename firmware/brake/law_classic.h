/* SPDX-License-Identifier: MIT */
/* The classic law's constants: time until the brake bites, 80 % of a brake of 8 m/s2, stand-off. */
#ifndef FUZZY51_LAW_CLASSIC_H
#define FUZZY51_LAW_CLASSIC_H

#include <stdint.h>

#define LAW_CLASSIC_DELAY_MS    300U
#define LAW_CLASSIC_DECEL_MMPS2 6400U
#define LAW_CLASSIC_MARGIN_MM   1000U
#define LAW_CLASSIC_RELEASE_MM  500U

/* The safe distance, at most 4 mm below the exact one; faster than 8.19 m/s it stays
 * 8.7 m, further than the sensor sees. */
/*@ assigns \nothing;
    ensures LAW_CLASSIC_MARGIN_MM <= \result <= 8701; */
uint16_t law_classic_safe_mm(uint16_t closing_mmps);

#endif
