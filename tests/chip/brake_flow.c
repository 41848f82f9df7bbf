/* SPDX-License-Identifier: MIT */
/* The brake controller, but while the override is pressed a job of the tick runs twice: for the
 * test of the marks that the jobs leave. */
#include "hal.h"

static uint8_t follow_and_stray(bool stop);

#define hal_outputs_wrong_ticks follow_and_stray
#include "../../firmware/brake/main.c"

static uint8_t follow_and_stray(bool stop)
{
    (void)stop;
    if (hal_override_held()) {
        show();
    }
    return 0;
}
