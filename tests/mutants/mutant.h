/* SPDX-License-Identifier: MIT */
/* Which mutant is alive. mutate.c puts this file in front of what it writes. */
#ifndef FUZZY51_MUTANT_H
#define FUZZY51_MUTANT_H

enum { MUTANTS_MAX = 20000, FUNCTIONS_MAX = 2000 };

extern unsigned mutant_alive; /* 0: none */
extern unsigned char mutant_reached[FUNCTIONS_MAX];
extern unsigned long long mutant_rounds_left;
void mutant_too_long(void);

/* 1 if that mutant is alive, else 0. */
#define IS(number) (mutant_alive == (number))

/* At the start of each function. */
static inline void mutant_enter(unsigned function)
{
    mutant_reached[function] = 1;
}

/* Once in each round of a loop. */
static inline void mutant_round(void)
{
    if (--mutant_rounds_left == 0) {
        mutant_too_long();
    }
}

#endif
