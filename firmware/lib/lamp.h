/* What one lamp can tell: off, on, a quick flicker, or a number to count. Portable. */
#ifndef FUZZY51_LAMP_H
#define FUZZY51_LAMP_H

#include <stdbool.h>
#include <stdint.h>

#define LAMP_OFF     0U
#define LAMP_ON      1U
#define LAMP_FLICKER 255U /* five times a second */

/* Every 1/100 s: is the lamp lit? A pattern of 2..9 is so many blinks of a quarter second, then a
 * pause of one second; a new pattern starts at once. */
bool lamp_tick(uint8_t pattern);

#endif
