/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/world/rig.c and pace.c, what drive measures of a car on a lane; by hand
 * calculation, with a brake that acts at once. */
#include "rig.h"
#include "pace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

static const int64_t us = 1000, ms = 1000000;
static struct scenario scenario;
static struct rig rig;
static struct outcome outcome;
/* Lamp and buzzer are on when their pin is low. */
static const bool all_off[BOARD_OUTPUTS] = {[PIN_LAMP] = true, [PIN_BUZZER] = true};

void setUp(void)
{
    memset(&scenario, 0, sizeof scenario);
    scenario.ego = (struct ego){.speed_mps = 4,
                                .brake_max_mps2 = 8,
                                .brake_lag_s = 1e-9,
                                .driver = DRIVER_COASTS,
                                .driver_mps = SCENARIO_UNSET,
                                .driver_mps2 = 2};
    scenario.lead.change_s = scenario.lead.appears_s = scenario.lead.leaves_s = SCENARIO_UNSET;
    scenario.lead.gap_m = 3;
    scenario.lead.present = true;
    scenario.hold_s = SCENARIO_UNSET;
}

void tearDown(void)
{
}

static void begin(void)
{
    rig_init(&rig, &scenario, ms);
    rig_start(&rig, all_off);
}

static double measured(enum metric metric, int64_t t_ns)
{
    outcome_clear(&outcome);
    rig_measure(&rig, t_ns, &outcome);
    return outcome.values[metric];
}

#define MEASURES(expected, metric, t_ns)                                                           \
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, expected, measured(METRIC_##metric, t_ns))
#define NEVER_CAME(metric, t_ns) TEST_ASSERT_EQUAL_DOUBLE(INFINITY, measured(METRIC_##metric, t_ns))

/* One period of the PWM from T_NS on; the next one must follow at once. */
static void period(int64_t t_ns, int64_t high_us)
{
    rig_pin(&rig, t_ns, PIN_PWM, true);
    if (high_us > 0) {
        rig_pin(&rig, t_ns + high_us * us, PIN_PWM, false);
    }
}

/* The brake is demanded like that from T_NS on. */
static void demand(int64_t t_ns, int64_t high_us)
{
    period(t_ns - 10 * ms, high_us);
    period(t_ns, high_us);
}

/* --- a stop by the STOP pin ----------------------------------------------------------------- */

/* 0.2 s at 4 m/s, then 8 m/s2: 0.8 m, and 1 m more in 0.5 s. */
static void test_that_a_stop_is_measured(void)
{
    scenario.event_s = 0.1;
    begin();
    rig_pin(&rig, 200 * ms, PIN_STOP, true);
    MEASURES(0.5, STOP_ON, 700 * ms);
    NEVER_CAME(RELEASE_WITHIN, 700 * ms);
    NEVER_CAME(RELEASE_GAP, 700 * ms);
    NEVER_CAME(RELEASE_KMH, 700 * ms);
    rig_pin(&rig, 1500 * ms, PIN_STOP, false);
    rig_advance(&rig, 2000 * ms);
    MEASURES(0, IMPACT, 2000 * ms);
    MEASURES(0, IMPACT_MPS, 2000 * ms);
    MEASURES(1.2, MIN_GAP, 2000 * ms);
    MEASURES(1.2, STOP_GAP, 2000 * ms);
    MEASURES(1.2, FINAL_GAP, 2000 * ms);
    MEASURES(0.6, STOP_WITHIN, 2000 * ms);
    MEASURES(0, FINAL_SPEED, 2000 * ms);
    MEASURES(8, PEAK_DECEL, 2000 * ms);
    MEASURES(8e9, PEAK_JERK, 2000 * ms);
    MEASURES(0, STUCK, 2000 * ms);
    MEASURES(100, MAX_BRAKE, 2000 * ms);
    MEASURES(0, MIN_BRAKE, 2000 * ms);
    MEASURES(0, FINAL_BRAKE, 2000 * ms);
    MEASURES(0.1, FULL_BRAKE_WITHIN, 2000 * ms);
    MEASURES(1, DUTY_STEPS, 2000 * ms);
    MEASURES(2, STOP_TOGGLES, 2000 * ms);
    MEASURES(1.3, STOP_ON, 2000 * ms);
    MEASURES(1.4, RELEASE_WITHIN, 2000 * ms);
    MEASURES(2.2, BRAKE_GAP, 2000 * ms);
    MEASURES(1.2, RELEASE_GAP, 2000 * ms);
    MEASURES(0, RELEASE_KMH, 2000 * ms);
    MEASURES(0, BLIND_FALL, 2000 * ms);
    MEASURES(0, BLIND_RISE, 2000 * ms);
    MEASURES(0, WARNINGS, 2000 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 4, measured(METRIC_RMS_ACCEL, 2000 * ms)); /* 64 / 4 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.7, outcome.rest_s);
    NEVER_CAME(FAULT_WITHIN, 2000 * ms);
    NEVER_CAME(ALARM_WITHIN, 2000 * ms);
}

static void test_that_a_second_stop_adds_to_the_first(void)
{
    begin();
    rig_pin(&rig, 100 * ms, PIN_STOP, true);
    rig_pin(&rig, 150 * ms, PIN_STOP, false);
    rig_pin(&rig, 250 * ms, PIN_STOP, true);
    NEVER_CAME(RELEASE_WITHIN, 250 * ms);
    rig_pin(&rig, 350 * ms, PIN_STOP, false);
    MEASURES(0.15, STOP_ON, 400 * ms);
    MEASURES(4, STOP_TOGGLES, 400 * ms);
    MEASURES(0.35, RELEASE_WITHIN, 400 * ms);
    /* The first release counts: after 0.05 s at 8 m/s2; 0.4 m driven, then 0.2 m less 0.01 m. */
    MEASURES(3.6 * 3.6, RELEASE_KMH, 400 * ms);
    MEASURES(3 - 0.4, BRAKE_GAP, 400 * ms);
    MEASURES(3 - 0.4 - 0.19, RELEASE_GAP, 400 * ms);
}

static void test_that_an_impact_is_measured_and_ends_the_run(void)
{
    begin();
    rig_advance(&rig, 740 * ms);
    TEST_ASSERT_FALSE(rig_is_over(&rig));
    rig_advance(&rig, 2000 * ms);
    TEST_ASSERT_TRUE(rig_is_over(&rig));
    MEASURES(1, IMPACT, 2000 * ms);
    MEASURES(4, IMPACT_MPS, 2000 * ms);
    NEVER_CAME(STOP_WITHIN, 2000 * ms);
    NEVER_CAME(FULL_BRAKE_WITHIN, 2000 * ms);
    NEVER_CAME(WARNING_LEAD, 2000 * ms);
    NEVER_CAME(BRAKE_GAP, 2000 * ms);
}

static void test_that_a_run_is_over_when_all_has_stood_for_so_long(void)
{
    scenario.hold_s = 0.25;
    begin();
    rig_pin(&rig, 100 * ms, PIN_STOP, true); /* at rest at 0.6 s */
    rig_advance(&rig, 850 * ms);
    TEST_ASSERT_FALSE(rig_is_over(&rig)); /* the record says 0.601 s: the end of that step */
    rig_advance(&rig, 852 * ms);
    TEST_ASSERT_TRUE(rig_is_over(&rig));
    scenario.hold_s = SCENARIO_UNSET;
    begin();
    rig_pin(&rig, 100 * ms, PIN_STOP, true);
    rig_advance(&rig, 9000 * ms);
    TEST_ASSERT_FALSE(rig_is_over(&rig));
    scenario.hold_s = 0;
    scenario.ego.speed_mps = 0;
    begin();
    rig_advance(&rig, 1 * ms);
    TEST_ASSERT_TRUE(rig_is_over(&rig));
}

/* --- the PWM -------------------------------------------------------------------------------- */

static void test_that_the_brake_is_the_duty(void)
{
    begin();
    demand(20 * ms, 3000);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 30, rig.car.demand_pct);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 4 - 2.4 * 0.003, rig.car.v_mps); /* the pin fell at 23 ms */
    rig_advance(&rig, 100 * ms); /* no edge after 23 ms: 0 % from 38 ms on */
    TEST_ASSERT_EQUAL_DOUBLE(0, rig.car.demand_pct);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 4 - 2.4 * 0.018, rig.car.v_mps);
    MEASURES(30, MAX_BRAKE, 100 * ms);
    rig_pin(&rig, 110 * ms, PIN_PWM, true); /* high for good: 100 % from 125 ms on */
    rig_advance(&rig, 124 * ms);
    MEASURES(0, FINAL_BRAKE, 124 * ms);
    rig_advance(&rig, 126 * ms);
    MEASURES(100, FINAL_BRAKE, 126 * ms);
    MEASURES(0.125, FULL_BRAKE_WITHIN, 126 * ms);
}

static void test_that_stop_comes_before_the_duty(void)
{
    begin();
    demand(20 * ms, 3000);
    rig_pin(&rig, 25 * ms, PIN_STOP, true);
    MEASURES(100, FINAL_BRAKE, 25 * ms);
    rig_pin(&rig, 26 * ms, PIN_STOP, false);
    MEASURES(30, FINAL_BRAKE, 26 * ms);
}

static void test_that_the_start_has_the_duty_of_the_pins_before_it(void)
{
    bool levels[BOARD_OUTPUTS];

    memcpy(levels, all_off, sizeof levels);
    levels[PIN_PWM] = true;
    rig_init(&rig, &scenario, ms);
    demand(20 * ms, 3000);
    TEST_ASSERT_EQUAL_DOUBLE(4, rig.car.v_mps);
    TEST_ASSERT_EQUAL_INT64(0, rig.car.now_ns);
    rig_start(&rig, levels);
    rig_advance(&rig, 5 * ms);
    MEASURES(30, FINAL_BRAKE, 5 * ms);
    MEASURES(30, MIN_BRAKE, 5 * ms);
    MEASURES(30, MAX_BRAKE, 5 * ms);
    MEASURES(0, DUTY_STEPS, 5 * ms);
    MEASURES(3, BRAKE_GAP, 5 * ms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 4 - 2.4 * 0.005, rig.car.v_mps);

    rig_init(&rig, &scenario, ms); /* its last edge is long over when another pin moves */
    demand(20 * ms, 3000);
    rig_pin(&rig, 38 * ms, PIN_LAMP, true);
    rig_start(&rig, all_off);
    MEASURES(0, FINAL_BRAKE, 5 * ms);

    rig_init(&rig, &scenario, ms); /* no edge at all */
    rig_pin(&rig, 1 * ms, PIN_STOP, false);
    MEASURES(0, STOP_TOGGLES, 1 * ms);
    rig_start(&rig, levels);
    MEASURES(100, FINAL_BRAKE, 5 * ms);
    rig_init(&rig, &scenario, ms);
    rig_start(&rig, all_off);
    MEASURES(0, FINAL_BRAKE, 5 * ms);
}

/* The pin was high for long, and fell just before the start: its duty is known 15 ms later. */
static void test_that_a_pin_that_has_just_fallen_is_not_steady(void)
{
    rig_init(&rig, &scenario, ms);
    rig_pin(&rig, 1 * ms, PIN_PWM, false);
    rig_start(&rig, all_off);
    rig_advance(&rig, 15 * ms - 1);
    MEASURES(100, FINAL_BRAKE, 15 * ms - 1);
    rig_advance(&rig, 15 * ms);
    MEASURES(0, FINAL_BRAKE, 15 * ms);
}

static void test_that_a_pin_is_noted_before_the_start(void)
{
    rig_init(&rig, &scenario, ms);
    rig_pin(&rig, 1 * ms, PIN_STOP, true);
    TEST_ASSERT_TRUE(rig.levels[PIN_STOP]);
    rig_throttle(&rig, 40);
    TEST_ASSERT_EQUAL_DOUBLE(0, rig.car.demand_pct);
    rig_start(&rig, all_off); /* the pins as they are now */
    MEASURES(0, FINAL_BRAKE, 5 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(-40, rig.car.demand_pct);
}

static void test_that_the_throttle_is_a_brake_of_less_than_0(void)
{
    begin();
    rig_throttle(&rig, 40);
    TEST_ASSERT_EQUAL_DOUBLE(-40, rig.car.demand_pct);
    MEASURES(0, MIN_BRAKE, 10 * ms);
    MEASURES(0, FINAL_BRAKE, 10 * ms);
    MEASURES(0, MAX_BRAKE, 10 * ms);
    NEVER_CAME(BRAKE_GAP, 10 * ms);
    demand(20 * ms, 3000);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 30, rig.car.demand_pct);
    NEVER_CAME(RELEASE_GAP, 20 * ms);
    rig_advance(&rig, 100 * ms);
    TEST_ASSERT_EQUAL_DOUBLE(-40, rig.car.demand_pct);
    MEASURES(rig.release_gap_m, RELEASE_GAP, 100 * ms);
}

static void test_that_steps_of_more_than_2_points_are_counted(void)
{
    begin();
    demand(20 * ms, 3000); /* from 0 %: one */
    MEASURES(1 / 0.1, DUTY_STEPS, 100 * ms);
    MEASURES(0, STOP_TOGGLES, 100 * ms); /* the PWM is another pin */
    period(30 * ms, 3200);
    period(40 * ms, 3201); /* 32 %: 2 points, which is not more */
    MEASURES(1 / 0.1, DUTY_STEPS, 100 * ms);
    period(50 * ms, 3200); /* 32.01 % */
    MEASURES(2 / 0.1, DUTY_STEPS, 100 * ms);
    period(60 * ms, 3000); /* back to 32 %: less than 2 from the last that was counted */
    period(70 * ms, 3000); /* 30 %: 2.01 points */
    MEASURES(3 / 0.1, DUTY_STEPS, 100 * ms);
    NEVER_CAME(RELEASE_GAP, 100 * ms);
}

static void test_that_hard_braking_is_5_mps2(void)
{
    scenario.ego.brake_max_mps2 = 10;
    begin();
    rig_pin(&rig, 5 * ms, PIN_LAMP, false);
    demand(20 * ms, 4999);
    NEVER_CAME(WARNING_LEAD, 20 * ms);
    period(30 * ms, 5000);
    period(40 * ms, 5000); /* 50 % of 10 m/s2 */
    MEASURES(0.035, WARNING_LEAD, 40 * ms);
    period(50 * ms, 9000);
    period(60 * ms, 9000);
    MEASURES(0.035, WARNING_LEAD, 60 * ms);
}

/* --- the event ------------------------------------------------------------------------------ */

static void test_that_what_counts_from_the_event_on_is_noted_there(void)
{
    scenario.event_s = 0.1;
    begin();
    rig_pin(&rig, 10 * ms, PIN_STOP, true);
    rig_pin(&rig, 20 * ms, PIN_BUZZER, false);
    rig_pin(&rig, 30 * ms, PIN_BUZZER, true);
    rig_state_reported(&rig, 40 * ms, "FAULT");
    rig_advance(&rig, 99 * ms);
    NEVER_CAME(FULL_BRAKE_WITHIN, 99 * ms);
    NEVER_CAME(ALARM_WITHIN, 99 * ms);
    NEVER_CAME(FAULT_WITHIN, 99 * ms);
    rig_advance(&rig, 150 * ms);
    MEASURES(0, FULL_BRAKE_WITHIN, 150 * ms);
    MEASURES(100, MIN_BRAKE, 150 * ms);
    rig_pin(&rig, 160 * ms, PIN_STOP, false);
    rig_pin(&rig, 170 * ms, PIN_STOP, true);
    MEASURES(0, FULL_BRAKE_WITHIN, 170 * ms);
    MEASURES(0, MIN_BRAKE, 170 * ms);
    rig_pin(&rig, 180 * ms, PIN_BUZZER, false);
    rig_pin(&rig, 190 * ms, PIN_BUZZER, true);
    rig_pin(&rig, 200 * ms, PIN_BUZZER, false);
    MEASURES(0.08, ALARM_WITHIN, 200 * ms);
    rig_state_reported(&rig, 205 * ms, "CONTROL");
    NEVER_CAME(FAULT_WITHIN, 205 * ms);
    rig_state_reported(&rig, 210 * ms, "FAULT");
    rig_state_reported(&rig, 220 * ms, "FAULT");
    MEASURES(0.11, FAULT_WITHIN, 220 * ms);
}

static void test_that_a_buzzer_that_goes_off_is_no_alarm(void)
{
    scenario.event_s = 0.1;
    begin();
    rig_pin(&rig, 50 * ms, PIN_BUZZER, false);
    rig_pin(&rig, 150 * ms, PIN_BUZZER, true);
    NEVER_CAME(ALARM_WITHIN, 200 * ms);
}

static void test_that_the_moment_of_the_event_belongs_to_it(void)
{
    scenario.event_s = 0.1;
    begin();
    rig_pin(&rig, 100 * ms, PIN_BUZZER, false);
    rig_pin(&rig, 100 * ms, PIN_STOP, true);
    rig_state_reported(&rig, 100 * ms, "FAULT");
    MEASURES(0, ALARM_WITHIN, 100 * ms);
    MEASURES(0, FULL_BRAKE_WITHIN, 100 * ms);
    MEASURES(0, FAULT_WITHIN, 100 * ms);
}

/* The least brake since the event is that at the event, although it grows afterwards. */
static void test_that_the_brake_at_the_event_counts(void)
{
    scenario.event_s = 0.035;
    begin();
    demand(20 * ms, 3000);
    period(30 * ms, 5000);
    period(40 * ms, 5000);
    MEASURES(30, MIN_BRAKE, 40 * ms);
}

/* --- blind ---------------------------------------------------------------------------------- */

static void test_that_changes_while_blind_are_measured_from_before(void)
{
    begin();
    demand(20 * ms, 3000);
    period(30 * ms, 4000);
    period(40 * ms, 4000);
    MEASURES(0, BLIND_RISE, 40 * ms);
    rig_blind(&rig, true);
    period(50 * ms, 2500);
    period(60 * ms, 2500);
    MEASURES(15, BLIND_FALL, 60 * ms);
    MEASURES(0, BLIND_RISE, 60 * ms);
    rig_blind(&rig, true); /* still: what was seen last stays */
    period(70 * ms, 6000);
    period(80 * ms, 6000);
    MEASURES(15, BLIND_FALL, 80 * ms);
    MEASURES(20, BLIND_RISE, 80 * ms);
    rig_blind(&rig, false);
    period(90 * ms, 9000);
    period(100 * ms, 9000);
    rig_blind(&rig, true);
    MEASURES(15, BLIND_FALL, 100 * ms);
    MEASURES(20, BLIND_RISE, 100 * ms);
    period(110 * ms, 7000);
    period(120 * ms, 7000);
    MEASURES(20, BLIND_FALL, 120 * ms);
}

/* --- lamp and buzzer ------------------------------------------------------------------------ */

static void test_that_lamp_and_buzzer_together_are_one_warning(void)
{
    begin();
    rig_pin(&rig, 10 * ms, PIN_LAMP, false);
    MEASURES(1, WARNINGS, 10 * ms);
    rig_pin(&rig, 20 * ms, PIN_BUZZER, false);
    MEASURES(1, WARNINGS, 20 * ms);
    rig_pin(&rig, 30 * ms, PIN_LAMP, true);
    rig_pin(&rig, 40 * ms, PIN_BUZZER, true);
    MEASURES(1, WARNINGS, 40 * ms);
    rig_pin(&rig, 50 * ms, PIN_BUZZER, false);
    MEASURES(2, WARNINGS, 50 * ms);
    MEASURES(0.02, ALARM_WITHIN, 50 * ms);
    rig_pin(&rig, 60 * ms, PIN_STOP, true);
    MEASURES(0.05, WARNING_LEAD, 60 * ms);
}

static void test_that_a_lamp_that_is_on_at_the_start_is_a_warning(void)
{
    bool levels[BOARD_OUTPUTS] = {[PIN_LAMP] = true};

    rig_init(&rig, &scenario, ms);
    rig_start(&rig, levels);
    MEASURES(1, WARNINGS, 10 * ms);
    rig_pin(&rig, 10 * ms, PIN_STOP, true);
    MEASURES(0.01, WARNING_LEAD, 10 * ms);
    levels[PIN_LAMP] = false;
    levels[PIN_BUZZER] = true;
    rig_init(&rig, &scenario, ms);
    rig_start(&rig, levels);
    MEASURES(1, WARNINGS, 10 * ms);
}

/* --- the trace ------------------------------------------------------------------------------ */

static void test_that_a_row_has_the_values_of_its_time(void)
{
    double row[RIG_COLUMNS];

    scenario.lead.speed_mps = 1;
    begin();
    rig_pin(&rig, 100 * ms, PIN_STOP, true);
    rig_pin(&rig, 100 * ms, PIN_LAMP, false);
    rig_advance(&rig, 200 * ms);
    rig_values(&rig, row);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3 - 0.4 - 0.4 + 0.04 + 0.2, row[RIG_GAP]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3.2, row[RIG_OWN_SPEED]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1, row[RIG_LEAD_SPEED]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, -8, row[RIG_ACCEL]);
    TEST_ASSERT_EQUAL_DOUBLE(100, row[RIG_BRAKE]);
    TEST_ASSERT_EQUAL_DOUBLE(1, row[5]);
    TEST_ASSERT_EQUAL_DOUBLE(1, row[6]);
    TEST_ASSERT_EQUAL_DOUBLE(0, row[7]);
    scenario.lead.present = false;
    begin();
    rig_pin(&rig, 100 * ms, PIN_BUZZER, false);
    rig_throttle(&rig, 40);
    rig_values(&rig, row);
    TEST_ASSERT_TRUE(isnan(row[RIG_GAP]) && isnan(row[RIG_LEAD_SPEED]));
    TEST_ASSERT_EQUAL_DOUBLE(0, row[RIG_BRAKE]);
    TEST_ASSERT_EQUAL_DOUBLE(0, row[5]);
    TEST_ASSERT_EQUAL_DOUBLE(0, row[6]);
    TEST_ASSERT_EQUAL_DOUBLE(1, row[7]);
}

/* --- the picture ---------------------------------------------------------------------------- */

static char *drawn;
static size_t drawn_bytes;

static struct picture new_picture(void)
{
    struct picture picture = {
        .out = open_memstream(&drawn, &drawn_bytes), .width = 60, .view_m = 10};

    TEST_ASSERT_NOT_NULL(picture.out);
    return picture;
}

static void was_drawn(const struct picture *picture, const char *expected, int lines)
{
    fclose(picture->out);
    TEST_ASSERT_EQUAL_STRING(expected, drawn);
    TEST_ASSERT_EQUAL_INT(lines, picture->lines);
    free(drawn);
}

#define END  "\033[K\n"
#define RAIL "------------------------------------------------------------" END

/* The road is 51 characters long, and the car ahead in the middle of its 10 m. */
static void test_that_the_road_is_drawn(void)
{
    const double values[RIG_COLUMNS] = {[RIG_GAP] = 5, [RIG_OWN_SPEED] = 2, [RIG_BRAKE] = 3};
    struct picture picture = new_picture();

    rig_draw_road(&picture, values, NAN);
    was_drawn(&picture, RAIL "[##>   .   .   .   .   .   . [##]" END RAIL, 3);
    picture = new_picture();
    rig_draw_road(&picture, values, 2);
    was_drawn(&picture, RAIL "[##>   .   .  |.   .   .   . [##]" END RAIL, 3);
}

/* A bar is 36 characters long. */
static void test_that_the_bars_are_drawn(void)
{
    double values[RIG_COLUMNS] = {[RIG_GAP] = 2.5, [RIG_OWN_SPEED] = 3.25, [RIG_BRAKE] = 87.5};
    struct picture picture = new_picture();

    rig_draw_bars(&picture, values);
    was_drawn(&picture,
              " gap         2.50 m     #########..........................." END
              " brake      87.50 %     ################################...." END
              " speed       3.25 m/s" END,
              3);
    values[RIG_GAP] = NAN; /* nothing ahead */
    values[RIG_BRAKE] = 0;
    picture = new_picture();
    rig_draw_bars(&picture, values);
    was_drawn(&picture,
              " gap            -       ####################################" END
              " brake       0.00 %     ...................................." END
              " speed       3.25 m/s" END,
              3);
}

/* --- pace ----------------------------------------------------------------------------------- */

static void test_that_the_shortest_pause_is_the_pace(void)
{
    struct pace pace = {0};

    pace_note(&pace, 100 * ms); /* the first trigger: no pause yet */
    TEST_ASSERT_EQUAL_INT64(0, pace.pause_ns);
    TEST_ASSERT_EQUAL_INT64(100 * ms, pace_next_ns(&pace, 100 * ms));
    pace_note(&pace, 1100 * ms); /* a second says nothing */
    TEST_ASSERT_EQUAL_INT64(0, pace.pause_ns);
    pace_note(&pace, 2100 * ms - 1);
    TEST_ASSERT_EQUAL_INT64(1000 * ms - 1, pace.pause_ns);
    pace_note(&pace, 2200 * ms);
    pace_note(&pace, 2260 * ms);
    pace_note(&pace, 2330 * ms);
    TEST_ASSERT_EQUAL_INT64(60 * ms, pace.pause_ns);
    TEST_ASSERT_EQUAL_INT64(2388 * ms, pace_next_ns(&pace, 2340 * ms)); /* 2 ms early */
    TEST_ASSERT_EQUAL_INT64(2400 * ms, pace_next_ns(&pace, 2400 * ms));
    pace = (struct pace){0};
    pace_note(&pace, 1);
    pace_note(&pace, 11);
    TEST_ASSERT_EQUAL_INT64(10, pace.pause_ns);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_stop_is_measured);
    RUN_TEST(test_that_a_second_stop_adds_to_the_first);
    RUN_TEST(test_that_an_impact_is_measured_and_ends_the_run);
    RUN_TEST(test_that_a_run_is_over_when_all_has_stood_for_so_long);
    RUN_TEST(test_that_the_brake_is_the_duty);
    RUN_TEST(test_that_stop_comes_before_the_duty);
    RUN_TEST(test_that_the_start_has_the_duty_of_the_pins_before_it);
    RUN_TEST(test_that_a_pin_that_has_just_fallen_is_not_steady);
    RUN_TEST(test_that_a_pin_is_noted_before_the_start);
    RUN_TEST(test_that_the_throttle_is_a_brake_of_less_than_0);
    RUN_TEST(test_that_steps_of_more_than_2_points_are_counted);
    RUN_TEST(test_that_hard_braking_is_5_mps2);
    RUN_TEST(test_that_what_counts_from_the_event_on_is_noted_there);
    RUN_TEST(test_that_a_buzzer_that_goes_off_is_no_alarm);
    RUN_TEST(test_that_the_moment_of_the_event_belongs_to_it);
    RUN_TEST(test_that_the_brake_at_the_event_counts);
    RUN_TEST(test_that_changes_while_blind_are_measured_from_before);
    RUN_TEST(test_that_lamp_and_buzzer_together_are_one_warning);
    RUN_TEST(test_that_a_lamp_that_is_on_at_the_start_is_a_warning);
    RUN_TEST(test_that_a_row_has_the_values_of_its_time);
    RUN_TEST(test_that_the_road_is_drawn);
    RUN_TEST(test_that_the_bars_are_drawn);
    RUN_TEST(test_that_the_shortest_pause_is_the_pace);
    return UNITY_END();
}
