/* SPDX-License-Identifier: MIT */
/* The tuned controller: a table with more gain on the closing speed, braking from the first reading
 * where that reading alone proves a speed, and ease.h for those who do not close. */
#include "law_tuned.h"
#include "cell.h"
#include "ease.h"
#include "law.h"
#include "target.h"

__data struct law_answer law_answer;

/* Holds from the start on: the cell of the last target stays when a new one is not looked up. */
/*@ predicate law_is_valid =
        ease_is_valid && law_answer.row < LUT_IN1_CELLS && law_answer.col < LUT_IN2_CELLS; */

/*@ assigns still_readings, hold_pct;
    ensures ease_is_valid; */
void law_restart(void)
{
    ease_restart();
}

/* The table's cell for a target that closes so fast. */
/*@ assigns law_answer;
    ensures law_answer.row < LUT_IN1_CELLS && law_answer.col < LUT_IN2_CELLS;
    ensures law_answer.brake_pct <= 100; */
static void look_up(uint16_t dist_mm, uint16_t closing_mmps)
{
    law_answer.col = cell_col(closing_mmps, closing_mmps != 0 ? 0 : CLOSING_LAW.opening_mmps);
    law_answer.row = cell_row(dist_mm);
    law_answer.brake_pct = cell_pct(law_answer.row, law_answer.col);
}

/* The least closing speed of a target that entered: the road was clear as far as the table goes, so
 * the target has come at least `way_mm` since. 0: not known. */
/*@ assigns \nothing;
    ensures worth == TARGET_GLIMPSE ==> \result == 0;
    ensures worth == TARGET_ENTERED ==> \result == (way_mm > LAW_TUNED_FIRST_MM ? 0 : 16 * way_mm);
    ensures worth == TARGET_ENTERED_LATE ==>
                \result == (way_mm > LAW_TUNED_LATE_MM ? 0 : 8 * way_mm);
    ensures worth > TARGET_ENTERED_LATE ==>
                \result == (way_mm > LAW_TUNED_LATE_MM ? 0 : 6 * way_mm); */
static uint16_t least_closing_mmps(uint8_t worth, uint16_t way_mm)
{
    if (worth == TARGET_ENTERED) { /* within one reading: 1/16 s */
        return way_mm > LAW_TUNED_FIRST_MM ? 0 : (uint16_t)(way_mm << 4);
    }
    if (worth == TARGET_GLIMPSE || way_mm > LAW_TUNED_LATE_MM) {
        return 0;
    }
    way_mm = (uint16_t)(way_mm << 1);
    if (worth == TARGET_ENTERED_LATE) { /* within two readings: 1/8 s */
        return (uint16_t)(way_mm << 2);
    }
    return (uint16_t)(way_mm + (uint16_t)(way_mm << 1)); /* within two to three: 1/6 s */
}

/* A target whose own two readings do not tell its speed yet. */
/*@ requires worth != TARGET_NONE && target_is_worth(worth) && closing_is_valid && law_is_valid;
    assigns law_answer;
    ensures law_is_valid;
    ensures law_answer.brake_pct <= 100;
    ensures first_is_gentle: worth == TARGET_ENTERED ==>
                law_answer.brake_pct <= LAW_TUNED_FIRST_PCT; */
static void look_at_entered(uint8_t worth, uint16_t dist_mm)
{
    uint16_t closing_mmps = least_closing_mmps(worth, (uint16_t)(LAW_FAR_MM - dist_mm));

    if (closing_mmps < CLOSING_LAW.closing_mmps) {
        closing_mmps = CLOSING_LAW.closing_mmps;
    }
    law_answer.brake_pct = 0;
    if (closing_mmps != 0) {
        look_up(dist_mm, closing_mmps);
        if (worth == TARGET_ENTERED && law_answer.brake_pct > LAW_TUNED_FIRST_PCT) {
            law_answer.brake_pct = LAW_TUNED_FIRST_PCT;
        }
    }
}

/*@ requires law_is_valid;
    assigns still_readings, hold_pct;
    ensures law_is_valid;
    ensures first_is_gentle: worth == TARGET_ENTERED ==>
                law_answer.brake_pct <= LAW_TUNED_FIRST_PCT; */
void law_step(uint8_t worth, uint16_t dist_mm)
{
    if (worth != TARGET_TRACKED) {
        ease_restart();
        if (worth != TARGET_NEW) {
            look_at_entered(worth, dist_mm);
            return;
        }
    }
    look_up(dist_mm, CLOSING_LAW.closing_mmps);
    law_answer.brake_pct = ease_pct(law_answer.brake_pct, dist_mm);
}

uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    return cell_pct(cell_row(dist_mm), cell_col(speed->closing_mmps, speed->opening_mmps));
}
