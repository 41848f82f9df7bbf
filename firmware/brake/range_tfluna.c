/* SPDX-License-Identifier: MIT */
/* The TF-Luna's frames -> distance and kind. A frame has nine bytes, low bytes first:
 *
 *     59 59   distance in cm   strength   temperature in 1/8 degree + 2048   low byte of their sum
 *
 * Of bytes that are no frame the oldest one is dropped, so whatever came before a frame does not
 * hide it. A good frame is taken as a whole, so 59 59 within it does not begin another. */
#include "range.h"
#include "fixed.h"

#define HEAD        0x59U
#define FRAME_BYTES 9U

volatile __idata uint8_t range_ring[RANGE_RING_BYTES];
volatile uint8_t range_came;
uint8_t range_taken;

/* The oldest bytes in the ring, up to eight: so many were looked at, and that is their sum. */
#define SUMMED_BYTES (FRAME_BYTES - 1U)
static uint8_t looked_at, looked_sum;

/* Whether they are a frame if the next byte is their sum, and what it says then. */
static __bit is_frame;
static __idata uint16_t frame_mm;
static __idata uint8_t strength_kind; /* RANGE_ECHO: as strong as an echo */

#define BYTE(offset)    range_ring[(uint8_t)(range_taken + (offset)) & (RANGE_RING_BYTES - 1U)]
#define WORD_AT(offset) ((uint16_t)((uint16_t)BYTE((offset) + 1U) << 8 | BYTE(offset)))

/*@ predicate range_is_valid = looked_at <= SUMMED_BYTES && strength_kind <= RANGE_NOT_FALLEN; */

/*@ requires range_is_valid;
    assigns range_taken, looked_at, looked_sum;
    ensures range_is_valid; */
void range_restart(void)
{
    range_taken = range_came;
    looked_at = 0;
    looked_sum = 0;
}

/* 64 m and more count as 65535 mm. */
/*@ assigns \nothing;
    ensures \result == (cm >= 6400 ? 65535 : 10 * cm); */
static uint16_t mm_of(uint16_t cm)
{
    uint8_t high = (uint8_t)(cm >> 8);

    if (high >= 25U) {
        return UINT16_MAX;
    }
    return (uint16_t)(mul_u8((uint8_t)cm, 10U) + (uint16_t)((uint16_t)mul_u8(high, 10U) << 8));
}

/*@ assigns \nothing;
    ensures \result == (strength == TFLUNA_STRENGTH_BLIND ? RANGE_NOT_FALLEN :
                        strength < TFLUNA_STRENGTH_MIN ? RANGE_NO_TARGET : RANGE_ECHO); */
static uint8_t kind_of(uint16_t strength)
{
    if (strength == TFLUNA_STRENGTH_BLIND) {
        return RANGE_NOT_FALLEN;
    }
    if (strength < TFLUNA_STRENGTH_MIN) {
        return RANGE_NO_TARGET;
    }
    return RANGE_ECHO;
}

/* The reading is made ready before its last byte comes, as STOP waits for it from then on. */
/*@ requires range_is_valid;
    assigns range_taken, looked_at, looked_sum, is_frame, frame_mm, strength_kind;
    ensures range_is_valid;
    ensures \result ==> range_taken == (uint8_t)(\old(range_taken) + FRAME_BYTES); */
bool range_take(void)
{
    uint8_t byte;

    if ((uint8_t)(range_came - range_taken) <= looked_at) {
        return false;
    }
    byte = BYTE(looked_at);
    if (looked_at < SUMMED_BYTES) {
        looked_at++;
    } else {
        if (is_frame && byte == looked_sum) {
            range_taken += FRAME_BYTES;
            looked_at = 0;
            looked_sum = 0;
            return true;
        }
        looked_sum -= BYTE(0);
        range_taken++;
    }
    looked_sum += byte;
    is_frame = false;
    if (looked_at == SUMMED_BYTES && BYTE(0) == HEAD && BYTE(1U) == HEAD) {
        is_frame = true;
        frame_mm = mm_of(WORD_AT(2U));
        strength_kind = kind_of(WORD_AT(4U));
    }
    return false;
}

uint16_t range_raw(void)
{
    return frame_mm;
}

/*@ requires range_is_valid; */
uint8_t range_kind(uint16_t dist_mm)
{
    if (strength_kind != RANGE_ECHO) {
        return strength_kind;
    }
    if (dist_mm > RANGE_MAX_MM) {
        return RANGE_NO_TARGET;
    }
    if (dist_mm < RANGE_MIN_MM) {
        return RANGE_DEAD_ZONE;
    }
    return RANGE_ECHO;
}
