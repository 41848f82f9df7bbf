/* Up after three good frames in a row, lost after 200 ms without one. */
#include "link.h"

static uint16_t good_ms;
static uint8_t good_row;
static bool up;

void link_init(void)
{
    good_row = 0;
    up = false;
}

bool link_good(uint16_t now_ms)
{
    (void)link_is_up(now_ms); /* a frame that ends a silence does not undo it */
    good_ms = now_ms;
    if (!up && ++good_row >= LINK_GOOD_FRAMES)
        up = true;
    return up;
}

void link_bad(void)
{
    if (!up)
        good_row = 0;
}

bool link_is_up(uint16_t now_ms)
{
    if (up && (uint16_t)(now_ms - good_ms) >= LINK_SILENCE_MS) {
        up = false;
        good_row = 0;
    }
    return up;
}
