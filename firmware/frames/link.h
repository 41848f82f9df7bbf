/* Whether the sensor head can be trusted: the sign-of-life watch over frames, for every controller
 * that lives on them. A bad frame is no sign of life; the last command stands until LINK_SILENCE_MS
 * have gone by without a good one. */
#ifndef FUZZY51_LINK_H
#define FUZZY51_LINK_H

#include <stdbool.h>
#include <stdint.h>

/* Silence for 200 ms. With a frame each 100 ms, one bad frame makes just these 200 ms, and the next
 * frame, which ends them, must still count: so 200 ms, and a tick of 10 ms for either end, as both
 * are read off the ticks. From the end of the last good frame to the fault it takes 210 to 220 ms:
 * one bad frame in a row never leads to it, two always do; of frames each 50 ms three and four, of
 * frames each 20 ms nine and eleven. A head may be 10 ms late. */
#define LINK_SILENCE_MS  220U
#define LINK_START_MS    500U /* to come up in after the start */
#define LINK_GOOD_FRAMES 3    /* in a row, before a link counts as up */

enum link_state {
    LINK_WAITING, /* just started: no command yet, no fault yet */
    LINK_UP,
    LINK_LOST, /* silent, or not up in time: the controller's fault state */
};

/* Starts watching at now_ms, as LINK_WAITING, or as LINK_LOST after a watchdog reset. */
void link_init(uint8_t state, uint16_t now_ms);

/* A good frame came at now_ms (a clock that wraps at 65,536). Returns whether the link is up. */
bool link_good(uint16_t now_ms);

/* A frame was bad or refused: the row of good ones starts anew. A link that is up stays up. */
void link_bad(void);

/* The link at now_ms, one of enum link_state. To be asked at least once in 60 s, else the wrapping
 * clock can hide a silence. */
uint8_t link_check(uint16_t now_ms);

#endif
