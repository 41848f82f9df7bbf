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
static uint16_t override_cs;

/* Of the last reading. What is within BRAKE_STOP_MM is STOP at once; in brake_finish the latch
 * takes over. */
static __bit is_believed, is_within;

/* Holds from brake_init on. */
/*@ predicate brake_is_valid =
        demand_pct <= 100 && (fault_state != FAULT_GOOD ==> demand_pct >= FAULT_PCT) &&
        override_cs <= BRAKE_OVERRIDE_END_CS &&
        (brake.overridden ==> override_cs >= BRAKE_OVERRIDE_CS) &&
        fault_is_valid && latch_is_valid && target_is_valid;
    predicate brake_is_settled =
        (brake.stop <==> !brake.overridden && (is_within || latch_is_stop)) &&
        brake.brake_pct == (brake.overridden ? 0 : brake.stop ? 100 : demand_pct) &&
        brake.state <= BRAKE_FAULT &&
        (brake.state == BRAKE_FAULT <==> fault_state != FAULT_GOOD); */
/* What the pins do, from what was decided. */
/*@ assigns brake.brake_pct, brake.stop, brake.state;
    ensures brake_is_settled; */
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
    } else if (is_within || LATCH_IS_STOP()) {
        brake.stop = true;
        brake.brake_pct = 100;
        brake.state = BRAKE_STOP;
    }
    if (fault_state != FAULT_GOOD) {
        brake.state = BRAKE_FAULT;
    }
}

/*@ assigns demand_pct;
    ensures demand_pct == \max(\old(demand_pct), least_pct); */
static void raise(uint8_t least_pct)
{
    if (demand_pct < least_pct) {
        demand_pct = least_pct;
    }
}

/* FAULT begins. The brake never falls for want of a reading. */
/*@ assigns demand_pct;
    ensures demand_pct == (FAULT_PCT == 0 ? 0 : \max(\old(demand_pct), FAULT_PCT)); */
static void demand_fault(void)
{
#if FAULT_PCT > 0
    raise(FAULT_PCT);
#else
    demand_pct = 0;
#endif
}

/* What a beginning sets, for contracts. */
#define BEGINNING                                                                                  \
    brake, range_reading.kind, demand_pct, is_in_reach, override_cs, is_believed, is_within,       \
        fault_state, fault_code, silence_cs, good_readings, latch_state, latch_twin, LATCH_COUNTS, \
        left_readings, target_worth, closing_place_mm, closing_difference, closing_smooth,         \
        since_cs, since_aside_cs, aside_mm, is_clear, is_moving, was_near, TARGET_STUCK_STATE,     \
        clears, smooth_2mmps

/*@ assigns BEGINNING;
    ensures brake_is_valid && brake_is_settled && !is_within;
    ensures silence_cs == 0 && good_readings == 0 && clear_readings == 0 && override_cs == 0; */
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

/*@ requires brake_is_valid && brake_is_settled;
    assigns brake.brake_pct, brake.stop, brake.state, demand_pct, fault_state, fault_code,
            latch_state, latch_twin;
    ensures brake_is_valid && brake_is_settled;
    ensures latch_state == (fault == BRAKE_FAULT_OUTPUT && FAULT_PCT > 0 ? LATCH_HELD
                                                                     : \old(latch_state));
    ensures t2_holds: FAULT_PCT > 0 ==> brake.brake_pct >= \old(brake.brake_pct); */
void brake_fail(uint8_t fault)
{
    if (fault_fail(fault)) {
        demand_fault();
    }
#if FAULT_PCT > 0
    if (fault == BRAKE_FAULT_OUTPUT) {
        latch_hold();
    }
#endif
    settle();
}

uint8_t brake_sum(void)
{
    return brake.brake_pct ^ brake.stop ^ brake.warn ^ brake.state ^ brake.overridden ^ demand_pct ^
           (uint8_t)override_cs ^ (uint8_t)(override_cs >> 8) ^ latch_sum() ^ fault_sum() ^
           target_sum() ^ closing_sum();
}

/*@ assigns BEGINNING;
    ensures brake_is_valid && brake_is_settled && !is_within;
    ensures silence_cs == 0 && good_readings == 0 && clear_readings == 0 && override_cs == 0; */
void brake_begin_anew(void)
{
    bool is_lasting = fault_state == FAULT_LASTING;
#if FAULT_PCT > 0
    uint8_t pct = demand_pct;
#endif
    uint8_t votes = 0; /* for STOP: one of them may be what has changed */

    if (brake.stop) {
        votes++;
    }
    if (latch_state != LATCH_OPEN) {
        votes++;
    }
    if (latch_twin != 0xFFU - LATCH_OPEN) {
        votes++;
    }
    brake_init(BRAKE_FAULT_WATCHDOG);
    fault_code = BRAKE_FAULT_STATE;
    if (is_lasting) {
        fault_state = FAULT_LASTING;
    }
#if FAULT_PCT > 0
    if (pct <= 100) { /* unreached: more, which only a bit that turns over makes of it */
        raise(pct);
    }
#endif
    if (votes >= 2) {
        latch_hold();
    }
    settle();
}

#ifndef __SDCC_mcs51
extern inline bool brake_must_stop(uint16_t dist_mm);
#endif

#ifdef BRAKE_RISE_PCT
/* What the law wants, no faster than brake.h says. */
/*@ requires wanted_pct <= 100 && demand_pct <= 100;
    assigns \nothing;
    ensures \result == \min(wanted_pct, \max(BRAKE_SUDDEN_PCT, demand_pct + BRAKE_RISE_PCT)); */
static uint8_t rising(uint8_t wanted_pct)
{
    uint8_t most_pct = (uint8_t)(demand_pct + BRAKE_RISE_PCT);

    if (most_pct < BRAKE_SUDDEN_PCT) {
        most_pct = BRAKE_SUDDEN_PCT;
    }
    return wanted_pct > most_pct ? most_pct : wanted_pct;
}
#else
#define rising(wanted_pct) (wanted_pct)
#endif

/* In FAULT nothing lowers the demand. */
/*@ requires wanted_pct <= 100;
    assigns demand_pct;
    ensures demand_pct == (fault_state == FAULT_GOOD ? wanted_pct
                                                     : \max(\old(demand_pct), wanted_pct)); */
static void demand(uint8_t wanted_pct)
{
    if (fault_state == FAULT_GOOD) {
        demand_pct = wanted_pct;
    } else {
        raise(wanted_pct);
    }
}

/* No target within the law's reach. */
/*@ assigns is_in_reach, demand_pct;
    ensures demand_pct == (fault_state == FAULT_GOOD ? 0 : \old(demand_pct)); */
static void demand_nothing(void)
{
    is_in_reach = false;
    law_restart();
    demand(0);
}

/* The believed echo of a target. With a lasting fault the table, or what holds it, cannot be
 * trusted. */
/*@ requires target_worth != TARGET_NONE && target_is_valid && demand_pct <= 100;
    assigns is_in_reach, demand_pct, law_answer;
    ensures demand_pct <= 100;
    ensures fault_state != FAULT_GOOD ==> demand_pct >= \old(demand_pct); */
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
        demand(rising(law_answer.brake_pct));
    }
}

/*@ requires target_is_valid && range_reading.kind <= RANGE_DEAD_ZONE;
    assigns target_worth, closing_place_mm, closing_span_cs, closing_difference, closing_smooth,
            echo_mm, since_cs, since_aside_cs, aside_mm, TARGET_STUCK_STATE, was_near, is_clear,
            clears, CLOSING_TAKEN;
    ensures target_is_valid;
    ensures \result < BRAKE_FAULT_WATCHDOG;
    ensures range_reading.kind > RANGE_NO_TARGET ==> \result != BRAKE_FAULT_NONE;
    ensures range_reading.kind == RANGE_ECHO && \result == BRAKE_FAULT_NONE ==>
                target_worth != TARGET_NONE; */
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

/*@ requires brake_is_valid;
    assigns target_worth, CLOSING_EXPECTED, closing_difference, closing_smooth, since_cs,
            since_aside_cs, was_clear, is_clear, is_moving, TARGET_STUCK_STATE, smooth_2mmps;
    ensures brake_is_valid; */
void brake_expect(uint8_t elapsed_cs)
{
    target_expect(elapsed_cs);
}

/*@ requires brake_is_valid && brake_is_settled && !is_within;
    assigns brake.brake_pct, brake.stop, brake.state, range_reading, law_answer, demand_pct,
            is_in_reach, is_believed, is_within,
            fault_state, fault_code, silence_cs, good_readings,
            target_worth, closing_place_mm, closing_span_cs, closing_difference, closing_smooth,
            echo_mm, since_cs, since_aside_cs, aside_mm, TARGET_STUCK_STATE, was_near, is_clear,
            clears, CLOSING_TAKEN;
    ensures brake_is_valid && brake_is_settled;
    ensures kind > RANGE_NO_TARGET ==> !is_believed;
    ensures is_within <==> kind == RANGE_ECHO && dist_mm <= BRAKE_STOP_MM;
    ensures silence_cs == (is_believed ? 0 : \old(silence_cs));
    ensures \old(fault_state) == FAULT_ON && fault_state == FAULT_ON ==>
                good_readings == (is_believed ? \old(good_readings) + 1 : 0);
    ensures t2_holds: !is_believed || (kind == RANGE_NO_TARGET && target_worth != TARGET_NONE) ==>
                brake.brake_pct >= \old(brake.brake_pct) && demand_pct >= \old(demand_pct);
    ensures t6_leaves: fault_state == \old(fault_state) ||
                (\old(fault_state) == FAULT_ON && fault_state == FAULT_GOOD && is_believed &&
                 \old(good_readings) == FAULT_GOOD_READINGS - 1);
    ensures t7_no_dead_state: \old(fault_state) == FAULT_ON && is_believed &&
                \old(good_readings) == FAULT_GOOD_READINGS - 1 ==> fault_state == FAULT_GOOD; */
void brake_step(uint8_t kind, uint16_t dist_mm)
{
    uint8_t trouble;

    range_reading.kind = kind;
    range_reading.dist_mm = dist_mm;
    trouble = find_trouble();
    is_believed = trouble == BRAKE_FAULT_NONE;
    fault_take(trouble);
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
        raise(rising(law_pct(closing_foreseen_mm, &CLOSING_LAW)));
    }
    settle();
}

/* Whether the driver should act now: see warning.h. */
/*@ requires closing_is_valid;
    assigns \nothing; */
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

/*@ requires brake_is_valid && brake_is_settled;
    assigns brake.brake_pct, brake.stop, brake.state, brake.warn, is_within, latch_state, latch_twin,
            LATCH_COUNTS, left_readings,
            closing_smooth, closing_difference, CLOSING_FINISHED;
    ensures brake_is_valid && brake_is_settled && !is_within;
    ensures !brake.overridden ==> latch_moves{Pre, Post}(is_believed);
    ensures brake.overridden ==> latch_state == \old(latch_state) &&
                clear_readings == \old(clear_readings); */
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
    is_within = false;
    brake.warn = warning_take(has_reason);
    settle();
}

/*@ requires brake_is_valid && brake_is_settled && !is_within;
    assigns brake.brake_pct, brake.stop, brake.state, brake.overridden, demand_pct, override_cs,
            latch_state, latch_twin, fault_state, silence_cs, good_readings;
    ensures brake_is_valid && brake_is_settled;
    ensures override_cs == (override_held ? \min(\old(override_cs) + 1, BRAKE_OVERRIDE_END_CS) : 0);
    ensures t8_override: brake.overridden <==> override_held && override_cs >= BRAKE_OVERRIDE_CS &&
                \old(override_cs) < BRAKE_OVERRIDE_END_CS;
    ensures latch_state == (brake.overridden ? LATCH_OPEN : \old(latch_state));
    ensures FAULT_PCT > 0 ==> demand_pct >= \old(demand_pct);
    ensures silence_cs == \min(\old(silence_cs) + 1, FAULT_SILENCE_CS);
    ensures t3_silence: \old(silence_cs) == FAULT_SILENCE_CS ==> fault_state != FAULT_GOOD;
    ensures fault_state == \old(fault_state) ? good_readings == \old(good_readings)
                : \old(fault_state) == FAULT_GOOD && fault_state == FAULT_ON && good_readings == 0; */
void brake_tick(bool override_held)
{
    brake.overridden = false;
    if (!override_held) {
        override_cs = 0;
    } else if ((uint8_t)(override_cs >> 8) < BRAKE_OVERRIDE_END_CS / 256U) {
        override_cs++;
        if (override_cs >= BRAKE_OVERRIDE_CS) {
            brake.overridden = true;
            latch_override();
        }
    }
#if FAULT_PCT > 0
    fault_tick();
    if (fault_state != FAULT_GOOD) {
        demand_fault(); /* in each tick, so that no bit that turns over ends it */
    }
#else
    if (fault_tick()) {
        demand_fault();
    }
#endif
    settle();
}
