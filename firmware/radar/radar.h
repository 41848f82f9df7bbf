/* SPDX-License-Identifier: MIT */
/* The collision avoidance with a millimetre-wave radar: from beat frequencies to a brake command.
 *
 * The driver has control until a target in the own lane is nearer than the safe distance S_F (at
 * most 100 m) and approaches. Then the throttle is cut, and the table of tables/radar.fis says how
 * hard to brake, until the closing speed is gone (V_R <= 0). It would be wrong to brake only until
 * S > S_F: that would let go in the middle of it. HOLDING follows: the brake is off, but the
 * throttle stays cut while the target is still nearer than S_F, or the driver would close the gap
 * again at once.
 *
 *     state      lost link  no target in the lane   V_R > 0                   V_R <= 0
 *     DRIVER     FAULT      -                       BRAKING if S < S_F and    -
 *                                                   it approaches
 *     HOLDING    FAULT      DRIVER (3)              the same; else DRIVER     DRIVER (2): far
 *                                                   (2) if it is far          or it draws away
 *     BRAKING    FAULT      DRIVER (3)              BRAKING                   DRIVER (2): far
 *                                                                             or it draws away,
 *                                                                             else HOLDING (2)
 *     FAULT      -          DRIVER (3)              after BRAKING, HOLDING    as from BRAKING
 *                                                   or a start: BRAKING;
 *                                                   after DRIVER: BRAKING if
 *                                                   S < S_F and it approaches,
 *                                                   else as from BRAKING
 *
 * (2), (3): at the second or third frame in a row that says so; until then state and brake stay as
 * they are, also those of FAULT.
 *
 * It is far if S > 9/8 S_F. It approaches if V_R is more than RADAR_SURE_DKMH, or S less than
 * RADAR_NEAR_CM, or V_R was above 0 in RADAR_CLOSING_FRAMES frames in a row: noise alone does not
 * brake. It draws away if V_R is less than -RADAR_AWAY_DKMH. While the car brakes, the brake is the
 * larger of what the last two frames ask for. */
#ifndef FUZZY51_RADAR_H
#define FUZZY51_RADAR_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

/* Payload of FRAME_RADAR:
 *     0  u16  own speed, tenths of km/h
 *     2  i16  curvature of the own way, millionths of 1/m, positive to the left: yaw rate by speed,
 *             or what the steering angle says
 *     4  u8   bits 0..3: number of targets, at most RADAR_TARGETS_MAX; and RADAR_SIGNED
 * then each target:
 *     0  i24  beat of the up sweep, Hz
 *     3  i24  beat of the down sweep, Hz
 *     6  i16  azimuth, 65,536ths of a turn, positive to the left; RADAR_NO_TARGET: an empty place
 * In whatever order: the nearest one in the own lane counts; of two at the same range, the first. A
 * head sends the same number in each frame, with empty places, because frames of different length
 * do not come evenly. */
#define RADAR_PAYLOAD_BYTES 5
#define RADAR_TARGET_BYTES  8
#define RADAR_TARGETS_MAX   8U
#define RADAR_TARGETS_MASK  0x0FU
#define RADAR_SIGNED        0x10U /* the front end has I and Q: it knows the sign of a beat */
#define RADAR_NO_TARGET     INT16_MIN

/* What is more than noise, and how long a closing speed below it must last. */
#define RADAR_SURE_DKMH      36 /* 1 m/s */
#define RADAR_AWAY_DKMH      72
#define RADAR_NEAR_CM        1000U
#define RADAR_CLOSING_FRAMES 10

/* In the order of how much the controller intervenes. */
enum radar_state {
    RADAR_DRIVER,  /* the driver has control */
    RADAR_HOLDING, /* the throttle is cut, the brake is off */
    RADAR_BRAKING, /* the throttle is cut, the table brakes */
    RADAR_FAULT,   /* the link is lost: the throttle is cut, the brake never falls */
};

struct radar {
    bool target;          /* there is one in the own lane; the next two are those of the last one */
    uint16_t range_cm;    /* of the nearest one */
    int16_t closing_dkmh; /* tenths of km/h, positive when the target comes nearer */
    uint16_t own_dkmh;
    uint16_t safe_cm;
    uint8_t row, col; /* of the table: closing speed and range as levels, 0..12 */
    uint8_t level;    /* the table's cell, 40 (J_A + 3), 0..240 */
    uint8_t brake_pct;
    uint8_t state; /* enum radar_state */
};

/* What the controller last read and decided. */
extern __idata struct radar radar;

/*@ predicate radar_is_valid =
        radar.brake_pct <= 100 && radar.state <= RADAR_FAULT &&
        -4593 <= radar.closing_dkmh <= 4593 && radar.own_dkmh <= 2500; */

/* Sets the state at start: no target, the driver has control. */
/*@ assigns radar.target, radar.brake_pct, radar.state;
    ensures radar.state == RADAR_DRIVER && radar.brake_pct == 0 && !radar.target; */
void radar_init(void);

/* Reads one target of a frame that is being received, after FRAME_ITEM. */
/*@ requires radar_is_valid;
    assigns \nothing;
    ensures radar_is_valid; */
void radar_read_target(void);

/* Reads the payload of a good frame, after its targets. Returns false, with nothing taken from the
 * frame, if
 *     a value is out of its range (fmcw.h, safe.h, lane.h),
 *     an unknown flag is set, or there are too many targets, or
 *     a front end without sign sends a negative beat or one with two meanings (fmcw_sign_is_open).
 */
/*@ requires radar_is_valid;
    assigns radar.target, radar.range_cm, radar.closing_dkmh, radar.own_dkmh;
    ensures radar_is_valid;
    ensures !\result ==> radar == \old(radar); */
bool radar_read(void);

/* Makes one control step with what was read. Call it only while the link is up. */
/*@ requires radar_is_valid;
    assigns radar.safe_cm, radar.row, radar.col, radar.level, radar.brake_pct, radar.state;
    ensures radar_is_valid;
    ensures radar.state <= RADAR_HOLDING ==> radar.brake_pct == 0; */
void radar_decide(void);

/* Makes one control step while the link is lost: FAULT. The brake takes the larger of its last
 * percent and fault_pct (0..100). */
/*@ requires radar_is_valid && fault_pct <= 100;
    assigns radar.state, radar.brake_pct;
    ensures radar_is_valid;
    ensures radar.state == RADAR_FAULT;
    ensures radar.brake_pct == \max(\old(radar.brake_pct), fault_pct); */
void radar_lose(uint8_t fault_pct);

/* Returns whether the driver's throttle is cut: in every state but DRIVER. */
/*@ assigns \nothing;
    ensures \result <==> radar.state != RADAR_DRIVER; */
bool radar_cuts_throttle(void);

/* Return the row and the column of the table, 0..12: floor((12 V + 30) / 60) of the closing speed V
 * in km/h, and floor((12 S + 50) / 100) of the range S in m, limited to 12. */
/*@ assigns \nothing;
    ensures 0 <= closing_dkmh <= 600 ==> \result == (closing_dkmh + 25) / 50;
    ensures closing_dkmh < 0 ==> \result == 0;
    ensures closing_dkmh > 600 ==> \result == 12; */
uint8_t radar_row(int16_t closing_dkmh);
/*@ assigns \nothing;
    ensures range_cm <= 10000 ==> \result == (range_cm * 3 + 1250) / 2500;
    ensures range_cm > 10000 ==> \result == 12; */
uint8_t radar_col(uint16_t range_cm);

#endif
