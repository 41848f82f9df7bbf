/* SPDX-License-Identifier: MIT */
/* The gap controller's decision. It divides by multiplying with reciprocals. */
#include "gap.h"
#include "fixed.h"
#include "frame.h"
#include "lut.h"

#define LEAD_STANDS_CMPS  5U
#define LEAD_BRAKES_CMPS2 (-20)
#define STANDING_CM       500U

/* The table's inputs: 0.2 (gap - D) in -2..4, and 0.04 (lead - v) in -0.8..0.8. */
#define ROOM_MIN_CM      (-1000)
#define ROOM_MAX_CM      2000
#define OPENING_MAX_CMPS 2000
#define ROOM_Q8          LUT_POSITION(LUT_IN1_CELLS, (ROOM_MAX_CM - ROOM_MIN_CM) * 4UL)
#define OPENING_Q8       LUT_POSITION(LUT_IN2_CELLS, 2UL * OPENING_MAX_CMPS * 4UL)

/* One level of the table is 2^LEVEL_SHIFT cm/s2, and level LEVEL_ZERO is 0. */
#define LEVEL_SHIFT 3
#define LEVEL_ZERO  (LUT_LEVELS / 2)
#if LUT_LEVELS != 200 || !LUT_IS_NODES
#error "gap wants the table of tables/gap.fis as nodes with 200 levels over -8..8: 8 cm/s2 a level"
#endif

__idata struct gap gap;

/*@ assigns \nothing;
    ensures \result == (gap.lead_cmps <= LEAD_STANDS_CMPS      ? GAP_LEAD_STANDS :
                        gap.lead_cmps2 >= LEAD_BRAKES_CMPS2 ? GAP_LEAD_DRIVES : GAP_LEAD_BRAKES); */
static uint8_t published_lead_state(void)
{
    if (gap.lead_cmps <= LEAD_STANDS_CMPS) {
        return GAP_LEAD_STANDS;
    }
    return gap.lead_cmps2 >= LEAD_BRAKES_CMPS2 ? GAP_LEAD_DRIVES : GAP_LEAD_BRAKES;
}

#ifdef GAP_AS_PUBLISHED
#define lead_state published_lead_state
#else
#define LEAD_STARTS_CMPS  50U
#define LEAD_SURELY_CMPS2 (-80)
#define FRAMES_TO_BRAKES  5
#define FRAMES_TO_DRIVES  10

static __idata uint8_t frames_other; /* in a row that say another lead state */

/* The published state, once it is no noise. */
/*@ requires gap.lead <= GAP_LEAD_BRAKES && frames_other < FRAMES_TO_DRIVES;
    assigns frames_other;
    ensures \result <= GAP_LEAD_BRAKES && frames_other < FRAMES_TO_DRIVES;
    ensures \result != gap.lead && \result == GAP_LEAD_BRAKES && gap.lead != GAP_LEAD_STANDS &&
                gap.lead_cmps2 >= LEAD_SURELY_CMPS2 ==>
                \old(frames_other) + 1 >= FRAMES_TO_BRAKES; */
static uint8_t lead_state(void)
{
    uint8_t state = published_lead_state();

    if (gap.lead == GAP_LEAD_STANDS && gap.lead_cmps <= LEAD_STARTS_CMPS) {
        return GAP_LEAD_STANDS;
    }
    if (state == gap.lead || state == GAP_LEAD_STANDS || gap.lead == GAP_LEAD_STANDS ||
        gap.lead_cmps2 < LEAD_SURELY_CMPS2) {
        frames_other = 0;
        return state;
    }
    frames_other++;
    if (frames_other < (state == GAP_LEAD_BRAKES ? FRAMES_TO_BRAKES : FRAMES_TO_DRIVES)) {
        return gap.lead;
    }
    frames_other = 0;
    return state;
}
#endif

/* The speed that D and h depend on. */
/*@ requires gap_is_valid;
    assigns \nothing;
    ensures \result <= gap.own_cmps; */
static uint16_t speed_cmps(void)
{
    if (gap.lead != GAP_LEAD_DRIVES) {
        return gap.own_cmps;
    }
    return gap.own_cmps > gap.lead_cmps ? (uint16_t)(gap.own_cmps - gap.lead_cmps) : 0;
}

/* a * b / 1200, that is a * b / (2A). The sum of a and b is at most 10,000, so the product is at
 * most 25,000,000. The product by the reciprocal of 1200 / 512 is at most one too small. Then the
 * remainder, below 2,400, is 1200 or more. */
/*@ logic integer gap_over_2a(integer a, integer b) = a * b / 1200; */
/*@ requires a + b <= 2 * GAP_SPEED_MAX_CMPS;
    assigns \nothing;
    ensures tried: \result == gap_over_2a(a, b);
    ensures tried: \result <= 20833; */
static uint16_t over_2a_cm(uint16_t a, uint16_t b)
{
    uint32_t product = mul_u16(a, b);
    uint16_t quotient = mul_hi_u16((uint16_t)(product >> 9), 27962U);

    if ((uint16_t)((uint16_t)product - (uint16_t)(quotient * 1200U)) >= 1200U) {
        quotient++;
    }
    return quotient;
}

uint16_t gap_safe_cm(void)
{
    uint16_t v_cmps = speed_cmps();
    uint16_t safe_cm = (uint16_t)(mul_hi_u16((uint16_t)(v_cmps * 9U), 52429U) >> 3); /* / 10 */
    uint16_t braking_cm;

    /*@ assert safe_cm <= 4500; */
    if (gap.lead != GAP_LEAD_BRAKES) {
        return (uint16_t)(safe_cm + over_2a_cm(v_cmps, v_cmps) + STANDING_CM);
    }

    if (v_cmps >= gap.lead_cmps) {
        return (uint16_t)(safe_cm +
                          over_2a_cm((uint16_t)(v_cmps - gap.lead_cmps),
                                     (uint16_t)(v_cmps + gap.lead_cmps)) +
                          STANDING_CM);
    }
    braking_cm = over_2a_cm((uint16_t)(gap.lead_cmps - v_cmps), (uint16_t)(v_cmps + gap.lead_cmps));
    return (uint16_t)((safe_cm > braking_cm ? safe_cm - braking_cm : 0) + STANDING_CM);
}

/* product / divisor for a quotient below 65,536 and a divisor below 32,768: bit by bit, because a
 * table of reciprocals would be larger than this controller. */
/*@ requires 0 < divisor < 32768;
    assigns \nothing; */
static uint16_t divided(uint32_t product, uint16_t divisor)
{
    uint16_t rest = (uint16_t)(product >> 16);
    uint16_t bits = (uint16_t)product;
    uint8_t left = 16;

    /*@ loop invariant 1 <= left <= 16;
        loop assigns rest, bits, left;
        loop variant left; */
    do {
        rest = (uint16_t)(rest << 1);
        if (bits & 0x8000U) {
            rest |= 1;
        }
        bits = (uint16_t)(bits << 1);
        if (rest >= divisor) {
            rest -= divisor;
            bits |= 1;
        }
    } while (--left != 0); /* rounds: 16 */
    return bits;
}

/* 100 * diff_cmps / h_cs, where h_cs is at least 90 hundredths of a second: 5555 at most. */
/*@ requires diff_cmps <= GAP_SPEED_MAX_CMPS && 90 <= h_cs <= 923;
    assigns \nothing;
    ensures tried: \result == 100 * diff_cmps / h_cs;
    ensures tried: \result <= 5555; */
static uint16_t over_h_cmps2(uint16_t diff_cmps, uint16_t h_cs)
{
    return divided(mul_u16(diff_cmps, 100U), h_cs);
}

/*@ requires low <= high;
    assigns \nothing;
    ensures \result == \max(low, \min(value, high)); */
static int16_t limited(int16_t value, int16_t low, int16_t high)
{
    if (value < low) {
        return low;
    }
    return value > high ? high : value;
}

int16_t gap_lq_cmps2(void)
{
    int16_t error_cm = (int16_t)((int16_t)gap.safe_cm - (int16_t)gap.gap_cm);
    uint16_t size_cm = magnitude_i16(error_cm);
    uint16_t h_cs = (uint16_t)(90U + (mul_hi_u16(speed_cmps(), 43691U) >> 2)); /* / 6 */
    uint16_t fine = mul_u8((uint8_t)size_cm, 77);
    /* 77 / 256 is the weight, 0.3. */
    int16_t pull = (int16_t)(mul_u8((uint8_t)(size_cm >> 8), 77) + (uint8_t)(fine >> 8));

    if (error_cm < 0) {
        pull = (int16_t)-(pull + ((uint8_t)fine != 0));
    }
    if (gap.own_cmps >= gap.lead_cmps) {
        pull += (int16_t)over_h_cmps2((uint16_t)(gap.own_cmps - gap.lead_cmps), h_cs);
    } else {
        pull -= (int16_t)over_h_cmps2((uint16_t)(gap.lead_cmps - gap.own_cmps), h_cs);
    }
    return limited((int16_t)-pull, -GAP_ACCEL_MAX_CMPS2, GAP_ACCEL_MAX_CMPS2);
}

int16_t gap_fuzzy_cmps2(void)
{
    int16_t room_cm =
        limited((int16_t)((int16_t)gap.gap_cm - (int16_t)gap.safe_cm), ROOM_MIN_CM, ROOM_MAX_CM);
    int16_t opening_cmps = limited((int16_t)((int16_t)gap.lead_cmps - (int16_t)gap.own_cmps),
                                   -OPENING_MAX_CMPS, OPENING_MAX_CMPS);
    uint16_t row = (uint16_t)((uint16_t)(room_cm - ROOM_MIN_CM) << 2);
    uint16_t col = (uint16_t)((uint16_t)(opening_cmps + OPENING_MAX_CMPS) << 2);
    uint8_t level = lut_between(mul_hi_u16(row, ROOM_Q8), mul_hi_u16(col, OPENING_Q8));

    return (int16_t)((int16_t)(level - LEVEL_ZERO) * (1 << LEVEL_SHIFT));
}

/* --- beyond the published law ---------------------------------------------------------------- */

#ifndef GAP_AS_PUBLISHED

#define REACTION_Q8       90U /* 0.35 s */
#define MARGIN_CM         50
#define FULL_CMPS2        750U /* of the 800 */
#define SAFE_AGAIN_CMPS2  500U
#define SAFE_AGAIN_FRAMES 2
#define CRUISE_MAX_CMPS2  200

/* The own speed, 0.2 s behind when it changes evenly: a quarter of the difference is made up each
 * frame. UINT16_MAX: not known. */
static __idata uint16_t late_cmps;
static __idata uint8_t frames_safe; /* in a row, in EMERGENCY */
static __idata int16_t asked_cmps2; /* by the frame before */

/* x * 0.35 s */
/*@ assigns \nothing;
    ensures \result == x * REACTION_Q8 / 256; */
static uint16_t in_reaction(uint16_t x)
{
    return (uint16_t)(mul_u16(x, REACTION_Q8) >> 8);
}

/*@ assigns \nothing;
    ensures \result == \max(a - b, 0); */
static uint16_t less(uint16_t a, uint16_t b)
{
    return a > b ? (uint16_t)(a - b) : 0;
}

bool gap_is_too_late(uint16_t now_cmps2, uint16_t later_cmps2)
{
    uint16_t lead_decel_cmps2 = gap.lead_cmps2 < 0 ? (uint16_t)-gap.lead_cmps2 : 0;
    uint16_t own_cmps = less(gap.own_cmps, in_reaction(now_cmps2)); /* after the 0.35 s */
    uint16_t lead_cmps = less(gap.lead_cmps, in_reaction(lead_decel_cmps2));
    uint16_t own_way_cm = in_reaction((uint16_t)(gap.own_cmps + own_cmps)) >> 1;
    uint16_t lead_way_cm = in_reaction((uint16_t)(gap.lead_cmps + lead_cmps)) >> 1;
    int16_t room_cm = (int16_t)((int16_t)(gap.gap_cm + lead_way_cm) - (int16_t)own_way_cm);

    room_cm -= MARGIN_CM;
    if (room_cm < 0) {
        room_cm = 0;
    }
    if (mul_hi_u16((uint16_t)(own_cmps << 3), (uint16_t)(lead_decel_cmps2 << 3)) >
        mul_hi_u16((uint16_t)(lead_cmps << 3), (uint16_t)(later_cmps2 << 3))) {
        /* The lead stands before the car does: both ways of stopping count. */
        own_way_cm = divided(mul_u16(own_cmps, own_cmps), (uint16_t)(later_cmps2 << 1));
        lead_way_cm = divided(mul_u16(lead_cmps, lead_cmps), (uint16_t)(lead_decel_cmps2 << 1));
        return less(own_way_cm, lead_way_cm) > (uint16_t)room_cm;
    }
    /* The gap is smallest when the speeds are equal; if the car is faster, then it brakes harder,
     * too. */
    own_cmps = (uint16_t)(less(own_cmps, lead_cmps) << 3);
    return mul_hi_u16(own_cmps, own_cmps) >
           mul_hi_u16((uint16_t)((uint16_t)room_cm << 1),
                      (uint16_t)(less(later_cmps2, lead_decel_cmps2) << 6));
}

/* Holds from gap_init on. */
/*@ predicate gap_remembers =
        frames_other < FRAMES_TO_DRIVES &&
        (gap.state == GAP_EMERGENCY ==> frames_safe < SAFE_AGAIN_FRAMES) &&
        -GAP_ACCEL_MAX_CMPS2 <= asked_cmps2 <= GAP_ACCEL_MAX_CMPS2; */

/* How hard the car brakes: as its speed of the last 0.2 s says, but not more than demanded. */
/*@ requires gap_is_valid;
    assigns late_cmps;
    ensures \result <= GAP_ACCEL_MAX_CMPS2;
    ensures gap.accel_cmps2 >= 0 ==> \result == 0; */
static uint16_t own_decel_cmps2(void)
{
    uint16_t demanded_cmps2 = gap.accel_cmps2 < 0 ? (uint16_t)-gap.accel_cmps2 : 0;
    uint16_t slower_cmps;

    if (late_cmps <= gap.own_cmps || late_cmps == UINT16_MAX) {
        late_cmps = gap.own_cmps;
        return 0;
    }
    slower_cmps = (uint16_t)(late_cmps - gap.own_cmps);
    late_cmps -= slower_cmps >> 2;
    if (slower_cmps >= GAP_ACCEL_MAX_CMPS2 / 5) {
        return demanded_cmps2;
    }
    slower_cmps *= 5U;
    return slower_cmps < demanded_cmps2 ? slower_cmps : demanded_cmps2;
}

/* CONTROL or EMERGENCY. */
/*@ requires gap_is_valid && gap_remembers;
    assigns late_cmps, frames_safe;
    ensures \result == GAP_CONTROL || \result == GAP_EMERGENCY;
    ensures \result == GAP_EMERGENCY ==> frames_safe < SAFE_AGAIN_FRAMES;
    ensures gap_two_frames: gap.state == GAP_EMERGENCY && \result == GAP_CONTROL &&
                gap.gap_cm != GAP_MAX_CM ==> \old(frames_safe) + 1 >= SAFE_AGAIN_FRAMES; */
static uint8_t safe_state(void)
{
    uint16_t decel_cmps2 = own_decel_cmps2();

    if (gap.gap_cm == GAP_MAX_CM) {
        return GAP_CONTROL;
    }
    if (gap.state != GAP_EMERGENCY) {
        frames_safe = 0;
        return gap_is_too_late(decel_cmps2, FULL_CMPS2) ? GAP_EMERGENCY : GAP_CONTROL;
    }
    if (gap_is_too_late(0, SAFE_AGAIN_CMPS2)) {
        frames_safe = 0;
        return GAP_EMERGENCY;
    }
    frames_safe++;
    return frames_safe < SAFE_AGAIN_FRAMES ? GAP_EMERGENCY : GAP_CONTROL;
}

/* The published law's acceleration, limited by the set speed and by what the frame before asked
 * for; full brake in EMERGENCY. */
/*@ requires gap_is_valid && -GAP_ACCEL_MAX_CMPS2 <= law_cmps2 <= GAP_ACCEL_MAX_CMPS2;
    requires -GAP_ACCEL_MAX_CMPS2 <= asked_cmps2 <= GAP_ACCEL_MAX_CMPS2;
    assigns asked_cmps2;
    ensures -GAP_ACCEL_MAX_CMPS2 <= asked_cmps2 <= GAP_ACCEL_MAX_CMPS2;
    ensures \result == \min(\old(asked_cmps2), asked_cmps2);
    ensures gap.state == GAP_EMERGENCY ==> asked_cmps2 == -GAP_ACCEL_MAX_CMPS2; */
static int16_t safe_cmps2(int16_t law_cmps2)
{
    int16_t cruise_cmps2 = limited((int16_t)((int16_t)gap.set_cmps - (int16_t)gap.own_cmps),
                                   -CRUISE_MAX_CMPS2, GAP_ACCEL_MAX_CMPS2);
    int16_t before_cmps2 = asked_cmps2;

    if (gap.gap_cm == GAP_MAX_CM) {
        law_cmps2 = CRUISE_MAX_CMPS2;
    }
    asked_cmps2 = law_cmps2 < cruise_cmps2 ? law_cmps2 : cruise_cmps2;
    if (gap.state == GAP_EMERGENCY) {
        asked_cmps2 = -GAP_ACCEL_MAX_CMPS2;
    }
    return asked_cmps2 < before_cmps2 ? asked_cmps2 : before_cmps2;
}

#endif

/* --- outputs and states ---------------------------------------------------------------------- */

/*@ requires -GAP_ACCEL_MAX_CMPS2 <= gap.accel_cmps2 <= GAP_ACCEL_MAX_CMPS2;
    assigns gap.brake_pct, gap.throttle_us;
    ensures gap.accel_cmps2 < 0 ==> gap.brake_pct == (-gap.accel_cmps2 + 4) / 8 &&
                gap.throttle_us == GAP_THROTTLE_CLOSED_US;
    ensures gap.accel_cmps2 >= 0 ==> gap.brake_pct == 0 &&
                gap.throttle_us == GAP_THROTTLE_CLOSED_US + gap.accel_cmps2 + gap.accel_cmps2 / 4; */
static void set_outputs(void)
{
    uint16_t size_cmps2;

    gap.brake_pct = 0;
    gap.throttle_us = GAP_THROTTLE_CLOSED_US;
    if (gap.accel_cmps2 < 0) {
        size_cmps2 = (uint16_t)-gap.accel_cmps2;
        gap.brake_pct = (uint8_t)((size_cmps2 + 4U) >> 3);
    } else {
        size_cmps2 = (uint16_t)gap.accel_cmps2;
        gap.throttle_us = (uint16_t)(GAP_THROTTLE_CLOSED_US + size_cmps2 + (size_cmps2 >> 2));
    }
}

/*@ assigns asked_cmps2, frames_other, frames_safe, late_cmps;
    ensures gap_remembers; */
void gap_init(void)
{
    gap.state = GAP_WAITING;
    gap.stop = true;
    gap.brake_pct = 100;
    gap.throttle_us = GAP_THROTTLE_CLOSED_US;
    gap.accel_cmps2 = -GAP_ACCEL_MAX_CMPS2;
    gap.lead = GAP_LEAD_DRIVES;
#ifndef GAP_AS_PUBLISHED
    asked_cmps2 = -GAP_ACCEL_MAX_CMPS2;
    frames_other = 0;
    frames_safe = 0;
    late_cmps = UINT16_MAX;
#endif
}

bool gap_read(void)
{
    int16_t lead_cmps2 = (int16_t)frame_u16(6);

    if (frame_u16(0) > GAP_MAX_CM || frame_u16(2) > GAP_SPEED_MAX_CMPS ||
        frame_u16(4) > GAP_SPEED_MAX_CMPS || lead_cmps2 > GAP_LEAD_MAX_CMPS2 ||
        lead_cmps2 < -GAP_LEAD_MAX_CMPS2 || frame_body[8] > GAP_SET_MAX) {
        return false;
    }
    gap.gap_cm = frame_u16(0);
    gap.own_cmps = frame_u16(2);
    gap.lead_cmps = frame_u16(4);
    gap.lead_cmps2 = lead_cmps2;
    gap.set_cmps = mul_u8(frame_body[8], GAP_SET_STEP_CMPS);
    return true;
}

/* Both laws; in the images that compare them, the same one twice. */
#ifdef GAP_FUZZY_ALONE
#define ONE_LAW_CMPS2 gap_fuzzy_cmps2
#else
#define ONE_LAW_CMPS2 gap_lq_cmps2
#endif
#ifdef GAP_LQ_ALONE
#define OTHER_LAW_CMPS2 gap_lq_cmps2
#else
#define OTHER_LAW_CMPS2 gap_fuzzy_cmps2
#endif

/*@ requires gap_remembers;
    assigns asked_cmps2, frames_other, frames_safe, late_cmps;
    ensures gap_remembers;
    ensures gap_two_frames: gap.accel_cmps2 == \min(\old(asked_cmps2), asked_cmps2); */
void gap_decide(void)
{
    int16_t accel_cmps2;

#ifdef GAP_AS_PUBLISHED
    gap.state = GAP_CONTROL;
#else
    gap.state = safe_state();
#endif
    gap.stop = false;
    gap.lead = lead_state();
    gap.safe_cm = gap_safe_cm();
    accel_cmps2 = 0;
    if (gap.gap_cm != GAP_MAX_CM) {
        accel_cmps2 = (int16_t)(ONE_LAW_CMPS2() + OTHER_LAW_CMPS2());
    }
    /* The mean of both laws, rounded towards 0. */
    if (accel_cmps2 < 0) {
        accel_cmps2++;
    }
    accel_cmps2 >>= 1;
    if (gap.own_cmps < GAP_CREEP_CMPS && accel_cmps2 > -GAP_HOLD_CMPS2 &&
        accel_cmps2 < (gap.lead == GAP_LEAD_STANDS ? GAP_HOLD_CMPS2 : 0)) {
        accel_cmps2 = -GAP_HOLD_CMPS2;
    }
#ifdef GAP_AS_PUBLISHED
    gap.accel_cmps2 = accel_cmps2;
#else
    gap.accel_cmps2 = safe_cmps2(accel_cmps2);
#endif
    set_outputs();
}

/*@ requires gap_remembers;
    assigns asked_cmps2, late_cmps;
    ensures gap_remembers;
    ensures gap_silence: gap.brake_pct >= fault_pct && gap.brake_pct >= \old(gap.brake_pct) &&
                gap.throttle_us == GAP_THROTTLE_CLOSED_US; */
void gap_lose(uint8_t fault_pct)
{
    gap.state = GAP_FAULT;
    gap.throttle_us = GAP_THROTTLE_CLOSED_US;
    if (gap.brake_pct < fault_pct) {
        gap.brake_pct = fault_pct;
    }
    gap.accel_cmps2 = (int16_t)-(int16_t)mul_u8(gap.brake_pct, GAP_ACCEL_MAX_CMPS2 / 100);
#ifndef GAP_AS_PUBLISHED
    asked_cmps2 = gap.accel_cmps2;
    late_cmps = UINT16_MAX;
#endif
}
