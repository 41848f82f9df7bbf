/* What a bench of a controller that lives on frames gives to step.c. */
#ifndef FUZZY51_BENCH_STEP_H
#define FUZZY51_BENCH_STEP_H

#include <stdint.h>

/* How many payloads there are, and the nth of them, 0 and up, put into frame_body. */
extern const uint16_t __code bench_payloads;
void bench_payload(uint16_t n);

#endif
