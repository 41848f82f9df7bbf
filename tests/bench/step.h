/* SPDX-License-Identifier: MIT */
/* What a bench of a controller gives to step.c, and one of a controller on frames to frames.c. */
#ifndef FUZZY51_BENCH_STEP_H
#define FUZZY51_BENCH_STEP_H

#include <stdint.h>

/* How many steps there are, and the machine cycles of the nth of them, 0 and up: between the macros
 * timer 0 counts, its start one of them. */
extern const uint16_t __code bench_steps;
uint16_t bench_step(uint16_t n);
#define BENCH_START()                                                                              \
    do {                                                                                           \
        TH0 = 0;                                                                                   \
        TL0 = 0;                                                                                   \
        TR0 = 1;                                                                                   \
    } while (0)
#define BENCH_STOP() (TR0 = 0, (uint16_t)((uint16_t)TH0 << 8 | TL0))

/* What did not go as meant, at the end: payloads refused, or states that never came. */
uint16_t bench_misses(void);

/* The nth payload of bench_steps, put into frame_body. */
void bench_payload(uint16_t n);

/* Times all steps, prints the figures, and stops the simulator. */
void bench_run(void);

#endif
