/* SPDX-License-Identifier: MIT */
/* Hashes, wide enough that no two of some millions are the same by chance. */
#ifndef FUZZY51_FLIP_HASH_H
#define FUZZY51_FLIP_HASH_H

#include <stddef.h>
#include <stdint.h>

/* A hash of HASH and VALUE. */
uint64_t hash_mix(uint64_t hash, uint64_t value);

/* A hash of HASH and BYTES; SIZE: a multiple of 8. */
uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size);

#endif
