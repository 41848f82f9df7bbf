/* SPDX-License-Identifier: MIT */
/* The brake, with the published law or, by eva_tuned.c, with the tuned one, whatever its sensor, its driver and its serial line do: no run-time error, for ever. */
#include "hal.h"
#include "machine.h"

#define IDENTITY "any"
#include "identity.c"

#include "lut.c"
#undef LUT_DATA
#include "fixed.c"
#include "lamp.c"
#include "any_line.h"
#include "range.c"
#include "closing.c"
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
