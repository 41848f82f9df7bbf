/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/best_driver.c, against hand calculation: the formulas of its
 * header, and a plain sum in small steps. */
#include "best_driver.h"

#include <math.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

/* Contact speed by small steps of time; 0: none. */
static double summed_mps(const struct encounter *encounter, double act_s)
{
    const double step_s = 1e-5;
    double gap_m = encounter->gap_m, own_mps = encounter->own_mps, lead_mps = encounter->lead_mps;

    for (double t_s = 0; t_s < 60 && (own_mps > 0 || lead_mps > 0); t_s += step_s) {
        if (t_s >= act_s) {
            own_mps = fmax(own_mps - encounter->brake_mps2 * step_s, 0);
        }
        if (encounter->lead_brakes_mps2 > 0 && t_s >= encounter->from_s) {
            lead_mps = fmax(lead_mps - encounter->lead_brakes_mps2 * step_s, encounter->to_mps);
        }
        gap_m -= (own_mps - lead_mps) * step_s;
        if (gap_m <= 0) {
            return own_mps - lead_mps;
        }
    }
    return 0;
}

static void test_that_a_standing_car_is_avoided_up_to_the_formula(void)
{
    struct encounter encounter = {.gap_m = 5, .brake_mps2 = 8};
    double most_mps =
        -8 * BEST_DRIVER_LATE_S + sqrt(64 * BEST_DRIVER_LATE_S * BEST_DRIVER_LATE_S + 2 * 8 * 5);

    TEST_ASSERT_DOUBLE_WITHIN(0.005, 6.57, most_mps); /* as the header says */
    encounter.own_mps = most_mps - 0.001;
    TEST_ASSERT_EQUAL_DOUBLE(0, best_driver_contact_mps(&encounter, BEST_DRIVER_LATE_S));
    for (double v = 7; v <= 35; v += 7) {
        encounter.own_mps = v;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(v * v - 16 * fmax(5 - v * BEST_DRIVER_LATE_S, 0)),
                                  best_driver_contact_mps(&encounter, BEST_DRIVER_LATE_S));
    }
}

static void test_that_a_braking_car_ahead_gives_what_small_steps_give(void)
{
    for (double v = 2; v <= 34; v += 4) {
        for (double b = 1; b <= 10; b += 1.5) {
            struct encounter encounter = {.own_mps = v,
                                          .gap_m = 5,
                                          .lead_mps = v,
                                          .brake_mps2 = 8,
                                          .lead_brakes_mps2 = b,
                                          .from_s = 0.3,
                                          .to_mps = v / 8};
            double act_s = BEST_DRIVER_LATE_S + best_driver_reason_s(&encounter);

            TEST_ASSERT_DOUBLE_WITHIN(0.02, summed_mps(&encounter, act_s),
                                      best_driver_contact_mps(&encounter, act_s));
        }
    }
}

static void test_that_two_cars_at_rest_do_not_touch(void)
{
    struct encounter encounter = {.own_mps = 4,
                                  .gap_m = 5,
                                  .lead_mps = 4,
                                  .brake_mps2 = 8,
                                  .lead_brakes_mps2 = 5}; /* its speed ends in a rounded 0 */

    TEST_ASSERT_EQUAL_DOUBLE(
        0,
        best_driver_contact_mps(&encounter, BEST_DRIVER_LATE_S + best_driver_reason_s(&encounter)));
}

static void test_that_the_reason_is_speed_or_a_near_gap(void)
{
    struct encounter encounter = {.own_mps = 10,
                                  .gap_m = 5,
                                  .lead_mps = 10,
                                  .brake_mps2 = 8,
                                  .lead_brakes_mps2 = 2,
                                  .from_s = 1};

    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1 + 0.25 + 0.03, best_driver_reason_s(&encounter));
    encounter.gap_m = 1.01; /* at 1 m after 0.1 s */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.1, best_driver_reason_s(&encounter));
    encounter.gap_m = 0.8;
    TEST_ASSERT_EQUAL_DOUBLE(0, best_driver_reason_s(&encounter));
}

/* 6 m/s faster than the car ahead, 5 m behind: 2 m are left when the brake acts. */
static void test_that_a_car_that_drives_on_is_met_with_the_formula(void)
{
    struct encounter encounter = {
        .own_mps = 10, .gap_m = 5, .lead_mps = 4, .brake_mps2 = 8, .from_s = 0.1};

    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(6 * 6 - 2 * 8 * 2),
                              best_driver_contact_mps(&encounter, 0.5));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_car_that_drives_on_is_met_with_the_formula);
    RUN_TEST(test_that_a_standing_car_is_avoided_up_to_the_formula);
    RUN_TEST(test_that_a_braking_car_ahead_gives_what_small_steps_give);
    RUN_TEST(test_that_two_cars_at_rest_do_not_touch);
    RUN_TEST(test_that_the_reason_is_speed_or_a_near_gap);
    return UNITY_END();
}
