/* SPDX-License-Identifier: MIT */
/* Times a control step of a frame-fed controller as it ships. Takes the place of frames/frames.c. A
 * step is app_item, app_read and app_decide together, with the payloads of tests/bench/APP.c. */
#include <8052.h>
#include "frames.h"
#include "step.h"

/* Direct RAM is the controllers'. */
static __idata uint16_t refused;

uint16_t bench_step(uint16_t n)
{
    if (n == 0) {
        app_init();
    }
    bench_payload(n);
    BENCH_START();
    if (app.item_bytes != 0) {
        app_item();
    }
    if (app_read()) {
        app_decide();
    } else {
        refused++;
    }
    return BENCH_STOP();
}

uint16_t bench_misses(void)
{
    return refused;
}

void frames_init(void)
{
    bench_run();
}

void frames_round(void)
{
}
