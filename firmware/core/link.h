/* Whether the sensor head can be trusted: the sign-of-life watch over frames, for every controller
 * that lives on them. A bad frame is no sign of life; the last command stands until LINK_SILENCE_MS
 * have gone by without a good one. */
#ifndef FUZZY51_LINK_H
#define FUZZY51_LINK_H

#include <stdbool.h>
#include <stdint.h>

/* 200 ms, and what a frame takes: so one bad frame in a row of one each 100 ms is no silence. */
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
