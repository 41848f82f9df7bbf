/* Following a robot and asking for the next lane: a table of tables/follow.fis decides to slow
 * down, to hold or to speed up, and whether to change lanes. After Liu and Fang, 2015.
 *
 * The system's mean of maxima is constant between thresholds, where two sets are equal: gap 2, 4,
 * 6, 8 m, closing speed -1 and 1 m/s, gap less change distance -0.05 and 0.05 m. On a threshold it
 * is the mean of the cells on both sides, half a command.
 *
 * Outside the table: if the wished change is refused, because the next lane is taken, the robot
 * slows down. The published system has no such rule, see FOLLOW_AS_PUBLISHED. */
#ifndef FUZZY51_FOLLOW_H
#define FUZZY51_FOLLOW_H

#include <stdbool.h>
#include <stdint.h>

/* Payload of FRAME_FOLLOW: gap (u16, mm), own speed (u16, mm/s), lead's speed (u16, mm/s), the next
 * lane (u8, 0: free, 1: taken). */
#define FOLLOW_PAYLOAD_BYTES  7
#define FOLLOW_GAP_MAX_MM     20000U /* beyond 10 m nothing changes */
#define FOLLOW_SPEED_MAX_MMPS 2500U  /* a robot drives 0..2 m/s */

#define FOLLOW_CHANGE_MM 1000 /* the change distance */

/* Whether a refused change brakes; 0 for the system as published. */
#ifdef FOLLOW_AS_PUBLISHED
#define FOLLOW_YIELDS 0
#else
#define FOLLOW_YIELDS 1
#endif

/* The throttle is a servo pulse of so many us, from closed to 2 m/s2; the brake is 100 % at 2 m/s2.
 */
#define FOLLOW_THROTTLE_CLOSED_US 1000U
#define FOLLOW_THROTTLE_FULL_US   2000U

enum follow_state {
    FOLLOW_WAITING, /* no three good frames yet: full brake, the robot does not roll */
    FOLLOW_CONTROL,
    FOLLOW_FAULT, /* the link is lost: throttle closed, brake as it was or more, until it is up
                     again */
};

struct follow {
    uint16_t gap_mm, own_mmps, lead_mmps; /* as last read */
    bool lane_is_taken;
    int8_t command_x2; /* -2 slow down, 0 hold, 2 speed up: by 2 m/s2; in halves, for thresholds */
    uint8_t change_x2; /* 0 stay, 2 change lanes; 1 on a threshold: not yet */
    bool asks_for_lane;
    uint8_t brake_pct;
    bool stop; /* the stop line: until the link is up for the first time */
    uint16_t throttle_us;
    uint8_t state; /* enum follow_state */
};

/* What the controller last read and decided. */
extern struct follow follow;

/* Full brake, throttle closed, waiting. */
void follow_init(void);

/* Takes the payload of a good frame. Returns false, with everything as before, when a value is out
 * of range: gap > FOLLOW_GAP_MAX_MM, a speed > FOLLOW_SPEED_MAX_MMPS, a lane that is neither. */
bool follow_read(void);

/* The table on what was read: sets command_x2 and change_x2, nothing else. */
void follow_look_up(void);

/* One control step on what was read, while the link is up; made for one in 100 ms. Under 1,600 mc
 * with follow_read, where three thresholds meet; 800 elsewhere. */
void follow_decide(void);

/* One control step while the link is lost: never less brake than before, `fault_pct` at least, and
 * no lane is asked for. */
void follow_lose(uint8_t fault_pct);

#endif
