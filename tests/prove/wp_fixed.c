/* SPDX-License-Identifier: MIT */
/* The byte product and the upper half of a product: exact for all values. */
#include "bits.h"
#include "fixed.c"
#include "mul_u16.c"
