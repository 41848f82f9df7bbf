/* SPDX-License-Identifier: MIT */
/* Closing speed, of a sensor that measures every 10 ms in steps of 1 cm. In place of closing.c:
 *   difference   of two places at least 60 ms apart, each 60 ms
 *   smooth       alpha-beta with 3/16 and 1/64
 * With readings rounded to 1 cm and noise of 2 cm the difference errs by 0.47 m/s (standard
 * deviation) and alpha-beta by 0.053; alpha-beta follows a ramp 0.11 s late (`make bench`; with 1/4
 * and 1/32: 0.096, 0.08 s; 1/8 and 1/128: 0.031, 0.16 s). The ultrasonic sensor with 1 cm: 0.24,
 * 0.047, 0.15 s.
 * Inside, a speed is in 2 mm/s, positive when closing, modulo 2^16. */
#include "closing.h"
#include "fixed.h"

__data struct closing_speed closing_difference, closing_smooth;
uint16_t closing_place_mm, closing_foreseen_mm;
uint8_t closing_span_cs;

/* The place that the difference counts from, and the time since then. */
static __idata uint16_t mark_mm;
static __idata uint8_t since_mark_cs;

static __idata uint16_t foreseen_4mm; /* as closing_foreseen_mm, in 1/4 mm */
static __idata uint16_t smooth_4mm;   /* alpha-beta's place of the target, and its speed */
static __idata uint16_t smooth_2mmps;

/* What closing_expect changes; closing_take, closing_take_second and the first estimator; and the
 * later one: for the contracts of target.c and brake.c. */
#define CLOSING_EXPECTED closing_foreseen_mm, foreseen_4mm
#define CLOSING_TAKEN    mark_mm, since_mark_cs, smooth_4mm, smooth_2mmps
#define CLOSING_FINISHED mark_mm, since_mark_cs, closing_span_cs, smooth_4mm, smooth_2mmps

/* 1 mm in n/100 s is 100 / n mm/s, that is 50 / n units. Times 65536 / 16 for n = 6..31. */
#define RATE(n) ((3276800UL / 16U + (n) - 1U) / (n))
static const uint16_t __code RATES[] = {
    RATE(6),  RATE(7),  RATE(8),  RATE(9),  RATE(10), RATE(11), RATE(12), RATE(13), RATE(14),
    RATE(15), RATE(16), RATE(17), RATE(18), RATE(19), RATE(20), RATE(21), RATE(22), RATE(23),
    RATE(24), RATE(25), RATE(26), RATE(27), RATE(28), RATE(29), RATE(30), RATE(31),
};

#define RATES_COUNT (CLOSING_SPAN_MAX_CS - CLOSING_SPAN_MIN_CS + 1U)

/* So many mm of a difference count: in the least time they are 53 m/s. */
#define MOVED_MAX_MM 3200U

/* So far from where it was foreseen a place counts for alpha-beta, 1/4 mm. */
#define OFF_MAX_4MM 1280

/*@ requires \valid(speed);
    assigns *speed;
    ensures speed->closing_mmps == 0 || speed->opening_mmps == 0;
    ensures speed_2mmps == 0 ==> speed->closing_mmps == 0 && speed->opening_mmps == 0; */
static void show_speed(struct closing_speed __data *speed, uint16_t speed_2mmps)
{
    uint16_t mmps = (uint16_t)(speed_2mmps << 1);

    speed->closing_mmps = 0;
    speed->opening_mmps = 0;
    if ((int16_t)speed_2mmps < 0) {
        speed->opening_mmps = (uint16_t)(0U - mmps);
    } else {
        speed->closing_mmps = mmps;
    }
}

/*@ assigns smooth_2mmps; */
void closing_restart(void)
{
    smooth_2mmps = 0;
    show_speed(&closing_smooth, 0);
    show_speed(&closing_difference, 0);
}

/*@ assigns since_mark_cs;
    ensures closing_span_cs == \old(closing_span_cs);
    ensures since_mark_cs == (uint8_t)(\old(since_mark_cs) + span_cs); */
void closing_take(uint16_t dist_mm, uint8_t span_cs)
{
    since_mark_cs += span_cs;
    closing_place_mm = dist_mm;
}

/* The speed from the mark to the last place. */
/*@ assigns mark_mm, since_mark_cs, closing_span_cs;
    ensures mark_mm == closing_place_mm && since_mark_cs == 0;
    ensures closing_span_cs == \old(since_mark_cs);
    ensures \old(mark_mm) == closing_place_mm ==> \result == 0; */
static uint16_t difference_2mmps(void)
{
    uint16_t mm = (uint16_t)(mark_mm - closing_place_mm);
    uint8_t index = (uint8_t)(since_mark_cs - CLOSING_SPAN_MIN_CS);
    __bit is_away = (int16_t)mm < 0;

    if (index >= RATES_COUNT) {
        index = RATES_COUNT - 1U;
    }
    if (is_away) {
        mm = (uint16_t)(0U - mm);
    }
    if (mm > MOVED_MAX_MM) {
        mm = MOVED_MAX_MM;
    }
    mm = mul_hi_u16((uint16_t)(mm << 4), RATES[index]);
    if (is_away) {
        mm = (uint16_t)(0U - mm);
    }
    closing_span_cs = since_mark_cs;
    mark_mm = closing_place_mm;
    since_mark_cs = 0;
    return mm;
}

/*@ assigns mark_mm, since_mark_cs, smooth_4mm, smooth_2mmps; */
void closing_take_second(uint16_t dist_mm, uint8_t span_cs)
{
    mark_mm = closing_place_mm;
    since_mark_cs = 0;
    closing_take(dist_mm, span_cs);
    smooth_4mm = (uint16_t)(dist_mm << 2);
    smooth_2mmps = difference_2mmps();
    show_speed(&closing_smooth, smooth_2mmps);
    closing_difference.closing_mmps = closing_smooth.closing_mmps;
    closing_difference.opening_mmps = closing_smooth.opening_mmps;
}

/* So long at most is foreseen. */
#define EXPECT_MAX_CS 25U

/* From here on smooth_4mm and foreseen_4mm are below 0: 11 m and more. */
#define NEGATIVE_4MM 0xB000U

/*@ assigns foreseen_4mm; */
void closing_expect(uint8_t span_cs)
{
    uint16_t factor;

    if (span_cs > EXPECT_MAX_CS) {
        span_cs = EXPECT_MAX_CS;
    }
    /* span * 65536 / 100 * 4 */
    factor = (uint16_t)((uint16_t)(mul_u8(span_cs, 10U) << 8) + mul_u8(span_cs, 61U));
    foreseen_4mm =
        mul_hi_u16((uint16_t)(closing_smooth.closing_mmps | closing_smooth.opening_mmps), factor);
    if (closing_smooth.opening_mmps == 0) {
        foreseen_4mm = (uint16_t)(0U - foreseen_4mm);
    }
    foreseen_4mm += smooth_4mm;
    closing_foreseen_mm = foreseen_4mm >> 2;
    if (foreseen_4mm >= NEGATIVE_4MM) {
        closing_foreseen_mm |= 0xC000U;
    }
}

/*@ assigns mark_mm, since_mark_cs;
    ensures closing_span_cs == (\old(since_mark_cs) >= CLOSING_SPAN_MIN_CS
                ? \old(since_mark_cs) : \old(closing_span_cs)); */
void closing_take_difference(void)
{
    if (since_mark_cs >= CLOSING_SPAN_MIN_CS) {
        show_speed(&closing_difference, difference_2mmps());
    }
}

/*@ assigns smooth_4mm, smooth_2mmps; */
void closing_take_smooth(void)
{
    int16_t off_4mm = (int16_t)(foreseen_4mm - (uint16_t)(closing_place_mm << 2));

    if (off_4mm > OFF_MAX_4MM) {
        off_4mm = OFF_MAX_4MM;
    } else if (off_4mm < -OFF_MAX_4MM) {
        off_4mm = -OFF_MAX_4MM;
    }
    /* cppcheck-suppress shiftNegativeLHS ; both compilers keep the sign */
    smooth_4mm = (uint16_t)(foreseen_4mm - (uint16_t)((int16_t)(off_4mm * 2 + off_4mm) >> 4));
    /* 1/64 of it in 1/100 s is 25 / 64 mm/s for each 1/4 mm, 25 / 128 units. */
    off_4mm = (int16_t)(off_4mm * 16 + off_4mm * 8 + off_4mm);
    /* cppcheck-suppress shiftNegativeLHS ; both compilers keep the sign */
    smooth_2mmps += (uint16_t)(off_4mm >> 7);
    show_speed(&closing_smooth, smooth_2mmps);
}

uint8_t closing_sum(void)
{
    uint16_t words = closing_difference.closing_mmps ^ closing_difference.opening_mmps ^
                     closing_smooth.closing_mmps ^ closing_smooth.opening_mmps ^ closing_place_mm ^
                     closing_foreseen_mm ^ foreseen_4mm ^ smooth_4mm ^ smooth_2mmps ^ mark_mm;

    return (uint8_t)words ^ (uint8_t)(words >> 8) ^ closing_span_cs ^ since_mark_cs;
}
