/* SPDX-License-Identifier: MIT */
/* The way to the place, driven in thought. */
#include "plan.h"
#include "cordic.h"
#include "fixed.h"

#define HALF_TURN    32768U
#define QUARTER_TURN 16384U

/* One step turns the car by this much at 45 degrees, in 65,536ths of a turn:
 * 65536 / (2 pi) * 250 mm / PARK_AXLES_MM. */
#define STEP_TURN ((uint16_t)((2607594UL + PARK_AXLES_MM / 2) / PARK_AXLES_MM))

#define IN_512(mm) ((uint16_t)((mm) * 512UL / 1000UL))

/* So near to the line of the place the car must be in front of it. */
#define LINE_Y_512 64
#define LINE_X_512 512

/* sin(i * 90 / 64 degrees) * 32768, i = 0..64, at most 32767. */
#define SINES 65
static const int16_t __code sines_q15[SINES] = {
    0,     804,   1608,  2411,  3212,  4011,  4808,  5602,  6393,  7180,  7962,  8740,  9512,
    10279, 11039, 11793, 12540, 13279, 14010, 14733, 15447, 16151, 16846, 17531, 18205, 18868,
    19520, 20160, 20788, 21403, 22006, 22595, 23170, 23732, 24279, 24812, 25330, 25833, 26320,
    26791, 27246, 27684, 28106, 28511, 28899, 29269, 29622, 29957, 30274, 30572, 30853, 31114,
    31357, 31581, 31786, 31972, 32138, 32286, 32413, 32522, 32610, 32679, 32729, 32758, 32767,
};

/* tan(i * 45 / 32 degrees) * 65536, i = 0..32, at most 65535. */
#define TANGENTS 33
static const uint16_t __code tangent_q16[TANGENTS] = {
    0,     1609,  3220,  4834,  6455,  8083,  9721,  11372, 13036, 14717, 16416,
    18136, 19880, 21650, 23449, 25280, 27146, 29050, 30996, 32988, 35030, 37126,
    39281, 41500, 43790, 46156, 48605, 51145, 53784, 56532, 59398, 62395, 65535,
};

static __idata int16_t x, y; /* the place on the way, as in `park` */
static __idata uint16_t heading;
static __idata uint16_t steps_left;

/*@ predicate plan_is_valid =
        -PARK_X_MAX_512 <= x <= PARK_X_MAX_512 && PARK_Y_MIN_512 <= y <= PARK_Y_MAX_512 &&
        steps_left <= PLAN_STEPS_MAX; */

/* more * fraction / 256, rounded down. Always inline, so that its callers call nothing: SDCC keeps
 * their variables in bytes that they share. */
/*@ requires more <= 4096;
    assigns \nothing;
    ensures \result == more * fraction / 256;
    ensures \result <= more; */
static inline uint16_t part(uint16_t more, uint8_t fraction)
{
    return (uint16_t)(mul_u8((uint8_t)(more >> 8), fraction) +
                      (mul_u8((uint8_t)more, fraction) >> 8));
}

int16_t plan_sine_q15(uint16_t angle_turn16)
{
    uint16_t within = angle_turn16 % QUARTER_TURN;
    uint8_t at;
    int16_t sine;

    if (angle_turn16 & QUARTER_TURN) {
        within = QUARTER_TURN - within;
    }
    at = (uint8_t)(within >> 8);
    /*@ split at; */
    sine = sines_q15[at];
    if (at < SINES - 1) {
        sine += (int16_t)part((uint16_t)(sines_q15[(uint8_t)(at + 1)] - sine), (uint8_t)within);
    }
    return angle_turn16 & HALF_TURN ? (int16_t)-sine : sine;
}

/* The tangent of 0..PARK_THETA_MAX_TURN16, times 65536; right to 25. */
/*@ requires angle_turn16 <= PARK_THETA_MAX_TURN16;
    assigns \nothing; */
static uint16_t tangent(uint16_t angle_turn16)
{
    uint8_t at = (uint8_t)(angle_turn16 >> 8);
    uint16_t low = tangent_q16[at];

    if (at == TANGENTS - 1) {
        return low;
    }
    return low + part((uint16_t)(tangent_q16[(uint8_t)(at + 1)] - low), (uint8_t)angle_turn16);
}

/*@ assigns park.x, park.y, park.heading, x, y, heading;
    ensures park.x == \old(x) && park.y == \old(y) && park.heading == \old(heading);
    ensures x == \old(park.x) && y == \old(park.y) && heading == \old(park.heading); */
static void swap(void)
{
    int16_t number;
    uint16_t angle;

    number = park.x;
    park.x = x;
    x = number;
    number = park.y;
    park.y = y;
    y = number;
    angle = park.heading;
    park.heading = heading;
    heading = angle;
}

/* A part of the step of 0.25 m, which is 128 in 1/512 m: 128 * sine / 32768, rounded to the
 * nearest. */
/*@ requires -32767 <= sine_q15 <= 32767;
    assigns \nothing;
    ensures -128 <= \result <= 128; */
static int16_t of_step(int16_t sine_q15)
{
    uint16_t raised = (uint16_t)sine_q15 + HALF_TURN; /* 1..65535: sine_q15 + 32768 */

    return (int16_t)(((raised / 128U + 1U) / 2U) - 128U);
}

/* Moves by one step backwards: along the circle, in the direction that the car has half way. */
/*@ requires plan_is_valid && -PARK_THETA_MAX_TURN16 <= theta <= PARK_THETA_MAX_TURN16;
    assigns x, y, heading;
    ensures \old(x) - 128 <= x <= \old(x) + 128 && \old(y) - 128 <= y <= \old(y) + 128; */
static void move(int16_t theta)
{
    uint16_t turn = mul_hi_u16(tangent(magnitude_i16(theta)), STEP_TURN);
    uint16_t half = turn >> 1;

    if (theta > 0) {
        turn = 0U - turn;
        half = 0U - half;
    }
    heading += half;
    x -= of_step(plan_sine_q15(heading + QUARTER_TURN));
    y -= of_step(plan_sine_q15(heading));
    heading += (uint16_t)(turn - half);
}

/* Whether the car is in the place, on the line Y = 0: its front end, at worst, is off by what the
 * rear axle is off and by what the angle adds. The rear end is nearer to the axle. A car that came
 * to the line backwards cannot stand the wrong way round. */
/*@ assigns \nothing; */
static bool is_in_place(void)
{
    uint16_t off_512 = magnitude_i16(x);

    off_512 += mul_hi_u16(magnitude_i16(plan_sine_q15(heading + QUARTER_TURN)),
                          2U * IN_512(PLAN_FRONT_MM));
    return off_512 <= IN_512(PLAN_ROOM_MM);
}

/*@ assigns x, y, heading, steps_left;
    ensures plan_is_valid; */
void plan_begin(void)
{
    x = park.x;
    y = park.y;
    heading = park.heading;
    steps_left = PLAN_STEPS_MAX;
}

/*@ requires plan_is_valid;
    assigns x, y, heading, steps_left, cordic_polar;
    ensures \result != PLAN_DEAD_ZONE ==> plan_is_valid; */
uint8_t plan_step(void)
{
    if (y <= 0) {
        return is_in_place() ? PLAN_PARKS : PLAN_DEAD_ZONE;
    }
    if (steps_left == 0 || (y < LINE_Y_512 && magnitude_i16(x) > LINE_X_512)) {
        return PLAN_DEAD_ZONE;
    }
    steps_left--;
    swap();
    park_steer();
    swap();
    move(park.theta);
    return magnitude_i16(x) > PLAN_X_MAX_512 || y > PLAN_Y_MAX_512 ? PLAN_DEAD_ZONE : PLAN_GOES_ON;
}
