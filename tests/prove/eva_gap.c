/* SPDX-License-Identifier: MIT */
/* Gap, whatever its sensor head sends and however late each round is: no run-time error, for ever.
 */
#include "eva_frames.h"

#include "mul_u16.c"
#include "gap.c"
#include "gap/main.c"
