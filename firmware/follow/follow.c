/* SPDX-License-Identifier: MIT */
/* The follower's decision: from values to cells of the table, and from cells to commands. */
#include "follow.h"
#include "cc51.h"
#include "frame.h"
#include "lut.h"

#define GAP_END_MM     10000U /* the table's end */
#define BRAKE_FULL_PCT 100U

/* The levels 0..4 mean -2..2. The table's commands are -1..1, its changes 0 and 1. The sum of two
 * levels is twice their mean. */
#define LEVEL_ZERO    2
#define LEVEL_ZERO_X2 (2 * LEVEL_ZERO)
#if LUT_LEVELS != 4 || LUT_IN1_CELLS != 5 || LUT_IN2_CELLS != 3 || LUT_IN3_CELLS != 3
#error "follow wants tables/follow.fis in 5x3x3 cells with 4 levels"
#endif

static const int16_t __code gap_mm_at[] = {2000, 4000, 6000, 8000};
static const int16_t __code closing_mmps_at[] = {-1000, 1000};
static const int16_t __code to_change_mm_at[] = {-50, 50};

struct follow follow;

#if FOLLOW_YIELDS
/* What the frame before asked for. */
static int8_t asked_x2;
static bool asked_lane;

/* Holds from follow_init on. */
/*@ predicate follow_remembers = -2 <= asked_x2 <= 2; */
#endif

/* How many of the thresholds are below the value: that is its cell. */
/*@ requires thresholds <= 4 && \valid_read(threshold + (0 .. thresholds - 1));
    assigns \nothing;
    ensures \result <= thresholds;
    ensures \forall integer i; 0 <= i < \result ==> value > threshold[i];
    ensures \result < thresholds ==> value <= threshold[\result]; */
static uint8_t cell_of(int16_t value, const int16_t __code *threshold, uint8_t thresholds)
{
    uint8_t cell = 0;

    /*@ loop invariant cell <= thresholds;
        loop invariant \forall integer i; 0 <= i < cell ==> value > threshold[i];
        loop assigns cell;
        loop variant thresholds - cell; */
    while (cell < thresholds && value > threshold[cell]) { /* rounds: 4 */
        cell++;
    }
    return cell;
}

/* A value on a threshold belongs to the cells on both sides. */
#define FIRST_CELL(value, threshold)                                                               \
    cell_of(value, threshold, sizeof threshold / sizeof threshold[0])
#define LAST_CELL(value, threshold) FIRST_CELL((int16_t)((value) + 1), threshold)

void follow_look_up(void)
{
    int16_t gap_mm = (int16_t)(follow.gap_mm < GAP_END_MM ? follow.gap_mm : GAP_END_MM);
    int16_t closing_mmps = (int16_t)((int16_t)follow.own_mmps - (int16_t)follow.lead_mmps);
    int16_t to_change_mm = (int16_t)(gap_mm - (int16_t)follow.change_mm);
    uint8_t gap_first = FIRST_CELL(gap_mm, gap_mm_at);
    uint8_t gap_last = LAST_CELL(gap_mm, gap_mm_at);
    uint8_t closing_first = FIRST_CELL(closing_mmps, closing_mmps_at);
    uint8_t closing_last = LAST_CELL(closing_mmps, closing_mmps_at);
    uint8_t change_first = FIRST_CELL(to_change_mm, to_change_mm_at);
    uint8_t change_last = LAST_CELL(to_change_mm, to_change_mm_at);
    uint8_t command_least = LUT_LEVELS, command_most = 0, change_least = LUT_LEVELS,
            change_most = 0;
    uint8_t gap, closing, change, level;

    /* The mean of the maxima is the middle between the least and the greatest. */
    /*@ loop invariant gap_first <= gap <= gap_last + 1;
        loop invariant gap > gap_first ==>
                LEVEL_ZERO - 1 <= command_least <= command_most <= LEVEL_ZERO + 1 &&
                LEVEL_ZERO <= change_least <= change_most <= LEVEL_ZERO + 1;
        loop invariant gap == gap_first ==> command_least == LUT_LEVELS && command_most == 0 &&
                change_least == LUT_LEVELS && change_most == 0;
        loop assigns gap, closing, change, level, command_least, command_most, change_least,
                change_most;
        loop variant gap_last + 1 - gap; */
    for (gap = gap_first; gap <= gap_last; gap++) { /* rounds: 2 */
        /*@ loop invariant closing_first <= closing <= closing_last + 1;
            loop invariant gap > gap_first || closing > closing_first ==>
                    LEVEL_ZERO - 1 <= command_least <= command_most <= LEVEL_ZERO + 1 &&
                    LEVEL_ZERO <= change_least <= change_most <= LEVEL_ZERO + 1;
            loop invariant gap == gap_first && closing == closing_first ==>
                    command_least == LUT_LEVELS && command_most == 0 &&
                    change_least == LUT_LEVELS && change_most == 0;
            loop assigns closing, change, level, command_least, command_most, change_least,
                    change_most;
            loop variant closing_last + 1 - closing; */
        for (closing = closing_first; closing <= closing_last; closing++) { /* rounds: 2 */
            /*@ loop invariant change_first <= change <= change_last + 1;
                loop invariant gap > gap_first || closing > closing_first ||
                        change > change_first ==>
                        LEVEL_ZERO - 1 <= command_least <= command_most <= LEVEL_ZERO + 1 &&
                        LEVEL_ZERO <= change_least <= change_most <= LEVEL_ZERO + 1;
                loop invariant gap == gap_first && closing == closing_first &&
                        change == change_first ==>
                        command_least == LUT_LEVELS && command_most == 0 &&
                        change_least == LUT_LEVELS && change_most == 0;
                loop assigns change, level, command_least, command_most, change_least,
                        change_most;
                loop variant change_last + 1 - change; */
            for (change = change_first; change <= change_last; change++) { /* rounds: 2 */
                level = lut_at3(gap, closing, change);
                /*@ assert tried: LEVEL_ZERO - 1 <= level <= LEVEL_ZERO + 1; */
                if (level < command_least) {
                    command_least = level;
                }
                if (level > command_most) {
                    command_most = level;
                }
                level = lut2_at3(gap, closing, change);
                /*@ assert tried: LEVEL_ZERO <= level <= LEVEL_ZERO + 1; */
                if (level < change_least) {
                    change_least = level;
                }
                if (level > change_most) {
                    change_most = level;
                }
            }
        }
    }
    follow.command_x2 = (int8_t)(command_least + command_most - LEVEL_ZERO_X2);
    follow.change_x2 = (uint8_t)(change_least + change_most - LEVEL_ZERO_X2);
}

/*@ requires -2 <= follow.command_x2 <= 2;
    assigns follow.brake_pct, follow.throttle_us;
    ensures follow.brake_pct == (follow.command_x2 == -2 ? 100 : follow.command_x2 == -1 ? 50 : 0);
    ensures follow.throttle_us == (follow.command_x2 == 2 ? FOLLOW_THROTTLE_FULL_US :
                                   follow.command_x2 == 1 ? 1500 : FOLLOW_THROTTLE_CLOSED_US); */
static void set_outputs(void)
{
    follow.brake_pct = 0;
    follow.throttle_us = FOLLOW_THROTTLE_CLOSED_US;
    if (follow.command_x2 < 0) {
        follow.brake_pct = follow.command_x2 == -2 ? 100 : 50;
    } else if (follow.command_x2 > 0) {
        follow.throttle_us = follow.command_x2 == 2
                                 ? FOLLOW_THROTTLE_FULL_US
                                 : (FOLLOW_THROTTLE_CLOSED_US + FOLLOW_THROTTLE_FULL_US) / 2;
    }
}

/*@ assigns asked_x2, asked_lane;
    ensures follow_remembers && asked_x2 == -2 && !asked_lane; */
void follow_init(void)
{
    follow.state = FOLLOW_WAITING;
    follow.change_mm = FOLLOW_CHANGE_MM;
    follow.stop = true;
    follow.command_x2 = -2;
    follow.change_x2 = 0;
    follow.asks_for_lane = false;
#if FOLLOW_YIELDS
    asked_x2 = -2;
    asked_lane = false;
#endif
    set_outputs();
}

bool follow_read(void)
{
    uint16_t gap_mm = frame_u16(0);
    uint16_t own_mmps = frame_u16(2);
    uint16_t lead_mmps = frame_u16(4);
    uint16_t change_mm = frame_u16(7);

    if (gap_mm > FOLLOW_GAP_MAX_MM || own_mmps > FOLLOW_SPEED_MAX_MMPS ||
        lead_mmps > FOLLOW_SPEED_MAX_MMPS || frame_body[6] > 1 ||
        change_mm < FOLLOW_CHANGE_MIN_MM || change_mm > FOLLOW_CHANGE_MAX_MM) {
        return false;
    }
    follow.gap_mm = gap_mm;
    follow.own_mmps = own_mmps;
    follow.lead_mmps = lead_mmps;
    follow.change_mm = change_mm;
    follow.lane_is_taken = frame_body[6] != 0;
    return true;
}

#if FOLLOW_YIELDS
/* Of what the last two frames ask for. */
/*@ requires follow_remembers && -2 <= follow.command_x2 <= 2;
    assigns follow.command_x2, follow.asks_for_lane, asked_x2, asked_lane;
    ensures follow_remembers;
    ensures follow.command_x2 == \min(\old(follow.command_x2), \old(asked_x2));
    ensures follow.asks_for_lane <==> \old(follow.asks_for_lane) && \old(asked_lane);
    ensures asked_x2 == \old(follow.command_x2) && asked_lane == \old(follow.asks_for_lane); */
static void take_the_more_careful(void)
{
    int8_t command_x2 = follow.command_x2;
    bool asks_for_lane = follow.asks_for_lane;

    if (asked_x2 < command_x2) {
        follow.command_x2 = asked_x2;
    }
    if (!asked_lane) {
        follow.asks_for_lane = false;
    }
    asked_x2 = command_x2;
    asked_lane = asks_for_lane;
}
#endif

/*@ requires follow_remembers;
    assigns asked_x2, asked_lane;
    ensures follow_remembers;
    ensures follow_two_frames: follow.command_x2 <= \old(asked_x2) && follow.command_x2 <= asked_x2;
    ensures follow_two_frames: follow.asks_for_lane ==> \old(asked_lane) && asked_lane;
    ensures follow_yields: follow.change_x2 != 0 && follow.lane_is_taken ==>
                follow.brake_pct == 100; */
void follow_decide(void)
{
    follow.state = FOLLOW_CONTROL;
    follow.stop = false;
    follow_look_up();
    /* Not as `= change_x2 == 2`: SDCC 4.2.0 loses the store of that one (small model). */
    follow.asks_for_lane = false;
    if (follow.change_x2 == 2) {
        follow.asks_for_lane = true;
    }
#if FOLLOW_YIELDS
    if (follow.change_x2 != 0 && follow.lane_is_taken) {
        follow.command_x2 = -2;
    }
    take_the_more_careful();
#endif
    set_outputs();
}

/*@ requires follow_remembers;
    assigns asked_x2, asked_lane;
    ensures follow_remembers && asked_x2 == -2 && !asked_lane;
    ensures follow_silence: follow.brake_pct >= fault_pct &&
                follow.brake_pct >= \old(follow.brake_pct) &&
                follow.throttle_us == FOLLOW_THROTTLE_CLOSED_US;
    ensures follow_near: follow.gap_mm < FOLLOW_NEAR_MM ==> follow.brake_pct == 100; */
void follow_lose(uint8_t fault_pct)
{
    follow.state = FOLLOW_FAULT;
    follow.asks_for_lane = false;
    follow.throttle_us = FOLLOW_THROTTLE_CLOSED_US;
#if FOLLOW_YIELDS
    if (follow.gap_mm < FOLLOW_NEAR_MM) {
        fault_pct = BRAKE_FULL_PCT;
    }
#endif
    if (follow.brake_pct < fault_pct) {
        follow.brake_pct = fault_pct;
    }
#if FOLLOW_YIELDS
    asked_x2 = -2;
    asked_lane = false;
#endif
}
