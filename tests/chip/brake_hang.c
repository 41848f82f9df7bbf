/* SPDX-License-Identifier: MIT */
/* The brake controller, but it hangs when the override is pressed: for the test of the watchdog. */
#include "hal.h"

static bool hang_when_held(void)
{
    while (hal_override_held()) {
        for (;;) {
        }
    }
    return false;
}

#define hal_override_held hang_when_held
#include "../../firmware/brake/main.c"
