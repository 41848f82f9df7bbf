/* Whether the sensor head can still be trusted: the sign-of-life watch over frames, for every
 * controller that lives on them. A bad frame is no sign of life; the last command stands until
 * LINK_SILENCE_MS have gone by without a good one. */
#ifndef FUZZY51_LINK_H
#define FUZZY51_LINK_H

#include <stdbool.h>
#include <stdint.h>

#define LINK_SILENCE_MS  200U
#define LINK_GOOD_FRAMES 3 /* in a row, before a lost link counts again */

/* The link is lost at first: a command needs LINK_GOOD_FRAMES first. */
void link_init(void);

/* A good frame came at now_ms (a clock that wraps at 65,536). Returns whether the link is up. */
bool link_good(uint16_t now_ms);

/* A frame was bad or refused: the row of good ones starts anew. A link that is up stays up. */
void link_bad(void);

/* Whether the link is up at now_ms. To be asked at least once in 60 s, else a silence can be
 * missed by the wrapping clock. */
bool link_is_up(uint16_t now_ms);

#endif
