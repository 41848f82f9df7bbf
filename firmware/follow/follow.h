/* SPDX-License-Identifier: MIT */
/* Following a robot and asking for the next lane. The table of tables/follow.fis decides whether to
 * slow down, hold or speed up, and whether to change lanes. After Liu and Fang, 2015.
 *
 * The system answers with the mean of maxima. That is constant between thresholds, at which two
 * sets are equal: gap 2, 4, 6, 8 m; closing speed -1 and 1 m/s; gap minus change distance -0.05 and
 * 0.05 m. On a threshold it is the mean of the cells on both sides, which can be half a command.
 *
 * Three rules are not in the table. If the robot wants to change lanes but the next lane is taken,
 * it slows down. Of what the last two frames ask for, it does the more careful: a single frame
 * never releases the brake, opens the throttle or asks for a lane. And if the link is lost less
 * than FOLLOW_NEAR_MM behind a robot, it brakes fully. The published system has no such rules; see
 * FOLLOW_AS_PUBLISHED. */
#ifndef FUZZY51_FOLLOW_H
#define FUZZY51_FOLLOW_H

#include <stdbool.h>
#include <stdint.h>

/* Payload of FRAME_FOLLOW: gap (u16, mm), own speed (u16, mm/s), lead's speed (u16, mm/s), the next
 * lane (u8, 0: free, 1: taken), the change distance (u16, mm). */
#define FOLLOW_PAYLOAD_BYTES  9
#define FOLLOW_GAP_MAX_MM     20000U /* beyond 10 m nothing changes */
#define FOLLOW_SPEED_MAX_MMPS 2500U  /* a robot drives 0..2 m/s */

/* The change distance: nearer, the robot slows down instead of asking for the next lane. It matters
 * below a gap of 2 m only, where the table has VN. A closing speed of just below 1 m/s counts as
 * none there until the gap is below the change distance: to lose it then takes 0.25 m and two
 * steps, so the least one is 0.5 m. */
#define FOLLOW_CHANGE_MIN_MM 500U
#define FOLLOW_CHANGE_MAX_MM 1900U
#define FOLLOW_CHANGE_MM     1000U /* as published, until a frame says another one */

#define FOLLOW_NEAR_MM 2000U /* as VN in the table */

/* Whether the rules beside the table hold; 0 for the system as published. */
#ifdef FOLLOW_AS_PUBLISHED
#define FOLLOW_YIELDS 0
#else
#define FOLLOW_YIELDS 1
#endif

/* The throttle is a servo pulse, from closed to full. Full throttle and 100 % of brake are 2 m/s2
 * each. */
#define FOLLOW_THROTTLE_CLOSED_US 1000U
#define FOLLOW_THROTTLE_FULL_US   2000U

enum follow_state {
    FOLLOW_WAITING, /* no three good frames yet: full brake, the robot does not roll */
    FOLLOW_CONTROL,
    FOLLOW_FAULT, /* the link is lost: the throttle is closed, the brake never falls */
};

struct follow {
    uint16_t gap_mm, own_mmps, lead_mmps; /* as last read */
    uint16_t change_mm;                   /* the change distance, as last read */
    bool lane_is_taken;
    int8_t command_x2; /* -2 slow down, 0 hold, 2 speed up, by 2 m/s2; -1 and 1: on a threshold */
    uint8_t change_x2; /* 0 stay, 2 change lanes; 1 on a threshold: not yet */
    bool asks_for_lane;
    uint8_t brake_pct;
    bool stop; /* the STOP pin: on until the link is up for the first time */
    uint16_t throttle_us;
    uint8_t state; /* enum follow_state */
};

/* What the controller last read and decided. */
extern struct follow follow;

/*@ predicate follow_is_valid =
        follow.gap_mm <= FOLLOW_GAP_MAX_MM && follow.own_mmps <= FOLLOW_SPEED_MAX_MMPS &&
        follow.lead_mmps <= FOLLOW_SPEED_MAX_MMPS && follow.brake_pct <= 100 &&
        FOLLOW_CHANGE_MIN_MM <= follow.change_mm <= FOLLOW_CHANGE_MAX_MM &&
        -2 <= follow.command_x2 <= 2 && follow.change_x2 <= 2 && follow.state <= FOLLOW_FAULT &&
        FOLLOW_THROTTLE_CLOSED_US <= follow.throttle_us <= FOLLOW_THROTTLE_FULL_US; */

/* Sets the state at start: WAITING, full brake, throttle closed. */
/*@ assigns follow.state, follow.change_mm, follow.stop, follow.command_x2, follow.change_x2,
            follow.asks_for_lane, follow.brake_pct, follow.throttle_us;
    ensures follow.state == FOLLOW_WAITING && follow.brake_pct == 100 && follow.stop;
    ensures !follow.asks_for_lane && follow.throttle_us == FOLLOW_THROTTLE_CLOSED_US; */
void follow_init(void);

/* Reads the payload of a good frame. Returns false, with nothing taken from the frame, if a value
 * is out of range: gap > FOLLOW_GAP_MAX_MM, a speed > FOLLOW_SPEED_MAX_MMPS, a lane not 0 or 1,
 * a change distance not in FOLLOW_CHANGE_MIN_MM..FOLLOW_CHANGE_MAX_MM. */
/*@ requires follow_is_valid;
    assigns follow.gap_mm, follow.own_mmps, follow.lead_mmps, follow.lane_is_taken,
            follow.change_mm;
    ensures follow_is_valid;
    ensures !\result ==> follow == \old(follow); */
bool follow_read(void);

/* Looks up the table with what was read: sets command_x2 and change_x2, nothing else. */
/*@ requires follow_is_valid;
    assigns follow.command_x2, follow.change_x2;
    ensures follow_is_valid; */
void follow_look_up(void);

/* Makes one control step with what was read. Call it only while the link is up, each 100 ms.
 * Together with follow_read less than 1,900 mc where three thresholds meet, and 1,100 elsewhere. */
/*@ requires follow_is_valid;
    assigns follow.state, follow.stop, follow.command_x2, follow.change_x2, follow.asks_for_lane,
            follow.brake_pct, follow.throttle_us;
    ensures follow_is_valid;
    ensures follow.state == FOLLOW_CONTROL && !follow.stop;
    ensures follow.asks_for_lane ==> follow.change_x2 == 2;
    ensures follow.brake_pct == 0 || follow.throttle_us == FOLLOW_THROTTLE_CLOSED_US; */
void follow_decide(void);

/* Makes one control step while the link is lost: FAULT, throttle closed, no lane is asked for. The
 * brake takes the larger of its last percent and fault_pct (0..100); or 100, if the robot ahead was
 * nearer than FOLLOW_NEAR_MM, but for the published system. */
/*@ requires follow_is_valid && fault_pct <= 100;
    assigns follow.state, follow.asks_for_lane, follow.brake_pct, follow.throttle_us;
    ensures follow_is_valid;
    ensures follow.state == FOLLOW_FAULT && !follow.asks_for_lane;
    ensures follow.throttle_us == FOLLOW_THROTTLE_CLOSED_US;
    ensures follow.brake_pct == \max(\old(follow.brake_pct), fault_pct) ||
            (follow.gap_mm < FOLLOW_NEAR_MM && follow.brake_pct == 100); */
void follow_lose(uint8_t fault_pct);

#endif
