/* SPDX-License-Identifier: MIT */
#include "meet.h"

#include "shared.h"

#include <stdatomic.h>

enum { SIZE = 1 << 24, FULL = SIZE / 4 * 3 };

/* An entry holds the upper bits of the key and, counted from 1, the case; 0: free. */
enum { CASE_BITS = 24 };
#define CASE_MASK ((1ULL << CASE_BITS) - 1)

struct meet {
    atomic_size_t count;
    _Atomic uint64_t entries[SIZE];
};

struct meet *meet_create(void)
{
    return shared_get(sizeof(struct meet));
}

size_t meet_at(struct meet *meet, uint64_t key, size_t index)
{
    uint64_t mine = (key & ~CASE_MASK) | (index + 1);

    if (index + 1 > CASE_MASK) {
        return index;
    }
    for (size_t i = key % SIZE;; i = (i + 1) % SIZE) {
        uint64_t there = 0;

        if (atomic_load(&meet->count) >= FULL && atomic_load(&meet->entries[i]) == 0) {
            return index;
        }
        if (atomic_compare_exchange_strong(&meet->entries[i], &there, mine)) {
            atomic_fetch_add(&meet->count, 1);
            return index;
        }
        if (((there ^ mine) & ~CASE_MASK) == 0) {
            return (size_t)(there & CASE_MASK) - 1;
        }
    }
}
