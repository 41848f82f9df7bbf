/* SPDX-License-Identifier: MIT */
/* The parking controller as published: it drives from wherever it is. */
#define PARK_AS_PUBLISHED
#include "test_park.c"
