/* SPDX-License-Identifier: MIT */
/* What the gap controller adds to the published law: the set speed, a lead state that does not
 * follow noise, two frames to release the brake, and full brake when the law would come too late.
 * The law itself is tested by test_gap_paper.c. */
#include <stddef.h>
#include "unity.h"

/* Files under test that want this controller's table. */
#include "lut.c"
#include "gap.c"
#include "sweep.h"

#define SET_MAX_CMPS ((uint16_t)(GAP_SET_MAX * GAP_SET_STEP_CMPS))

void setUp(void)
{
    gap_init();
    gap.set_cmps = SET_MAX_CMPS;
}

void tearDown(void)
{
}

static void step(uint16_t gap_cm, uint16_t own_cmps, uint16_t lead_cmps, int16_t lead_cmps2)
{
    gap.gap_cm = gap_cm;
    gap.own_cmps = own_cmps;
    gap.lead_cmps = lead_cmps;
    gap.lead_cmps2 = lead_cmps2;
    gap_decide();
}

static void steps(uint8_t count, uint16_t gap_cm, uint16_t own_cmps, uint16_t lead_cmps,
                  int16_t lead_cmps2)
{
    while (count-- != 0) {
        step(gap_cm, own_cmps, lead_cmps, lead_cmps2);
    }
}

/* --- set speed ------------------------------------------------------------------------------- */

static void test_nobody_ahead_drives_at_the_set_speed(void)
{
    gap.set_cmps = 2000;
    steps(2, GAP_MAX_CM, 1000, 0, 0);
    TEST_ASSERT_EQUAL_INT16(200, gap.accel_cmps2);
    step(GAP_MAX_CM, 1900, 0, 0);
    TEST_ASSERT_EQUAL_INT16(100, gap.accel_cmps2);
    step(GAP_MAX_CM, 2000, 0, 0);
    TEST_ASSERT_EQUAL_INT16(0, gap.accel_cmps2);
    TEST_ASSERT_EQUAL_UINT8(0, gap.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
    step(GAP_MAX_CM, 2050, 0, 0);
    TEST_ASSERT_EQUAL_INT16(-50, gap.accel_cmps2);
    step(GAP_MAX_CM, 4000, 0, 0);
    TEST_ASSERT_EQUAL_INT16(-200, gap.accel_cmps2);
}

static void test_set_speed_limits_the_law(void)
{
    gap.set_cmps = 1500;
    steps(2, 20000, 1480, 2500, 0); /* the law would catch up */
    TEST_ASSERT_EQUAL_INT16(20, gap.accel_cmps2);
    steps(2, 20000, 1600, 2500, 0);
    TEST_ASSERT_EQUAL_INT16(-100, gap.accel_cmps2);
    gap.set_cmps = SET_MAX_CMPS;
    steps(2, 20000, 1480, 2500, 0);
    TEST_ASSERT_GREATER_THAN_INT16(300, gap.accel_cmps2);
}

static void send(uint8_t set)
{
    uint8_t at;

    for (at = 0; at < 8; at++) {
        frame_body[at] = at + 1;
    }
    frame_body[6] = 0;
    frame_body[8] = set;
}

static void test_frame_carries_the_set_speed(void)
{
    send(GAP_SET_MAX);
    TEST_ASSERT_TRUE(gap_read());
    TEST_ASSERT_EQUAL_UINT16(SET_MAX_CMPS, gap.set_cmps);
    send(GAP_SET_MAX + 1);
    TEST_ASSERT_FALSE(gap_read());
    TEST_ASSERT_EQUAL_UINT16(SET_MAX_CMPS, gap.set_cmps);
    send(1);
    TEST_ASSERT_TRUE(gap_read());
    TEST_ASSERT_EQUAL_UINT16(20, gap.set_cmps);
}

static void test_other_values_out_of_range_are_refused(void)
{
    static const uint8_t high[][2] = {{0, 98}, {2, 20}, {4, 20}, {6, 6}, {6, 250}};
    uint8_t at;

    for (at = 0; at < sizeof high / sizeof high[0]; at++) {
        send(0);
        frame_body[high[at][0]] = high[at][1];
        frame_body[high[at][0] + 1] = 0;
        TEST_ASSERT_FALSE(gap_read());
        send(0);
        TEST_ASSERT_TRUE(gap_read());
    }
}

/* Each value at its limit, and one beyond. */
static void test_each_value_has_its_limit(void)
{
    static const struct {
        uint8_t at;
        int16_t limit, beyond;
    } __code LIMITS[] = {
        {0, 25000, 25001}, {2, 5000, 5001}, {4, 5000, 5001}, {6, 1500, 1501}, {6, -1500, -1501}};
    uint8_t i;

    for (i = 0; i < sizeof LIMITS / sizeof LIMITS[0]; i++) {
        uint8_t at = LIMITS[i].at;

        send(0);
        frame_body[at] = (uint8_t)((uint16_t)LIMITS[i].limit >> 8);
        frame_body[at + 1] = (uint8_t)LIMITS[i].limit;
        TEST_ASSERT_TRUE(gap_read());
        frame_body[at] = (uint8_t)((uint16_t)LIMITS[i].beyond >> 8);
        frame_body[at + 1] = (uint8_t)LIMITS[i].beyond;
        TEST_ASSERT_FALSE(gap_read());
    }
    TEST_ASSERT_EQUAL_INT16(-1500, gap.lead_cmps2);
}

/* --- beginnings and outputs ------------------------------------------------------------------ */

static void test_a_beginning_forgets_what_was(void)
{
    steps(5, 20000, 1000, 1000, -70);
    TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
    frames_other = frames_safe = 1;
    gap_init();
    TEST_ASSERT_EQUAL_UINT8(GAP_WAITING, gap.state);
    TEST_ASSERT_TRUE(gap.stop);
    TEST_ASSERT_EQUAL_UINT8(100, gap.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
    TEST_ASSERT_EQUAL_INT16(-800, gap.accel_cmps2);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
    TEST_ASSERT_EQUAL_INT16(-800, asked_cmps2);
    TEST_ASSERT_EQUAL_UINT8(0, frames_other);
    TEST_ASSERT_EQUAL_UINT8(0, frames_safe);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, late_cmps);
}

static void test_a_lost_link_asks_for_the_brake_that_is_on(void)
{
    steps(2, 20000, 1000, 1000, 0);
    TEST_ASSERT_GREATER_THAN_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
    gap_lose(60);
    TEST_ASSERT_EQUAL_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
    TEST_ASSERT_EQUAL_INT16(-480, gap.accel_cmps2);
    TEST_ASSERT_EQUAL_INT16(-480, asked_cmps2);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, late_cmps);
    gap_lose(59);
    TEST_ASSERT_EQUAL_UINT8(60, gap.brake_pct);
}

static void test_each_acceleration_is_brake_or_throttle(void)
{
    for (gap.accel_cmps2 = -800; gap.accel_cmps2 <= 800; gap.accel_cmps2++) {
        uint16_t size_cmps2 = magnitude_i16(gap.accel_cmps2);
        bool brakes = gap.accel_cmps2 < 0;

        set_outputs();
        TEST_ASSERT_EQUAL_UINT8(brakes ? (size_cmps2 + 4U) / 8U : 0, gap.brake_pct);
        TEST_ASSERT_EQUAL_UINT16(brakes ? 1000U : 1000U + size_cmps2 * 5U / 4U, gap.throttle_us);
    }
}

/* -49 and 48 cm/s2 make -1, of which the half is rounded towards 0. */
static void test_the_mean_of_both_laws_is_rounded_towards_0(void)
{
    steps(2, 1953, 1000, 500, 0);
    TEST_ASSERT_EQUAL_INT16(-1, gap_lq_cmps2() + gap_fuzzy_cmps2());
    TEST_ASSERT_EQUAL_INT16(0, gap.accel_cmps2);
}

static void test_a_creeping_car_that_brakes_a_little_is_held(void)
{
    steps(2, 414, GAP_CREEP_CMPS - 1, 50, 0);
    TEST_ASSERT_EQUAL_INT16(-58, gap_lq_cmps2() + gap_fuzzy_cmps2());
    TEST_ASSERT_EQUAL_INT16(-30, gap.accel_cmps2);
}

static void test_set_speed_lets_the_law_ask_for_full_throttle(void)
{
    gap.state = GAP_CONTROL;
    gap.gap_cm = 20000;
    gap.own_cmps = 0;
    (void)safe_cmps2(800);
    TEST_ASSERT_EQUAL_INT16(800, asked_cmps2);
}

/* --- lead state ------------------------------------------------------------------------------ */

static void test_lead_state_follows_what_is_sure_at_once(void)
{
    step(3000, 1000, 800, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
    step(3000, 1000, 800, LEAD_SURELY_CMPS2 - 1);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_BRAKES, gap.lead);
    step(3000, 1000, LEAD_STANDS_CMPS, -600);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_STANDS, gap.lead);
    step(3000, 1000, LEAD_STARTS_CMPS, -600);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_STANDS, gap.lead);
    step(3000, 1000, LEAD_STARTS_CMPS + 1, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
}

/* It does not have to brake before, and one that creeps never stood. */
static void test_a_lead_stands_from_the_first_frame_that_says_so(void)
{
    step(3000, 1000, LEAD_STARTS_CMPS, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
    step(3000, 1000, LEAD_STANDS_CMPS, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_STANDS, gap.lead);
}

static void test_the_next_small_change_has_to_last_as_long(void)
{
    steps(FRAMES_TO_BRAKES, 3000, 1000, 800, LEAD_BRAKES_CMPS2 - 1);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_BRAKES, gap.lead);
    steps(FRAMES_TO_DRIVES - 1, 3000, 1000, 800, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_BRAKES, gap.lead);
    step(3000, 1000, 800, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
}

static void test_lead_state_follows_small_changes_when_they_last(void)
{
    steps(FRAMES_TO_BRAKES - 1, 3000, 1000, 800, LEAD_SURELY_CMPS2);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
    step(3000, 1000, 800, 0);
    steps(FRAMES_TO_BRAKES - 1, 3000, 1000, 800, LEAD_BRAKES_CMPS2 - 1);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
    step(3000, 1000, 800, LEAD_BRAKES_CMPS2 - 1);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_BRAKES, gap.lead);
    steps(FRAMES_TO_DRIVES - 1, 3000, 1000, 800, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_BRAKES, gap.lead);
    step(3000, 1000, 800, -30);
    steps(FRAMES_TO_DRIVES - 1, 3000, 1000, 800, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_BRAKES, gap.lead);
    step(3000, 1000, 800, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
}

/* --- two frames ------------------------------------------------------------------------------ */

static void test_one_frame_neither_releases_the_brake_nor_opens_the_throttle(void)
{
    int16_t before_cmps2;

    steps(2, 2000, 1000, 0, 0);
    before_cmps2 = gap.accel_cmps2;
    TEST_ASSERT_LESS_THAN_INT16(-300, before_cmps2);
    step(20000, 1000, 1000, 0);
    TEST_ASSERT_EQUAL_INT16(before_cmps2, gap.accel_cmps2);
    step(2000, 1000, 0, 0);
    step(20000, 1000, 1000, 0);
    TEST_ASSERT_EQUAL_INT16(before_cmps2, gap.accel_cmps2);
    TEST_ASSERT_EQUAL_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
    step(20000, 1000, 1000, 0);
    TEST_ASSERT_EQUAL_UINT8(0, gap.brake_pct);
    TEST_ASSERT_GREATER_THAN_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
}

static void test_car_waits_braked_and_a_lost_link_brakes(void)
{
    TEST_ASSERT_TRUE(gap.stop);
    TEST_ASSERT_EQUAL_UINT8(100, gap.brake_pct);
    step(20000, 1000, 1000, 0);
    TEST_ASSERT_EQUAL_UINT8(100, gap.brake_pct);
    step(20000, 1000, 1000, 0);
    TEST_ASSERT_EQUAL_UINT8(0, gap.brake_pct);
    TEST_ASSERT_FALSE(gap.stop);

    gap_lose(60);
    TEST_ASSERT_EQUAL_UINT8(GAP_FAULT, gap.state);
    TEST_ASSERT_EQUAL_UINT8(60, gap.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
    step(20000, 1000, 1000, 0);
    TEST_ASSERT_EQUAL_UINT8(60, gap.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
}

/* --- EMERGENCY ------------------------------------------------------------------------------- */

static void test_the_reaction_takes_0_35_s(void)
{
    TEST_ASSERT_UINT16_WITHIN(20, 3500, in_reaction(10000));
}

static void test_too_late_is_what_mechanics_say(void)
{
    gap.own_cmps = 1500;
    gap.lead_cmps = 0;
    gap.lead_cmps2 = 0;
    /* 0.35 s at 15 m/s, then 15 m/s in 7.5 m/s2, and 0.5 m. */
    gap.gap_cm = 525 + 1500 + 50 + 10;
    TEST_ASSERT_FALSE(gap_is_too_late(0, 750));
    gap.gap_cm = 525 + 1500 + 50 - 10;
    TEST_ASSERT_TRUE(gap_is_too_late(0, 750));
    TEST_ASSERT_FALSE(gap_is_too_late(700, 750)); /* brakes already */

    gap.lead_cmps = 1500; /* both brake: 0.37 m in 0.35 s, then 2.1 m/s in 1.5 m/s2 */
    gap.lead_cmps2 = -600;
    gap.gap_cm = 37 + 147 + 50 + 8;
    TEST_ASSERT_FALSE(gap_is_too_late(0, 750));
    gap.gap_cm = 37 + 147 + 50 - 8;
    TEST_ASSERT_TRUE(gap_is_too_late(0, 750));

    gap.lead_cmps2 = -1500; /* harder than the car can */
    gap.gap_cm = 525 - 433 + 1500 - 318 + 50 + 10;
    TEST_ASSERT_FALSE(gap_is_too_late(0, 750));
    gap.gap_cm -= 20;
    TEST_ASSERT_TRUE(gap_is_too_late(0, 750));

    gap.gap_cm = 20; /* very near, but slower */
    gap.own_cmps = 1000;
    gap.lead_cmps2 = 0;
    TEST_ASSERT_FALSE(gap_is_too_late(0, 750));
    gap.own_cmps = 1600;
    TEST_ASSERT_TRUE(gap_is_too_late(0, 750));
}

/* 0.35 s are 90 / 256 s here: at 15 m/s 527 cm. With 7.5 m/s2 the car stands after 1500 cm more. */
enum { STANDS_15_MPS_CM = 527 + 1500 + 50 };

static void test_too_late_begins_1_cm_below_what_mechanics_say(void)
{
    gap.own_cmps = 1500;
    gap.lead_cmps = 0;
    gap.lead_cmps2 = 0; /* the speeds are equal when both stand */
    gap.gap_cm = STANDS_15_MPS_CM;
    TEST_ASSERT_FALSE(gap_is_too_late(0, 750));
    gap.gap_cm--;
    TEST_ASSERT_TRUE(gap_is_too_late(0, 750));
    gap.lead_cmps2 = -1; /* both ways of stopping */
    TEST_ASSERT_TRUE(gap_is_too_late(0, 750));
    gap.gap_cm++;
    TEST_ASSERT_FALSE(gap_is_too_late(0, 750));

    /* A lead that brakes with 10 m/s2 has 11.49 m/s after 465 cm, and stands 660 cm later. */
    gap.lead_cmps = 1500;
    gap.lead_cmps2 = -1000;
    gap.gap_cm = STANDS_15_MPS_CM - 465 - 660;
    TEST_ASSERT_FALSE(gap_is_too_late(0, 750));
    gap.gap_cm--;
    TEST_ASSERT_TRUE(gap_is_too_late(0, 750));
}

/* Within the margin there is no room: 39 cm/s take 1 cm, rounded down, and 38 cm/s take none. */
static void test_within_the_margin_the_car_must_stand_first(void)
{
    gap.gap_cm = 0;
    gap.lead_cmps = 0;
    gap.lead_cmps2 = -1500;
    gap.own_cmps = 38;
    TEST_ASSERT_FALSE(gap_is_too_late(0, 750));
    gap.own_cmps = 39;
    TEST_ASSERT_TRUE(gap_is_too_late(0, 750));
}

static void test_emergency_begins_where_7_5_mps2_do_not_suffice(void)
{
    step(STANDS_15_MPS_CM, 1500, 0, -1);
    TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
    step(STANDS_15_MPS_CM - 1, 1500, 0, -1);
    TEST_ASSERT_EQUAL_UINT8(GAP_EMERGENCY, gap.state);
    TEST_ASSERT_EQUAL_INT16(-800, gap.accel_cmps2);
}

/* With 5 m/s2 the car stands after 2250 cm. */
static void test_emergency_ends_where_5_mps2_suffice(void)
{
    step(1900, 1500, 0, -1);
    steps(SAFE_AGAIN_FRAMES, 527 + 2250 + 50 - 1, 1500, 0, -1);
    TEST_ASSERT_EQUAL_UINT8(GAP_EMERGENCY, gap.state);
    steps(SAFE_AGAIN_FRAMES, 527 + 2250 + 50, 1500, 0, -1);
    TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
}

static void test_each_emergency_takes_two_safe_frames(void)
{
    uint8_t i;

    for (i = 0; i < 3; i++) {
        step(1900, 1500, 0, 0);
        step(5000, 1500, 0, 0);
        TEST_ASSERT_EQUAL_UINT8(GAP_EMERGENCY, gap.state);
        step(5000, 1500, 0, 0);
        TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
    }
}

static void test_emergency_ends_at_once_when_nobody_is_ahead(void)
{
    step(1900, 1500, 0, 0);
    step(GAP_MAX_CM - 1, 1500, 0, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_EMERGENCY, gap.state);
    step(1900, 1500, 0, 0);
    step(GAP_MAX_CM, 1500, 0, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
}

/* The least gap that is not too late. */
static uint16_t least_gap_cm(uint16_t own_cmps, uint16_t lead_cmps, int16_t lead_cmps2)
{
    gap.own_cmps = own_cmps;
    gap.lead_cmps = lead_cmps;
    gap.lead_cmps2 = lead_cmps2;
    gap.gap_cm = 0;
    while (gap_is_too_late(0, 750)) {
        gap.gap_cm++;
    }
    return gap.gap_cm;
}

/* 40 m/s are gone after 106.7 m with 7.5 m/s2, and after 106.8 m with 0.01 m/s2 less. */
static void test_only_a_lead_that_brakes_needs_more_room(void)
{
    uint16_t steady_cm = least_gap_cm(4500, 500, 0);

    TEST_ASSERT_UINT16_WITHIN(30, 10667 + 1400 + 50, steady_cm);
    TEST_ASSERT_UINT16_WITHIN(10, steady_cm + 14U, least_gap_cm(4500, 500, -1));
    TEST_ASSERT_EQUAL_UINT16(steady_cm, least_gap_cm(4500, 500, 1));
    TEST_ASSERT_EQUAL_UINT16(2, less(7, 5));
    TEST_ASSERT_EQUAL_UINT16(0, less(5, 7));
}

static void test_emergency_ends_when_two_frames_are_safe(void)
{
    steps(2, 5000, 1500, 1500, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
    step(1900, 1500, 0, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_EMERGENCY, gap.state);
    TEST_ASSERT_EQUAL_UINT8(100, gap.brake_pct);
    step(5000, 1500, 0, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_EMERGENCY, gap.state);
    step(2400, 1500, 0, 0); /* 5 m/s2 do not suffice */
    step(5000, 1500, 0, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_EMERGENCY, gap.state);
    TEST_ASSERT_EQUAL_UINT8(100, gap.brake_pct);
    step(5000, 1500, 0, 0);
    TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
    step(5000, 1500, 0, 0);
    TEST_ASSERT_LESS_THAN_UINT8(90, gap.brake_pct);
    step(1900, 1500, 0, 0);
    steps(2, GAP_MAX_CM, 1500, 1500, 0); /* nobody is there any more */
    TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
}

static void test_own_deceleration_counts_as_measured_and_as_demanded(void)
{
    uint16_t own_cmps;

    steps(2, 2800, 1500, 0, 0);
    for (own_cmps = 1500; own_cmps > 1300; own_cmps -= 20) { /* 4 m/s2 */
        step(2800, own_cmps, 0, 0);
    }
    gap.accel_cmps2 = -700;
    gap.own_cmps = 1300;
    TEST_ASSERT_UINT16_WITHIN(40, 400, own_decel_cmps2());
    gap.accel_cmps2 = -200;
    gap.own_cmps = 1280;
    TEST_ASSERT_EQUAL_UINT16(200, own_decel_cmps2());
    gap.own_cmps = 1000;
    TEST_ASSERT_EQUAL_UINT16(200, own_decel_cmps2());
    gap.own_cmps = 1400;
    TEST_ASSERT_EQUAL_UINT16(0, own_decel_cmps2()); /* faster again */
}

static uint16_t own_decel_with(uint16_t slower_cmps, int16_t accel_cmps2)
{
    gap.own_cmps = 1000;
    gap.accel_cmps2 = accel_cmps2;
    late_cmps = 1000 + slower_cmps;
    return own_decel_cmps2();
}

/* In 0.2 s 1.6 m/s are 8 m/s2, the most that can be demanded. */
static void test_own_deceleration_is_no_more_than_demanded(void)
{
    TEST_ASSERT_EQUAL_UINT16(795, own_decel_with(159, -800));
    TEST_ASSERT_EQUAL_UINT16(800, own_decel_with(160, -800));
    TEST_ASSERT_EQUAL_UINT16(800, own_decel_with(4000, -800));
    TEST_ASSERT_EQUAL_UINT16(1, own_decel_with(4, -1));
    TEST_ASSERT_EQUAL_UINT16(0, own_decel_with(4, 0));
    TEST_ASSERT_EQUAL_UINT16(0, own_decel_with(4, 1));
    TEST_ASSERT_EQUAL_UINT16(0, own_decel_with(160, 1));
}

#ifndef __SDCC_mcs51

#include <math.h>
#include <stdio.h>

/* Two cars as drive has them: dead time 0.05 s, lag 0.2 s, 8 m/s2 at 100 %; a frame each 50 ms
 * takes effect 20 ms later. Returns the least gap. A lead that brakes does so from the start to
 * rest. With BRAKES_FULLY the own car brakes at 8 m/s2 from the first frame on, whatever the law
 * says, and when it stands the gap gets no smaller. */
static double least_gap_m(double gap_m, double own_mps, double lead_mps, double lead_mps2,
                          bool brakes_fully)
{
    enum { STEP_MS = 2, FRAME_MS = 50, EFFECT_MS = 70 /* 20 ms and the dead time */ };
    const double dt_s = STEP_MS * 0.001;
    double least_m = gap_m, decel_mps2 = 0, now_mps2 = 0, next_mps2 = brakes_fully ? 8 : 0;

    setUp();
    steps(3, GAP_MAX_CM, (uint16_t)lround(own_mps * 100), 0, 0);
    gap.accel_cmps2 = asked_cmps2 = 0; /* it has followed evenly so far */
    for (long ms = 0; gap_m > 0 && ms < 40000 && (own_mps > 0 || (lead_mps > 0 && !brakes_fully));
         ms += STEP_MS) {
        if (ms % FRAME_MS == 0 && !brakes_fully) {
            step((uint16_t)lround(fmin(gap_m * 100, GAP_MAX_CM)), (uint16_t)lround(own_mps * 100),
                 (uint16_t)lround(lead_mps * 100),
                 lead_mps > 0 ? (int16_t)lround(lead_mps2 * 100) : 0);
            next_mps2 = -gap.accel_cmps2 / 100.0;
        }
        if (ms >= EFFECT_MS && (ms - EFFECT_MS) % FRAME_MS == 0) {
            now_mps2 = next_mps2;
        }
        decel_mps2 += (now_mps2 - decel_mps2) * dt_s / 0.2;
        gap_m += (lead_mps - own_mps) * dt_s;
        own_mps = fmax(0, own_mps - decel_mps2 * dt_s);
        lead_mps = fmax(0, lead_mps + lead_mps2 * dt_s);
        least_m = fmin(least_m, gap_m);
    }
    return least_m;
}

static void test_no_impact_wherever_full_brake_from_the_same_reading_avoids_it(void)
{
    static const double leads_mps2[] = {0, -1, -3, -5, -6, -7.5, -9, 2};
    char text[120];
    long avoidable = 0;

    for (double own_mps = 1; own_mps <= 43; own_mps += 3.5 * SWEEP) {
        for (double lead_mps = 0; lead_mps <= 42; lead_mps += 3.5) {
            for (size_t i = 0; i < sizeof leads_mps2 / sizeof leads_mps2[0]; i++) {
                double low_m = 0, high_m = 249;

                if (lead_mps <= 0 && i != 0) {
                    continue; /* it stands */
                }
                /* The least gap that full brake can save, to 2 cm; then that one and some more. */
                while (high_m - low_m > 0.02) {
                    double middle_m = (low_m + high_m) / 2;

                    if (least_gap_m(middle_m, own_mps, lead_mps, leads_mps2[i], true) > 0) {
                        high_m = middle_m;
                    } else {
                        low_m = middle_m;
                    }
                }
                for (double more_m = 0; more_m < 6; more_m = more_m * 2 + 0.05) {
                    double least_m =
                        least_gap_m(high_m + more_m, own_mps, lead_mps, leads_mps2[i], false);

                    avoidable++;
                    snprintf(text, sizeof text,
                             "impact from %.2f m, %.1f m/s behind %.1f m/s, %.1f m/s2",
                             high_m + more_m, own_mps, lead_mps, leads_mps2[i]);
                    TEST_ASSERT_TRUE_MESSAGE(least_m > 0, text);
                }
            }
        }
    }
    TEST_ASSERT_GREATER_THAN_INT32(5000 / SWEEP, avoidable);
}

/* Where room and opening lie in the table: 1/256 of the way between two nodes, rounded down, by
 * factors that are rounded down. */
static void test_the_fuzzy_part_looks_where_room_and_opening_are(void)
{
    const double row_factor = floor(LUT_IN1_CELLS * 256 * 65536.0 / 12000);
    const double col_factor = floor(LUT_IN2_CELLS * 256 * 65536.0 / 16000);

    gap.safe_cm = 2000;
    for (int room_cm = -1000; room_cm <= 2000; room_cm += 11) {
        uint16_t row_q8 = (uint16_t)((room_cm + 1000) * 4 * row_factor / 65536);

        for (int opening_cmps = -2000; opening_cmps <= 2000; opening_cmps++) {
            uint16_t col_q8 = (uint16_t)((opening_cmps + 2000) * 4 * col_factor / 65536);
            int16_t wanted_cmps2 = (int16_t)((lut_between(row_q8, col_q8) - 100) * 8);

            gap.gap_cm = (uint16_t)(2000 + room_cm);
            gap.own_cmps = 2500;
            gap.lead_cmps = (uint16_t)(2500 + opening_cmps);
            if (gap_fuzzy_cmps2() != wanted_cmps2) {
                SWEEP_FAIL(room_cm, "cm of room: looks elsewhere");
            }
        }
    }
}

/* The case that the published law loses: the lead brakes as hard as its own model assumes. */
static void test_lead_that_brakes_as_the_model_assumes_is_not_hit(void)
{
    TEST_ASSERT_TRUE(least_gap_m(5.5, 15, 15, -6, false) > 0.5);
}

#endif

/* 1/256 of the way down from 10 to 9 is 9.996, rounded down. */
static void test_what_lies_between_two_nodes_is_rounded_down(void)
{
    TEST_ASSERT_EQUAL_UINT8(10, between(10, 9, 0));
    TEST_ASSERT_EQUAL_UINT8(9, between(10, 9, 1));
    TEST_ASSERT_EQUAL_UINT8(9, between(9, 10, 255));
    TEST_ASSERT_EQUAL_UINT8(60, between(60, 60, 200));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nobody_ahead_drives_at_the_set_speed);
    RUN_TEST(test_set_speed_limits_the_law);
    RUN_TEST(test_frame_carries_the_set_speed);
    RUN_TEST(test_other_values_out_of_range_are_refused);
    RUN_TEST(test_each_value_has_its_limit);
    RUN_TEST(test_a_beginning_forgets_what_was);
    RUN_TEST(test_a_lost_link_asks_for_the_brake_that_is_on);
    RUN_TEST(test_each_acceleration_is_brake_or_throttle);
    RUN_TEST(test_the_mean_of_both_laws_is_rounded_towards_0);
    RUN_TEST(test_a_creeping_car_that_brakes_a_little_is_held);
    RUN_TEST(test_set_speed_lets_the_law_ask_for_full_throttle);
    RUN_TEST(test_lead_state_follows_what_is_sure_at_once);
    RUN_TEST(test_a_lead_stands_from_the_first_frame_that_says_so);
    RUN_TEST(test_the_next_small_change_has_to_last_as_long);
    RUN_TEST(test_lead_state_follows_small_changes_when_they_last);
    RUN_TEST(test_one_frame_neither_releases_the_brake_nor_opens_the_throttle);
    RUN_TEST(test_car_waits_braked_and_a_lost_link_brakes);
    RUN_TEST(test_the_reaction_takes_0_35_s);
    RUN_TEST(test_too_late_is_what_mechanics_say);
    RUN_TEST(test_too_late_begins_1_cm_below_what_mechanics_say);
    RUN_TEST(test_within_the_margin_the_car_must_stand_first);
    RUN_TEST(test_emergency_begins_where_7_5_mps2_do_not_suffice);
    RUN_TEST(test_emergency_ends_where_5_mps2_suffice);
    RUN_TEST(test_each_emergency_takes_two_safe_frames);
    RUN_TEST(test_emergency_ends_at_once_when_nobody_is_ahead);
    RUN_TEST(test_only_a_lead_that_brakes_needs_more_room);
    RUN_TEST(test_emergency_ends_when_two_frames_are_safe);
    RUN_TEST(test_own_deceleration_counts_as_measured_and_as_demanded);
    RUN_TEST(test_own_deceleration_is_no_more_than_demanded);
#ifndef __SDCC_mcs51
    RUN_TEST(test_no_impact_wherever_full_brake_from_the_same_reading_avoids_it);
    RUN_TEST(test_the_fuzzy_part_looks_where_room_and_opening_are);
    RUN_TEST(test_lead_that_brakes_as_the_model_assumes_is_not_hit);
#endif
    RUN_TEST(test_what_lies_between_two_nodes_is_rounded_down);
    return UNITY_END();
}
