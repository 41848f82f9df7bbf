/* SPDX-License-Identifier: MIT */
/* For eva_*.c of the controllers that are fed by frames: all but the controller, which comes after
 * it, and the main loop that Eva analyses. */
#ifndef FUZZY51_PROVE_EVA_FRAMES_H
#define FUZZY51_PROVE_EVA_FRAMES_H

#include "hal_head.h"
#include "machine.h"

#define IDENTITY "any"
#include "identity.c"

#include "fixed.c"
#include "lamp.c"
#include "lut.c"
#include "selftest.c"
#include "any_line.h"
#include "frame.c"
#include "link.c"
#include "frames.c"

/* As the controller's main, but the rounds of the self-test are told from those after it. */
void main(void)
{
    frames_init();
    /*@ loop unroll 100; */
    while (is_testing) {
        frames_round();
    }
    for (;;) {
        frames_round();
    }
}

#define main controller_main

#endif
