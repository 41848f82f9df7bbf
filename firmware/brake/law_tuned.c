/* SPDX-License-Identifier: MIT */
/* The tuned controller: a table with more gain on the closing speed, braking from the first reading
 * where that reading alone proves a speed, and ease.h for those who do not close. */
#include "law_tuned.h"
#include "brake.h"
#include "cell.h"
#include "ease.h"
#include "law.h"
#include "lut.h"

/* One reading ago the road was clear as far as the table goes, so the target came at least this
 * far. */
static uint8_t first_sight(uint16_t dist_mm)
{
    uint16_t came_mm = LAW_FAR_MM - dist_mm;
    uint8_t pct;

    if (came_mm > LAW_TUNED_FIRST_MM) {
        return 0;
    }
    brake.col =
        cell_col((uint16_t)(came_mm << 4), 0); /* in 1/16 s; it was LAW_ENTER_CS, a little less */
    brake.row = cell_row(dist_mm);
    pct = cell_pct(brake.row, brake.col);
    return pct < LAW_TUNED_FIRST_PCT ? pct : LAW_TUNED_FIRST_PCT;
}

uint8_t law_step(uint8_t target, uint16_t dist_mm)
{
    if (target != LAW_TRACKED) {
        ease_restart();
        if (target == LAW_GLIMPSE) {
            return 0;
        }
        if (target == LAW_ENTERED) {
            return first_sight(dist_mm);
        }
    }
    brake.col = cell_col(BRAKE_SPEED.closing_mmps, BRAKE_SPEED.opening_mmps);
    brake.row = cell_row(dist_mm);
    return ease_pct(cell_pct(brake.row, brake.col), dist_mm);
}

uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    return cell_pct(cell_row(dist_mm), cell_col(speed->closing_mmps, speed->opening_mmps));
}
