/* Following and holding. */
#include "ease.h"
#include "fixed.h"

static __idata uint8_t still_readings; /* in a row, 0..EASE_STILL_READINGS */
static __idata uint8_t hold_pct;

void ease_restart(void)
{
    still_readings = 0;
    hold_pct = 0;
}

/* w, 0..256. */
static uint16_t weight(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    uint16_t w = 0, near_w;

    if (speed->opening_mmps < EASE_OPENING_MMPS) {
        w = (uint16_t)(speed->closing_mmps + EASE_OPENING_MMPS - speed->opening_mmps) >> EASE_SHIFT;
    }
    if (dist_mm < EASE_NEAR_MM && speed->opening_mmps <= EASE_STILL_MMPS) {
        near_w = (uint16_t)(EASE_NEAR_MM - dist_mm) >> 1;
        w = w > near_w ? w : near_w;
    }
    return w;
}

/* The least brake of a car that seems to stand. */
static void hold(uint8_t brake_pct, const struct closing_speed __data *speed)
{
    if (speed->opening_mmps >= EASE_OPENING_MMPS) {
        ease_restart();
    } else if (brake_pct == 0 || speed->closing_mmps > EASE_STILL_MMPS ||
               speed->opening_mmps > EASE_STILL_MMPS) {
        still_readings = 0;
    } else if (still_readings < EASE_STILL_READINGS) {
        still_readings++;
    } else if (hold_pct < EASE_HOLD_PCT) {
        hold_pct++;
    }
}

uint8_t ease_pct(uint8_t table_pct, uint16_t dist_mm, const struct closing_speed __data *speed)
{
    uint16_t w = weight(dist_mm, speed);
    uint8_t brake_pct = table_pct;

    if (w < 256U) {
        brake_pct = (uint8_t)((uint16_t)(mul_u8((uint8_t)w, table_pct) + 128U) >> 8);
    }
    hold(brake_pct, speed);
    return brake_pct > hold_pct ? brake_pct : hold_pct;
}
