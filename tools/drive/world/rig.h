/* SPDX-License-Identifier: MIT */
/* What every world with a car on a lane has: the car, the brake as PWM and STOP pin demand it,
 * lamp and buzzer, and the record of what they did. */
#ifndef FUZZY51_RIG_H
#define FUZZY51_RIG_H

#include "board.h"
#include "car.h"
#include "expect.h"
#include "pwm.h"
#include "world.h"

#include <stdbool.h>
#include <stdint.h>

struct rig {
    struct car car;
    struct pwm pwm;
    bool levels[BOARD_OUTPUTS];
    bool started;
    bool has_duty;          /* the PWM was read before the start */
    double throttle_pct;    /* where the controller has it; 0 otherwise */
    bool blind;             /* readings are missing: the demand must not leave seen_pct */
    double event_s, hold_s; /* as in the scenario */
    int64_t now_ns, event_ns;
    /* what is measured beside the car's own record */
    double seen_pct, blind_fall_pct, blind_rise_pct;
    double max_brake_pct, min_brake_pct, full_brake_s, counted_duty_pct, duty_steps;
    double stop_toggles, stop_on_s, stop_rise_s, stop_fall_s;
    double warnings, first_warning_s, hard_braking_s, first_fault_s, alarm_s;
    double brake_gap_m, release_gap_m, release_kmh;
};

/* The columns of the trace that a rig fills, in this order. */
enum { RIG_COLUMNS = 8 };
#define RIG_COLUMN_NAMES                                                                           \
    {"gap_m", 4}, {"ego_mps", 4}, {"lead_mps", 4}, {"accel_mps2", 3}, {"brake_pct", 1},            \
        {"stop", 0}, {"lamp", 0}, {"buzzer", 0}
enum { RIG_GAP, RIG_OWN_SPEED, RIG_LEAD_SPEED, RIG_ACCEL, RIG_BRAKE };

void rig_init(struct rig *rig, const struct scenario *scenario, int64_t step_ns);

/* t = 0, with the output pins at LEVELS. */
void rig_start(struct rig *rig, const bool levels[BOARD_OUTPUTS]);

/* The car drives until T_NS; stands still before rig_start. */
void rig_advance(struct rig *rig, int64_t t_ns);

/* An output pin goes to LEVEL at T_NS; advances to there. Pins that are no part of a rig are only
 * noted. */
void rig_pin(struct rig *rig, int64_t t_ns, enum board_pin pin, bool level);

/* The controller's throttle is open so far: the same as a brake of less than 0, unless that is on.
 */
void rig_throttle(struct rig *rig, double throttle_pct);

/* From now on readings are missing, or no longer. */
void rig_blind(struct rig *rig, bool blind);

/* The functions of struct world_class that are a rig's alone. */
void rig_state_reported(struct rig *rig, int64_t t_ns, const char *state);
bool rig_is_over(const struct rig *rig);
void rig_values(const struct rig *rig, double *row);

/* Draws a road with the gap, or with a mark MARK_M ahead (NAN: none), then gap, brake and speed. */
void rig_draw_road(struct picture *picture, const double *values, double mark_m);
void rig_draw_bars(struct picture *picture, const double *values);
void rig_measure(const struct rig *rig, int64_t t_ns, struct outcome *outcome);

#endif
