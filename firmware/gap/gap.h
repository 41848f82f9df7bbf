/* SPDX-License-Identifier: MIT */
/* Keeping a gap: from the safe distance to the car ahead to an acceleration, half by an optimal
 * (LQ) law and half by the fuzzy table of tables/gap.fis. After Bi and Li. Both cars brake with at
 * most A = 6 m/s2, the brake acts tau = 0.9 s late, and 5 m remain when both stand.
 *
 *     lead                 safe distance D                                h = dD/dv
 *     stands (<= 5 cm/s)   v tau + v^2/(2A) + 5 m                         tau + v/A
 *     drives               c tau + c^2/(2A) + 5 m, c = closing speed      tau + c/A
 *     brakes (> 20 cm/s2)  max(0, v tau + v^2/(2A) - lead^2/(2A)) + 5 m   tau + v/A
 *
 *     u_LQ    = -0.3 (D - gap) - (v - lead)/h, to +-8 m/s2
 *     u_fuzzy = table(0.2 (gap - D), 0.04 (lead - v))
 *     u       = (u_LQ + u_fuzzy) / 2
 *
 * The image gap_paper (GAP_AS_PUBLISHED) is this law alone; gap_fuzzy and gap_lq have only one half
 * of it, u = u_fuzzy (GAP_FUZZY_ALONE) or u = u_LQ (GAP_LQ_ALONE). The image gap adds:
 *
 *     set speed    u is at most (set - v) / 1 s, which itself is at least -2 m/s2; with no car
 *                  ahead u is that, at most 2 m/s2
 *     lead state   `brakes` begins above 80 cm/s2, or at the fifth frame in a row above 20; it ends
 *                  at the tenth frame in a row below that. `stands` ends above 50 cm/s
 *     two frames   u is the smaller one of what the last two frames ask for: a single frame never
 *                  releases the brake nor opens the throttle
 *     EMERGENCY    full brake, see the states:
 *
 *     state      lost link  full brake, begun 0.35 s  even 5 m/s2, begun 0.35 s from now, keep
 *                           from now, comes too late  the car from the lead, in two frames in a row
 *     WAITING    FAULT      EMERGENCY                 CONTROL
 *     CONTROL    FAULT      EMERGENCY                 -
 *     EMERGENCY  FAULT      -                         CONTROL
 *     FAULT      -          EMERGENCY                 CONTROL
 * Between both, WAITING and FAULT end in CONTROL. It comes too late if, with 7.5 of the 8 m/s2,
 * less than 0.5 m remains at any time while the lead keeps its present deceleration. 0.35 s are the
 * next reading, its frame, and dead time and lag of the brake; meanwhile the car brakes as now.
 *
 * Lengths are in cm, speeds in cm/s, accelerations in cm/s2; positive means faster. Roundings
 * belong to the specification: all of them make the car brake harder, by up to 0.17 m/s2. */
#ifndef FUZZY51_GAP_H
#define FUZZY51_GAP_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

/* Payload of FRAME_GAP: gap (u16, cm), own speed (u16, cm/s), lead's speed (u16, cm/s), lead's
 * acceleration (i16, cm/s2), set speed (u8, GAP_SET_STEP_CMPS). */
#define GAP_PAYLOAD_BYTES  9
#define GAP_MAX_CM         25000U /* this and more: no car ahead */
#define GAP_SET_STEP_CMPS  20U
#define GAP_SET_MAX        225U /* 45 m/s */
#define GAP_SPEED_MAX_CMPS 5000U
#define GAP_LEAD_MAX_CMPS2 1500 /* faster or slower */

#define GAP_ACCEL_MAX_CMPS2 800

/* Below GAP_CREEP_CMPS a brake that is on brakes at least with GAP_HOLD_CMPS2, until the car
 * stands. Behind a lead that stands, an acceleration of less than that is such a brake, too: the
 * car does not creep up to the safe distance. */
#define GAP_CREEP_CMPS 30U
#define GAP_HOLD_CMPS2 30

/* The throttle is a servo pulse, from closed to full. Full throttle and 100 % of brake are 8 m/s2
 * each. */
#define GAP_THROTTLE_CLOSED_US 1000U
#define GAP_THROTTLE_FULL_US   2000U

enum gap_lead { GAP_LEAD_STANDS, GAP_LEAD_DRIVES, GAP_LEAD_BRAKES };

enum gap_state {
    GAP_WAITING, /* no three good frames yet: full brake, the car does not roll */
    GAP_CONTROL,
    GAP_EMERGENCY, /* full brake */
    GAP_FAULT,     /* the link is lost: the throttle is closed, the brake never falls */
};

struct gap {
    uint16_t gap_cm, own_cmps, lead_cmps; /* as last read */
    int16_t lead_cmps2;
    uint16_t set_cmps;   /* set speed, as last read */
    uint16_t safe_cm;    /* D */
    int16_t accel_cmps2; /* -800..800 */
    uint8_t brake_pct;
    bool stop; /* the STOP pin: on until the link is up for the first time */
    uint16_t throttle_us;
    uint8_t lead;  /* enum gap_lead */
    uint8_t state; /* enum gap_state */
};

/* What the controller last read and decided. */
extern __idata struct gap gap;

/*@ predicate gap_is_valid =
        gap.gap_cm <= GAP_MAX_CM && gap.own_cmps <= GAP_SPEED_MAX_CMPS &&
        gap.lead_cmps <= GAP_SPEED_MAX_CMPS && gap.set_cmps <= GAP_SET_MAX * GAP_SET_STEP_CMPS &&
        -GAP_ACCEL_MAX_CMPS2 <= gap.accel_cmps2 <= GAP_ACCEL_MAX_CMPS2 &&
        -GAP_LEAD_MAX_CMPS2 <= gap.lead_cmps2 <= GAP_LEAD_MAX_CMPS2 &&
        gap.brake_pct <= 100 && gap.state <= GAP_FAULT && gap.lead <= GAP_LEAD_BRAKES &&
        GAP_THROTTLE_CLOSED_US <= gap.throttle_us <= GAP_THROTTLE_FULL_US; */

/* Sets the state at start: WAITING, full brake, throttle closed. */
/*@ assigns gap.state, gap.stop, gap.brake_pct, gap.throttle_us, gap.accel_cmps2, gap.lead;
    ensures gap.state == GAP_WAITING && gap.brake_pct == 100 && gap.stop;
    ensures gap.throttle_us == GAP_THROTTLE_CLOSED_US; */
void gap_init(void);

/* Reads the payload of a good frame. Returns false, with nothing taken from the frame, if a value
 * is out of range: gap_cm > GAP_MAX_CM, a speed > GAP_SPEED_MAX_CMPS, the lead's acceleration more
 * than GAP_LEAD_MAX_CMPS2 in either direction, or a set speed > GAP_SET_MAX. */
/*@ requires gap_is_valid;
    assigns gap.gap_cm, gap.own_cmps, gap.lead_cmps, gap.lead_cmps2, gap.set_cmps;
    ensures gap_is_valid;
    ensures !\result ==> gap == \old(gap); */
bool gap_read(void);

/* Makes one control step with what was read. Call it only while the link is up, each 50 ms. Less
 * than 8,000 mc together with gap_read and what frames.c does with a frame. */
/*@ requires gap_is_valid;
    assigns gap.state, gap.stop, gap.lead, gap.safe_cm, gap.accel_cmps2, gap.brake_pct,
            gap.throttle_us;
    ensures gap_is_valid;
    ensures (gap.state == GAP_CONTROL || gap.state == GAP_EMERGENCY) && !gap.stop;
    ensures gap_emergency: gap.state == GAP_EMERGENCY ==> gap.brake_pct == 100;
    ensures gap.brake_pct == 0 || gap.throttle_us == GAP_THROTTLE_CLOSED_US; */
void gap_decide(void);

/* Makes one control step while the link is lost: FAULT, throttle closed. The brake takes the larger
 * of its last percent and fault_pct (0..100). */
/*@ requires gap_is_valid && fault_pct <= 100;
    assigns gap.state, gap.throttle_us, gap.brake_pct, gap.accel_cmps2;
    ensures gap_is_valid;
    ensures gap.state == GAP_FAULT && gap.throttle_us == GAP_THROTTLE_CLOSED_US;
    ensures gap.brake_pct == \max(\old(gap.brake_pct), fault_pct); */
void gap_lose(uint8_t fault_pct);

/* The parts of gap_decide; gap.lead must be set. gap_safe_cm returns D, 500..25833 cm. The other
 * two need gap.safe_cm as well and return the LQ law and the table, each -800..800 cm/s2. */
/*@ requires gap_is_valid;
    assigns \nothing;
    ensures 500 <= \result;
    ensures \result <= 25833; */
uint16_t gap_safe_cm(void);
/*@ requires gap_is_valid && 500 <= gap.safe_cm <= 25833;
    assigns \nothing;
    ensures -GAP_ACCEL_MAX_CMPS2 <= \result <= GAP_ACCEL_MAX_CMPS2; */
int16_t gap_lq_cmps2(void);
/*@ requires gap_is_valid && 500 <= gap.safe_cm <= 25833;
    assigns \nothing;
    ensures -GAP_ACCEL_MAX_CMPS2 <= \result <= GAP_ACCEL_MAX_CMPS2; */
int16_t gap_fuzzy_cmps2(void);

/* Returns whether the car comes too near to the lead if it brakes with now_cmps2 (0..800) for 0.35
 * s, and then with later_cmps2 (200..800). */
/*@ requires gap_is_valid && now_cmps2 <= 800 && 200 <= later_cmps2 <= 800;
    assigns \nothing; */
bool gap_is_too_late(uint16_t now_cmps2, uint16_t later_cmps2);

#endif
