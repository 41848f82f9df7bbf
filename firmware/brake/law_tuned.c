/* SPDX-License-Identifier: MIT */
/* The tuned controller: a table with more gain on the closing speed, braking from the first reading
 * where that reading alone proves a speed, and ease.h for those who do not close. */
#include "law_tuned.h"
#include "cell.h"
#include "ease.h"
#include "law.h"
#include "target.h"

__data struct law_answer law_answer;

void law_restart(void)
{
    ease_restart();
}

static void look_up(uint16_t dist_mm, uint16_t closing_mmps)
{
    law_answer.col = cell_col(closing_mmps, CLOSING_LAW.opening_mmps);
    law_answer.row = cell_row(dist_mm);
    law_answer.brake_pct = cell_pct(law_answer.row, law_answer.col);
}

/* One reading ago, or two, the road was clear as far as the table goes, so the target came at least
 * this far: in 1/16 s, or 1/8 s, a little more than it was. */
static void look_at_first_sight(uint8_t worth, uint16_t dist_mm)
{
    uint16_t closing_mmps = (uint16_t)(LAW_FAR_MM - dist_mm);

    if (worth == TARGET_GLIMPSE || closing_mmps > LAW_TUNED_FIRST_MM) {
        return;
    }
    closing_mmps <<= 3;
    if (worth == TARGET_ENTERED) {
        closing_mmps <<= 1;
    }
    look_up(dist_mm, closing_mmps);
    if (worth == TARGET_ENTERED && law_answer.brake_pct > LAW_TUNED_FIRST_PCT) {
        law_answer.brake_pct = LAW_TUNED_FIRST_PCT;
    }
}

void law_step(uint8_t worth, uint16_t dist_mm)
{
    if (worth != TARGET_TRACKED) {
        ease_restart();
    }
    if (worth >= TARGET_NEW) {
        look_up(dist_mm, CLOSING_LAW.closing_mmps);
        law_answer.brake_pct = ease_pct(law_answer.brake_pct, dist_mm);
        return;
    }
    law_answer.brake_pct = 0;
    look_at_first_sight(worth, dist_mm);
}

uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    return cell_pct(cell_row(dist_mm), cell_col(speed->closing_mmps, speed->opening_mmps));
}
