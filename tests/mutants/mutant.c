/* SPDX-License-Identifier: MIT */
/* The program's side of the mutants:
 *     MUTANT=N             makes mutant N alive
 *     MUTANT_ROUNDS=N      ends the program after so many rounds of loops: a mutant that loops for
 *                          ever ends at the same place on each machine
 *     MUTANT_REACHED=FILE  gets the number of those rounds, and which functions were reached: one
 *                          byte each, 0 or 1 */
#include "mutant.h"
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

unsigned mutant_alive;
unsigned char mutant_reached[FUNCTIONS_MAX];
unsigned long long mutant_rounds_left = ~0ULL;

void mutant_too_long(void)
{
    _exit(1);
}

/* Unity jumps out of a case that fails. One is enough. */
_Noreturn void __wrap_longjmp(void *frame, int value);
_Noreturn void __wrap_longjmp(void *frame, int value)
{
    (void)frame;
    (void)value;
    _exit(1);
}

static void write_reached(void)
{
    FILE *file = fopen(getenv("MUTANT_REACHED"), "w");

    if (file != NULL) {
        fprintf(file, "%llu\n", ~0ULL - mutant_rounds_left);
        fwrite(mutant_reached, 1, sizeof mutant_reached, file);
        fclose(file);
    }
}

/* Before the tables are changed. */
__attribute__((constructor(101))) static void choose(void)
{
    const char *alive = getenv("MUTANT"), *rounds = getenv("MUTANT_ROUNDS");

    if (alive != NULL) {
        mutant_alive = (unsigned)strtoul(alive, NULL, 10);
    }
    if (rounds != NULL) {
        mutant_rounds_left = strtoull(rounds, NULL, 10);
    }
    if (getenv("MUTANT_REACHED") != NULL) {
        atexit(write_reached);
    }
}
