/* Closing speed. Inside, a speed is a signed number of 2 mm/s, positive when closing. */
#include "closing.h"
#include "cc51.h"
#include "fixed.h"

__data struct closing_speed closing_difference, closing_smooth;
uint8_t closing_samples, closing_span_cs;

static uint16_t last_mm;       /* believed */
static uint16_t smooth_mm;     /* alpha-beta's place of the target */
static int16_t smooth_2mmps;   /* and its speed */
static uint8_t since_cs;       /* since last_mm; 255: long */
static uint16_t aside_mm;      /* not believed; 0: none */
static uint8_t since_aside_cs;

/* Where and how near to it the next reading of this target is expected, and its time's rate. */
static uint16_t expected_mm;
static uint16_t gate_mm;
static uint16_t rate; /* out of RATES, of the time between the last two readings believed */

/* Of the reading believed last: */
static uint16_t moved_mm;      /* how far it lies from the one before, */
static bool is_nearer;
static uint16_t off_mm;        /* and from where alpha-beta saw the target */
static bool is_further;

/* 1 mm in n/100 s is 100 / n mm/s, that is 50 / n units. Times 65536 / 16 for n = 4..31. */
#define RATE(n) ((3276800UL / 16U + (n) - 1U) / (n))
static const uint16_t __code RATES[] = {
    RATE(4),  RATE(5),  RATE(6),  RATE(7),  RATE(8),  RATE(9),  RATE(10), RATE(11), RATE(12), RATE(13),
    RATE(14), RATE(15), RATE(16), RATE(17), RATE(18), RATE(19), RATE(20), RATE(21), RATE(22), RATE(23),
    RATE(24), RATE(25), RATE(26), RATE(27), RATE(28), RATE(29), RATE(30), RATE(31),
};

/* So far at `rate`. Up to 4095 mm count. */
static uint16_t speed_2mmps(uint16_t mm)
{
    if (mm > 4095U) {
        mm = 4095U;
    }
    return mul_hi_u16((uint16_t)(mm << 4), rate);
}

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

static bool is_within(int16_t apart_mm, uint16_t limit_mm)
{
    return (apart_mm >= 0 ? (uint16_t)apart_mm : (uint16_t)-apart_mm) <= limit_mm;
}

static void publish(struct closing_speed __data *speed, int16_t speed_2mmps)
{
    speed->closing_mmps = 0;
    speed->opening_mmps = 0;
    if (speed_2mmps >= 0) {
        speed->closing_mmps = (uint16_t)((uint16_t)speed_2mmps << 1);
    } else {
        speed->opening_mmps = (uint16_t)((uint16_t)-speed_2mmps << 1);
    }
}

static void start(uint16_t dist_mm)
{
    last_mm = smooth_mm = dist_mm;
    smooth_2mmps = 0;
    closing_samples = 1;
}

void closing_restart(void)
{
    closing_samples = 0;
    aside_mm = 0;
    publish(&closing_difference, 0);
    publish(&closing_smooth, 0);
}

void closing_expect(uint8_t elapsed_cs)
{
    since_cs = since_cs + elapsed_cs < 255 ? (uint8_t)(since_cs + elapsed_cs) : 255;
    since_aside_cs = since_aside_cs + elapsed_cs < 255 ? (uint8_t)(since_aside_cs + elapsed_cs) : 255;
    if (since_cs > CLOSING_ELAPSED_MAX_CS) {
        closing_samples = 0; /* too long: whatever comes is another target */
    }
    if (closing_samples == 0) {
        return;
    }
    rate = RATES[since_cs - CLOSING_ELAPSED_MIN_CS];
    expected_mm = smooth_mm - (uint16_t)travel_mm(smooth_2mmps, since_cs);
    gate_mm = CLOSING_GATE_MM;
    if (closing_samples == 1) {
        gate_mm = (uint16_t)(mul_u8(since_cs, CLOSING_REACH_MM_PER_CS / 2U) << 1);
    }
}

bool closing_update(uint16_t dist_mm)
{
    if (closing_samples == 0) {
        closing_restart();
        start(dist_mm);
        since_cs = 0;
        return true;
    }

    off_mm = dist_mm - expected_mm;
    if ((int16_t)off_mm < 0) {
        off_mm = expected_mm - dist_mm;
        is_further = false;
    } else {
        is_further = true;
    }
    if (off_mm > gate_mm) {
        int16_t off_aside_mm = (int16_t)(dist_mm - aside_mm);

        if (aside_mm == 0 || since_aside_cs > CLOSING_ELAPSED_MAX_CS ||
            !is_within(off_aside_mm, CLOSING_GATE_MM)) {
            aside_mm = dist_mm;
            since_aside_cs = 0;
            return false;
        }
        start(aside_mm);
        since_cs = since_aside_cs;
        rate = RATES[since_cs - CLOSING_ELAPSED_MIN_CS];
    }
    aside_mm = 0;

    moved_mm = last_mm - dist_mm;
    is_nearer = true;
    if (dist_mm > last_mm) {
        moved_mm = dist_mm - last_mm;
        is_nearer = false;
    }
    last_mm = dist_mm;
    closing_span_cs = since_cs;
    since_cs = 0;
    if (closing_samples == 1) { /* nothing to smooth yet */
        closing_samples = 2;
        closing_take_difference();
        smooth_mm = dist_mm;
        smooth_2mmps = closing_difference.closing_mmps != 0 ? (int16_t)(closing_difference.closing_mmps >> 1)
                                                            : -(int16_t)(closing_difference.opening_mmps >> 1);
        publish(&closing_smooth, smooth_2mmps);
    } else {
        closing_samples = 3;
    }
    return true;
}

void closing_take_difference(void)
{
    uint16_t difference_2mmps = speed_2mmps(moved_mm);

    publish(&closing_difference, is_nearer ? (int16_t)difference_2mmps : -(int16_t)difference_2mmps);
}

void closing_take_smooth(void)
{
    uint16_t part_mm = off_mm >> 2, part_2mmps = speed_2mmps(off_mm) >> 2;

    if (is_further) {
        smooth_mm = last_mm - part_mm;
        smooth_2mmps -= (int16_t)part_2mmps;
    } else {
        smooth_mm = last_mm + part_mm;
        smooth_2mmps += (int16_t)part_2mmps;
    }
    publish(&closing_smooth, smooth_2mmps);
}
