/* SPDX-License-Identifier: MIT */
/* The TF-Luna's frames -> distance and kind. A frame has nine bytes, low bytes first:
 *
 *     59 59   distance in cm   strength   temperature in 1/8 degree + 2048   low byte of their sum
 *
 * Nine bytes that are no frame lose only the first of them, so whatever came before a frame does
 * not hide it. A good frame is taken as a whole, so 59 59 within it does not begin another. */
#include "range.h"

#define HEAD        0x59U
#define FRAME_BYTES 9U

volatile __idata uint8_t range_ring[RANGE_RING_BYTES];
volatile uint8_t range_came;
uint8_t range_taken;

static __idata uint16_t dist_cm, strength; /* of the last good frame */

/* The oldest bytes in the ring. */
#define WAITING         ((uint8_t)(range_came - range_taken))
#define BYTE(offset)    range_ring[(uint8_t)(range_taken + (offset)) & (RANGE_RING_BYTES - 1U)]
#define WORD_AT(offset) ((uint16_t)((uint16_t)BYTE((offset) + 1U) << 8 | BYTE(offset)))

void range_restart(void)
{
    range_taken = range_came;
}

/* Whether the oldest nine bytes are a frame. */
static bool is_frame(void)
{
    uint8_t sum = 0, offset;

    if (BYTE(0) != HEAD || BYTE(1) != HEAD) {
        return false;
    }
    for (offset = 0; offset != FRAME_BYTES - 1U; offset++) { /* rounds: 8 */
        sum += BYTE(offset);
    }
    return sum == BYTE(FRAME_BYTES - 1U);
}

bool range_take(void)
{
    if (WAITING < FRAME_BYTES) {
        return false;
    }
    if (!is_frame()) {
        range_taken++;
        return false;
    }
    dist_cm = WORD_AT(2U);
    strength = WORD_AT(4U);
    range_taken += FRAME_BYTES;
    return true;
}

uint16_t range_raw(void)
{
    return dist_cm;
}

uint16_t range_mm(uint16_t cm)
{
    if (cm > UINT16_MAX / 10U) {
        return UINT16_MAX;
    }
    return (uint16_t)((uint16_t)(cm << 3) + (uint16_t)(cm << 1));
}

uint8_t range_kind(uint16_t dist_mm)
{
    if (strength == TFLUNA_STRENGTH_BLIND) {
        return RANGE_NOT_FALLEN;
    }
    if (strength < TFLUNA_STRENGTH_MIN || dist_mm > RANGE_MAX_MM) {
        return RANGE_NO_TARGET;
    }
    return dist_mm < RANGE_MIN_MM ? RANGE_DEAD_ZONE : RANGE_ECHO;
}
