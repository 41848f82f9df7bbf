/* SPDX-License-Identifier: MIT */
/* target: each row of the tables in target.h. Places and times are arguments; no clock. */
#include <stddef.h>
#include "unity.h"
#include "sweep.h"
#include "fault.h"
#include "target.h"

#define PERIOD_CS RANGE_PERIOD_CS

static uint16_t place_mm;

void setUp(void)
{
    target_init();
}

void tearDown(void)
{
}

static uint8_t echo_after(uint16_t dist_mm, uint8_t elapsed_cs)
{
    uint8_t trouble;

    target_expect(elapsed_cs);
    trouble = target_echo(dist_mm);
    if (trouble == BRAKE_FAULT_NONE && target_worth == TARGET_TRACKED) {
        CLOSING_TAKE_LATER();
    }
    return trouble;
}

static uint8_t echo(uint16_t dist_mm)
{
    place_mm = dist_mm;
    return echo_after(dist_mm, PERIOD_CS);
}

static uint8_t nearer(int16_t step_mm)
{
    return echo((uint16_t)(place_mm - step_mm));
}

static uint8_t clear(void)
{
    target_expect(PERIOD_CS);
    return target_clear();
}

static void missing(void)
{
    target_expect(PERIOD_CS);
}

/* A target that is tracked, with that step a reading. */
static void track(uint16_t from_mm, int16_t step_mm, uint8_t readings)
{
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, echo(from_mm));
    while (--readings != 0) {
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(step_mm));
    }
}

/* --- worth ------------------------------------------------------------------------------------ */

static void test_readings_of_one_target_are_worth_more_and_more(void)
{
    TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
    echo(3000);
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
    echo(2900);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_UINT16_WITHIN(3, 1667, closing_difference.closing_mmps);
    TEST_ASSERT_UINT16_WITHIN(3, 1667, closing_smooth.closing_mmps);
    echo(2800);
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
    echo(2700);
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
}

static void test_a_target_after_a_clear_road_has_entered(void)
{
    clear();
    echo(4700);
    TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED, target_worth);

    target_init();
    clear();
    missing();
    echo(4700);
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
}

/* --- the tracked target's window -------------------------------------------------------------- */

static void test_second_reading_is_what_wheels_can_do(void)
{
    int16_t step;

    for (step = -800; step <= 2300; step++) {
        uint8_t wanted = step >= -720 && step <= 2160 ? BRAKE_FAULT_NONE : BRAKE_FAULT_JUMP;

        target_init();
        echo(3000);
        if (nearer(step) != wanted) {
            SWEEP_FAIL(step, "mm nearer: believed, or not");
        }
    }
}

static void test_a_tracked_target_is_within_the_gate(void)
{
    int16_t off;
    uint8_t missed;

    for (missed = 0; missed <= 4; missed++) {
        int16_t gate_mm =
            (int16_t)(TARGET_GATE_MM + TARGET_GATE_MM_PER_CS * PERIOD_CS * (missed + 1));

        for (off = -700; off <= 700; off++) {
            uint8_t wanted =
                off >= -gate_mm && off <= gate_mm ? BRAKE_FAULT_NONE : BRAKE_FAULT_JUMP;
            uint8_t i;

            target_init();
            track(3000, 0, 3);
            for (i = 0; i < missed; i++) {
                missing();
            }
            if (nearer(off) != wanted) {
                SWEEP_FAIL(off, "mm off: believed, or not");
            }
        }
    }
}

static void test_the_window_moves_with_the_target(void)
{
    track(5000, 180, 4);
    missing();
    missing();
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(3 * 180));
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
    TEST_ASSERT_UINT16_WITHIN(4, 3000, closing_difference.closing_mmps);
    TEST_ASSERT_UINT16_WITHIN(10, 3000, closing_smooth.closing_mmps);
}

static void test_a_target_begins_anew_after_a_long_silence(void)
{
    track(5000, 100, 3);
    target_expect(TARGET_SILENCE_MAX_CS);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, echo(1500));
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
    TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
}

static void test_a_time_too_short_counts_as_the_shortest(void)
{
    uint8_t elapsed_cs;

    for (elapsed_cs = 0; elapsed_cs < CLOSING_SPAN_MIN_CS; elapsed_cs++) {
        target_init();
        echo(3000);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, echo_after(2900, elapsed_cs));
        TEST_ASSERT_UINT16_WITHIN(2, 2000, closing_difference.closing_mmps);
    }
}

/* --- the one aside ---------------------------------------------------------------------------- */

static void test_a_time_too_long_does_not_wrap(void)
{
    track(3000, 60, 4);
    target_expect(10);
    target_expect(250);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
}

static void test_one_stray_echo_leaves_the_target_alone(void)
{
    track(4000, 60, 6);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo_after(600, PERIOD_CS));
    TEST_ASSERT_UINT16_WITHIN(2, 1000, closing_difference.closing_mmps);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(120));
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
    TEST_ASSERT_UINT16_WITHIN(5, 1000, closing_smooth.closing_mmps);
}

/* Whatever it moved in between: 25 mm to 2 m a reading. */
static void test_the_second_echo_of_another_target_makes_it_the_target(void)
{
    int16_t step;

    for (step = -600; step <= 2000; step += 25) {
        target_init();
        track(6000, 0, 4);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo(3000));
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(step));
        TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
        TEST_ASSERT_UINT16_WITHIN(3, (step < 0 ? -step : step) * 50L / 3,
                                  step < 0 ? closing_smooth.opening_mmps
                                           : closing_smooth.closing_mmps);
    }
}

static void test_of_two_seen_once_the_one_seen_last_is_confirmed(void)
{
    echo(3600); /* a stray one */
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo(4900));
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(330)); /* 4570 mm: may be either */
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_UINT16_WITHIN(3, 5500, closing_smooth.closing_mmps);
}

/* As long as it is no more than 720 mm from the place of the one seen last. */
static void test_the_one_seen_last_is_the_likelier_one_near_its_place(void)
{
    static const int16_t __code off_mm[] = {-721, -720, 720, 721};
    uint8_t i;

    for (i = 0; i < 4; i++) {
        bool is_likely = off_mm[i] >= -720 && off_mm[i] <= 720;

        target_init();
        echo(3000);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo(4500));
        missing();
        echo((uint16_t)(4500 + off_mm[i]));
        if (off_mm[i] > 0) { /* farther than wheels take the first one in 180 ms */
            TEST_ASSERT_EQUAL_UINT8(is_likely ? TARGET_NEW : TARGET_GLIMPSE, target_worth);
        } else { /* 120 ms after 4500 mm, or 180 ms after 3000 mm */
            TEST_ASSERT_EQUAL_UINT16(is_likely ? 6000 : 0, closing_smooth.closing_mmps);
        }
    }
}

static void test_a_stray_echo_after_a_glimpse_is_not_taken_for_it(void)
{
    echo(2083);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo(3674)); /* a stray one */
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, echo(2083)); /* nearer by 27 m/s, or at rest */
    TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
}

static void test_echoes_that_fit_nothing_are_never_believed(void)
{
    static const uint16_t __code wild_mm[] = {600, 5600, 1700, 3100, 4600};
    uint8_t i;

    track(4000, 0, 3);
    for (i = 0; i < 4; i++) {
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo(wild_mm[i]));
    }
}

static void test_the_one_aside_is_forgotten_after_a_long_silence(void)
{
    track(5900, 0, 3);
    echo(2000);
    echo_after(5900, PERIOD_CS);
    echo_after(5900, 20);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo_after(1900, 20));
}

/* --- a stray echo just before the target ----------------------------------------------------- */

static void test_an_echo_behind_what_has_just_entered_has_entered_late(void)
{
    clear();
    echo(3800); /* a stray one */
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, echo(4600));
    TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED_LATE, target_worth);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(360));
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_UINT16_WITHIN(3, 6000, closing_smooth.closing_mmps);

    target_init();
    clear();
    echo(4500);
    echo(4500 + TARGET_BEHIND_MM);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);

    target_init();
    clear();
    echo(4500);
    echo(4500 + TARGET_BEHIND_MM + 1);
    TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED_LATE, target_worth);
}

/* The same where the target's first echo was missing, or what came before the stray one is not
 * known. */
static void test_a_clear_reading_between_them_makes_no_difference(void)
{
    uint8_t was_clear;

    for (was_clear = 0; was_clear <= 1; was_clear++) {
        target_init();
        if (was_clear) {
            clear();
        }
        echo(3800);
        clear();
        echo(3800 + TARGET_BEHIND_MM + 1);
        TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED_LATE, target_worth);
    }
}

/* But an echo that is not behind the first one, after a clear reading: of either. */
static void test_a_second_reading_after_a_clear_one_may_be_the_first(void)
{
    clear();
    echo(4181);
    clear();
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, echo(4056));
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW_LATE, target_worth);
    TEST_ASSERT_UINT16_WITHIN(3, 1042, closing_difference.closing_mmps);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(370)); /* it was */
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);

    target_init(); /* the road was not seen to be clear before */
    echo(4181);
    clear();
    echo(4056);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
}

static void test_a_new_target_may_close_faster_than_its_first_reading_said(void)
{
    echo(4300); /* a stray one */
    echo(4900);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(330));
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_UINT16_WITHIN(3, 5500, closing_smooth.closing_mmps);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, nearer(-600)); /* but not slower */
}

/* --- clear readings --------------------------------------------------------------------------- */

static void test_two_clear_readings_end_a_glimpse(void)
{
    uint8_t has_entered;

    for (has_entered = 0; has_entered <= 1; has_entered++) {
        target_init();
        if (has_entered) {
            clear();
        }
        echo(2000);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, clear());
        TEST_ASSERT_TRUE(target_worth != TARGET_NONE);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, clear());
        TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
    }
}

static void check_far_clears(void)
{
    uint8_t i;

    for (i = 1; i < TARGET_FAR_CLEARS; i++) {
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, clear());
        TEST_ASSERT_TRUE(target_worth != TARGET_NONE);
    }
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, clear());
    TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
}

static void test_clear_readings_that_end_a_new_target(void)
{
    track(2000, 0, 2);
    check_far_clears();
}

static void test_clear_readings_that_end_a_tracked_target_far_away(void)
{
    track(TARGET_NEAR_MM, 0, 5);
    check_far_clears();
}

/* 1.2 s; and in a silence longer than TARGET_SILENCE_MAX_CS it stays near. */
static void check_near_clears(void)
{
    uint8_t i;

    for (i = 1; i < TARGET_NEAR_CLEARS; i++) {
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_LOST, clear());
    }
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, clear());
    TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, clear());
}

static void test_a_near_target_does_not_vanish_for_1200_ms(void)
{
    track(TARGET_NEAR_MM - 1U, 0, 3);
    check_near_clears();
}

/* 120 ms before it was 5900 mm, which is not near; 180 ms before 4000 mm. */
static void test_what_entered_late_takes_a_likely_one_aside_only(void)
{
    (void)clear();
    (void)echo(3000);
    (void)echo(4000);
    TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED_LATE, target_worth);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo(5900));
    missing();
    (void)echo(5100);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
}

static void test_a_start_forgets_that_a_target_was_near(void)
{
    track(2000, 50, 4);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_LOST, clear());
    target_init();
    (void)echo(4000);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, clear());
}

static void test_a_target_that_was_dropped_has_no_speed(void)
{
    uint8_t i;

    track(4000, 50, 4);
    TEST_ASSERT_NOT_EQUAL(0, closing_smooth.closing_mmps);
    for (i = 0; target_worth != TARGET_NONE && i < 20; i++) {
        missing();
    }
    TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
    TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
    TEST_ASSERT_EQUAL_UINT16(0, closing_difference.closing_mmps);
}

static void test_a_target_that_is_near_by_now_is_near(void)
{
    track(5200, 300, 4); /* 4.3 m and 5 m/s: 4 m by the clear reading */
    check_near_clears();
}

static void test_a_near_target_stays_near_when_it_begins_anew(void)
{
    uint8_t i;

    track(2000, 0, 5);
    for (i = 0; i < 6; i++) {
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_LOST, clear());
    }
    echo(2000);
    TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED, target_worth);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_LOST, clear());
    echo(2000);
    echo(2000);
    TEST_ASSERT_EQUAL_UINT8(TARGET_TRACKED, target_worth);
    check_near_clears();
}

static void test_the_next_echo_of_a_target_that_seemed_gone_is_its_second_reading(void)
{
    echo(4800);
    clear();
    clear();
    TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
    clear();
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(4 * 330));
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_UINT16_WITHIN(3, 5500, closing_smooth.closing_mmps);
}

/* --- stuck ------------------------------------------------------------------------------------ */

static void test_the_same_reading_while_closing_or_opening_is_stuck(void)
{
    int16_t step;

    for (step = 66; step <= 240; step += 3) { /* 1.1 m/s and faster */
        target_init();
        track(3000, step, 6);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, nearer(0));
        target_init();
        track(1500, -step, 6);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, nearer(0));
    }
}

/* An echo that lasts as long again may differ by a count of the timer. */
static void test_a_reading_that_differs_by_1_mm_is_stuck_too(void)
{
    int16_t off;

    for (off = -3; off <= 3; off++) {
        bool is_stuck = off >= -1 && off <= 1;

        target_init();
        track(4000, 100, 6);
        TEST_ASSERT_EQUAL(is_stuck, echo((uint16_t)(closing_place_mm + off)) == BRAKE_FAULT_STUCK);
        TEST_ASSERT_EQUAL(is_stuck, echo((uint16_t)(closing_place_mm - off)) == BRAKE_FAULT_STUCK);
    }
}

/* A stray echo and one of a target may look like a target at 23 m/s that then stands still. */
static void test_a_stray_echo_and_a_target_at_rest_are_not_stuck(void)
{
    echo(3085);
    echo(1710);
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo(1710));
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, echo(1710));
    TEST_ASSERT_UINT16_WITHIN(3, 0, closing_smooth.closing_mmps);

    target_init(); /* but up to 8 m/s it is a sensor that hangs */
    echo(3085);
    echo(3085 - 480);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, nearer(0));
    target_init();
    echo(3085);
    echo(3085 - 500); /* 8.3 m/s */
    TEST_ASSERT_TRUE(nearer(0) != BRAKE_FAULT_STUCK);
}

static void test_stuck_lasts_until_another_reading_comes(void)
{
    uint8_t i;

    track(4000, 100, 6);
    for (i = 0; i < 10; i++) {
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, nearer(0));
        if (i & 1) {
            missing();
        }
    }
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(2));
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
    TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(0));
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(0));
}

static void test_stuck_lasts_three_seconds_at_most(void)
{
    uint8_t i = 0;

    track(4000, 100, 6);
    while (nearer(0) == BRAKE_FAULT_STUCK && i < 255) {
        i++;
    }
    TEST_ASSERT_EQUAL_UINT8(TARGET_REST_READINGS, i);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(0));
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(0));
}

static void test_a_stuck_reading_that_is_lost_three_seconds_long_counts_down(void)
{
    uint8_t i;

    track(4000, 100, 6);
    nearer(0);
    for (i = 0; i < TARGET_REST_READINGS; i++) {
        missing();
    }
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(0));
}

/* Nothing of a stuck target is left once clear readings have ended it, or after init. */
static void test_stuck_ends_with_the_target(void)
{
    uint8_t i;

    track(5500, 100, 6);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, nearer(0));
    for (i = 0; i < TARGET_FAR_CLEARS; i++) {
        clear();
    }
    TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(0));

    target_init();
    track(5500, 100, 6);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, nearer(0));
    target_init();
    TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, echo(0));
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
}

/* One estimator is not enough. Either way, a target at 0.6 m/s that seems to jump by 80 mm: 1.3 m/s
 * by the difference, but 0.78 m/s by the smooth one; and one at 1.33 m/s that slows down: 0.92 m/s
 * by the difference, but 1.2 m/s by the smooth one. Both may have come to rest. */
static void test_a_target_that_only_one_estimator_sees_moving_is_not_stuck(void)
{
    uint8_t i;

    for (i = 0; i < 2; i++) {
        int16_t away = i == 0 ? 1 : -1;

        target_init();
        track(i == 0 ? 3000 : 2000, (int16_t)(36 * away), 8);
        nearer((int16_t)(80 * away));
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(0));
        target_init();
        track(i == 0 ? 3000 : 2000, (int16_t)(80 * away), 8);
        nearer((int16_t)(55 * away));
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(0));
    }
}

static void test_the_same_reading_at_rest_is_fine(void)
{
    uint8_t i;

    track(3000, 40, 10); /* 0.67 m/s: 10 m/s2 stop that between two readings */
    for (i = 0; i < 50; i++) {
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, nearer(0));
    }
}

/* A car that brakes at that many m/s2 to a standstill, before a sensor of 1, 3 and 10 mm and no
 * noise, in any phase of the sensor; two readings in a row are missing, anywhere. Wheels hold 10
 * m/s2. */
static void test_a_car_that_has_just_stopped_is_not_stuck(void)
{
    static const uint8_t __code sensor_mm[] = {1, 3, 10};
    uint8_t k, decel, phase_cs, missing_at;

    for (k = 0; k < 3; k++) {
        for (decel = 6; decel <= 10; decel += 2) {
            for (phase_cs = 0; phase_cs < PERIOD_CS; phase_cs++) {
                for (missing_at = 0; missing_at < 6; missing_at++) {
                    uint16_t speed_mmps = 3000, gap_tenths = 40000U; /* of 1 mm */
                    uint8_t i, j;

                    target_init();
                    for (i = 0; i < 16; i++) {
                        for (j = 0; j < PERIOD_CS; j++) {
                            uint16_t loss_mmps =
                                i * PERIOD_CS + j < phase_cs ? 0 : (uint16_t)(decel * 10U);

                            if (loss_mmps > speed_mmps) {
                                loss_mmps = speed_mmps;
                            }
                            gap_tenths -= (uint16_t)((speed_mmps - loss_mmps / 2U) / 10U);
                            speed_mmps -= loss_mmps;
                        }
                        if (i / 2 == missing_at) {
                            missing();
                        } else {
                            uint16_t mm = gap_tenths / 10U;

                            mm = (uint16_t)((mm + sensor_mm[k] / 2U) / sensor_mm[k] * sensor_mm[k]);
                            if (echo(mm) == BRAKE_FAULT_STUCK) {
                                TEST_ASSERT_EQUAL_UINT8_MESSAGE(0, sensor_mm[k], "stuck");
                            }
                        }
                    }
                }
            }
        }
    }
}

static void test_init_forgets_a_clear_road(void)
{
    clear();
    target_init();
    echo(4700);
    TEST_ASSERT_EQUAL_UINT8(TARGET_GLIMPSE, target_worth);
}

/* Seen once or tracked, in one silence of 0.32 s and more, or in several. */
static void test_any_target_ends_in_a_long_silence(void)
{
    uint8_t readings;

    for (readings = 1; readings <= 3; readings++) {
        target_init();
        track(5000, 0, readings);
        target_expect(40);
        TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
        target_init();
        track(5000, 0, readings);
        target_expect(11);
        target_expect(11);
        TEST_ASSERT_TRUE(target_worth != TARGET_NONE);
        target_expect(11);
        TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
    }
}

/* TARGET_ENTERED_LATE is a first reading: it has no speed, its next one is the second, wherever a
 * target was foreseen before, and two clear readings end it. */
static void test_what_entered_late_was_seen_once(void)
{
    uint8_t i;

    for (i = 0; i < 2; i++) {
        target_init();
        track(5000, 0, 3);
        target_expect(40);
        clear();
        echo(4600);
        echo(5000);
        TEST_ASSERT_EQUAL_UINT8(TARGET_ENTERED_LATE, target_worth);
        TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.closing_mmps);
        TEST_ASSERT_EQUAL_UINT16(0, closing_smooth.opening_mmps);
        if (i == 0) {
            echo(5000);
            TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
        } else {
            clear();
            clear();
            TEST_ASSERT_EQUAL_UINT8(TARGET_NONE, target_worth);
        }
    }
}

/* However far its second echo is from its first, as long as wheels can bring it there. */
static void test_another_target_replaces_one_of_two_readings(void)
{
    echo(3000);
    echo(3000);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, echo(5500));
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, echo(4500));
    TEST_ASSERT_EQUAL_UINT8(TARGET_NEW, target_worth);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_readings_of_one_target_are_worth_more_and_more);
    RUN_TEST(test_a_target_after_a_clear_road_has_entered);
    RUN_TEST(test_second_reading_is_what_wheels_can_do);
    RUN_TEST(test_a_tracked_target_is_within_the_gate);
    RUN_TEST(test_the_window_moves_with_the_target);
    RUN_TEST(test_a_target_begins_anew_after_a_long_silence);
    RUN_TEST(test_a_time_too_short_counts_as_the_shortest);
    RUN_TEST(test_a_time_too_long_does_not_wrap);
    RUN_TEST(test_one_stray_echo_leaves_the_target_alone);
    RUN_TEST(test_the_second_echo_of_another_target_makes_it_the_target);
    RUN_TEST(test_of_two_seen_once_the_one_seen_last_is_confirmed);
    RUN_TEST(test_the_one_seen_last_is_the_likelier_one_near_its_place);
    RUN_TEST(test_a_stray_echo_after_a_glimpse_is_not_taken_for_it);
    RUN_TEST(test_echoes_that_fit_nothing_are_never_believed);
    RUN_TEST(test_the_one_aside_is_forgotten_after_a_long_silence);
    RUN_TEST(test_an_echo_behind_what_has_just_entered_has_entered_late);
    RUN_TEST(test_a_clear_reading_between_them_makes_no_difference);
    RUN_TEST(test_a_second_reading_after_a_clear_one_may_be_the_first);
    RUN_TEST(test_a_new_target_may_close_faster_than_its_first_reading_said);
    RUN_TEST(test_two_clear_readings_end_a_glimpse);
    RUN_TEST(test_clear_readings_that_end_a_new_target);
    RUN_TEST(test_clear_readings_that_end_a_tracked_target_far_away);
    RUN_TEST(test_a_near_target_does_not_vanish_for_1200_ms);
    RUN_TEST(test_what_entered_late_takes_a_likely_one_aside_only);
    RUN_TEST(test_a_start_forgets_that_a_target_was_near);
    RUN_TEST(test_a_target_that_was_dropped_has_no_speed);
    RUN_TEST(test_a_target_that_is_near_by_now_is_near);
    RUN_TEST(test_a_near_target_stays_near_when_it_begins_anew);
    RUN_TEST(test_the_next_echo_of_a_target_that_seemed_gone_is_its_second_reading);
    RUN_TEST(test_the_same_reading_while_closing_or_opening_is_stuck);
    RUN_TEST(test_a_reading_that_differs_by_1_mm_is_stuck_too);
    RUN_TEST(test_a_stray_echo_and_a_target_at_rest_are_not_stuck);
    RUN_TEST(test_stuck_lasts_until_another_reading_comes);
    RUN_TEST(test_stuck_lasts_three_seconds_at_most);
    RUN_TEST(test_a_stuck_reading_that_is_lost_three_seconds_long_counts_down);
    RUN_TEST(test_stuck_ends_with_the_target);
    RUN_TEST(test_a_target_that_only_one_estimator_sees_moving_is_not_stuck);
    RUN_TEST(test_the_same_reading_at_rest_is_fine);
    RUN_TEST(test_a_car_that_has_just_stopped_is_not_stuck);
    RUN_TEST(test_init_forgets_a_clear_road);
    RUN_TEST(test_any_target_ends_in_a_long_silence);
    RUN_TEST(test_what_entered_late_was_seen_once);
    RUN_TEST(test_another_target_replaces_one_of_two_readings);
    return UNITY_END();
}
