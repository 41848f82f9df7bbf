/* SPDX-License-Identifier: MIT */
/* controller: gap
 * proves: lut.c
 * long: yes
 *
 * Look-up between the nodes of a table, and its check sum. */
#include "bits.h"
#include "fixed.h"
#include "lut.c"
