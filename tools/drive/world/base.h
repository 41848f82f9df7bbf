/* SPDX-License-Identifier: MIT */
/* What worlds have in common, so that each is only its plant and its expectations: a struct world
 * begins with a struct base, and its class takes those of the functions below that it has nothing
 * to add to. */
#ifndef FUZZY51_BASE_H
#define FUZZY51_BASE_H

#include "head.h"
#include "pace.h"
#include "rig.h"
#include "world.h"

struct base {
    struct pace pace;  /* of the controller's triggers */
    struct rig *rig;   /* the world's car on a lane; NULL: it has none */
    struct head *head; /* its sensor head; NULL: it has none */

    /* With a head: what it measures at the trigger that ends now. */
    void (*sense)(struct world *world, uint8_t payload[HEAD_PAYLOAD_MAX]);
};

/* For the class of each world: what its trace shows, from arrays of that world. */
#define BASE_TRACE(column_array, reported_array)                                                   \
    .columns = column_array, .column_count = sizeof column_array / sizeof column_array[0],         \
    .reported = reported_array, .reported_count = sizeof reported_array / sizeof reported_array[0]

/* SIZE bytes of zeros, of which the first are the base. */
struct world *base_create(size_t size);
void base_destroy(struct world *world);

/* Times begin at 0 anew. */
void base_start(struct world *world);

/* Of a world with a head: the trigger pin goes to LEVEL; when that ends a pulse that the head
 * hears, the head senses, and the answer is on its way. */
void base_trigger(struct world *world, int64_t t_ns, bool level);

/* Of a world with a head and a rig: the rig drives until T_NS, and knows from when on frames are
 * bad. */
void base_advance(struct world *world, int64_t t_ns);

/* For the class of a world with a head. */
bool base_is_warm(const struct world *world);
int64_t base_horizon_ns(const struct world *world, int64_t t_ns);
int64_t base_guess_ns(const struct world *world, int64_t t_ns);
int64_t base_mark_ns(const struct world *world);
int64_t base_measured_ns(const struct world *world);
size_t base_take_bytes(struct world *world, int64_t t_ns, uint8_t bytes[WORLD_BYTES]);
#define BASE_HEAD_FUNCTIONS                                                                        \
    .horizon_ns = base_horizon_ns, .guess_ns = base_guess_ns, .mark_ns = base_mark_ns,             \
    .measured_ns = base_measured_ns, .take_bytes = base_take_bytes

/* For the class of a world with a rig. */
void base_state_reported(struct world *world, int64_t t_ns, const char *state);
bool base_is_over(const struct world *world);
void base_measure(const struct world *world, int64_t t_ns, struct outcome *outcome);
#define BASE_RIG_FUNCTIONS .state_reported = base_state_reported, .is_over = base_is_over

#endif
