/* SPDX-License-Identifier: MIT */
/* The radar's decision: when to brake, how hard, and when to let go. */
#include "radar.h"
#include "fixed.h"
#include "fmcw.h"
#include "frame.h"
#include "lane.h"
#include "lut.h"
#include "safe.h"

#if LUT_INPUTS != 2 || LUT_IN1_CELLS != 13 || LUT_IN2_CELLS != 13
#error "radar needs a table of 13 x 13 cells: fistab table --grid=13x13"
#endif

#define GATE_RANGE_MAX_CM 10000U
#define CLOSING_MAX_DKMH  600
#define FRAMES_LESS       2 /* frames in a row that ask for less, until there is less */
#define FRAMES_AWAY       3 /* the same without a target in the lane */
#define BRAKE_COAST_PCT   10
#define BRAKE_FULL_PCT    100

__idata struct radar radar;

/* The nearest target in the own lane, of the frame that is being received. */
#define NONE_CM UINT16_MAX
static __idata uint16_t nearest_cm;
static __idata int16_t nearest_dkmh;
static bool is_impossible; /* one of its targets is */

static __idata uint8_t frames_less;    /* in a row that ask for less than the present state */
static __idata uint8_t frames_closing; /* in a row with a closing target, to RADAR_CLOSING_FRAMES */
static __idata uint8_t asked_pct;      /* what the last frame asked the brake for */

/* A target was braked for, and its closing speed is not gone yet. After a start, nobody knows: if
 * FAULT is the first state, it counts as such. */
static __idata bool is_approach;

/* Holds from radar_init on. */
/*@ predicate radar_counts = frames_less < FRAMES_AWAY && frames_closing <= RADAR_CLOSING_FRAMES &&
        asked_pct <= BRAKE_FULL_PCT && (radar.state == RADAR_BRAKING ==> is_approach) &&
        (radar.state <= RADAR_HOLDING ==> radar.brake_pct == 0); */

/*@ predicate radar_nearest = -4593 <= nearest_dkmh <= 4593; */

/*@ assigns frames_less, frames_closing, asked_pct, is_approach;
    ensures radar_counts; */
void radar_init(void)
{
    radar.target = false;
    radar.brake_pct = 0;
    radar.state = RADAR_DRIVER;
    frames_less = 0;
    frames_closing = 0;
    asked_pct = 0;
    is_approach = true;
}

uint8_t radar_row(int16_t closing_dkmh)
{
    if (closing_dkmh <= 0) {
        return 0;
    }
    if (closing_dkmh >= CLOSING_MAX_DKMH) {
        return 12;
    }
    /* (V + 25) / 50, by the reciprocal 1311 / 65536. That is a little more than 1/50; the quotient
     * is exact below 4681. */
    return (uint8_t)mul_hi_u16((uint16_t)(closing_dkmh + 25), 1311U);
}

uint8_t radar_col(uint16_t range_cm)
{
    if (range_cm >= GATE_RANGE_MAX_CM) {
        return 12;
    }
    /* (3 S + 1250) / 2500, by the reciprocal 26844 / 2^26. That is a little more than 1/2500; the
     * quotient is exact below 59,000. */
    return (uint8_t)(mul_hi_u16((uint16_t)(range_cm * 3U + 1250U), 26844U) >> 10);
}

/* Whether the own car's speed and curvature can be. */
/*@ assigns \nothing;
    ensures \result <==> own_dkmh <= 2500 && curvature_upm != -32768; */
static bool is_own_car_possible(uint16_t own_dkmh, int16_t curvature_upm)
{
    return own_dkmh <= SAFE_SPEED_MAX_DKMH && curvature_upm != INT16_MIN;
}

/*@ assigns nearest_cm, nearest_dkmh, is_impossible;
    ensures \old(radar_nearest) ==> radar_nearest; */
void radar_read_target(void)
{
    int32_t up_hz = frame_i24(RADAR_PAYLOAD_BYTES);
    int32_t down_hz = frame_i24(RADAR_PAYLOAD_BYTES + 3);
    int16_t azimuth = (int16_t)frame_u16(RADAR_PAYLOAD_BYTES + 6);
    uint16_t own_dkmh = frame_u16(0);
    int16_t curvature_upm = (int16_t)frame_u16(2);
    bool has_sign = (frame_body[4] & RADAR_SIGNED) != 0;
    uint16_t range_cm;

    if ((uint8_t)(frame_items_left() + 1U) == (frame_body[4] & RADAR_TARGETS_MASK)) {
        nearest_cm = NONE_CM;
        is_impossible = false;
    }
    if (azimuth == RADAR_NO_TARGET || is_impossible ||
        !is_own_car_possible(own_dkmh, curvature_upm)) {
        return;
    }
    if (azimuth < -LANE_AZIMUTH_MAX_TURN16 || azimuth > LANE_AZIMUTH_MAX_TURN16 ||
        !fmcw_pair_is_possible(up_hz, down_hz) ||
        (!has_sign && (up_hz < 0 || down_hz < 0 || fmcw_sign_is_open(up_hz, down_hz, own_dkmh)))) {
        is_impossible = true;
        return;
    }
    range_cm = fmcw_range_cm(up_hz, down_hz);
    if (range_cm < nearest_cm && lane_is_own(range_cm, azimuth, curvature_upm)) {
        nearest_cm = range_cm;
        nearest_dkmh = fmcw_closing_dkmh(up_hz, down_hz);
    }
}

/*@ requires radar_nearest; */
bool radar_read(void)
{
    uint8_t targets = frame_body[4] & (uint8_t)~RADAR_SIGNED;
    uint16_t own_dkmh = frame_u16(0);

    if (targets > RADAR_TARGETS_MAX || !is_own_car_possible(own_dkmh, (int16_t)frame_u16(2))) {
        return false;
    }
    if (targets != 0 && is_impossible) {
        return false;
    }
    radar.target = false;
    if (targets != 0 && nearest_cm != NONE_CM) {
        radar.target = true;
        radar.range_cm = nearest_cm;
        radar.closing_dkmh = nearest_dkmh;
    }
    radar.own_dkmh = own_dkmh;
    return true;
}

/* What the table says, and in doubt what the frame before asked for. */
/*@ requires radar_counts && radar.state == RADAR_BRAKING;
    assigns radar.row, radar.col, radar.level, radar.brake_pct, asked_pct;
    ensures radar_counts;
    ensures BRAKE_COAST_PCT <= asked_pct <= radar.brake_pct <= BRAKE_FULL_PCT; */
static void brake(void)
{
    uint8_t before_pct = asked_pct;

    radar.row = radar_row(radar.closing_dkmh);
    radar.col = radar_col(radar.range_cm);
    radar.level = lut_at(radar.row, radar.col);
    /* 0.8 m/s2, and 0.03 m/s2 for each level; 100 % is 8 m/s2. */
    asked_pct = (uint8_t)(BRAKE_COAST_PCT + (uint8_t)((uint16_t)(radar.level * 3U + 4U) >> 3));
    /* unreached: 240 levels are 100 %; a table with more would need this */
    if (asked_pct > BRAKE_FULL_PCT) {
        asked_pct = BRAKE_FULL_PCT;
    }
    radar.brake_pct = asked_pct > before_pct ? asked_pct : before_pct;
}

/* Whether the closing speed is no noise. */
/*@ assigns \nothing; */
static bool is_sure(void)
{
    return radar.closing_dkmh > RADAR_SURE_DKMH || radar.range_cm < RADAR_NEAR_CM ||
           frames_closing >= RADAR_CLOSING_FRAMES;
}

/* The state that the target in the own lane asks for. */
/*@ requires radar_is_valid;
    assigns \nothing;
    ensures \result <= RADAR_BRAKING;
    ensures \result == RADAR_BRAKING ==> radar.closing_dkmh > 0;
    ensures radar.closing_dkmh > 0 && is_approach && radar.state != RADAR_DRIVER ==>
                \result == RADAR_BRAKING; */
static uint8_t wanted_state(void)
{
    uint16_t gate_cm = radar.safe_cm < GATE_RANGE_MAX_CM ? radar.safe_cm : GATE_RANGE_MAX_CM;

    if (radar.closing_dkmh > 0 && is_approach && radar.state != RADAR_DRIVER) {
        return RADAR_BRAKING;
    }
    if (radar.closing_dkmh > 0 && radar.range_cm < gate_cm && is_sure()) {
        return RADAR_BRAKING;
    }
    if (radar.state == RADAR_DRIVER || radar.closing_dkmh < -RADAR_AWAY_DKMH ||
        radar.range_cm >= (uint16_t)(gate_cm + (gate_cm >> 3))) {
        return RADAR_DRIVER;
    }
    return RADAR_HOLDING;
}

/*@ requires radar_counts;
    assigns frames_less, frames_closing, asked_pct, is_approach;
    ensures radar_counts;
    ensures radar_holds: \old(radar.state) == RADAR_BRAKING && radar.target &&
                radar.closing_dkmh > 0 ==> radar.state == RADAR_BRAKING;
    ensures radar_holds: \old(radar.state) == RADAR_BRAKING && radar.state < RADAR_BRAKING ==>
                (radar.closing_dkmh <= 0 && \old(frames_less) + 1 >= FRAMES_LESS) ||
                \old(frames_less) + 1 >= FRAMES_AWAY;
    ensures radar_over_fault: \old(radar.state) == RADAR_FAULT && \old(is_approach) &&
                radar.target && radar.closing_dkmh > 0 ==> radar.state == RADAR_BRAKING;
    ensures radar_over_fault: \old(radar.state) == RADAR_FAULT && \old(is_approach) &&
                radar.state < RADAR_BRAKING ==>
                (radar.closing_dkmh <= 0 && \old(frames_less) + 1 >= FRAMES_LESS) ||
                \old(frames_less) + 1 >= FRAMES_AWAY;
    ensures radar_holds: radar.state < RADAR_BRAKING || radar.brake_pct >= BRAKE_COAST_PCT ||
                radar.brake_pct == \old(radar.brake_pct); */
void radar_decide(void)
{
    uint8_t wanted = RADAR_DRIVER;
    uint8_t frames_needed = FRAMES_AWAY;

    radar.safe_cm = safe_distance_cm(radar.own_dkmh);
    if (radar.target) {
        if (radar.closing_dkmh <= 0) {
            frames_closing = 0;
        } else if (frames_closing < RADAR_CLOSING_FRAMES) {
            frames_closing++;
        }
        wanted = wanted_state();
        frames_needed = FRAMES_LESS;
    }

    /* A target can be hidden for a moment, by a bump or at the edge of the lane; and one frame of
     * noise must not let go. */
    if (wanted != RADAR_BRAKING && wanted < radar.state) {
        frames_less++;
        if (frames_less < frames_needed) {
            return;
        }
    }
    frames_less = 0;
    radar.state = wanted;
    if (wanted == RADAR_BRAKING) {
        is_approach = true;
        brake();
    } else {
        is_approach = false;
        asked_pct = 0;
        radar.brake_pct = 0;
    }
}

/*@ requires radar_counts;
    assigns is_approach, frames_less, frames_closing, asked_pct;
    ensures radar_counts;
    ensures radar_over_fault: \old(radar.state) == RADAR_HOLDING ||
                \old(radar.state) == RADAR_BRAKING || \old(is_approach) ==> is_approach;
    ensures radar_silence: radar.state == RADAR_FAULT && radar.brake_pct >= fault_pct &&
                radar.brake_pct >= \old(radar.brake_pct); */
void radar_lose(uint8_t fault_pct)
{
    if (radar.state == RADAR_HOLDING) {
        is_approach = true;
    }
    radar.state = RADAR_FAULT;
    frames_less = 0;
    frames_closing = 0;
    if (radar.brake_pct < fault_pct) {
        radar.brake_pct = fault_pct;
    }
    asked_pct = radar.brake_pct;
}

bool radar_cuts_throttle(void)
{
    return radar.state != RADAR_DRIVER;
}
