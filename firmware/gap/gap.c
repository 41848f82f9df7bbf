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

struct gap gap;

static uint8_t lead_state(void)
{
    if (gap.lead_cmps <= LEAD_STANDS_CMPS) {
        return GAP_LEAD_STANDS;
    }
    return gap.lead_cmps2 >= LEAD_BRAKES_CMPS2 ? GAP_LEAD_DRIVES : GAP_LEAD_BRAKES;
}

/* The speed that D and h depend on. */
static uint16_t speed_cmps(void)
{
    if (gap.lead != GAP_LEAD_DRIVES) {
        return gap.own_cmps;
    }
    return gap.own_cmps > gap.lead_cmps ? (uint16_t)(gap.own_cmps - gap.lead_cmps) : 0;
}

/* a * b / 1200, that is a * b / (2A), for products up to 25,000,000. The product by the reciprocal
 * of 1200 / 512 is at most one too small. Then the remainder, below 2,400, is 1200 or more. */
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

/* 100 * diff_cmps / h_cs, where h_cs is at least 90 hundredths of a second. A division bit by bit,
 * because a table of 1 / h for all 834 values would be larger than this controller. The quotient
 * has 13 bits: 100 * 5000 / 90 is 5555. */
static uint16_t over_h_cmps2(uint16_t diff_cmps, uint16_t h_cs)
{
    uint32_t product = (uint32_t)mul_u16(diff_cmps, 100U) << 3; /* the 13 low bits are divided */
    uint16_t rest = (uint16_t)(product >> 16);
    uint16_t bits = (uint16_t)product;
    uint8_t left = 13;

    do {
        rest = (uint16_t)(rest << 1);
        if (bits & 0x8000U) {
            rest |= 1;
        }
        bits = (uint16_t)(bits << 1);
        if (rest >= h_cs) {
            rest -= h_cs;
            bits |= 1;
        }
    } while (--left != 0); /* rounds: 13 */
    return bits & 0x1FFFU;
}

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

void gap_init(void)
{
    gap.state = GAP_WAITING;
    gap.stop = true;
    gap.brake_pct = 100;
    gap.throttle_us = GAP_THROTTLE_CLOSED_US;
    gap.accel_cmps2 = -GAP_ACCEL_MAX_CMPS2;
}

bool gap_read(void)
{
    uint16_t gap_cm = frame_u16(0);
    uint16_t own_cmps = frame_u16(2);
    uint16_t lead_cmps = frame_u16(4);
    int16_t lead_cmps2 = (int16_t)frame_u16(6);

    if (gap_cm > GAP_MAX_CM || own_cmps > GAP_SPEED_MAX_CMPS || lead_cmps > GAP_SPEED_MAX_CMPS ||
        lead_cmps2 > GAP_LEAD_MAX_CMPS2 || lead_cmps2 < -GAP_LEAD_MAX_CMPS2) {
        return false;
    }
    gap.gap_cm = gap_cm;
    gap.own_cmps = own_cmps;
    gap.lead_cmps = lead_cmps;
    gap.lead_cmps2 = lead_cmps2;
    return true;
}

void gap_decide(void)
{
    int16_t accel_cmps2;

    gap.state = GAP_CONTROL;
    gap.stop = false;
    gap.lead = lead_state();
    gap.safe_cm = gap_safe_cm();
    accel_cmps2 = 0;
    if (gap.gap_cm != GAP_MAX_CM) {
        accel_cmps2 = (int16_t)(gap_lq_cmps2() + gap_fuzzy_cmps2());
    }
    /* The mean of both laws, rounded towards 0. */
    if (accel_cmps2 < 0) {
        accel_cmps2++;
    }
    accel_cmps2 >>= 1;
    if (gap.own_cmps < GAP_CREEP_CMPS && accel_cmps2 < 0 && accel_cmps2 > -GAP_HOLD_CMPS2) {
        accel_cmps2 = -GAP_HOLD_CMPS2;
    }
    gap.accel_cmps2 = accel_cmps2;
    set_outputs();
}

void gap_lose(uint8_t fault_pct)
{
    gap.state = GAP_FAULT;
    gap.throttle_us = GAP_THROTTLE_CLOSED_US;
    if (gap.brake_pct < fault_pct) {
        gap.brake_pct = fault_pct;
    }
    gap.accel_cmps2 = (int16_t)-(int16_t)mul_u8(gap.brake_pct, GAP_ACCEL_MAX_CMPS2 / 100);
}
