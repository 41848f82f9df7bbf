/* SPDX-License-Identifier: MIT */
/* Closing speed. Inside, a speed is a signed number of 2 mm/s, positive when closing. */
#include "closing.h"
#include "cc51.h"
#include "fixed.h"

__data struct closing_speed closing_difference, closing_smooth;
uint8_t closing_samples, closing_span_cs;

static uint16_t place_mm; /* believed last */
static uint8_t since_cs;  /* since then; 255: long */
static __bit has_aside;   /* and one that was not */
static uint16_t aside_mm;
static uint8_t since_aside_cs;

/* Alpha-beta's place of the target and its speed; both wait for closing_expect where they are due.
 */
static uint16_t smooth_mm;
static int16_t smooth_2mmps;
static __bit is_place_due, is_speed_due;

/* What the next reading is taken from, where this target's lies if it is believed, and the rate of
 * its time, or of that since the one aside. */
static uint16_t before_mm;
static uint16_t gate_from_mm, gate_span_mm;
static uint16_t rate, rate_aside; /* out of RATES */

/* Of the reading believed last: how far it lies from where alpha-beta saw the target. */
static uint16_t off_mm;
static __bit is_further;

/* 1 mm in n/100 s is 100 / n mm/s, that is 50 / n units. Times 65536 / 16 for n = 5..31. */
#define RATE(n) ((3276800UL / 16U + (n) - 1U) / (n))
static const uint16_t __code RATES[] = {
    RATE(5),  RATE(6),  RATE(7),  RATE(8),  RATE(9),  RATE(10), RATE(11), RATE(12), RATE(13),
    RATE(14), RATE(15), RATE(16), RATE(17), RATE(18), RATE(19), RATE(20), RATE(21), RATE(22),
    RATE(23), RATE(24), RATE(25), RATE(26), RATE(27), RATE(28), RATE(29), RATE(30), RATE(31),
};

/* How far that speed brings the target nearer; at most 1 mm off. */
static int16_t travel_mm(int16_t speed_2mmps, uint8_t elapsed_cs)
{
    /* elapsed * 65536 / 50 */
    uint16_t factor = (uint16_t)(mul_u8(elapsed_cs, 5U) << 8) + mul_u8(elapsed_cs, 31U);

    if (speed_2mmps >= 0) {
        return (int16_t)mul_hi_u16((uint16_t)speed_2mmps, factor);
    }
    return -(int16_t)mul_hi_u16((uint16_t)-speed_2mmps, factor);
}

/* Believes no reading. */
static void shut_gate(void)
{
    closing_samples = 0;
    gate_from_mm = 65535U;
    gate_span_mm = 0;
}

void closing_restart(void)
{
    shut_gate();
    has_aside = false;
    is_speed_due = false;
    smooth_2mmps = 0;
    closing_smooth.closing_mmps = 0;
    closing_smooth.opening_mmps = 0;
    closing_difference.closing_mmps = 0;
    closing_difference.opening_mmps = 0;
}

static uint8_t later_cs(uint8_t time_cs, uint8_t elapsed_cs)
{
    return time_cs + elapsed_cs < 255 ? (uint8_t)(time_cs + elapsed_cs) : 255;
}

void closing_expect(uint8_t elapsed_cs)
{
    uint16_t gate_mm = CLOSING_GATE_MM;

    if (elapsed_cs < CLOSING_ELAPSED_MIN_CS) { /* RATES begins there */
        elapsed_cs = CLOSING_ELAPSED_MIN_CS;
    }
    if (is_place_due) {
        uint16_t part_mm = off_mm >> 2;

        is_place_due = false;
        smooth_mm = is_further ? place_mm - part_mm : place_mm + part_mm;
    }
    if (is_speed_due) { /* nothing to smooth yet */
        is_speed_due = false;
        smooth_mm = place_mm;
        smooth_2mmps = (int16_t)(closing_smooth.closing_mmps >> 1) -
                       (int16_t)(closing_smooth.opening_mmps >> 1);
    }
    before_mm = place_mm;
    since_cs = later_cs(since_cs, elapsed_cs);
    since_aside_cs = later_cs(since_aside_cs, elapsed_cs);
    if (since_aside_cs > CLOSING_ELAPSED_MAX_CS) {
        has_aside = false;
    } else {
        rate_aside = RATES[since_aside_cs - CLOSING_ELAPSED_MIN_CS];
    }
    if (since_cs > CLOSING_ELAPSED_MAX_CS) {
        shut_gate(); /* too long: whatever comes is another target */
    }
    if (closing_samples == 0) {
        return;
    }
    rate = RATES[since_cs - CLOSING_ELAPSED_MIN_CS];
    if (closing_samples == 1) {
        gate_mm = (uint16_t)(mul_u8(since_cs, CLOSING_REACH_MM_PER_CS / 2U) << 1);
    }
    gate_from_mm = (uint16_t)(smooth_mm - (uint16_t)travel_mm(smooth_2mmps, since_cs) - gate_mm);
    gate_span_mm = (uint16_t)(gate_mm << 1);
}

/* A reading that is not within the gate. */
static bool take_stranger(uint16_t dist_mm)
{
    if (closing_samples == 0) {
        closing_restart();
        smooth_mm = dist_mm;
        return true;
    }
    if (!has_aside || (uint16_t)(dist_mm - aside_mm + CLOSING_GATE_MM) > 2U * CLOSING_GATE_MM) {
        has_aside = true;
        aside_mm = dist_mm;
        since_aside_cs = 0;
        return false;
    }
    before_mm = aside_mm;
    since_cs = since_aside_cs;
    rate = rate_aside;
    closing_samples = 1;
    return true;
}

bool closing_update(uint16_t dist_mm)
{
    off_mm = dist_mm - gate_from_mm; /* for now from the gate's end */
    if (off_mm > gate_span_mm && !take_stranger(dist_mm)) {
        return false;
    }
    has_aside = false;
    place_mm = dist_mm;
    closing_span_cs = since_cs;
    since_cs = 0;
    if (closing_samples < 3) {
        closing_samples++;
        if (closing_samples == 2) {
            closing_take_difference();
            closing_smooth.closing_mmps = closing_difference.closing_mmps;
            closing_smooth.opening_mmps = closing_difference.opening_mmps;
            is_speed_due = true;
        }
    }
    return true;
}

/* So many mm at `rate`, in 2 mm/s, doubled. Up to 4095 mm count. */
void closing_take_difference(void)
{
    uint16_t moved_mm = before_mm - place_mm;
    __bit is_nearer = true;

    if ((int16_t)moved_mm < 0) {
        moved_mm = place_mm - before_mm;
        is_nearer = false;
    }
    if ((uint8_t)(moved_mm >> 8) >= 16U) {
        moved_mm = 4095U;
    }
    moved_mm = (uint16_t)(moved_mm << 4);
    moved_mm = mul_hi_bytes((uint8_t)(moved_mm >> 8), (uint8_t)moved_mm, (uint8_t)(rate >> 8),
                            (uint8_t)rate);
    moved_mm = (uint16_t)(moved_mm << 1);
    if (is_nearer) {
        closing_difference.closing_mmps = moved_mm;
        closing_difference.opening_mmps = 0;
    } else {
        closing_difference.closing_mmps = 0;
        closing_difference.opening_mmps = moved_mm;
    }
}

void closing_take_smooth(void)
{
    uint16_t part_2mmps;

    is_place_due = true;
    if (off_mm >= CLOSING_GATE_MM) {
        off_mm = (uint16_t)(off_mm - CLOSING_GATE_MM);
        is_further = true;
    } else {
        off_mm = (uint16_t)(CLOSING_GATE_MM - off_mm);
        is_further = false;
    }
    /* A quarter of what closing_take_difference says of so many mm: CLOSING_GATE_MM at most, no sum
     * overflows. */
    part_2mmps = mul_u8((uint8_t)off_mm, (uint8_t)rate) >> 8;
    part_2mmps += mul_u8((uint8_t)off_mm, (uint8_t)(rate >> 8));
    if ((uint8_t)(off_mm >> 8) != 0) {
        part_2mmps += rate;
    }
    part_2mmps >>= 6;
    if (is_further) {
        smooth_2mmps -= (int16_t)part_2mmps;
    } else {
        smooth_2mmps += (int16_t)part_2mmps;
    }
    if (smooth_2mmps >= 0) {
        closing_smooth.closing_mmps = (uint16_t)((uint16_t)smooth_2mmps << 1);
        closing_smooth.opening_mmps = 0;
    } else {
        closing_smooth.closing_mmps = 0;
        closing_smooth.opening_mmps = (uint16_t)((uint16_t)-smooth_2mmps << 1);
    }
}
