/* SPDX-License-Identifier: MIT */
/* controller: brake
 * proves: range.c closing.c target.c
 * long: yes
 *
 * The brake's targets and their speeds: each function keeps its contract, from any state that can be. */
#include "bits.h"
#include "sensor.h"
#include "fixed.h"
#include RANGE_C
#include CLOSING_C
#include "target.c"
