/* SPDX-License-Identifier: MIT */
/* The parking decision: two steering laws, their blend, and when to stand. */
#include "park.h"
#include "cordic.h"
#include "fixed.h"
#include "frame.h"
#include "lut.h"
#include "plan.h"

#if LUT_INPUTS != 1 || LUT_LEVELS != 255
#error "park needs w(D) as a table of one input in 255 levels: fistab table --grid=256 --levels=255"
#endif

#define QUARTER_TURN 16384U

/* From 1/512 m * CORDIC_GAIN to mm: 1000 / 512 / 1.646760 = 1 + 12192 / 65536. */
#define MM_OVER_1_Q16 12192U

/* From X in 1/512 m to X / 8 rad (X in m) in 65,536ths of a turn:
 * 65536 / (2 pi) / 4096 = 2 + 35814 / 65536. */
#define NEAR_OVER_2_Q16 35814U

__idata struct park park;

/* The check of the start has ended well. As published there is none. */
static bool is_checked;

/*@ assigns is_checked; */
void park_init(void)
{
#ifdef PARK_AS_PUBLISHED
    is_checked = true;
#else
    is_checked = false;
#endif
    park.theta = 0;
    park.servo_us = PARK_SERVO_MID_US;
    park.state = PARK_WAITING;
}

/*@ assigns \nothing;
    ensures \result == (theta > PARK_THETA_MAX_TURN16    ? PARK_THETA_MAX_TURN16
                        : theta < -PARK_THETA_MAX_TURN16 ? -PARK_THETA_MAX_TURN16 : theta); */
static int16_t limited(int32_t theta)
{
    if (theta > PARK_THETA_MAX_TURN16) {
        return PARK_THETA_MAX_TURN16;
    }
    if (theta < -PARK_THETA_MAX_TURN16) {
        return -PARK_THETA_MAX_TURN16;
    }
    return (int16_t)theta;
}

/* w(D) of the table; beyond its ends its first or last cell. */
/*@ assigns \nothing; */
static uint8_t weight_at(uint16_t dist_mm)
{
    uint16_t cell;

    if (dist_mm < (uint16_t)LUT_IN1_MIN_MILLI) {
        return lut_at(0, 0);
    }
    dist_mm -= (uint16_t)LUT_IN1_MIN_MILLI;
    if (dist_mm >= (uint16_t)LUT_IN1_SPAN_MILLI) {
        return lut_at((uint8_t)(LUT_IN1_CELLS - 1), 0);
    }
    cell = mul_hi_u16(dist_mm, LUT_IN1_MUL) >> LUT_IN1_SHIFT;
    return lut_at((uint8_t)cell, 0);
}

/*@ requires -PARK_THETA_MAX_TURN16 <= far_law <= PARK_THETA_MAX_TURN16;
    requires -PARK_THETA_MAX_TURN16 <= near_law <= PARK_THETA_MAX_TURN16;
    assigns \nothing;
    ensures \min(far_law, near_law) <= \result <= \max(far_law, near_law); */
static int16_t blended(int16_t far_law, int16_t near_law, uint8_t weight)
{
    int16_t more = far_law - near_law; /* -16384..16384 */
    int16_t part;

    if (weight == 255) {
        return far_law;
    }
    /* 255 means 1. The weight in 256ths is weight + weight / 128. */
    part = (int16_t)mul_hi_u16(magnitude_i16(more),
                               (uint16_t)((uint16_t)(weight + (weight >> 7)) << 8));
    return more < 0 ? near_law - part : near_law + part;
}

/*@ assigns cordic_polar; */
void park_steer(void)
{
    int16_t delta = (int16_t)(park.heading - QUARTER_TURN);
    int32_t across =
        (int32_t)magnitude_i16(park.x) * 2 + mul_hi_u16(magnitude_i16(park.x), NEAR_OVER_2_Q16);
    int16_t line; /* -phi */

    cordic_to_polar(park.x, park.y);
    line = cordic_polar.angle;
    park.dist_mm = cordic_polar.length + mul_hi_u16(cordic_polar.length, MM_OVER_1_Q16);
    park.weight = weight_at(park.dist_mm);

    /* delta + line is an angle and wraps in 16 bits; the other sums must not wrap. */
    park.theta_far =
        limited((int32_t)line * 3 + (int32_t)(int16_t)((uint16_t)delta + (uint16_t)line) * 2);
    park.theta_near = limited((park.x < 0 ? -across : across) + delta);
    park.theta = blended(park.theta_far, park.theta_near, park.weight);
}

bool park_read(void)
{
    int16_t x = (int16_t)frame_u16(0);
    int16_t y = (int16_t)frame_u16(2);

    if (x < -PARK_X_MAX_512 || x > PARK_X_MAX_512 || y < PARK_Y_MIN_512 || y > PARK_Y_MAX_512) {
        return false;
    }
    park.x = x;
    park.y = y;
    park.heading = frame_u16(4);
    return true;
}

/* In these states a way is being driven in thought. */
/*@ predicate park_plans = park.state == PARK_CHECKING || park.state == PARK_DEAD_ZONE ||
        park.state == PARK_READY ==> plan_is_valid; */

/* The next step of the check. */
/*@ requires park_is_valid && park_plans && park.state != PARK_DEAD_ZONE &&
        park.state != PARK_READY;
    assigns park.state, park.x, park.y, park.heading, park.dist_mm, park.weight, park.theta_far,
            park.theta_near, park.theta, x, y, heading, steps_left, cordic_polar, is_checked;
    ensures park_is_valid && park_plans;
    ensures park.x == \old(park.x) && park.y == \old(park.y) &&
                park.heading == \old(park.heading);
    ensures park.state == PARK_CHECKING || park.state == PARK_DEAD_ZONE; */
static void check(void)
{
    if (park.state != PARK_CHECKING) {
        park.state = PARK_CHECKING;
        plan_begin();
    }
    switch (plan_step()) {
    case PLAN_GOES_ON:
        break;
    case PLAN_PARKS:
        is_checked = true;
        break;
    default:
        park.state = PARK_DEAD_ZONE;
        plan_begin();
    }
}

/* The next step of the check from where the car is by now. */
/*@ requires park_is_valid && plan_is_valid;
    assigns park.state, park.x, park.y, park.heading, park.dist_mm, park.weight, park.theta_far,
            park.theta_near, park.theta, x, y, heading, steps_left, cordic_polar;
    ensures park_is_valid && plan_is_valid;
    ensures park.x == \old(park.x) && park.y == \old(park.y) &&
                park.heading == \old(park.heading);
    ensures park.state == \old(park.state) || park.state == PARK_DEAD_ZONE ||
                park.state == PARK_READY; */
static void check_again(void)
{
    switch (plan_step()) {
    case PLAN_GOES_ON:
        return;
    case PLAN_PARKS:
        park.state = PARK_READY;
        break;
    default:
        park.state = PARK_DEAD_ZONE;
    }
    plan_begin();
}

/*@ requires park_plans;
    assigns x, y, heading, steps_left, cordic_polar, is_checked;
    ensures park_plans; */
void park_decide(void)
{
    uint16_t off_us;

    if (park.state == PARK_ARRIVED) {
        return;
    }
    if (park.state == PARK_DEAD_ZONE || park.state == PARK_READY) {
        check_again();
        return;
    }
    if (park.y <= 0) {
        park.state = PARK_ARRIVED;
        return;
    }
    if (!is_checked) {
        check();
        return;
    }
    park.state = PARK_DRIVING;
    park_steer();
    /* 500 us / 8192 is 4000 / 65536. */
    off_us = mul_hi_u16(magnitude_i16(park.theta), 4000U);
    park.servo_us = park.theta < 0 ? PARK_SERVO_MID_US - off_us : PARK_SERVO_MID_US + off_us;
}

void park_lose(void)
{
    if (park.state == PARK_DRIVING || park.state == PARK_CHECKING) {
        park.state = PARK_FAULT;
    }
}

bool park_must_stand(void)
{
    return park.state != PARK_DRIVING;
}
