/* SPDX-License-Identifier: MIT */
/* The follower with the rules as published. */
#define FOLLOW_AS_PUBLISHED
#include "test_follow.c"
