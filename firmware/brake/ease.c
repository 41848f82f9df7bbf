/* SPDX-License-Identifier: MIT */
/* Following and holding. */
#include "ease.h"
#include "fixed.h"

static uint8_t still_readings; /* in a row, 0..EASE_STILL_READINGS */
static uint8_t hold_pct;

/* Holds from ease_restart on. */
/*@ predicate ease_is_valid =
        still_readings <= EASE_STILL_READINGS && hold_pct <= EASE_HOLD_PCT; */

/*@ assigns still_readings, hold_pct;
    ensures ease_is_valid && still_readings == 0 && hold_pct == 0; */
void ease_restart(void)
{
    still_readings = 0;
    hold_pct = 0;
}

/*@ requires ease_is_valid;
    assigns still_readings, hold_pct;
    ensures ease_is_valid;
    ensures \result <= \max(table_pct, EASE_HOLD_PCT);
    ensures hold_pct > \old(hold_pct) ==> \old(still_readings) == EASE_STILL_READINGS; */
uint8_t ease_pct(uint8_t table_pct, uint16_t dist_mm)
{
    uint8_t opening_mmps, w; /* w: n / 256, and 255 takes nothing of 100 percent either */

    if (closing_smooth.opening_mmps >= EASE_OPENING_MMPS) {
        ease_restart();
        return 0;
    }
    if (closing_smooth.closing_mmps >= EASE_SPAN_MMPS - EASE_OPENING_MMPS) {
        still_readings = 0;
    } else {
        opening_mmps = (uint8_t)closing_smooth.opening_mmps;
        w = EASE_OPENING_MMPS - opening_mmps;
        w = (uint8_t)((uint16_t)(closing_smooth.closing_mmps + w) >> EASE_SHIFT);
        if (opening_mmps <= EASE_STILL_MMPS && dist_mm < EASE_NEAR_MM) {
            dist_mm = EASE_NEAR_MM - dist_mm;
            if (dist_mm >= 512U) {
                w = 255;
            } else if (w < (uint8_t)(dist_mm >> 1)) {
                w = (uint8_t)(dist_mm >> 1);
            }
        }
        /*@ assert w * table_pct <= 255 * table_pct; */
        table_pct = (uint8_t)((uint16_t)(mul_u8(w, table_pct) + 128U) >> 8);
        /* The least brake of a car that seems to stand. */
        if (table_pct == 0 || closing_smooth.closing_mmps > EASE_STILL_MMPS ||
            opening_mmps > EASE_STILL_MMPS) {
            still_readings = 0;
        } else if (still_readings < EASE_STILL_READINGS) {
            still_readings++;
        } else if (hold_pct < EASE_HOLD_PCT) {
            hold_pct++;
#if RANGE_IS_FAST
            still_readings = (uint8_t)(still_readings - (EASE_HOLD_READINGS - 1U));
#endif
        }
    }
    if (table_pct < hold_pct) {
        table_pct = hold_pct;
    }
    return table_pct;
}
