/* SPDX-License-Identifier: MIT */
/* long: yes
 *
 * The brake, with the published law, or with the tuned one by eva_tuned.c and, behind the lidar, by eva_brake_far.c,
 * whatever its sensor, its driver and its serial line do: no run-time error, for ever. */
#include "hal.h"
#include "machine.h"

#define IDENTITY "any"
#include "identity.c"

#include "lut.c"
#undef LUT_DATA
#include "fixed.c"
#include "lamp.c"
#include "any_line.h"
#include "sensor.h"
#include RANGE_C
#include CLOSING_C
#include "target.c"
#include "latch.c"
#include "fault.c"
#include "warning.c"
#include "cell.c"
#ifdef ESTIMATOR_smooth
#include "ease.c"
#include "law_tuned.c"
#else
#include "law_fuzzy.c"
#endif
#include "brake.c"
#include "brake/main.c"
