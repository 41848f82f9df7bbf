/* SPDX-License-Identifier: MIT */
#include "base.h"

#include <stdlib.h>

static struct base *base_of(struct world *world)
{
    return (struct base *)world;
}

static const struct base *const_base_of(const struct world *world)
{
    return (const struct base *)world;
}

struct world *base_create(size_t size)
{
    struct world *world = calloc(1, size);

    if (world == NULL) {
        abort();
    }
    return world;
}

void base_destroy(struct world *world)
{
    free(world);
}

/* --- with a head -------------------------------------------------------------------------- */

void base_start(struct world *world)
{
    head_start(base_of(world)->head);
    base_of(world)->pace = (struct pace){0};
}

void base_trigger(struct world *world, int64_t t_ns, bool level)
{
    struct base *base = base_of(world);
    uint8_t payload[HEAD_PAYLOAD_MAX];

    if (!head_trigger(base->head, t_ns, level)) {
        return;
    }
    pace_note(&base->pace, t_ns);
    base->sense(world, payload);
    head_measured(base->head, t_ns, payload);
}

bool base_is_warm(const struct world *world)
{
    return head_is_warm(const_base_of(world)->head);
}

int64_t base_horizon_ns(const struct world *world, int64_t t_ns)
{
    return t_ns + const_base_of(world)->head->delay_ns;
}

int64_t base_guess_ns(const struct world *world, int64_t t_ns)
{
    return base_horizon_ns(world, pace_next_ns(&const_base_of(world)->pace, t_ns));
}

int64_t base_mark_ns(const struct world *world)
{
    return head_due_ns(const_base_of(world)->head);
}

int64_t base_measured_ns(const struct world *world)
{
    return const_base_of(world)->head->answered_ns;
}

size_t base_take_bytes(struct world *world, int64_t t_ns, uint8_t bytes[WORLD_BYTES])
{
    struct base *base = base_of(world);
    size_t count = head_take(base->head, t_ns, bytes);

    if (base->rig != NULL && head_blind_ns(base->head) == INT64_MAX) {
        rig_blind(base->rig, false);
    }
    return count;
}

/* --- with a rig --------------------------------------------------------------------------- */

void base_advance(struct world *world, int64_t t_ns)
{
    struct base *base = base_of(world);
    int64_t blind_ns = head_blind_ns(base->head);

    if (blind_ns <= t_ns) {
        rig_advance(base->rig, blind_ns);
        rig_blind(base->rig, true);
    }
    rig_advance(base->rig, t_ns);
}

void base_state_reported(struct world *world, int64_t t_ns, const char *state)
{
    rig_state_reported(base_of(world)->rig, t_ns, state);
}

bool base_is_over(const struct world *world)
{
    return rig_is_over(const_base_of(world)->rig);
}

void base_measure(const struct world *world, int64_t t_ns, struct outcome *outcome)
{
    rig_measure(const_base_of(world)->rig, t_ns, outcome);
}
