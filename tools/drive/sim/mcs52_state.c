/* SPDX-License-Identifier: MIT */
/* Checkpoints: copying a chip and comparing two. */
#include "mcs52_inside.h"

#include <string.h>

size_t mcs52_size(void)
{
    return sizeof(struct mcs52);
}

void mcs52_copy(struct mcs52 *to, const struct mcs52 *from)
{
    struct mcs52_outside outside = to->outside;
    uint8_t *covered = to->covered, watched[sizeof to->watched];

    memcpy(watched, to->watched, sizeof watched);
    *to = *from;
    memcpy(to->watched, watched, sizeof watched);
    to->outside = outside;
    to->covered = covered;
}

/* Brings what is computed only when somebody looks to the present cycle, and forgets what makes no
 * difference any more. */
static void normalize(struct mcs52 *chip)
{
    mcs52_catch_up(chip, chip->now);
    mcs52_timers_sync(chip, chip->now - 1);
    mcs52_uart_advance(chip, chip->now);
    mcs52_timers_plan(chip);
    for (int source = 0; source < SOURCES; source++) {
        if (chip->on[source] == NEVER || chip->off[source] + 2 <= chip->now) {
            chip->on[source] = chip->off[source] = NEVER;
        } else if (chip->on[source] + 2 < chip->now) {
            chip->on[source] = chip->now - 2;
        }
    }
    if (chip->held != chip->now) {
        chip->held = NEVER;
    }
    mcs52_poll(chip);
}

/* All that a chip's way on depends on, but for the changes of pins that wait. */
#define FIELD(member) {offsetof(struct mcs52, member), sizeof(((struct mcs52 *)NULL)->member)}
static const struct {
    size_t at, size;
} fields[] = {FIELD(now),
              FIELD(pc),
              FIELD(a),
              FIELD(psw),
              FIELD(ram),
              FIELD(sfr),
              FIELD(idle),
              FIELD(power_down),
              FIELD(on),
              FIELD(off),
              FIELD(held),
              FIELD(in_service),
              FIELD(timer_at),
              FIELD(t1_is_odd),
              FIELD(tx_clock.next_state),
              FIELD(tx_clock.period),
              FIELD(tx_clock.phase),
              FIELD(rx_clock.next_state),
              FIELD(rx_clock.period),
              FIELD(rx_clock.phase),
              FIELD(tx_bits),
              FIELD(tx_byte),
              FIELD(tx_next),
              FIELD(tx_next_ninth),
              FIELD(tx_waits),
              FIELD(tx_rolled),
              FIELD(tx_position),
              FIELD(rx_position),
              FIELD(rx_sample),
              FIELD(rx_ones),
              FIELD(rx_bits),
              FIELD(watchdog_left),
              FIELD(watchdog_half),
              FIELD(bitten),
              FIELD(outside_pins),
              FIELD(shorted_low),
              FIELD(shorted_high),
              FIELD(tied),
              FIELD(alternate),
              FIELD(due),
              FIELD(xdata),
              FIELD(code)};

static bool same_fields(const struct mcs52 *a, const struct mcs52 *b)
{
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        if (memcmp((const char *)a + fields[i].at, (const char *)b + fields[i].at,
                   fields[i].size) != 0) {
            return false;
        }
    }
    return true;
}

static bool same_queue(const struct mcs52 *a, const struct mcs52 *b)
{
    if (a->queue_count != b->queue_count) {
        return false;
    }
    for (unsigned i = 0; i < a->queue_count; i++) {
        const struct pin_change *p = &a->queue[(a->queue_first + i) % MCS52_PIN_QUEUE];
        const struct pin_change *q = &b->queue[(b->queue_first + i) % MCS52_PIN_QUEUE];

        if (p->cycle != q->cycle || p->port != q->port || p->mask != q->mask ||
            p->level != q->level) {
            return false;
        }
    }
    return true;
}

/* --- snapshots ---------------------------------------------------------------------------- */

/* The last two fields are compared by mcs52_equal, but are no part of a snapshot. */
enum { LARGE_FIELDS = 2, SMALL_FIELDS = sizeof fields / sizeof fields[0] - LARGE_FIELDS };

void mcs52_snapshot(struct mcs52 *chip, struct mcs52_snapshot *snapshot)
{
    uint8_t *to = snapshot->bytes;

    normalize(chip);
    for (size_t i = 0; i < SMALL_FIELDS; i++) {
        memcpy(to, (const char *)chip + fields[i].at, fields[i].size);
        to += fields[i].size;
    }
    memcpy(to, chip->pins, sizeof chip->pins);
    memset(to + sizeof chip->pins, 0,
           (size_t)(snapshot->bytes + MCS52_SNAPSHOT_BYTES - to) - sizeof chip->pins);
}

void mcs52_revive(struct mcs52 *chip, const struct mcs52_snapshot *snapshot)
{
    const uint8_t *from = snapshot->bytes;

    for (size_t i = 0; i < SMALL_FIELDS; i++) {
        memcpy((char *)chip + fields[i].at, from, fields[i].size);
        from += fields[i].size;
    }
    memcpy(chip->pins, from, sizeof chip->pins);
    chip->queue_count = 0;
    chip->due[EVENT_PIN] = NEVER;
    mcs52_poll(chip);
}

bool mcs52_equal(struct mcs52 *a, struct mcs52 *b)
{
    if (a->now != b->now || a->pc != b->pc) {
        return false;
    }
    normalize(a);
    normalize(b);
    return same_fields(a, b) && same_queue(a, b);
}
