/* SPDX-License-Identifier: MIT */
/* Up after three good frames in a row, lost after LINK_SILENCE_MS without one. */
#include "link.h"
#include "cc51.h"

static __idata uint16_t
    since_ms; /* LINK_UP: time of the last good frame; LINK_WAITING: of the start */
static __idata uint8_t frames_good; /* in a row, while the link is not up */
static __idata uint8_t link;        /* enum link_state */

/* Holds from link_init on. */
/*@ predicate link_is_valid =
        link <= LINK_LOST && (link != LINK_UP ==> frames_good < LINK_GOOD_FRAMES); */

/*@ requires state <= LINK_LOST;
    assigns link, since_ms, frames_good;
    ensures link == state && since_ms == now_ms && frames_good == 0; */
void link_init(uint8_t state, uint16_t now_ms)
{
    link = state;
    since_ms = now_ms;
    frames_good = 0;
}

/*@ requires link_is_valid;
    assigns link, since_ms, frames_good;
    ensures link_is_valid;
    ensures \result <==> link == LINK_UP;
    ensures \result ==> since_ms == now_ms;
    ensures up_needs_three: \old(link) != LINK_UP && \result ==>
                \old(frames_good) == LINK_GOOD_FRAMES - 1; */
bool link_good(uint16_t now_ms)
{
    /* The frame that ends too long a silence does not count as if it had come in time. */
    (void)link_check(now_ms);
    if (link != LINK_UP) {
        frames_good++;
        if (frames_good < LINK_GOOD_FRAMES) {
            return false;
        }
        link = LINK_UP;
    }
    since_ms = now_ms;
    return true;
}

/*@ requires link_is_valid;
    assigns frames_good;
    ensures link_is_valid;
    ensures bad_is_no_life: since_ms == \old(since_ms) && link == \old(link);
    ensures frames_good == 0; */
void link_bad(void)
{
    frames_good = 0;
}

/*@ requires link_is_valid;
    assigns link, frames_good;
    ensures link_is_valid;
    ensures \result == link;
    ensures silence_is_lost: \old(link) == LINK_UP &&
                (uint16_t)(now_ms - since_ms) >= LINK_SILENCE_MS ==> link == LINK_LOST;
    ensures link == LINK_LOST || link == \old(link);
    ensures frames_good == (link == \old(link) ? \old(frames_good) : 0); */
uint8_t link_check(uint16_t now_ms)
{
    uint16_t past_ms = (uint16_t)(now_ms - since_ms);

    if ((link == LINK_UP && past_ms >= LINK_SILENCE_MS) ||
        (link == LINK_WAITING && past_ms >= LINK_START_MS)) {
        link = LINK_LOST;
        frames_good = 0;
    }
    return link;
}
