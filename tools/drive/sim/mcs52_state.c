/* SPDX-License-Identifier: MIT */
/* Checkpoints: copying a chip and comparing two. */
#include "mcs52_inside.h"

#include <string.h>

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
    chip->t1_overflows &= 1;
    chip->poll = true;
    mcs52_attend(chip);
}

static bool same_clock(const struct baud *a, const struct baud *b)
{
    return a->next_state == b->next_state && a->period == b->period && a->phase == b->phase;
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

#define SAME(field) (memcmp(&a->field, &b->field, sizeof a->field) == 0)

static bool same_processor(const struct mcs52 *a, const struct mcs52 *b)
{
    return SAME(now) && SAME(pc) && SAME(a) && SAME(psw) && SAME(ram) && SAME(sfr) && SAME(idle) &&
           SAME(power_down) && SAME(on) && SAME(off) && SAME(held) && SAME(in_service);
}

static bool same_periphery(const struct mcs52 *a, const struct mcs52 *b)
{
    return SAME(timer_at) && SAME(t1_overflows) && same_clock(&a->tx_clock, &b->tx_clock) &&
           same_clock(&a->rx_clock, &b->rx_clock) && SAME(tx_bits) && SAME(tx_byte) &&
           SAME(tx_next) && SAME(tx_next_ninth) && SAME(tx_waits) && SAME(tx_rolled) &&
           SAME(tx_position) && SAME(rx_position) && SAME(rx_sample) && SAME(rx_ones) &&
           SAME(rx_bits) && SAME(watchdog_left) && SAME(watchdog_last) && SAME(bitten) &&
           SAME(outside_pins) && SAME(alternate) && SAME(due);
}

bool mcs52_equal(struct mcs52 *a, struct mcs52 *b)
{
    normalize(a);
    normalize(b);
    return same_processor(a, b) && same_periphery(a, b) && same_queue(a, b) && SAME(xdata) &&
           SAME(code);
}
