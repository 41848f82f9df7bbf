/* SPDX-License-Identifier: MIT */
#include "hash.h"

#include <string.h>

/* The finalizer of MurmurHash3 (Austin Appleby, public domain). */
uint64_t hash_mix(uint64_t hash, uint64_t value)
{
    hash ^= value + 0x9E3779B97F4A7C15u;
    hash = (hash ^ hash >> 33) * 0xFF51AFD7ED558CCDu;
    hash = (hash ^ hash >> 33) * 0xC4CEB9FE1A85EC53u;
    return hash ^ hash >> 33;
}

uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    const char *from = bytes;
    uint64_t word;

    for (size_t i = 0; i < size; i += sizeof word) {
        memcpy(&word, from + i, sizeof word);
        hash = (hash ^ word) * 0x9FB21C651E98DF25u;
        hash ^= hash >> 32;
    }
    return hash_mix(hash, size);
}
