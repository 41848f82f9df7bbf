/* SPDX-License-Identifier: MIT */
/* The follower's plant: a robot behind another one, on a lane beside another. Time goes in steps of
 * 0.1 s, at whose beginning the robot is measured and for which its motion control holds one
 * acceleration; speeds stay in 0..2 m/s. All numbers are whole, so a run is the same everywhere. */
#ifndef FUZZY51_ROBOTS_H
#define FUZZY51_ROBOTS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    ROBOTS_STEP_MS = 100,
    ROBOTS_SPEED_MAX_MMPS = 2000,
    ROBOTS_ACCEL_MAX_MMPS2 = 2000,
    ROBOTS_ACCEL_STEP_MMPS2 = 100,  /* what the motion control tells apart */
    ROBOTS_NEW_GAP_MM = 6000,       /* to the robot ahead in the other lane, after a change */
    ROBOTS_GAP_MAX_UM = 1000000000, /* no gap grows beyond */
    ROBOTS_NOBODY_UM = INT32_MAX    /* the gap, if there is no robot ahead */
};

struct robots {
    int32_t gap_um; /* to the nearest robot ahead */
    int own_mmps;
    int lead_mmps;     /* may be set before any step, until the lane is changed */
    int32_t driven_um; /* in the last step, if there was one */
    bool lane_is_free; /* the other one; taken once the robot has changed to it */
    int new_lead_mmps; /* who drives there */
    int step;          /* so many are over */
    int changed_step;  /* the change was made then; -1: none */
    int least_gap_um;
    bool collided; /* the gap became 0: nothing moves any more */
};

/* One of several robots ahead in the own lane. They drive their own ways, and see nobody. */
struct robot_ahead {
    bool there; /* not yet in the lane, or no longer, if false */
    int32_t gap_um;
    int mmps;
};

/* Sets what is not the scenario's: step, changed_step, least_gap_um, collided. */
void robots_start(struct robots *robots);

/* What the robot measures, mm: the gap rounded half up. */
int robots_gap_mm(const struct robots *robots);

/* One step at ACCEL_MMPS2, rounded to what the motion control tells apart. At its end, if the robot
 * ASKS_FOR_LANE and it is free, the robot is there. */
void robots_step(struct robots *robots, double accel_mmps2, bool asks_for_lane);

/* Moves COUNT robots ahead by the step that was just made. */
void robots_move_ahead(const struct robots *robots, struct robot_ahead *ahead, int count);

/* Sets gap and speed of the robot ahead to those of the nearest one that is there; ROBOTS_NOBODY_UM
 * and 0 if there is none. One that would be beside the own robot or behind it is none. Not after a
 * change of lanes, nor after a contact. */
void robots_see_nearest(struct robots *robots, const struct robot_ahead *ahead, int count);

#endif
