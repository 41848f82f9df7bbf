/* SPDX-License-Identifier: MIT */
/* The brake's decision. */
#include "brake.h"
#include "law.h"
#include "target.h"
#include "warning.h"

struct brake_output brake;
__data struct range_reading range_reading;

static uint8_t demand_pct; /* what the brake does but for STOP and override */
static __bit is_in_reach;  /* the target, of the law */
static uint8_t override_cs;

/* Of the last reading. What is within BRAKE_STOP_MM is STOP at once; the latch follows in
 * brake_finish. */
static __bit is_believed, is_within;

/* What the pins do, from what was decided. */
static void settle(void)
{
    brake.stop = false;
    brake.brake_pct = demand_pct;
    brake.state = BRAKE_RELEASED;
    if (is_in_reach) {
        brake.state = BRAKE_CONTROL;
    }
    if (brake.overridden) {
        brake.brake_pct = 0;
        brake.state = BRAKE_RELEASED;
    } else if (is_within || latch_state != LATCH_OPEN) {
        brake.stop = true;
        brake.brake_pct = 100;
        brake.state = BRAKE_STOP;
    }
    if (fault_state != FAULT_GOOD) {
        brake.state = BRAKE_FAULT;
    }
}

static void raise(uint8_t least_pct)
{
    if (demand_pct < least_pct) {
        demand_pct = least_pct;
    }
}

/* FAULT begins. The brake never falls for want of a reading. */
static void demand_fault(void)
{
#if FAULT_PCT > 0
    raise(FAULT_PCT);
#else
    demand_pct = 0;
#endif
}

void brake_init(uint8_t fault)
{
    target_init();
    latch_init();
    warning_init();
    law_restart();
    fault_init(fault);
    demand_pct = 0;
    if (fault != BRAKE_FAULT_NONE) {
        demand_fault();
    }
    is_in_reach = false;
    override_cs = 0;
    brake.overridden = false;
    range_reading.kind = RANGE_NO_TARGET;
    is_believed = false;
    is_within = false;
    brake.warn = false;
    settle();
}

void brake_fail(uint8_t fault)
{
    if (fault_fail(fault)) {
        demand_fault();
        settle();
    }
}

#ifndef __SDCC_mcs51
extern inline bool brake_must_stop(uint16_t dist_mm);
#endif

/* In FAULT nothing lowers the demand. */
static void demand(uint8_t wanted_pct)
{
    if (fault_state == FAULT_GOOD) {
        demand_pct = wanted_pct;
    } else {
        raise(wanted_pct);
    }
}

/* No target within the law's reach. */
static void demand_nothing(void)
{
    is_in_reach = false;
    law_restart();
    demand(0);
}

/* The believed echo of a target. With a lasting fault the table, or what holds it, cannot be
 * trusted. */
static void demand_for_target(void)
{
    uint16_t far_mm = LAW_FAR_MM;

    if (is_in_reach) {
        far_mm = LAW_FAR_MM + BRAKE_SLACK_FAR_MM;
    }
    if (range_reading.dist_mm > far_mm) {
        demand_nothing();
        return;
    }
    is_in_reach = true;
    if (fault_state != FAULT_LASTING) {
        law_step(target_worth, range_reading.dist_mm);
        demand(law_answer.brake_pct);
    }
}

static uint8_t find_trouble(void)
{
    if (range_reading.kind == RANGE_ECHO) {
        return target_echo(range_reading.dist_mm);
    }
    if (range_reading.kind == RANGE_NO_TARGET) {
        return target_clear();
    }
    return (uint8_t)(range_reading.kind - RANGE_NOT_RISEN + BRAKE_FAULT_NOT_RISEN);
}

void brake_expect(uint8_t elapsed_cs)
{
    target_expect(elapsed_cs);
}

void brake_step(uint8_t kind, uint16_t dist_mm)
{
    uint8_t trouble;

    range_reading.kind = kind;
    range_reading.dist_mm = dist_mm;
    trouble = find_trouble();
    is_believed = trouble == BRAKE_FAULT_NONE;
    fault_take(trouble);
    is_within = false;
    if (range_reading.kind == RANGE_ECHO) {
        if (range_reading.dist_mm <= BRAKE_STOP_MM) {
            is_within = true;
        }
        if (is_believed) {
            demand_for_target();
        }
    } else if (target_worth == TARGET_NONE) {
        if (is_believed) {
            demand_nothing();
        }
    } else if (is_in_reach && fault_state != FAULT_LASTING &&
               (uint8_t)(CLOSING_LAW.closing_mmps >> 8) >= BRAKE_APPROACH_MMPS / 256U) {
        /* An echo is missing, and the target has come nearer since the last one. Foreseen below
         * 0 mm, modulo 2^16, it is at the table's far end, where the law says least. */
        raise(law_pct(closing_foreseen_mm, &CLOSING_LAW));
    }
    settle();
}

/* Whether the driver should act now: see warning.h. */
static bool is_urgent(void)
{
    uint16_t ahead_mm = range_reading.dist_mm;

    if (closing_smooth.closing_mmps < WARNING_MMPS) {
        return false;
    }
    if (ahead_mm < closing_smooth.closing_mmps) { /* it is no nearer than 0 m after a second */
        return true;
    }
    ahead_mm -= closing_smooth.closing_mmps;
    if (ahead_mm <= BRAKE_STOP_MM) {
        return true;
    }
    if (ahead_mm > LAW_FAR_MM) {
        return false;
    }
    return law_pct(ahead_mm, &closing_smooth) >= WARNING_PCT;
}

void brake_finish(void)
{
    bool has_reason = false;

    if (is_believed && range_reading.kind == RANGE_ECHO) {
        if (target_worth == TARGET_TRACKED) {
            CLOSING_TAKE_LATER();
        }
        if (fault_state != FAULT_LASTING) {
            has_reason = is_urgent();
        }
    }
    if (!brake.overridden) {
        latch_take(is_believed);
    }
    brake.warn = warning_take(has_reason);
    settle();
}

void brake_tick(bool override_held)
{
    if (!override_held) {
        override_cs = 0;
    } else if (override_cs < BRAKE_OVERRIDE_CS) {
        override_cs++;
    }
    brake.overridden = override_cs >= BRAKE_OVERRIDE_CS;
    if (brake.overridden) {
        latch_override();
    }
    if (fault_tick()) {
        demand_fault();
    }
    settle();
}
