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

/* 1 mm in n/100 s is 100 / n mm/s, that is 50 / n units. Times 65536 / 16 for n = 4..31. */
#define RATE(n) ((3276800UL / 16U + (n) - 1U) / (n))
static const uint16_t __code RATES[] = {
    RATE(4),  RATE(5),  RATE(6),  RATE(7),  RATE(8),  RATE(9),  RATE(10), RATE(11), RATE(12), RATE(13),
    RATE(14), RATE(15), RATE(16), RATE(17), RATE(18), RATE(19), RATE(20), RATE(21), RATE(22), RATE(23),
    RATE(24), RATE(25), RATE(26), RATE(27), RATE(28), RATE(29), RATE(30), RATE(31),
};

/* So far at a rate out of RATES. Up to 4095 mm count. */
static uint16_t speed_2mmps(uint16_t mm, uint16_t rate)
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

static bool is_within(int16_t off_mm, uint16_t limit_mm)
{
    return (off_mm >= 0 ? (uint16_t)off_mm : (uint16_t)-off_mm) <= limit_mm;
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

void closing_skip(uint8_t elapsed_cs)
{
    since_cs = since_cs + elapsed_cs < 255 ? (uint8_t)(since_cs + elapsed_cs) : 255;
    since_aside_cs = since_aside_cs + elapsed_cs < 255 ? (uint8_t)(since_aside_cs + elapsed_cs) : 255;
}

bool closing_update(uint16_t dist_mm, uint8_t elapsed_cs)
{
    uint16_t gate_mm = CLOSING_GATE_MM, off_mm, rate;
    int16_t further_mm, difference_2mmps;

    closing_skip(elapsed_cs);
    if (closing_samples == 0 || since_cs > CLOSING_ELAPSED_MAX_CS) {
        closing_restart();
        start(dist_mm);
        since_cs = 0;
        return true;
    }

    further_mm = (int16_t)(dist_mm - smooth_mm) + travel_mm(smooth_2mmps, since_cs);
    off_mm = further_mm >= 0 ? (uint16_t)further_mm : (uint16_t)-further_mm;
    if (closing_samples == 1) {
        gate_mm = (uint16_t)(mul_u8(since_cs, CLOSING_REACH_MM_PER_CS / 2U) << 1);
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
    }
    aside_mm = 0;

    rate = RATES[since_cs - CLOSING_ELAPSED_MIN_CS];
    if (dist_mm <= last_mm) {
        difference_2mmps = (int16_t)speed_2mmps((uint16_t)(last_mm - dist_mm), rate);
    } else {
        difference_2mmps = -(int16_t)speed_2mmps((uint16_t)(dist_mm - last_mm), rate);
    }
    if (closing_samples == 1) {
        smooth_mm = dist_mm;
        smooth_2mmps = difference_2mmps;
        closing_samples = 2;
    } else {
        uint16_t part_mm = off_mm >> 2, part_2mmps = speed_2mmps(off_mm, rate) >> 2;

        if (further_mm >= 0) {
            smooth_mm = dist_mm - part_mm;
            smooth_2mmps -= (int16_t)part_2mmps;
        } else {
            smooth_mm = dist_mm + part_mm;
            smooth_2mmps += (int16_t)part_2mmps;
        }
        closing_samples = 3;
    }
    last_mm = dist_mm;
    closing_span_cs = since_cs;
    since_cs = 0;
    publish(&closing_difference, difference_2mmps);
    publish(&closing_smooth, smooth_2mmps);
    return true;
}
