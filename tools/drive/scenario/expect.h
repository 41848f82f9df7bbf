/* Stated outcomes of a scenario, and what a run measures to judge them by. */
#ifndef FUZZY51_EXPECT_H
#define FUZZY51_EXPECT_H

#include <stdbool.h>
#include <stdio.h>

/* id, name, unit, decimals, kind. Times "within" count from the scenario's event_s. A number that
 * never came about is infinite: `stop_within_s <= 4` fails when the car never stops. */
#define EXPECT_METRICS(METRIC)                                                                     \
    METRIC(IMPACT, "impact", "", 0, KIND_TEXT)              /* none, or any */                     \
    METRIC(IMPACT_MPS, "impact_mps", "m/s", 3, KIND_NUMBER) /* closing speed at contact */         \
    METRIC(MIN_GAP, "min_gap_m", "m", 3, KIND_NUMBER)                                              \
    METRIC(STOP_GAP, "stop_gap_m", "m", 3, KIND_NUMBER)       /* when it last came to rest */      \
    METRIC(STOP_WITHIN, "stop_within_s", "s", 3, KIND_NUMBER) /* comes to rest */                  \
    METRIC(FINAL_SPEED, "final_speed_mps", "m/s", 3, KIND_NUMBER)                                  \
    METRIC(PEAK_DECEL, "peak_decel_mps2", "m/s2", 2, KIND_NUMBER)                                  \
    METRIC(PEAK_JERK, "peak_jerk_mps3", "m/s3", 1, KIND_NUMBER)                                    \
    METRIC(RMS_ACCEL, "rms_accel_mps2", "m/s2", 2, KIND_NUMBER)                                    \
    METRIC(STUCK, "stuck_s", "s", 2, KIND_NUMBER)           /* stands while the lead moves */      \
    METRIC(MAX_BRAKE, "max_brake_pct", "%", 1, KIND_NUMBER) /* as the pins demand it */            \
    METRIC(MIN_BRAKE, "min_brake_pct", "%", 1, KIND_NUMBER) /* from event_s on */                  \
    METRIC(FINAL_BRAKE, "final_brake_pct", "%", 1, KIND_NUMBER)                                    \
    METRIC(FULL_BRAKE_WITHIN, "full_brake_within_s", "s", 3, KIND_NUMBER)                          \
    METRIC(BLIND_FALL, "blind_brake_fall_pct", "%", 1, KIND_NUMBER) /* while readings miss */      \
    METRIC(BLIND_RISE, "blind_brake_rise_pct", "%", 1, KIND_NUMBER) /* the same upwards */         \
    METRIC(DUTY_STEPS, "duty_steps_per_s", "1/s", 2, KIND_NUMBER)   /* of more than 2 points */    \
    METRIC(STOP_TOGGLES, "stop_toggles", "", 0, KIND_COUNT)         /* changes of the stop line */ \
    METRIC(STOP_ON, "stop_on_s", "s", 3, KIND_NUMBER)               /* stop line high, in all */   \
    METRIC(RELEASE_WITHIN, "release_within_s", "s", 3, KIND_NUMBER) /* stop line low for good */   \
    METRIC(FAULT_WITHIN, "fault_within_s", "s", 3, KIND_NUMBER)     /* FAULT reported */           \
    METRIC(ALARM_WITHIN, "alarm_within_s", "s", 3, KIND_NUMBER)     /* buzzer goes on */           \
    METRIC(WARNING_LEAD, "warning_lead_s", "s", 3, KIND_NUMBER)     /* before hard braking */      \
    METRIC(WARNINGS, "warnings", "", 0, KIND_COUNT)                 /* lamp or buzzer goes on */   \
    METRIC(RESETS, "resets", "", 0, KIND_COUNT)                     /* by the watchdog */          \
    METRIC(RESET_BRAKE, "reset_brake_pct", "%", 1, KIND_NUMBER)     /* lowest after a reset */     \
    METRIC(BRAKE_GAP, "brake_gap_m", "m", 2, KIND_NUMBER)           /* when it first brakes */     \
    METRIC(RELEASE_GAP, "release_gap_m", "m", 2, KIND_NUMBER)       /* when it lets go again */    \
    METRIC(RELEASE_KMH, "release_kmh", "km/h", 2, KIND_NUMBER)      /* the own speed then */       \
    METRIC(PARKED, "parked", "", 0, KIND_TEXT)              /* yes: within 0.4 m and 2 degrees */  \
    METRIC(END_X, "end_x_m", "m", 3, KIND_NUMBER)           /* beside the place, at Y = 0 */       \
    METRIC(END_TURN, "end_turn_deg", "deg", 2, KIND_NUMBER) /* off the place's direction */        \
    METRIC(ARRIVES_WITHIN, "arrives_within_s", "s", 3, KIND_NUMBER) /* at Y = 0 */                 \
    METRIC(BLIND_STEER, "blind_steer_deg", "deg", 2, KIND_NUMBER)   /* change on bad frames */     \
    METRIC(FINAL_GAP, "final_gap_m", "m", 3, KIND_NUMBER)                                          \
    METRIC(EVENT_ACCEL, "event_accel_mps2", "m/s2", 2, KIND_NUMBER) /* at event_s */               \
    METRIC(PEAK_DECEL_AT, "peak_decel_at_s", "s", 2, KIND_NUMBER)                                  \
    METRIC(DECEL_AGAIN, "decel_again_mps2", "m/s2", 2, KIND_NUMBER) /* its growth after that */    \
    METRIC(TOP_SPEED, "top_speed_mps", "m/s", 2, KIND_NUMBER)                                      \
    METRIC(CLOSING_PEAK_AT, "closing_peak_at_s", "s", 2, KIND_NUMBER) /* fastest approach */       \
    METRIC(ASKS_LANE_AT, "asks_lane_at_s", "s", 2, KIND_NUMBER)       /* for the first time */     \
    METRIC(CHANGES_LANE_AT, "changes_lane_at_s", "s", 2, KIND_NUMBER)                              \
    METRIC(BLIND_ASKS, "blind_asks", "", 0, KIND_COUNT) /* for a lane, on bad frames */            \
    METRIC(FINAL_STATE, "final_state", "", 0, KIND_TEXT)                                           \
    METRIC(REACHED, "reached", "", 0, KIND_LIST)       /* states that must occur */                \
    METRIC(NEVER, "never", "", 0, KIND_LIST)           /* states that must not */                  \
    METRIC(UART_SAYS, "uart_says", "", 0, KIND_PHRASE) /* text on the serial line */

enum expect_kind { KIND_NUMBER, KIND_COUNT, KIND_TEXT, KIND_LIST, KIND_PHRASE };

#define EXPECT_ID(id, name, unit, decimals, kind) METRIC_##id,
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

/* What a run came to. */
struct outcome {
    double values[METRIC_COUNT]; /* of the numbers and counts; NAN: not measured in this world */
    double rest_s;               /* when the car last came to rest; INFINITY: it did not */
    char final_state[16];
    char states[EXPECT_VALUE]; /* all that occurred, each followed by a blank */
    const char *uart;          /* all that the controller said */
};

const char *expect_name(enum metric metric);
const char *expect_unit(enum metric metric);
enum expect_kind expect_kind(enum metric metric);

/* The metric of that name, or METRIC_COUNT. */
enum metric expect_find(const char *name);

/* "min_gap_m >= 0.5" */
void expect_format(const struct expectation *expectation, char *text, size_t size);

/* What the run has for it: "2.731 m". */
void expect_value(enum metric metric, const struct outcome *outcome, char *text, size_t size);

bool expect_holds(const struct expectation *expectation, const struct outcome *outcome);

#endif
