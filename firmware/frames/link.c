/* SPDX-License-Identifier: MIT */
/* Up after three good frames in a row, lost after LINK_SILENCE_MS without one. */
#include "link.h"
#include "cc51.h"

static __idata uint16_t
    since_ms; /* LINK_UP: time of the last good frame; LINK_WAITING: of the start */
static __idata uint8_t frames_good; /* in a row, while the link is not up */
static __idata uint8_t link;        /* enum link_state */

void link_init(uint8_t state, uint16_t now_ms)
{
    link = state;
    since_ms = now_ms;
    frames_good = 0;
}

bool link_good(uint16_t now_ms)
{
    /* If the silence was too long, the frame that ends it does not count as if it had come in time.
     */
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

void link_bad(void)
{
    frames_good = 0;
}

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
