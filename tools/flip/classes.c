/* SPDX-License-Identifier: MIT */
#include "classes.h"

#include "hash.h"

#include <stdlib.h>
#include <string.h>

/* Classes that became one point to each other; the last one has itself as its parent. */
struct class
{
    uint32_t parent;
    struct fault_case first;
};

struct state {
    uint32_t class;
    struct mcs52_snapshot snapshot;
};

/* The states at the end of a slot. */
struct states {
    struct state *all;
    size_t count, capacity;
};

/* By hash. A key of 0 is a free place. */
struct map {
    struct map_entry {
        uint64_t key;
        uint32_t value;
    } *entries;
    size_t count, size; /* size: a power of two */
};

struct classes {
    struct class *all;
    size_t count, capacity;
    struct states old, present;
    struct map stayed, left; /* in this slot */
};

/* --- hashes ------------------------------------------------------------------------------- */

static uint64_t key_of(const struct mcs52_snapshot *snapshot, uint64_t edges)
{
    uint64_t key = hash_bytes(edges, snapshot, sizeof *snapshot);

    return key != 0 ? key : 1;
}

static struct map_entry *map_place(const struct map *map, uint64_t key)
{
    size_t i = key & (map->size - 1);

    while (map->entries[i].key != 0 && map->entries[i].key != key) {
        i = (i + 1) & (map->size - 1);
    }
    return &map->entries[i];
}

static void map_grow(struct map *map)
{
    struct map larger = {.count = map->count, .size = map->size > 0 ? 2 * map->size : 1024};

    larger.entries = calloc(larger.size, sizeof *larger.entries);
    if (larger.entries == NULL) {
        abort();
    }
    for (size_t i = 0; i < map->size; i++) {
        if (map->entries[i].key != 0) {
            *map_place(&larger, map->entries[i].key) = map->entries[i];
        }
    }
    free(map->entries);
    *map = larger;
}

/* The entry of KEY; a new one has value VALUE. */
static struct map_entry *map_put(struct map *map, uint64_t key, uint32_t value)
{
    struct map_entry *entry;

    if (2 * map->count >= map->size) {
        map_grow(map);
    }
    entry = map_place(map, key);
    if (entry->key == 0) {
        *entry = (struct map_entry){key, value};
        map->count++;
    }
    return entry;
}

static void map_clear(struct map *map)
{
    if (map->count > 0) {
        memset(map->entries, 0, map->size * sizeof *map->entries);
        map->count = 0;
    }
}

/* --- classes ------------------------------------------------------------------------------ */

static void *grown(void *all, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity) {
        return all;
    }
    *capacity = 2 * *capacity + 1024;
    all = realloc(all, *capacity * size);
    if (all == NULL) {
        abort();
    }
    return all;
}

struct classes *classes_create(void)
{
    struct classes *classes = calloc(1, sizeof *classes);

    if (classes == NULL) {
        abort();
    }
    for (int i = 0; i <= CLASS_UNKNOWN; i++) {
        classes_add(classes, &(struct fault_case){0});
    }
    return classes;
}

/* Large, and of no use after the last slot. */
static void forget_states(struct classes *classes)
{
    free(classes->old.all);
    free(classes->present.all);
    free(classes->stayed.entries);
    free(classes->left.entries);
    classes->old = classes->present = (struct states){0};
    classes->stayed = classes->left = (struct map){0};
}

void classes_free(struct classes *classes)
{
    forget_states(classes);
    free(classes->all);
    free(classes);
}

uint32_t classes_add(struct classes *classes, const struct fault_case *first)
{
    uint32_t class = (uint32_t)classes->count;

    classes->all = grown(classes->all, classes->count, &classes->capacity, sizeof *classes->all);
    classes->all[classes->count++] = (struct class){.parent = class, .first = *first};
    return class;
}

void classes_end(struct classes *classes, uint32_t class)
{
    classes->all[class].parent = CLASS_NONE;
}

uint32_t classes_stay(struct classes *classes, uint32_t class, const struct mcs52_snapshot *state)
{
    struct states *states = &classes->present;
    uint32_t one = map_put(&classes->stayed, key_of(state, 0), class)->value;

    classes->all[class].parent = one;
    if (one == class) {
        states->all = grown(states->all, states->count, &states->capacity, sizeof *states->all);
        states->all[states->count].class = class;
        states->all[states->count++].snapshot = *state;
    }
    return one;
}

uint32_t classes_leave(struct classes *classes, uint32_t class, const struct mcs52_snapshot *state,
                       uint64_t edges)
{
    uint32_t one = map_put(&classes->left, key_of(state, edges), class)->value;

    classes->all[class].parent = one;
    return one;
}

void classes_turn(struct classes *classes)
{
    struct states empty = classes->old;

    classes->old = classes->present;
    classes->present = empty;
    classes->present.count = 0;
    map_clear(&classes->stayed);
    map_clear(&classes->left);
}

const struct mcs52_snapshot *classes_old(const struct classes *classes, size_t i, uint32_t *class)
{
    if (i >= classes->old.count) {
        return NULL;
    }
    *class = classes->old.all[i].class;
    return &classes->old.all[i].snapshot;
}

void classes_forget(struct classes *classes, uint32_t class)
{
    if (class + 1 != classes->count) {
        abort();
    }
    classes->count--;
}

uint32_t classes_root(struct classes *classes, uint32_t class)
{
    while (classes->all[class].parent != class) {
        classes->all[class].parent = classes->all[classes->all[class].parent].parent;
        class = classes->all[class].parent;
    }
    return class;
}

size_t classes_count(const struct classes *classes)
{
    return classes->count;
}

void classes_plan(struct classes *classes, struct plan *plan)
{
    for (uint32_t class = CLASS_UNKNOWN + 1; class < classes->count; class ++) {
        if (classes->all[class].parent == class) {
            struct fault_case flight = classes->all[class].first;

            flight.tag = class;
            plan_add(plan, &flight);
        }
    }
    forget_states(classes);
}
