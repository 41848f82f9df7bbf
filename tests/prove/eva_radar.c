/* SPDX-License-Identifier: MIT */
/* Radar, whatever its sensor head sends and however late each round is: no run-time error, for
 * ever. */
#include "eva_frames.h"

#include "fmcw.c"
#include "lane.c"
#include "safe.c"
#include "mul_u16.c"
#include "radar.c"
#include "radar/main.c"
