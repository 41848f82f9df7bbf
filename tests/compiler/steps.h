/* SPDX-License-Identifier: MIT */
/* Chip against host: the same C, compiled by SDCC and by the host's compiler, makes the same random
 * steps. host.c draws what goes into a step, gives it to both and compares each byte that comes
 * out.
 *
 * Each controller has a file NAME.c here with the three functions below. `step` and steps_begin run
 * on both sides; `draw` runs on the host alone. */
#ifndef FUZZY51_STEPS_H
#define FUZZY51_STEPS_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

/* Once at the start. */
void steps_begin(void);

/* One step: takes what `draw` has given, in the same order, and puts all that came of it. */
void step(void);

/* What a step takes and puts. Numbers go high byte first. */
uint8_t take(void);
uint16_t take_u16(void);
void put(uint8_t byte);
void put_u16(uint16_t number);

/* What all controllers share: fixed point, table, lamp, telemetry. Call it in each step. */
void step_lib(void);

#ifndef __SDCC_mcs51

/* Draws the input of one step by `give`. */
void draw(void);
void draw_lib(void);

void give(uint8_t byte);
void give_u16(uint16_t number);

/* 0..below - 1; and from `low` to `high`, mostly, with both ends and what lies beyond them now and
 * then. */
uint32_t chance(uint32_t below);
uint16_t draw_u16(uint16_t low, uint16_t high);

#endif
#endif
