/* SPDX-License-Identifier: MIT */
/* Whether the sensor head can be trusted: watches for good frames as its sign of life. A bad frame
 * is no sign of life. The last command stays in force until LINK_SILENCE_MS have passed without a
 * good frame. */
#ifndef FUZZY51_LINK_H
#define FUZZY51_LINK_H

#include <stdbool.h>
#include <stdint.h>

/* The silence that makes a fault: 200 ms, and one tick of 10 ms for its start and one for its end,
 * because both are read from the ticks. With one frame each 100 ms, one bad frame makes just 200 ms
 * of silence; the next frame ends it and must still count. From the end of the last good frame to
 * the fault it takes 210 to 220 ms. With frames each 100 ms, one bad frame never makes a fault and
 * two in a row always do; with frames each 50 ms three and four; with frames each 20 ms nine and
 * eleven. A head may be 10 ms late. */
#define LINK_SILENCE_MS  220U
#define LINK_START_MS    500U /* after the start the link must be up within this time */
#define LINK_GOOD_FRAMES 3    /* good frames in a row until the link is up */

enum link_state {
    LINK_WAITING, /* just started: no command yet, no fault yet */
    LINK_UP,
    LINK_LOST, /* silent, or not up in time: the controller's fault state */
};

/* Starts to watch at now_ms. `state` is LINK_WAITING, or LINK_LOST after a watchdog reset. now_ms
 * here and below is any clock of milliseconds that wraps at 65,536. */
/*@ requires state == LINK_WAITING || state == LINK_LOST; */
void link_init(uint8_t state, uint16_t now_ms);

/* A good frame came at now_ms. Returns whether the link is up. */
bool link_good(uint16_t now_ms);

/* A frame was bad or refused: the count of good frames in a row starts again. A link that is up
 * stays up. */
void link_bad(void);

/* Returns enum link_state at now_ms. Must be called at least once in 60 s; otherwise a silence can
 * hide behind the wrapping clock. */
/*@ ensures \result == LINK_WAITING || \result == LINK_UP || \result == LINK_LOST; */
uint8_t link_check(uint16_t now_ms);

#endif
