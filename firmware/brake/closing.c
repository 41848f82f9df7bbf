/* SPDX-License-Identifier: MIT */
/* Closing speed. Inside, a speed is in 2 mm/s, positive when closing, modulo 2^16. */
#include "closing.h"
#include "fixed.h"

__data struct closing_speed closing_difference, closing_smooth;
uint16_t closing_place_mm, closing_foreseen_mm;
uint8_t closing_span_cs;

static uint16_t nearer_mm; /* than the place before, modulo 2^16 */
static uint16_t rate;      /* of the time between them, out of RATES */
static uint16_t smooth_mm; /* alpha-beta's place of the target, and its speed */
static uint16_t smooth_2mmps;

/* What closing_expect changes; closing_take, closing_take_second and the first estimator; and the
 * later one: for the contracts of target.c and brake.c. */
#define CLOSING_EXPECTED closing_foreseen_mm
#define CLOSING_TAKEN    rate, nearer_mm, smooth_mm, smooth_2mmps
#define CLOSING_FINISHED closing_span_cs, smooth_mm, smooth_2mmps

/* 1 mm in n/100 s is 100 / n mm/s, that is 50 / n units. Times 65536 / 16 for n = 5..31. */
#define RATE(n) ((3276800UL / 16U + (n) - 1U) / (n))
static const uint16_t __code RATES[] = {
    RATE(5),  RATE(6),  RATE(7),  RATE(8),  RATE(9),  RATE(10), RATE(11), RATE(12), RATE(13),
    RATE(14), RATE(15), RATE(16), RATE(17), RATE(18), RATE(19), RATE(20), RATE(21), RATE(22),
    RATE(23), RATE(24), RATE(25), RATE(26), RATE(27), RATE(28), RATE(29), RATE(30), RATE(31),
};

#define RATES_COUNT (CLOSING_SPAN_MAX_CS - CLOSING_SPAN_MIN_CS + 1U)

/* So many mm of a difference count: in the least time they are 64 m/s. */
#define MOVED_MAX_MM 3200U

/*@ assigns closing_smooth;
    ensures closing_smooth.closing_mmps == 0 || closing_smooth.opening_mmps == 0;
    ensures smooth_2mmps == 0 ==>
                closing_smooth.closing_mmps == 0 && closing_smooth.opening_mmps == 0; */
static void show_smooth(void)
{
    uint16_t mmps = (uint16_t)(smooth_2mmps << 1);

    closing_smooth.closing_mmps = 0;
    closing_smooth.opening_mmps = 0;
    if ((int16_t)smooth_2mmps < 0) {
        closing_smooth.opening_mmps = (uint16_t)(0U - mmps);
    } else {
        closing_smooth.closing_mmps = mmps;
    }
}

/*@ assigns closing_difference;
    ensures closing_difference == closing_smooth; */
static void copy_to_difference(void)
{
    closing_difference.closing_mmps = closing_smooth.closing_mmps;
    closing_difference.opening_mmps = closing_smooth.opening_mmps;
}

/*@ assigns smooth_2mmps; */
void closing_restart(void)
{
    smooth_2mmps = 0;
    show_smooth();
    copy_to_difference();
}

/*@ assigns rate, nearer_mm;
    ensures closing_span_cs == span_cs;
    ensures nearer_mm == (uint16_t)(\old(closing_place_mm) - dist_mm); */
void closing_take(uint16_t dist_mm, uint8_t span_cs)
{
    uint8_t index = (uint8_t)(span_cs - CLOSING_SPAN_MIN_CS);

    if (index >= RATES_COUNT) {
        index = RATES_COUNT - 1U;
    }
    rate = RATES[index];
    closing_span_cs = span_cs;
    nearer_mm = closing_place_mm - dist_mm;
    closing_place_mm = dist_mm;
}

/* So many mm, modulo 2^16, at `rate`. */
/*@ assigns \nothing;
    ensures mm == 0 ==> \result == 0; */
static uint16_t speed_2mmps(uint16_t mm)
{
    __bit is_opening = (int16_t)mm < 0;

    if (is_opening) {
        mm = (uint16_t)(0U - mm);
    }
    if (mm > MOVED_MAX_MM) {
        mm = MOVED_MAX_MM;
    }
    mm = mul_hi_u16((uint16_t)(mm << 4), rate);
    if (is_opening) {
        mm = (uint16_t)(0U - mm);
    }
    return mm;
}

/*@ assigns rate, nearer_mm, smooth_mm, smooth_2mmps; */
void closing_take_second(uint16_t dist_mm, uint8_t span_cs)
{
    closing_take(dist_mm, span_cs);
    smooth_mm = dist_mm;
    smooth_2mmps = speed_2mmps(nearer_mm);
    show_smooth();
    copy_to_difference();
}

void closing_expect(uint8_t span_cs)
{
    /* span * 65536 / 100 */
    uint16_t factor = (uint16_t)(mul_u8(span_cs, 2U) << 8) + mul_u8(span_cs, 143U);

    closing_foreseen_mm =
        mul_hi_u16((uint16_t)(closing_smooth.closing_mmps | closing_smooth.opening_mmps), factor);
    if (closing_smooth.opening_mmps == 0) {
        closing_foreseen_mm = (uint16_t)(0U - closing_foreseen_mm);
    }
    closing_foreseen_mm += smooth_mm;
}

void closing_take_difference(void)
{
    uint16_t speed = speed_2mmps(nearer_mm);

    closing_difference.closing_mmps = 0;
    closing_difference.opening_mmps = 0;
    if ((int16_t)speed < 0) {
        closing_difference.opening_mmps = (uint16_t)((0U - speed) << 1);
    } else {
        closing_difference.closing_mmps = (uint16_t)(speed << 1);
    }
}

/*@ assigns smooth_mm, smooth_2mmps; */
void closing_take_smooth(void)
{
    int16_t off_mm = (int16_t)(closing_foreseen_mm - closing_place_mm);

    smooth_mm = (uint16_t)(closing_place_mm + (uint16_t)((int16_t)((uint16_t)off_mm + 2U) >> 2));
    off_mm = (int16_t)speed_2mmps((uint16_t)off_mm);
    smooth_2mmps += (uint16_t)(off_mm >> 2);
    show_smooth();
}

uint8_t closing_sum(void)
{
    uint16_t words = closing_difference.closing_mmps ^ closing_difference.opening_mmps ^
                     closing_smooth.closing_mmps ^ closing_smooth.opening_mmps ^ closing_place_mm ^
                     closing_foreseen_mm ^ smooth_mm ^ smooth_2mmps;

    return (uint8_t)words ^ (uint8_t)(words >> 8) ^ closing_span_cs;
}
