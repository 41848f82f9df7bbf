/* SPDX-License-Identifier: MIT */
#include "car.h"

#include <math.h>
#include <string.h>

static const double driver_gain_per_s = 2; /* how hard the driver closes a gap to his set speed */

/* --- the car ahead ------------------------------------------------------------------------ */

/* A stretch of constant acceleration that begins at speed V0 and lasts DURATION_S. */
static double stretch_m(double v0, double accel_mps2, double duration_s)
{
    return duration_s * (v0 + 0.5 * accel_mps2 * duration_s);
}

static double profile_path_m(const struct lead *lead, double t_s, double *speed_mps)
{
    const struct profile *profile = &lead->profile;
    double path = 0, last_s = 0, last_mps = profile->points[0].speed_mps;

    for (int i = 0; i < profile->count; i++) {
        double point_s = profile->points[i].t_s, length_s = point_s - last_s;
        double accel = length_s > 0 ? (profile->points[i].speed_mps - last_mps) / length_s : 0;

        if (t_s < point_s) {
            *speed_mps = last_mps + accel * (t_s - last_s);
            return path + stretch_m(last_mps, accel, t_s - last_s);
        }
        path += stretch_m(last_mps, accel, length_s);
        last_s = point_s;
        last_mps = profile->points[i].speed_mps;
    }
    *speed_mps = last_mps;
    return path + last_mps * (t_s - last_s);
}

double car_lead_path_m(const struct lead *lead, double t_s, double *speed_mps)
{
    double accel = lead->change_mps2, duration_s;

    if (lead->profile.count > 0) {
        return profile_path_m(lead, t_s, speed_mps);
    }
    *speed_mps = lead->speed_mps;
    if (lead->change_s < 0 || t_s <= lead->change_s) {
        return lead->speed_mps * t_s;
    }
    duration_s = (lead->change_to_mps - lead->speed_mps) / accel;
    /* With the wrong sign it never gets there: the change then takes no time. */
    if (!(duration_s >= 0) || isinf(duration_s)) {
        duration_s = 0;
    }
    if (t_s < lead->change_s + duration_s) {
        *speed_mps += accel * (t_s - lead->change_s);
        return lead->speed_mps * lead->change_s +
               stretch_m(lead->speed_mps, accel, t_s - lead->change_s);
    }
    *speed_mps = lead->change_to_mps;
    return lead->speed_mps * lead->change_s + stretch_m(lead->speed_mps, accel, duration_s) +
           lead->change_to_mps * (t_s - lead->change_s - duration_s);
}

/* Where the target's rear is at T_S, and how fast. */
static double target_x_m(const struct target *target, double t_s, double *speed_mps)
{
    return target->origin_m + car_lead_path_m(&target->lead, t_s, speed_mps);
}

bool car_lead_is_there(const struct lead *lead, double t_s)
{
    return lead->present && t_s >= lead->appears_s && (lead->leaves_s < 0 || t_s < lead->leaves_s);
}

static double now_s(const struct car *car)
{
    return (double)car->now_ns * 1e-9;
}

/* A car in another lane is passed. */
static bool is_in_the_way(const struct car *car, int index)
{
    return car->targets[index].there && fabs(car->targets[index].lead.lane) < 0.5;
}

double car_target_gap_m(const struct car *car, int index)
{
    const struct target *target = &car->targets[index];
    double speed_mps;

    return target->there ? target_x_m(target, now_s(car), &speed_mps) - car->x_m : INFINITY;
}

double car_target_mps(const struct car *car, int index)
{
    double speed_mps;

    target_x_m(&car->targets[index], now_s(car), &speed_mps);
    return speed_mps;
}

/* Of two targets that are there: a car in the way comes first, else the nearer one. */
static bool comes_first(const struct car *car, int index, int other)
{
    bool in_the_way = is_in_the_way(car, index);

    return in_the_way == is_in_the_way(car, other)
               ? car_target_gap_m(car, index) < car_target_gap_m(car, other)
               : in_the_way;
}

int car_nearest(const struct car *car)
{
    int nearest = -1;

    for (int i = 0; i < CAR_TARGETS; i++) {
        if (car->targets[i].there && (nearest < 0 || comes_first(car, i, nearest))) {
            nearest = i;
        }
    }
    return nearest;
}

double car_gap_m(const struct car *car)
{
    int nearest = car_nearest(car);

    return nearest < 0 ? INFINITY : car_target_gap_m(car, nearest);
}

double car_lead_mps(const struct car *car)
{
    int nearest = car_nearest(car);

    return nearest < 0 ? 0 : car_target_mps(car, nearest);
}

/* Where the rear of the nearest car in the way is at T_S, and how fast; INFINITY: nothing is. */
static double obstacle_x_m(const struct car *car, double t_s, double *speed_mps)
{
    double nearest_m = INFINITY, target_mps;

    for (int i = 0; i < CAR_TARGETS; i++) {
        if (is_in_the_way(car, i)) {
            double x_m = target_x_m(&car->targets[i], t_s, &target_mps);

            if (x_m < nearest_m) {
                nearest_m = x_m;
                *speed_mps = target_mps;
            }
        }
    }
    return nearest_m;
}

/* A target appears its gap_m ahead of the ego, wherever that is by then. */
static void place_targets(struct car *car)
{
    for (int i = 0; i < CAR_TARGETS; i++) {
        struct target *target = &car->targets[i];

        target->there = car_lead_is_there(&target->lead, now_s(car));
        if (target->there && !target->placed) {
            double speed_mps;

            target->placed = true; /* its origin is still 0 */
            target->origin_m =
                car->x_m + target->lead.gap_m - target_x_m(target, now_s(car), &speed_mps);
        }
    }
}

bool car_command_lead(struct car *car, int index, double accel_mps2, double top_mps)
{
    struct lead *lead = &car->targets[index].lead;
    struct profile *profile = &lead->profile;
    double t_s = now_s(car), speed_mps, end_mps = accel_mps2 < 0 ? 0 : top_mps;

    car_lead_path_m(lead, t_s, &speed_mps);
    if (profile->count == 0) {
        profile->points[profile->count++].speed_mps = lead->speed_mps; /* at 0 s */
    }
    if (profile->points[profile->count - 1].t_s > t_s) {
        profile->count--; /* where the last command would have ended */
    }
    if (profile->count > PROFILE_POINTS - 2) {
        return false;
    }
    profile->points[profile->count].t_s = t_s;
    profile->points[profile->count++].speed_mps = speed_mps;
    if (accel_mps2 != 0 && (end_mps - speed_mps) / accel_mps2 > 0) {
        profile->points[profile->count].t_s = t_s + (end_mps - speed_mps) / accel_mps2;
        profile->points[profile->count++].speed_mps = end_mps;
    }
    return true;
}

/* --- the ego ------------------------------------------------------------------------------ */

struct motion {
    double x_m, v_mps, brake_mps2;
    double rest_s; /* came to rest so long after the start; INFINITY: did not */
};

/* Distance and speed after T_S at a steady PUSH_MPS2, with the brake going from B0 to B1 by its
 * lag. */
static struct motion rolling(const struct motion *start, double push_mps2, double b1, double lag_s,
                             double t_s)
{
    double decay = exp(-t_s / lag_s), excess = start->brake_mps2 - b1;
    double lag_area_s = lag_s * (1 - decay); /* integral of the decay */

    return (struct motion){
        .v_mps = start->v_mps + (push_mps2 - b1) * t_s - excess * lag_area_s,
        .x_m = start->x_m + start->v_mps * t_s + 0.5 * (push_mps2 - b1) * t_s * t_s -
               excess * lag_s * (t_s - lag_area_s),
        .brake_mps2 = b1 + excess * decay,
        .rest_s = INFINITY,
    };
}

static double driver_push_mps2(const struct car *car)
{
    double wish;

    if (car->ego.driver == DRIVER_COASTS || car->throttle_cut || car->demand_pct > 0 ||
        car->acting_pct > 0) {
        return 0; /* the driver does not accelerate while the controller brakes */
    }
    wish = (car->ego.driver_mps - car->v_mps) * driver_gain_per_s + car->ego.rolling_mps2;
    return fmin(fmax(wish, 0), car->ego.driver_mps2);
}

/* The motion T_S after START while nothing but time changes. A brake stops, it does not reverse. */
static struct motion motion_after(const struct car *car, const struct motion *start, double t_s)
{
    double b1 = car->ego.brake_max_mps2 * car->acting_pct / 100, lag_s = car->ego.brake_lag_s;
    double push = driver_push_mps2(car), low = 0, high = t_s;
    struct motion end = rolling(start, push - car->ego.rolling_mps2, b1, lag_s, t_s);
    bool at_rest = start->v_mps <= 0;

    if (at_rest && push > start->brake_mps2 + car->ego.rolling_mps2) {
        return end; /* starts to drive */
    }
    if (at_rest) {
        return (struct motion){start->x_m, 0, end.brake_mps2, INFINITY};
    }
    if (end.v_mps > 0) {
        return end;
    }
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);

        if (rolling(start, push - car->ego.rolling_mps2, b1, lag_s, middle).v_mps > 0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    end.x_m = rolling(start, push - car->ego.rolling_mps2, b1, lag_s, high).x_m;
    end.v_mps = 0;
    end.rest_s = high;
    return end;
}

/* --- records ------------------------------------------------------------------------------ */

/* The car's acceleration with the brake as it is now. */
static double accel_mps2(const struct car *car)
{
    double push = driver_push_mps2(car);

    if (car->v_mps <= 0 && push <= car->brake_mps2 + car->ego.rolling_mps2) {
        return 0;
    }
    return push - car->ego.rolling_mps2 - car->brake_mps2;
}

static void note_impact(struct car *car, const struct motion *start, double start_s, double t_s)
{
    double low = 0, high = t_s, lead_mps = 0;
    struct motion at;

    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);

        at = motion_after(car, start, middle);
        if (obstacle_x_m(car, start_s + middle, &lead_mps) > at.x_m) {
            low = middle;
        } else {
            high = middle;
        }
    }
    at = motion_after(car, start, high);
    obstacle_x_m(car, start_s + high, &lead_mps);
    car->x_m = at.x_m;
    car->v_mps = at.v_mps;
    car->brake_mps2 = at.brake_mps2;
    car->now_ns = (int64_t)llround((start_s + high) * 1e9);
    car->record.impact = true;
    car->record.impact_s = start_s + high;
    car->record.impact_mps = fmax(at.v_mps - lead_mps, 0);
    car->record.min_gap_m = 0;
}

static void note_gap(struct car *car)
{
    int nearest = car_nearest(car);

    if (nearest >= 0 && is_in_the_way(car, nearest)) {
        car->record.min_gap_m = fmin(car->record.min_gap_m, car_target_gap_m(car, nearest));
    }
}

static void note_step(struct car *car, const struct motion *end, double start_s, double t_s,
                      double accel_before_mps2)
{
    struct car_record *record = &car->record;
    double lead_mps = car_lead_mps(car);

    note_gap(car);
    if (isfinite(end->rest_s)) {
        record->rest_s = start_s + end->rest_s;
        record->rest_gap_m = car_gap_m(car);
        if (record->rest_s >= car->event_s) {
            record->first_rest_s = fmin(record->first_rest_s, record->rest_s);
        }
    }
    car->accel_mps2 = accel_mps2(car);
    record->peak_decel_mps2 = fmax(record->peak_decel_mps2, -car->accel_mps2);
    record->square_mps3 +=
        0.5 * t_s * (accel_before_mps2 * accel_before_mps2 + car->accel_mps2 * car->accel_mps2);
    if (car->v_mps <= 0 && lead_mps > 0.1) {
        record->stuck_s += t_s;
    }
    if (car->v_mps > 0 || lead_mps > 0) {
        record->still_s = INFINITY;
    } else if (isinf(record->still_s)) {
        record->still_s = start_s + t_s;
    }
}

/* One step in which the demand that acts does not change. */
static void step(struct car *car, int64_t t_ns)
{
    struct motion start = {car->x_m, car->v_mps, car->brake_mps2, INFINITY}, end;
    double start_s = now_s(car), t_s = (double)(t_ns - car->now_ns) * 1e-9, lead_mps;
    double b1 = car->ego.brake_max_mps2 * car->acting_pct / 100, before_mps2 = accel_mps2(car);

    /* The lag's slope is steepest where the step begins. */
    if (start.v_mps > 0) {
        car->record.peak_jerk_mps3 =
            fmax(car->record.peak_jerk_mps3, fabs(b1 - start.brake_mps2) / car->ego.brake_lag_s);
    }
    end = motion_after(car, &start, t_s);
    if (obstacle_x_m(car, start_s + t_s, &lead_mps) <= end.x_m) {
        note_impact(car, &start, start_s, t_s);
        return;
    }
    car->x_m = end.x_m;
    car->v_mps = end.v_mps;
    car->brake_mps2 = end.brake_mps2;
    car->now_ns = t_ns;
    place_targets(car);
    note_step(car, &end, start_s, t_s, before_mps2);
}

/* --- outside ------------------------------------------------------------------------------ */

void car_init(struct car *car, const struct scenario *scenario, int64_t step_ns)
{
    memset(car, 0, sizeof *car);
    car->ego = scenario->ego;
    for (int i = 0; i < CAR_TARGETS; i++) {
        car->targets[i].lead = scenario->leads[i];
    }
    car->event_s = scenario->event_s;
    car->step_ns = step_ns;
    car->v_mps = car->ego.speed_mps;
    if (car->ego.driver_mps < 0) {
        car->ego.driver_mps = car->ego.speed_mps;
    }
    car->record = (struct car_record){.impact_s = INFINITY,
                                      .min_gap_m = INFINITY,
                                      .rest_s = INFINITY,
                                      .rest_gap_m = INFINITY,
                                      .first_rest_s = INFINITY,
                                      .still_s = INFINITY};
    place_targets(car);
    note_gap(car);
    if (car->v_mps <= 0) { /* at rest on its mark */
        car->record.rest_s = car->record.first_rest_s = 0;
        car->record.rest_gap_m = car_gap_m(car);
    }
}

/* The first time after now at which a target comes or goes. */
static int64_t next_change_ns(const struct car *car)
{
    int64_t first = INT64_MAX;

    for (int i = 0; i < CAR_TARGETS; i++) {
        const double marks_s[] = {car->targets[i].lead.appears_s, car->targets[i].lead.leaves_s};

        for (int k = 0; k < 2; k++) {
            int64_t mark_ns = (int64_t)llround(marks_s[k] * 1e9);

            if (mark_ns > car->now_ns && mark_ns < first) {
                first = mark_ns;
            }
        }
    }
    return first;
}

/* End of the step that begins now: the grid, a demand that begins to act, a target that comes or
 * goes. */
static int64_t step_end_ns(struct car *car, int64_t t_ns)
{
    int64_t end;

    if (car->now_ns >= car->grid_ns) {
        car->grid_ns = (car->now_ns / car->step_ns + 1) * car->step_ns;
    }
    end = car->grid_ns < t_ns ? car->grid_ns : t_ns;
    if (car->demand_count > 0 && car->demands[car->first_demand].at_ns < end) {
        end = car->demands[car->first_demand].at_ns;
    }
    if (car->now_ns >= car->change_ns) {
        car->change_ns = next_change_ns(car);
    }
    if (car->change_ns < end) {
        end = car->change_ns;
    }
    return end;
}

void car_advance(struct car *car, int64_t t_ns)
{
    while (car->now_ns < t_ns && !car->record.impact) {
        int64_t end = step_end_ns(car, t_ns);

        if (end > car->now_ns) {
            step(car, end);
        }
        while (car->demand_count > 0 && car->demands[car->first_demand].at_ns <= car->now_ns) {
            car->acting_pct = car->demands[car->first_demand].percent;
            car->first_demand = (car->first_demand + 1) % CAR_DEMANDS;
            car->demand_count--;
        }
    }
}

void car_demand(struct car *car, int64_t t_ns, double percent)
{
    int64_t dead_ns = (int64_t)llround(car->ego.brake_dead_s * 1e9);
    int slot;

    car_advance(car, t_ns);
    car->demand_pct = percent;
    if (dead_ns == 0) {
        car->acting_pct = percent;
        return;
    }
    if (car->demand_count ==
        CAR_DEMANDS) { /* too many for any brake to follow: the last two become one */
        slot = (car->first_demand + car->demand_count - 1) % CAR_DEMANDS;
    } else {
        slot = (car->first_demand + car->demand_count) % CAR_DEMANDS;
        car->demand_count++;
    }
    car->demands[slot].at_ns = car->now_ns + dead_ns;
    car->demands[slot].percent = percent;
}

void car_cut(struct car *car, int64_t t_ns, bool cut)
{
    car_advance(car, t_ns);
    car->throttle_cut = cut;
}
