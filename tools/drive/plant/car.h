/* SPDX-License-Identifier: MIT */
/* The plant: a car with a brake on a lane, and up to eight cars ahead of it. Between two changes of
 * the brake's demand the motion is integrated in closed form, so neither the step nor the
 * simulator's quantum moves an outcome; only the driver model looks at the speed once a step. */
#ifndef FUZZY51_CAR_H
#define FUZZY51_CAR_H

#include "scenario.h"

#include <stdbool.h>
#include <stdint.h>

enum { CAR_DEMANDS = 256, CAR_TARGETS = LEADS_MAX };

/* A car ahead. */
struct target {
    struct lead lead;
    double origin_m;    /* where its own path begins on the lane */
    bool there, placed; /* there now; has been there */
};

/* What the run has come to so far. Times are seconds of the scenario, INFINITY until it happens. */
struct car_record {
    bool impact;
    double impact_s, impact_mps; /* closing speed at contact */
    double min_gap_m;            /* INFINITY: never anything ahead */
    double rest_s, rest_gap_m;   /* when and where it last came to rest */
    double first_rest_s;         /* first rest at or after event_s */
    double peak_decel_mps2, peak_jerk_mps3;
    double square_mps3; /* integral of the acceleration's square */
    double stuck_s;     /* at rest while the car ahead moves */
    double still_s;     /* both at rest since; INFINITY: not */
};

struct car {
    struct ego ego;
    struct target targets[CAR_TARGETS];
    double event_s;
    int64_t now_ns, step_ns;
    int64_t grid_ns;   /* the next whole step after now */
    int64_t change_ns; /* the next time that a target comes or goes; INT64_MAX: none does */
    double x_m, v_mps; /* the front of the ego car */
    double brake_mps2; /* deceleration of the brake now */
    double accel_mps2; /* of the car now */
    double demand_pct; /* at the pins now */
    double acting_pct; /* the demand of a dead time ago */
    bool throttle_cut; /* the driver cannot accelerate */
    struct {
        int64_t at_ns;
        double percent;
    } demands[CAR_DEMANDS]; /* on their way through the dead time */
    int first_demand, demand_count;
    struct car_record record;
};

/* The world at t = 0, before the controller's first trigger; STEP_NS is the longest step. */
void car_init(struct car *car, const struct scenario *scenario, int64_t step_ns);

/* Lets the world run to T_NS, or to the impact: then it stands for ever. */
void car_advance(struct car *car, int64_t t_ns);

/* The pins demand PERCENT of the brake from T_NS on; advances to there. */
void car_demand(struct car *car, int64_t t_ns, double percent);

/* The driver's throttle is cut from T_NS on, or no longer; advances to there. */
void car_cut(struct car *car, int64_t t_ns, bool cut);

/* From now on the target of that INDEX gains ACCEL_MPS2 until it stands or drives at TOP_MPS; 0: it
 * keeps its speed. Only for a target whose scenario plans no change of its speed. Returns false,
 * and changes nothing, after too many commands: each takes one of its profile's points for good. */
bool car_command_lead(struct car *car, int index, double accel_mps2, double top_mps);

/* Index of the nearest target that is there, those in the own way first; -1: none is there. */
int car_nearest(const struct car *car);

/* Gap to the target of that INDEX, m; INFINITY when it is not there. */
double car_target_gap_m(const struct car *car, int index);

/* Speed of the target of that INDEX, m/s. */
double car_target_mps(const struct car *car, int index);

/* Gap to the nearest target, m; INFINITY when there is none. */
double car_gap_m(const struct car *car);

/* Speed of the nearest target, m/s; 0 when there is none. */
double car_lead_mps(const struct car *car);

/* Distance that a lead has covered T_S seconds after the start, m, and its speed then. */
double car_lead_path_m(const struct lead *lead, double t_s, double *speed_mps);

/* Whether a lead is on the road then: it appeared, and did not leave yet. */
bool car_lead_is_there(const struct lead *lead, double t_s);

#endif
