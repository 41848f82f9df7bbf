/* SPDX-License-Identifier: MIT */
/* Park, whatever its sensor head sends and however late each round is: no run-time error, for ever.
 */
#include "eva_frames.h"

#include "cordic.c"
#include "plan.c"
#include "park.c"
#include "park/main.c"
