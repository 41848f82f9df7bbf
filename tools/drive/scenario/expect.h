/* SPDX-License-Identifier: MIT */
/* Stated outcomes of a scenario, and what a run measures to judge them by. */
#ifndef FUZZY51_EXPECT_H
#define FUZZY51_EXPECT_H

#include <stdbool.h>
#include <stdio.h>

/* id, name, unit, decimals, kind, meaning. Times "within" count from the scenario's event_s. A
 * number that never came about is infinite: `stop_within_s <= 4` fails when the car never stops. */
/* clang-format off */
#define EXPECT_METRICS(METRIC) \
    METRIC(IMPACT, "impact", "", 0, KIND_CHOICE, "none or any: whether the car touches the one ahead") \
    METRIC(IMPACT_MPS, "impact_mps", "m/s", 3, KIND_NUMBER, "closing speed at contact; 0 without one") \
    METRIC(MIN_GAP, "min_gap_m", "m", 3, KIND_NUMBER, "smallest gap") \
    METRIC(STOP_GAP, "stop_gap_m", "m", 3, KIND_NUMBER, "gap where it last came to rest") \
    METRIC(STOP_WITHIN, "stop_within_s", "s", 3, KIND_NUMBER, "comes to rest") \
    METRIC(FINAL_SPEED, "final_speed_mps", "m/s", 3, KIND_NUMBER, "speed at the end") \
    METRIC(PEAK_DECEL, "peak_decel_mps2", "m/s2", 2, KIND_NUMBER, "strongest deceleration") \
    METRIC(PEAK_JERK, "peak_jerk_mps3", "m/s3", 1, KIND_NUMBER, "fastest change of the deceleration") \
    METRIC(RMS_ACCEL, "rms_accel_mps2", "m/s2", 2, KIND_NUMBER, "root mean square of the acceleration") \
    METRIC(STUCK, "stuck_s", "s", 2, KIND_NUMBER, "time at rest while the car ahead moves") \
    METRIC(MAX_BRAKE, "max_brake_pct", "%", 1, KIND_NUMBER, "most brake that the pins demand") \
    METRIC(MIN_BRAKE, "min_brake_pct", "%", 1, KIND_NUMBER, "least brake from event_s on") \
    METRIC(FINAL_BRAKE, "final_brake_pct", "%", 1, KIND_NUMBER, "brake at the end") \
    METRIC(FULL_BRAKE_WITHIN, "full_brake_within_s", "s", 3, KIND_NUMBER, "100 % brake is demanded") \
    METRIC(BLIND_FALL, "blind_brake_fall_pct", "%", 1, KIND_NUMBER, "largest fall of the brake while readings are missing") \
    METRIC(BLIND_RISE, "blind_brake_rise_pct", "%", 1, KIND_NUMBER, "largest rise of the brake while readings are missing") \
    METRIC(DUTY_STEPS, "duty_steps_per_s", "1/s", 2, KIND_NUMBER, "changes of the brake by more than 2 points, per second") \
    METRIC(STOP_TOGGLES, "stop_toggles", "", 0, KIND_COUNT, "changes of the STOP pin") \
    METRIC(STOP_ON, "stop_on_s", "s", 3, KIND_NUMBER, "time with the STOP pin high, in all") \
    METRIC(RELEASE_WITHIN, "release_within_s", "s", 3, KIND_NUMBER, "the STOP pin goes low for good") \
    METRIC(FAULT_WITHIN, "fault_within_s", "s", 3, KIND_NUMBER, "the state FAULT is reported") \
    METRIC(ALARM_WITHIN, "alarm_within_s", "s", 3, KIND_NUMBER, "the buzzer goes on") \
    METRIC(WARNING_LEAD, "warning_lead_s", "s", 3, KIND_NUMBER, "time from the first warning to hard braking (5 m/s2)") \
    METRIC(WARNINGS, "warnings", "", 0, KIND_COUNT, "how often lamp or buzzer go on") \
    METRIC(RESETS, "resets", "", 0, KIND_COUNT, "resets by the watchdog") \
    METRIC(RESET_BRAKE, "reset_brake_pct", "%", 1, KIND_NUMBER, "least brake after a reset") \
    METRIC(BRAKE_GAP, "brake_gap_m", "m", 2, KIND_NUMBER, "gap when it first brakes") \
    METRIC(RELEASE_GAP, "release_gap_m", "m", 2, KIND_NUMBER, "gap when it releases the brake again") \
    METRIC(RELEASE_KMH, "release_kmh", "km/h", 2, KIND_NUMBER, "own speed when it releases the brake again") \
    METRIC(PARKED, "parked", "", 0, KIND_CHOICE, "yes or no: at Y = 0, with its whole outline in the place") \
    METRIC(CONTACTS, "contacts", "", 0, KIND_COUNT, "how often the outline of the car touches a wall") \
    METRIC(END_X, "end_x_m", "m", 3, KIND_NUMBER, "distance beside the place, at Y = 0") \
    METRIC(END_TURN, "end_turn_deg", "deg", 2, KIND_NUMBER, "angle to the direction of the place, at Y = 0") \
    METRIC(ARRIVES_WITHIN, "arrives_within_s", "s", 3, KIND_NUMBER, "comes to Y = 0") \
    METRIC(BLIND_STEER, "blind_steer_deg", "deg", 2, KIND_NUMBER, "largest change of the steering while frames are bad") \
    METRIC(FINAL_GAP, "final_gap_m", "m", 3, KIND_NUMBER, "gap at the end") \
    METRIC(EVENT_ACCEL, "event_accel_mps2", "m/s2", 2, KIND_NUMBER, "acceleration at event_s") \
    METRIC(PEAK_DECEL_AT, "peak_decel_at_s", "s", 2, KIND_NUMBER, "when it brakes hardest") \
    METRIC(DECEL_AGAIN, "decel_again_mps2", "m/s2", 2, KIND_NUMBER, "how far the deceleration grows again after that") \
    METRIC(TOP_SPEED, "top_speed_mps", "m/s", 2, KIND_NUMBER, "highest speed") \
    METRIC(CLOSING_PEAK_AT, "closing_peak_at_s", "s", 2, KIND_NUMBER, "when the gap closes fastest") \
    METRIC(ASKS_LANE_AT, "asks_lane_at_s", "s", 2, KIND_NUMBER, "when it first asks for the other lane") \
    METRIC(CHANGES_LANE_AT, "changes_lane_at_s", "s", 2, KIND_NUMBER, "when it changes lanes") \
    METRIC(BLIND_ASKS, "blind_asks", "", 0, KIND_COUNT, "how often it asks for a lane while frames are bad") \
    METRIC(FINAL_STATE, "final_state", "", 0, KIND_TEXT, "state that was reported last") \
    METRIC(REACHED, "reached", "", 0, KIND_LIST, "states that must be reported, separated by commas") \
    METRIC(NEVER, "never", "", 0, KIND_LIST, "states that must not be reported") \
    METRIC(UART_SAYS, "uart_says", "", 0, KIND_PHRASE, "text that the controller must send")
/* clang-format on */

/* Numbers, counts and choices are measured by the world, the others read off the serial line. */
enum expect_kind { KIND_NUMBER, KIND_COUNT, KIND_CHOICE, KIND_TEXT, KIND_LIST, KIND_PHRASE };

#define EXPECT_ID(id, name, unit, decimals, kind, meaning) METRIC_##id,
enum metric { EXPECT_METRICS(EXPECT_ID) METRIC_COUNT };
#undef EXPECT_ID

enum { EXPECT_MAX = 24, EXPECT_VALUE = 64 };

struct expectation {
    enum metric metric;
    char op; /* '<' means <=, '>' means >=, or '=' */
    double limit;
    char text[EXPECT_VALUE];
    int line; /* in the scenario file; 0: understood without being written */
};

/* The result of a run. */
struct outcome {
    double values[METRIC_COUNT]; /* NAN: not measured in this world, or a text */
    double rest_s;               /* when the car last came to rest; INFINITY: it did not */
    char final_state[16];
    char states[EXPECT_VALUE]; /* all that occurred, each followed by a blank */
    const char *uart;          /* all that the controller said */
};

/* Nothing is measured yet, but that the controller was not reset. */
void outcome_clear(struct outcome *outcome);

const char *expect_name(enum metric metric);
const char *expect_unit(enum metric metric);
const char *expect_meaning(enum metric metric);
enum expect_kind expect_kind(enum metric metric);

/* The metric of that name, or METRIC_COUNT. */
enum metric expect_find(const char *name);

/* "min_gap_m >= 0.5" */
void expect_format(const struct expectation *expectation, char *text, size_t size);

/* What the run has for it: "2.731 m". */
void expect_value(enum metric metric, const struct outcome *outcome, char *text, size_t size);

bool expect_holds(const struct expectation *expectation, const struct outcome *outcome);

#endif
