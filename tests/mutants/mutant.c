/* SPDX-License-Identifier: MIT */
/* The program's side of the mutants:
 *     MUTANT=N             makes mutant N alive
 *     MUTANT_ROUNDS=N      ends the program after so many rounds of loops: a mutant that loops for
 *                          ever ends at the same place on each machine
 *     MUTANT_CASE=N        runs Unity's case N alone; from 1 on
 *     MUTANT_REACHED=FILE  gets the number of cases and of those rounds, and which functions were
 *                          reached: one byte each, 0 or 1 */
#include "mutant.h"
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
#include <unity.h>

unsigned mutant_alive;
unsigned char mutant_reached[FUNCTIONS_MAX];
unsigned long long mutant_rounds_left = ~0ULL;
static unsigned case_alone, case_count;

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

void __real_UnityDefaultTestRun(UnityTestFunction function, const char *name, int line);
void __wrap_UnityDefaultTestRun(UnityTestFunction function, const char *name, int line);
void __wrap_UnityDefaultTestRun(UnityTestFunction function, const char *name, int line)
{
    case_count++;
    if (case_alone == 0 || case_alone == case_count) {
        __real_UnityDefaultTestRun(function, name, line);
    }
}

static void write_reached(void)
{
    FILE *file = fopen(getenv("MUTANT_REACHED"), "w");

    if (file != NULL) {
        fprintf(file, "%u %llu\n", case_count, ~0ULL - mutant_rounds_left);
        fwrite(mutant_reached, 1, sizeof mutant_reached, file);
        fclose(file);
    }
}

/* Before the tables are changed. */
__attribute__((constructor(101))) static void choose(void)
{
    const char *alive = getenv("MUTANT"), *rounds = getenv("MUTANT_ROUNDS"),
               *alone = getenv("MUTANT_CASE");

    if (alive != NULL) {
        mutant_alive = (unsigned)strtoul(alive, NULL, 10);
    }
    if (rounds != NULL) {
        mutant_rounds_left = strtoull(rounds, NULL, 10);
    }
    if (alone != NULL) {
        case_alone = (unsigned)strtoul(alone, NULL, 10);
    }
    if (getenv("MUTANT_REACHED") != NULL) {
        atexit(write_reached);
    }
}
