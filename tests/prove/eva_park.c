/* SPDX-License-Identifier: MIT */
/* Park, whatever its sensor head sends and however late each round is: no run-time error, for ever.
 */
#include "hal_head.h"
#include "machine.h"

const char identity[] = "any";

#include "fixed.c"
#include "lamp.c"
#include "lut.c"
#include "selftest.c"
#include "any_line.h"
#include "frame.c"
#include "link.c"
#include "frames.c"
#include "cordic.c"
#include "park.c"
#define main park_main
#include "park/main.c"
#undef main

/* As park_main, but the rounds of the self-test are told from those after it. */
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
