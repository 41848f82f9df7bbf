/* SPDX-License-Identifier: MIT */
/* The target and the one echo aside. */
#include "target.h"
#include "fixed.h"

uint8_t target_worth;

/* Whether two places so far apart in time tell a speed. */
#if RANGE_IS_FAST
#define TELLS_SPEED(time_cs) ((time_cs) >= RANGE_SPAN_MIN_CS && (time_cs) != LONG_AGO_CS)
#else
#define TELLS_SPEED(time_cs) ((time_cs) != LONG_AGO_CS)
#endif

/* Too long for the place of a target to say where it is now. */
#define LONG_AGO_CS (TARGET_SILENCE_MAX_CS + 1U)

static uint8_t since_cs;       /* the target's last reading */
static uint8_t since_aside_cs; /* the echo aside; LONG_AGO_CS: there is none */
static uint16_t aside_mm;

static __bit was_clear; /* the reading before this one */
static __bit is_clear;  /* this one */
static __bit is_moving; /* the target cannot have come to rest */
static __bit was_near;  /* the target, when it was tracked last */

static uint8_t stuck_readings; /* so many more are stuck at most; 0: none is */
static uint8_t clears;         /* since the target was seen */

static uint16_t echo_mm; /* this reading */

#if RANGE_IS_FAST
/* Since the target's reading differed from the one before: 0 if it may have come to rest, else its
 * speed then, 256 mm/s; and how far it should have come at that speed, 2.56 mm, up to 255. */
static __idata uint8_t run_speed, run_way;
static __bit has_changed; /* the last reading differed; run_speed is yet to be taken */
#endif

/* What tells a stuck reading, for the contracts here and in brake.c. */
#if RANGE_IS_FAST
#define TARGET_STUCK_STATE stuck_readings, run_speed, run_way, has_changed
#else
#define TARGET_STUCK_STATE stuck_readings
#endif

/* Holds from target_init on. */
/*@ predicate target_is_valid =
        target_worth <= TARGET_TRACKED && since_cs <= LONG_AGO_CS &&
        since_aside_cs <= LONG_AGO_CS && stuck_readings <= TARGET_REST_READINGS &&
        clears < TARGET_NEAR_CLEARS && closing_is_valid; */
/* Whatever comes next is another target. */
/*@ assigns target_worth, TARGET_STUCK_STATE, closing_smooth, closing_difference, smooth_2mmps;
    ensures target_worth == TARGET_NONE && stuck_readings == 0 && closing_is_valid; */
static void drop(void)
{
    target_worth = TARGET_NONE;
    stuck_readings = 0;
#if RANGE_IS_FAST
    has_changed = true;
#endif
    closing_restart();
}

/*@ assigns aside_mm, since_aside_cs;
    ensures aside_mm == closing_place_mm && since_aside_cs == since_cs; */
static void set_target_aside(void)
{
    aside_mm = closing_place_mm;
    since_aside_cs = since_cs;
}

/*@ assigns since_cs, since_aside_cs, aside_mm, is_clear, is_moving, was_near, TARGET_STUCK_STATE,
            clears, smooth_2mmps;
    ensures target_is_valid; */
void target_init(void)
{
    closing_place_mm = 0;
    since_cs = LONG_AGO_CS;
    set_target_aside();
    drop();
    is_clear = false;
    is_moving = false;
    was_near = false;
    clears = 0;
}

/*@ requires time_cs <= LONG_AGO_CS && elapsed_cs <= LONG_AGO_CS;
    assigns \nothing;
    ensures \result == \min(time_cs + elapsed_cs, LONG_AGO_CS); */
static uint8_t later_cs(uint8_t time_cs, uint8_t elapsed_cs)
{
    time_cs += elapsed_cs;
    return time_cs > LONG_AGO_CS ? LONG_AGO_CS : time_cs;
}

/* A speed in units of 256 mm/s; of its magnitudes one is 0. */
#define HIGH(speed)                                                                                \
    ((uint8_t)((uint8_t)(speed.closing_mmps >> 8) | (uint8_t)(speed.opening_mmps >> 8)))

/*@ assigns \nothing; */
static bool may_not_rest(void)
{
    uint8_t least = (uint8_t)(closing_span_cs >> 2) + TARGET_STUCK;
    uint8_t speed = HIGH(closing_difference);

    if (speed < least || (speed >= TARGET_STUCK_NEW_MAX && target_worth != TARGET_TRACKED)) {
        return false;
    }
    return HIGH(closing_smooth) >= TARGET_STUCK_SMOOTH;
}

#if RANGE_IS_FAST
/* Whether the target must have left the place of its last reading by now. */
/*@ assigns run_speed, run_way, has_changed; */
static bool has_come_far(uint8_t elapsed_cs)
{
    uint16_t way;

    if (has_changed) {
        has_changed = false;
        run_way = 0;
        run_speed = 0;
        if (may_not_rest()) {
            run_speed = HIGH(closing_smooth);
        }
    }
    way = (uint16_t)(mul_u8(run_speed, elapsed_cs) + run_way);
    run_way = way > 255U ? 255U : (uint8_t)way;
    return run_way >= TARGET_STUCK_WAY;
}
#else
#define has_come_far(elapsed_cs) may_not_rest()
#endif

/*@ requires target_is_valid;
    assigns since_cs, since_aside_cs, was_clear, is_clear, is_moving, TARGET_STUCK_STATE,
            CLOSING_EXPECTED, smooth_2mmps;
    ensures target_is_valid; */
void target_expect(uint8_t elapsed_cs)
{
    if (elapsed_cs < RANGE_ELAPSED_MIN_CS) {
        elapsed_cs = RANGE_ELAPSED_MIN_CS;
    }
    if (elapsed_cs > LONG_AGO_CS) {
        elapsed_cs = LONG_AGO_CS;
    }
    since_cs = later_cs(since_cs, elapsed_cs);
    since_aside_cs = later_cs(since_aside_cs, elapsed_cs);
    was_clear = is_clear;
    is_clear = false;
    is_moving = false;
    if (stuck_readings != 0) {
        stuck_readings--;
        /* unreached: the second part holds only after a bit of RAM has turned over */
        if (stuck_readings == 0 || stuck_readings >= TARGET_REST_READINGS) {
            drop();
        }
    } else if (target_worth != TARGET_NONE) {
        if (since_cs == LONG_AGO_CS) {
            drop();
        } else if (target_worth >= TARGET_NEW) {
            is_moving = has_come_far(elapsed_cs);
            closing_expect(since_cs);
        }
    }
}

/* Whether wheels can bring a target from that place to the echo in 0..LONG_AGO_CS. */
/*@ requires time_cs <= LONG_AGO_CS;
    assigns \nothing; */
static bool can_reach(uint16_t place_mm, uint8_t time_cs)
{
    uint16_t nearer_mm = (uint16_t)(mul_u8(time_cs, TARGET_NEARER_MM_PER_CS / 2U) << 1);

    return (uint16_t)(echo_mm - place_mm + nearer_mm) <=
           (uint16_t)(nearer_mm + mul_u8(time_cs, TARGET_AWAY_MM_PER_CS));
}

/* What the echo makes of the target; TARGET_NONE: it is neither the target's nor another one's. */
/*@ requires target_is_valid;
    assigns closing_place_mm, since_cs;
    ensures target_is_valid;
    ensures target_is_worth(\result);
    ensures \result == TARGET_TRACKED ==> target_worth >= TARGET_NEW;
    ensures \result == TARGET_GLIMPSE || \result == TARGET_ENTERED ==>
                target_worth == TARGET_NONE;
    ensures RANGE_IS_FAST == 1 && TARGET_NEW <= \result <= TARGET_NEW_LATE &&
                since_cs < RANGE_SPAN_MIN_CS ==> target_worth != TARGET_NONE; */
static uint8_t judge(void)
{
    uint16_t gate_mm = (uint16_t)(mul_u8(since_cs, TARGET_GATE_MM_PER_CS) + TARGET_GATE_MM);
    uint16_t off_mm = (uint16_t)(echo_mm - closing_foreseen_mm + gate_mm);
    __bit is_nearer = (uint8_t)(off_mm >> 8) >= 0x80U;

    gate_mm = (uint16_t)(gate_mm << 1);
    if (target_worth >= TARGET_NEW && off_mm <= gate_mm) {
        return TARGET_TRACKED;
    }
    if (TELLS_SPEED(since_aside_cs) && can_reach(aside_mm, since_aside_cs)) {
        off_mm = (uint16_t)(echo_mm - aside_mm + TARGET_LIKELY_MM);
        if (target_worth == TARGET_NONE || target_worth >= TARGET_NEW ||
            off_mm <= 2U * TARGET_LIKELY_MM) {
            closing_place_mm = aside_mm;
            since_cs = since_aside_cs;
            return TARGET_NEW;
        }
    }
    if (target_worth == TARGET_NONE) {
        return was_clear ? TARGET_ENTERED : TARGET_GLIMPSE;
    }
    if (target_worth < TARGET_NEW) {
        off_mm = closing_place_mm + TARGET_BEHIND_MM;
        if (off_mm < echo_mm && (was_clear || target_worth == TARGET_ENTERED)) {
            return TARGET_ENTERED_LATE;
        }
    } else if (target_worth == TARGET_TRACKED || !is_nearer) {
        return TARGET_NONE;
    }
    if (!can_reach(closing_place_mm, since_cs)) {
        return TARGET_NONE;
    }
    return was_clear && target_worth == TARGET_ENTERED ? TARGET_NEW_LATE : TARGET_NEW;
}

/* A reading that stays the same though the target moves is stuck; a stuck target that moves on is
 * another one. An echo that lasts as long again may differ by one count of the timer, which is up
 * to 1 mm. */
/*@ requires target_is_valid;
    assigns TARGET_STUCK_STATE, target_worth;
    ensures target_is_valid;
    ensures target_worth == \old(target_worth) || target_worth == TARGET_NONE;
    ensures stuck_readings != 0 ==> (uint16_t)(echo_mm - closing_place_mm + 1) <= 2; */
static void watch_stuck(void)
{
    if ((uint16_t)(echo_mm - closing_place_mm + 1U) > 2U) {
        if (stuck_readings != 0) {
            stuck_readings = 0;
            target_worth = TARGET_NONE;
        }
#if RANGE_IS_FAST
        has_changed = true;
#endif
    } else if (is_moving) {
        stuck_readings = TARGET_REST_READINGS;
    }
}

/*@ requires target_is_valid;
    assigns echo_mm, since_cs, since_aside_cs, aside_mm, TARGET_STUCK_STATE, was_near, clears,
            CLOSING_TAKEN;
    ensures target_is_valid;
    ensures \result == BRAKE_FAULT_NONE ==>
                (closing_place_mm == dist_mm && since_cs == 0) ||
                (RANGE_IS_FAST == 1 && since_cs < RANGE_SPAN_MIN_CS &&
                 target_worth == \old(target_worth)); */
uint8_t target_echo(uint16_t dist_mm)
{
    uint8_t worth;

    echo_mm = dist_mm;
    watch_stuck();
    if (stuck_readings != 0) {
        return BRAKE_FAULT_STUCK;
    }
    worth = judge();
    if (worth == TARGET_NONE) {
#if RANGE_IS_FAST
        if (since_aside_cs < RANGE_SPAN_MIN_CS && can_reach(aside_mm, since_aside_cs)) {
            return BRAKE_FAULT_JUMP;
        }
#endif
        aside_mm = echo_mm;
        since_aside_cs = 0;
        return BRAKE_FAULT_JUMP;
    }
    since_aside_cs = LONG_AGO_CS;
#if RANGE_IS_FAST
    if ((worth == TARGET_NEW || worth == TARGET_NEW_LATE) && since_cs < RANGE_SPAN_MIN_CS) {
        return BRAKE_FAULT_NONE;
    }
#endif
    target_worth = worth;
    if (worth == TARGET_TRACKED) {
        closing_take(echo_mm, since_cs);
        CLOSING_TAKE_FIRST();
        was_near = false;
    } else if (worth >= TARGET_NEW) {
        closing_take_second(echo_mm, since_cs);
    } else {
        closing_restart();
    }
    closing_place_mm = echo_mm;
    since_cs = 0;
    if (!was_near) {
        clears = 0;
    }
    return BRAKE_FAULT_NONE;
}

/*@ requires target_is_valid;
    assigns is_clear, was_near, clears, aside_mm, since_aside_cs, TARGET_STUCK_STATE, smooth_2mmps;
    ensures target_is_valid; */
uint8_t target_clear(void)
{
    uint8_t clears_to_end = TARGET_GLIMPSE_CLEARS;

    is_clear = true;
    if (target_worth >= TARGET_NEW) {
        clears_to_end = TARGET_FAR_CLEARS;
        if (target_worth == TARGET_TRACKED &&
            (int8_t)(closing_foreseen_mm >> 8) < (int8_t)(TARGET_NEAR_MM >> 8)) {
            was_near = true;
        }
    }
    if (was_near) {
        clears_to_end = TARGET_NEAR_CLEARS;
    }
    clears++;
    if (clears < clears_to_end) {
        return was_near ? BRAKE_FAULT_LOST : BRAKE_FAULT_NONE;
    }
    if (target_worth != TARGET_NONE) {
        set_target_aside();
        drop();
    }
    was_near = false;
    clears = 0;
    return BRAKE_FAULT_NONE;
}

uint8_t target_sum(void)
{
    return target_worth ^ since_cs ^ since_aside_cs ^ stuck_readings ^ clears ^ (uint8_t)aside_mm ^
#if RANGE_IS_FAST
           run_speed ^ run_way ^
#endif
           (uint8_t)(aside_mm >> 8);
}
