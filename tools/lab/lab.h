/* SPDX-License-Identifier: MIT */
/* What the laboratory asks of a controller: situations, each in many runs with other noise and
 * another phase of the sensor. */
#ifndef FUZZY51_LAB_H
#define FUZZY51_LAB_H

#include <stdio.h>

#include "board.h"
#include "image.h"
#include "scenario.h"

/* Of the runs of one situation. A gap of an impact counts below zero: what a brake of 8 m/s2 would
 * still have needed, v^2/16. */
struct figures {
    int runs, impacts;
    double gap_min_m, gap_mean_m, gap_short_m; /* short: mean of what is missing to 0.25 m */
    double jerk_worst_mps3, jerk_mean_mps3, decel_mean_mps2, rms_mps2, stuck_worst_s;
};

/* The ordinary scenario: a brake of 8 m/s2, 50 ms dead time and 0.2 s lag; 2 % of the readings
 * missing; 5 m of sight and 1 cm of noise, or 8 m and 2 cm before a TF-Luna; a car ahead that
 * stands; its gap is still to be set. */
struct scenario lab_situation(const struct image *image, double speed_mps, double duration_s);

/* A standing car, first seen from as far as the sensor sees; own driver keeps SPEED_MPS. */
struct figures lab_standing(const struct image *image, double speed_mps, int runs);

/* Both at 10 m/s and 5 m apart; then the one ahead brakes with DECEL_MPS2. */
struct figures lab_lead_brakes(const struct image *image, double decel_mps2, int runs);

/* Stop-and-go: the car ahead drives 0-3-0 m/s at 0.5 m/s2, once in 40 s; the driver wants 8 m/s and
 * accelerates with DRIVER_MPS2. */
struct figures lab_stop_and_go(const struct image *image, double driver_mps2, int runs);

/* Prints what the controllers come to. */
void lab_print(FILE *out, const struct image *images, int count, int runs);

/* Prints, for each controller, how often stray, missing and coarse readings make it hit or stop for
 * good, and how often a sensor that hangs is not found. */
void lab_print_trouble(FILE *out, const struct image *images, int count, int runs);

/* Drives RUNS scenarios of chance from SEED on and prints what nobody would expect of a brake.
 * FIRST brakes fully at first sight, as a measure. Returns how many runs were flagged. */
int lab_attack(FILE *out, const struct image *image, const struct image *first, long seed,
               long runs);

/* The same for the real image HEX of a frame-fed controller, named APP, in the fast engine. Leaves
 * the flagged drives in build/attack. Returns -1 after a message. */
int lab_attack_head(FILE *out, const char *hex, const char *app, const struct board *board,
                    long seed, long runs);

/* Looks for a table for IMAGE, which links law_tuned, that is at least as gentle as REFERENCE at
 * low speeds: ROUNDS steps from START. Writes the best to OUT. Returns EXIT_FINE, or EXIT_INPUT
 * after a message. */
int lab_tune(const struct image *image, const struct image *reference, unsigned long seed,
             long rounds, const char *path);

#endif
