/* SPDX-License-Identifier: MIT */
/* Radar, whatever its sensor head sends and however late each round is: no run-time error, for
 * ever. */
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
#include "fmcw.c"
#include "lane.c"
#include "safe.c"
#include "mul_u16.c"
#include "radar.c"
#define main radar_main
#include "radar/main.c"
#undef main

/* As radar_main, but the rounds of the self-test are told from those after it. */
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
