/* SPDX-License-Identifier: MIT */
/* Follow, whatever its sensor head sends and however late each round is: no run-time error, for
 * ever. */
#include "eva_frames.h"

#include "follow.c"
#include "follow/main.c"
