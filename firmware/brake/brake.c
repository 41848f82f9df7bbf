/* SPDX-License-Identifier: MIT */
/* The brake's decision. */
#include "brake.h"
#include "closing.h"
#include "fixed.h"
#include "law.h"
#include "range.h"

struct brake_output brake;

static uint8_t demand_pct; /* what the brake does but for STOP and override */
static __bit has_target;   /* the last good reading was an echo within the law's reach */
static __bit is_clear;     /* the last reading was a good "no target" */
static __bit is_fault;
static uint8_t silence_cs; /* since the last good reading */
static uint8_t override_cs;
static __bit is_latched; /* STOP */
static __bit is_sure;    /* of it: a second reading or a tracked approach said the same */
static uint16_t raw_mm;  /* the last echo, believed or not */
static __bit is_tracked; /* and its third reading or a later one of this target */
static __bit is_stuck;
static __bit
    is_moving; /* the target cannot have come to rest: the same reading again is a stuck one */
static __bit is_unfinished; /* brake_finish is due */
static __bit is_prompt;     /* this measurement, LAW_ENTER_CS or less after the one before */

/* Less often used: the RAM that instructions address is nearly full. */
static __idata uint8_t good_readings; /* in a row, while in FAULT */
static __idata uint8_t doubts;        /* readings against STOP */
static __idata uint8_t opening_readings;
static __idata uint8_t lost_readings; /* so many more "no target" are a missing echo */
static __idata uint8_t calm_readings;

/* What the pins do, from what was decided. */
static void settle(void)
{
    brake.stop = false;
    brake.brake_pct = demand_pct;
    brake.state = BRAKE_RELEASED;
    if (has_target) {
        brake.state = BRAKE_CONTROL;
    }
    if (brake.overridden) {
        is_latched = false;
        brake.brake_pct = 0;
        brake.state = BRAKE_RELEASED;
    } else if (is_latched) {
        brake.stop = true;
        brake.brake_pct = 100;
        brake.state = BRAKE_STOP;
    }
    if (is_fault) {
        brake.state = BRAKE_FAULT;
    }
}

/* The brake never falls for want of a reading. */
static void enter_fault(void)
{
    is_fault = true;
    is_moving = false;
    good_readings = 0;
    closing_restart();
#if FAULT_PCT > 0
    if (demand_pct < FAULT_PCT) {
        demand_pct = FAULT_PCT;
    }
#else
    demand_pct = 0;
#endif
}

void brake_init(uint8_t fault)
{
    closing_restart();
    demand_pct = 0;
    has_target = false;
    is_clear = false;
    is_fault = false;
    silence_cs = 0;
    override_cs = 0;
    brake.overridden = false;
    is_latched = false;
    lost_readings = 0;
    raw_mm = 0;
    is_stuck = false;
    is_moving = false;
    is_unfinished = false;
    brake.warn = false;
    brake.row = 0;
    brake.col = 0;
    brake.fault = fault;
    if (fault != BRAKE_FAULT_NONE) {
        enter_fault();
    }
    settle();
}

void brake_fail(uint8_t fault)
{
    if (brake.fault < BRAKE_FAULT_TABLE) {
        brake.fault = fault;
        enter_fault();
        settle();
    }
}

#ifndef __SDCC_mcs51
extern inline bool brake_must_stop(uint16_t dist_mm);
#endif

/* STOP comes with the first reading and stays, unless that reading stood alone: a glitch. */
static void hold_stop(void)
{
    is_sure = is_latched || is_tracked;
    is_latched = true;
    doubts = 0;
    opening_readings = 0;
}

static void doubt_stop(void)
{
    if (raw_mm <= BRAKE_RELEASE_MM) {
        is_sure = true;
    } else if (is_tracked || ++doubts == 2) {
        is_latched = false;
    }
}

/* What an echo is worth: BRAKE_FAULT_NONE, or why it is not believed. */
static inline uint8_t judge_echo(uint16_t dist_mm)
{
    uint8_t trouble;

    is_tracked = false;
    if (dist_mm != raw_mm) {
        is_stuck = false;
        raw_mm = dist_mm;
    } else if (is_moving) {
        is_stuck = true; /* as long as the reading stays */
    }
    if (is_stuck) {
        trouble = BRAKE_FAULT_STUCK;
    } else if (!closing_update(raw_mm)) {
        trouble = BRAKE_FAULT_JUMP;
    } else {
        if (closing_samples == 3) {
            is_tracked = true;
            BRAKE_TAKE_FIRST();
        }
        trouble = BRAKE_FAULT_NONE;
    }
    if (raw_mm <= BRAKE_STOP_MM) {
        hold_stop();
    } else if (is_latched && !is_sure) {
        doubt_stop();
    }
    return trouble;
}

static void unlatch(void)
{
    if (raw_mm > BRAKE_RELEASE_MM && closing_smooth.opening_mmps > BRAKE_RELEASE_MMPS &&
        closing_samples == 3) {
        if (++opening_readings == 2) {
            is_latched = false;
        }
    } else {
        opening_readings = 0;
    }
}

/* How many "no target" it takes to believe that this target is gone. Fewer readings of it change
 * nothing: after a silence they may be those of a target that was there before. */
static void note_target(void)
{
    if (!has_target) {
        lost_readings = 0;
    } else if (closing_samples == 3) {
        lost_readings = raw_mm > BRAKE_NEAR_MM ? 1 : BRAKE_LOST_READINGS;
    } else if (closing_samples == 2 && lost_readings == 0) {
        lost_readings = 1;
    }
}

static void warn(uint16_t dist_mm)
{
    uint16_t closing_mmps = closing_smooth.closing_mmps;

    if (closing_mmps >= BRAKE_WARN_MMPS) {
        /* After one second; what is 0 by then is no further off than 0 m. */
        uint16_t ahead_mm = dist_mm > closing_mmps ? dist_mm - closing_mmps : 0;

        if (ahead_mm <= BRAKE_STOP_MM ||
            (ahead_mm <= LAW_FAR_MM && law_pct(ahead_mm, &closing_smooth) >= BRAKE_WARN_PCT)) {
            brake.warn = true;
            calm_readings = 0;
            return;
        }
    }
    if (++calm_readings >= BRAKE_CALM_READINGS) {
        brake.warn = false;
        calm_readings = BRAKE_CALM_READINGS;
    }
}

static uint8_t judge_no_echo(uint8_t kind)
{
    is_stuck = false;
    raw_mm = 0;
    if (kind != RANGE_NO_TARGET) {
        return (uint8_t)(kind - RANGE_NOT_RISEN + BRAKE_FAULT_NOT_RISEN);
    }
    if (lost_readings != 0) {
        lost_readings--;
        if (!is_sure && ++doubts == 2) {
            is_latched = false;
        }
        return BRAKE_FAULT_LOST;
    }
    if (!is_sure) {
        is_latched = false;
    }
    if (closing_samples != 1) { /* a lone reading waits for its second one, past a missing echo */
        closing_restart();
    }
    return BRAKE_FAULT_NONE;
}

/* A speed's magnitudes are added: one of them is 0. */
static bool may_not_rest(void)
{
    return (uint16_t)(closing_smooth.closing_mmps + closing_smooth.opening_mmps) >=
               BRAKE_STUCK_MMPS &&
           (uint16_t)(closing_difference.closing_mmps + closing_difference.opening_mmps) >=
               mul_u8(closing_span_cs, BRAKE_STUCK_MMPS_PER_CS);
}

void brake_expect(uint8_t elapsed_cs)
{
    is_prompt = elapsed_cs <= LAW_ENTER_CS;
    is_moving = may_not_rest();
    closing_expect(elapsed_cs);
}

void brake_step(uint8_t kind, uint16_t dist_mm)
{
    __bit is_echo = kind == RANGE_ECHO, had_target = has_target, was_clear = is_clear;
    uint8_t trouble = is_echo ? judge_echo(dist_mm) : judge_no_echo(kind);
    uint8_t target, wanted_pct;

    is_clear = false;
    if (trouble != BRAKE_FAULT_NONE) {
        good_readings = 0;
        if (brake.fault < BRAKE_FAULT_TABLE) {
            brake.fault = trouble;
        }
        settle();
        return;
    }

    silence_cs = 0;
    is_unfinished = true;
    has_target = false;
    wanted_pct = 0;
    if (!is_echo) {
        is_clear = true;
    } else if (raw_mm <= LAW_FAR_MM || (had_target && raw_mm <= LAW_FAR_MM + BRAKE_SLACK_FAR_MM)) {
        has_target = true;
        target = LAW_TRACKED;
        if (!had_target) {
            target = LAW_NEW;
            if (closing_samples == 1) {
                target = was_clear && is_prompt ? LAW_ENTERED : LAW_GLIMPSE;
            }
        }
        if (brake.fault <
            BRAKE_FAULT_TABLE) { /* else the table, or what holds it, cannot be trusted */
            wanted_pct = law_step(target, raw_mm);
        }
    }
    if (is_fault && (brake.fault >= BRAKE_FAULT_TABLE || ++good_readings < BRAKE_GOOD_READINGS)) {
        if (demand_pct < wanted_pct) {
            demand_pct = wanted_pct;
        }
    } else {
        is_fault = false;
        brake.fault = BRAKE_FAULT_NONE;
        demand_pct = wanted_pct;
    }
    settle();
}

void brake_finish(void)
{
    if (!is_unfinished) {
        return;
    }
    is_unfinished = false;
    if (raw_mm != 0) {
        if (closing_samples == 3) {
            BRAKE_TAKE_LATER();
        }
        unlatch();
        note_target();
    }
    if (brake.fault < BRAKE_FAULT_TABLE) {
        warn(raw_mm != 0 ? raw_mm : 65535U);
    }
    settle();
}

void brake_tick(bool override_held)
{
    if (!override_held) {
        override_cs = 0;
        brake.overridden = false;
    } else if (!brake.overridden && ++override_cs == BRAKE_OVERRIDE_CS) {
        brake.overridden = true;
    }
    if (silence_cs < BRAKE_SILENCE_CS) {
        silence_cs++;
    } else if (!is_fault) {
        enter_fault();
    }
    settle();
}
