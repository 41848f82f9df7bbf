/* SPDX-License-Identifier: MIT */
#include "rig.h"

#include <math.h>
#include <string.h>

/* Hard braking is what UN R152 asks of emergency braking. */
static const double hard_braking_mps2 = 5.0;
static const double duty_step_pct = 2.0;

static double seconds(int64_t t_ns)
{
    return (double)t_ns * 1e-9;
}

/* --- the brake ---------------------------------------------------------------------------- */

static double demand_pct(const struct rig *rig)
{
    double brake_pct = rig->levels[PIN_STOP] ? 100 : rig->pwm.duty_pct;

    return brake_pct > 0 ? brake_pct : -rig->throttle_pct;
}

static void note_release(struct rig *rig, double demand)
{
    bool first = isnan(rig->brake_gap_m);

    if (first && demand > 0) {
        rig->brake_gap_m = car_gap_m(&rig->car);
    }
    if (!first && isnan(rig->release_gap_m) && demand <= 0) {
        rig->release_gap_m = car_gap_m(&rig->car);
        rig->release_kmh = rig->car.v_mps * 3.6;
    }
}

static void note_demand(struct rig *rig)
{
    double demand = rig->car.demand_pct, t_s = seconds(rig->now_ns);

    rig->max_brake_pct = fmax(rig->max_brake_pct, demand);
    if (rig->now_ns >= rig->event_ns) {
        rig->min_brake_pct = fmin(rig->min_brake_pct, fmax(demand, 0));
        if (demand >= 100 && isinf(rig->full_brake_s)) {
            rig->full_brake_s = t_s;
        }
    }
    if (isinf(rig->hard_braking_s) &&
        demand / 100 * rig->car.ego.brake_max_mps2 >= hard_braking_mps2) {
        rig->hard_braking_s = t_s;
    }
    if (fabs(demand - rig->counted_duty_pct) > duty_step_pct) {
        rig->counted_duty_pct = demand;
        rig->duty_steps++;
    }
    if (rig->blind) {
        rig->blind_fall_pct = fmax(rig->blind_fall_pct, rig->seen_pct - demand);
        rig->blind_rise_pct = fmax(rig->blind_rise_pct, demand - rig->seen_pct);
    }
    note_release(rig, demand);
}

static void update_demand(struct rig *rig)
{
    double demand = demand_pct(rig);

    if (demand < rig->car.demand_pct || demand > rig->car.demand_pct) {
        car_demand(&rig->car, rig->now_ns, demand);
        note_demand(rig);
    }
}

void rig_throttle(struct rig *rig, double throttle_pct)
{
    rig->throttle_pct = throttle_pct;
    if (rig->started) {
        update_demand(rig);
    }
}

void rig_blind(struct rig *rig, bool blind)
{
    if (!rig->blind) {
        rig->seen_pct = rig->car.demand_pct;
    }
    rig->blind = blind;
}

/* --- time and pins ------------------------------------------------------------------------ */

void rig_advance(struct rig *rig, int64_t t_ns)
{
    while (rig->started && rig->now_ns < t_ns) {
        int64_t next = t_ns, steady = pwm_steady_ns(&rig->pwm);

        if (steady < next) {
            next = steady;
        }
        if (rig->event_ns > rig->now_ns && rig->event_ns < next) {
            next = rig->event_ns;
        }
        car_advance(&rig->car, next);
        rig->now_ns = next;
        if (next == steady && pwm_settle(&rig->pwm)) {
            update_demand(rig);
        }
        if (next == rig->event_ns) {
            note_demand(rig);
        }
    }
}

static void warning_goes_on(struct rig *rig)
{
    bool both = !rig->levels[PIN_LAMP] && !rig->levels[PIN_BUZZER];

    if (!both) { /* the first of the two */
        rig->warnings++;
    }
    if (isinf(rig->first_warning_s)) {
        rig->first_warning_s = seconds(rig->now_ns);
    }
}

static void stop_pin_changes(struct rig *rig, bool level)
{
    rig->stop_toggles++;
    if (level) {
        rig->stop_rise_s = seconds(rig->now_ns);
        rig->stop_fall_s = INFINITY;
    } else {
        rig->stop_fall_s = seconds(rig->now_ns);
        rig->stop_on_s += rig->stop_fall_s - rig->stop_rise_s;
    }
    update_demand(rig);
}

/* While the world stands, so that it starts at the duty that the controller has set by then. */
static void read_duty_early(struct rig *rig, int64_t t_ns, enum board_pin pin, bool level)
{
    if (pwm_steady_ns(&rig->pwm) <= t_ns) {
        pwm_settle(&rig->pwm);
    }
    if (pin != PIN_PWM) {
        return;
    }
    pwm_edge(&rig->pwm, t_ns, level);
    rig->has_duty = true;
}

void rig_pin(struct rig *rig, int64_t t_ns, enum board_pin pin, bool level)
{
    rig_advance(rig, t_ns);
    rig->levels[pin] = level;
    if (!rig->started) {
        read_duty_early(rig, t_ns, pin, level);
        return;
    }
    switch (pin) {
    case PIN_PWM:
        if (pwm_edge(&rig->pwm, rig->now_ns, level)) {
            update_demand(rig);
        }
        break;
    case PIN_STOP:
        stop_pin_changes(rig, level);
        break;
    case PIN_LAMP:
    case PIN_BUZZER:
        if (!level) {
            warning_goes_on(rig);
        }
        if (!level && pin == PIN_BUZZER && rig->now_ns >= rig->event_ns) {
            rig->alarm_s = fmin(rig->alarm_s, seconds(rig->now_ns));
        }
        break;
    default:
        break;
    }
}

/* --- life and outcome --------------------------------------------------------------------- */

void rig_init(struct rig *rig, const struct scenario *scenario, int64_t step_ns)
{
    memset(rig, 0, sizeof *rig);
    car_init(&rig->car, scenario, step_ns);
    pwm_init(&rig->pwm, rig->now_ns, true);
    rig->event_s = scenario->event_s;
    rig->event_ns = (int64_t)llround(scenario->event_s * 1e9);
    rig->hold_s = scenario->hold_s;
    rig->min_brake_pct = INFINITY;
    rig->full_brake_s = rig->hard_braking_s = rig->first_warning_s = INFINITY;
    rig->stop_fall_s = rig->first_fault_s = rig->alarm_s = INFINITY;
    rig->brake_gap_m = rig->release_gap_m = rig->release_kmh = NAN;
}

void rig_start(struct rig *rig, const bool levels[BOARD_OUTPUTS])
{
    double duty_pct;

    memcpy(rig->levels, levels, sizeof rig->levels);
    rig->started = true;
    duty_pct = rig->pwm.duty_pct;
    pwm_init(&rig->pwm, rig->now_ns, levels[PIN_PWM]);
    if (rig->has_duty) {
        rig->pwm.duty_pct = duty_pct;
    }
    car_demand(&rig->car, rig->now_ns, demand_pct(rig));
    rig->counted_duty_pct = rig->car.demand_pct;
    note_demand(rig);
    if (!levels[PIN_LAMP] || !levels[PIN_BUZZER]) {
        rig->warnings = 1, rig->first_warning_s = 0;
    }
}

void rig_state_reported(struct rig *rig, int64_t t_ns, const char *state)
{
    if (strcmp(state, "FAULT") == 0 && t_ns >= rig->event_ns && isinf(rig->first_fault_s)) {
        rig->first_fault_s = seconds(t_ns);
    }
}

bool rig_is_over(const struct rig *rig)
{
    const struct car_record *record = &rig->car.record;

    return record->impact ||
           (rig->hold_s >= 0 && seconds(rig->now_ns) - record->still_s >= rig->hold_s);
}

void rig_values(const struct rig *rig, double *row)
{
    double gap = car_gap_m(&rig->car);

    row[0] = isinf(gap) ? NAN : gap;
    row[1] = rig->car.v_mps;
    row[2] = isinf(gap) ? NAN : car_lead_mps(&rig->car);
    row[3] = rig->car.accel_mps2;
    row[4] = fmax(rig->car.demand_pct, 0);
    row[5] = rig->levels[PIN_STOP];
    row[6] = !rig->levels[PIN_LAMP];
    row[7] = !rig->levels[PIN_BUZZER];
}

void rig_draw_road(struct picture *picture, const double *values, double mark_m)
{
    picture_rail(picture);
    picture_lane(picture, true, values[RIG_GAP], mark_m);
    picture_rail(picture);
}

void rig_draw_bars(struct picture *picture, const double *values)
{
    double gap_m = values[RIG_GAP];

    picture_bar(picture, "gap", gap_m, "m", isnan(gap_m) ? 1 : gap_m / picture->view_m);
    picture_bar(picture, "brake", values[RIG_BRAKE], "%", values[RIG_BRAKE] / 100);
    picture_text(picture, " speed    %7.2f m/s", values[RIG_OWN_SPEED]);
    picture_end(picture);
}

/* What never came about, as a number that no limit holds. */
static double or_never(double value)
{
    return isnan(value) ? INFINITY : value;
}

void rig_measure(const struct rig *rig, int64_t t_ns, struct outcome *outcome)
{
    const struct car_record *record = &rig->car.record;
    double *value = outcome->values, t_s = seconds(t_ns), since_s = rig->event_s;

    outcome->rest_s = record->rest_s;
    value[METRIC_IMPACT] = record->impact;
    value[METRIC_IMPACT_MPS] = record->impact_mps;
    value[METRIC_MIN_GAP] = record->min_gap_m;
    value[METRIC_STOP_GAP] = record->rest_gap_m;
    value[METRIC_STOP_WITHIN] = record->first_rest_s - since_s;
    value[METRIC_FINAL_SPEED] = rig->car.v_mps;
    value[METRIC_PEAK_DECEL] = record->peak_decel_mps2;
    value[METRIC_PEAK_JERK] = record->peak_jerk_mps3;
    value[METRIC_RMS_ACCEL] = sqrt(record->square_mps3 / t_s);
    value[METRIC_STUCK] = record->stuck_s;
    value[METRIC_MAX_BRAKE] = rig->max_brake_pct;
    value[METRIC_MIN_BRAKE] = fmin(rig->min_brake_pct, fmax(rig->car.demand_pct, 0));
    value[METRIC_FINAL_BRAKE] = fmax(rig->car.demand_pct, 0);
    value[METRIC_FINAL_GAP] = car_gap_m(&rig->car);
    value[METRIC_FULL_BRAKE_WITHIN] = rig->full_brake_s - since_s;
    value[METRIC_BLIND_FALL] = rig->blind_fall_pct;
    value[METRIC_DUTY_STEPS] = rig->duty_steps / t_s;
    value[METRIC_STOP_TOGGLES] = rig->stop_toggles;
    value[METRIC_STOP_ON] = rig->stop_on_s + (rig->levels[PIN_STOP] ? t_s - rig->stop_rise_s : 0);
    value[METRIC_RELEASE_WITHIN] = rig->stop_fall_s - since_s;
    value[METRIC_FAULT_WITHIN] = rig->first_fault_s - since_s;
    value[METRIC_BLIND_RISE] = rig->blind_rise_pct;
    value[METRIC_ALARM_WITHIN] = rig->alarm_s - since_s;
    value[METRIC_WARNINGS] = rig->warnings;
    value[METRIC_WARNING_LEAD] =
        isinf(rig->hard_braking_s) ? INFINITY : rig->hard_braking_s - rig->first_warning_s;
    value[METRIC_BRAKE_GAP] = or_never(rig->brake_gap_m);
    value[METRIC_RELEASE_GAP] = or_never(rig->release_gap_m);
    value[METRIC_RELEASE_KMH] = or_never(rig->release_kmh);
}
