/* SPDX-License-Identifier: MIT */
/* The TF-Luna's frames -> distance and kind. A frame has nine bytes, low bytes first:
 *
 *     59 59   distance in cm   strength   temperature in 1/8 degree + 2048   low byte of their sum
 *
 * Of bytes that are no frame the oldest one is dropped, so whatever came before a frame does not hide
 * it. A good frame is taken as a whole, so 59 59 within it does not begin another. */
#include "range.h"

#define HEAD        0x59U
#define FRAME_BYTES 9U

volatile __idata uint8_t range_ring[RANGE_RING_BYTES];
volatile uint8_t range_came;
uint8_t range_taken;

/* The oldest bytes in the ring, up to eight: so many were looked at, and that is their sum. */
#define SUMMED_BYTES (FRAME_BYTES - 1U)
static uint8_t looked_at, sum;

static __idata uint16_t dist_cm, strength; /* of the last good frame */

#define BYTE(offset)    range_ring[(uint8_t)(range_taken + (offset)) & (RANGE_RING_BYTES - 1U)]
#define WORD_AT(offset) ((uint16_t)((uint16_t)BYTE((offset) + 1U) << 8 | BYTE(offset)))

/* So many of the oldest bytes are done with. */
static void drop(uint8_t bytes)
{
    range_taken += bytes;
    looked_at = 0;
    sum = 0;
}

void range_restart(void)
{
    drop((uint8_t)(range_came - range_taken));
}

bool range_take(void)
{
    uint8_t byte;

    if ((uint8_t)(range_came - range_taken) <= looked_at) {
        return false;
    }
    byte = BYTE(looked_at);
    if (looked_at < SUMMED_BYTES) {
        looked_at++;
        sum += byte;
        return false;
    }
    if (byte != sum || BYTE(0) != HEAD || BYTE(1U) != HEAD) {
        sum += (uint8_t)(byte - BYTE(0));
        range_taken++;
        return false;
    }
    dist_cm = WORD_AT(2U);
    strength = WORD_AT(4U);
    drop(FRAME_BYTES);
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
