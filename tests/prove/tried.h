/* SPDX-License-Identifier: MIT */
/* For tried_*.c, the proofs by trying all values, where the provers give up. A contract's clause that such a program
 * proves has the label `tried`. Each prints a line for what it proves, and exits with 1 if one does not hold. */
#ifndef FUZZY51_PROVE_TRIED_H
#define FUZZY51_PROVE_TRIED_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static bool is_proved = true;

static void say(const char *what, bool holds)
{
    printf("tried: %s: %s\n", what, holds ? "proved" : "WRONG");
    is_proved = is_proved && holds;
}

#ifdef FUZZY51_LUT_H
#if LUT_PACKED
#define TRIED_PACKED ", packed,"
#else
#define TRIED_PACKED ""
#endif

/* After #include "lut.c": each cell of the unit's table, by the firmware's own look-up. */
static void say_cells(void)
{
    bool are_levels = true;

#if LUT_INPUTS == 3
    for (unsigned first = 0; first < LUT_IN1_CELLS; first++) {
        for (unsigned second = 0; second < LUT_IN2_CELLS; second++) {
            for (unsigned third = 0; third < LUT_IN3_CELLS; third++) {
                are_levels = are_levels &&
                             lut_at3((uint8_t)first, (uint8_t)second, (uint8_t)third) <= LUT_LEVELS;
#if LUT_OUTPUTS == 2
                are_levels = are_levels && lut2_at3((uint8_t)first, (uint8_t)second,
                                                    (uint8_t)third) <= LUT_LEVELS;
#endif
            }
        }
    }
#else
#if LUT_INPUTS == 1
#define TRIED_COLS 1
#else
#define TRIED_COLS LUT_IN2_VALUES
#endif
    for (unsigned row = 0; row < LUT_IN1_VALUES; row++) {
        for (unsigned col = 0; col < TRIED_COLS; col++) {
            unsigned level = lut_at((uint8_t)row, (uint8_t)col);

            are_levels = are_levels && level <= LUT_LEVELS;
        }
    }
#endif
    say("lut.h: each cell of " LUT_SOURCE TRIED_PACKED " is a level", are_levels);
}
#endif

#endif
