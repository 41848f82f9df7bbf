/* SPDX-License-Identifier: MIT */
#include "robots.h"

#include <math.h>

void robots_start(struct robots *robots)
{
    robots->step = 0;
    robots->changed_step = -1;
    robots->least_gap_um = robots->gap_um;
    robots->collided = robots->gap_um <= 0;
}

int robots_gap_mm(const struct robots *robots)
{
    return robots->gap_um <= 0 ? 0 : (robots->gap_um + 500) / 1000;
}

/* A gap after a step in which the robot ahead drove with that speed, and the own one so far. */
static int32_t gap_after_um(int32_t gap_um, int ahead_mmps, int32_t driven_um)
{
    if (gap_um == ROBOTS_NOBODY_UM) {
        return gap_um;
    }
    gap_um += ahead_mmps * ROBOTS_STEP_MS - driven_um;
    return gap_um < ROBOTS_GAP_MAX_UM ? gap_um : ROBOTS_GAP_MAX_UM;
}

void robots_step(struct robots *robots, double accel_mmps2, bool asks_for_lane)
{
    int accel = (int)lround(accel_mmps2 / ROBOTS_ACCEL_STEP_MMPS2) * ROBOTS_ACCEL_STEP_MMPS2;
    int before_mmps = robots->own_mmps;

    if (robots->collided) {
        return;
    }
    robots->own_mmps += accel * ROBOTS_STEP_MS / 1000;
    if (robots->own_mmps < 0) {
        robots->own_mmps = 0;
    }
    if (robots->own_mmps > ROBOTS_SPEED_MAX_MMPS) {
        robots->own_mmps = ROBOTS_SPEED_MAX_MMPS;
    }
    /* The mean speed of the step, exact for a constant acceleration. */
    robots->driven_um = (before_mmps + robots->own_mmps) * ROBOTS_STEP_MS / 2;
    robots->gap_um = gap_after_um(robots->gap_um, robots->lead_mmps, robots->driven_um);
    robots->step++;
    if (robots->gap_um < robots->least_gap_um) {
        robots->least_gap_um = robots->gap_um;
    }
    robots->collided = robots->gap_um <= 0;
    if (robots->collided) {
        return;
    }

    if (asks_for_lane && robots->lane_is_free) {
        robots->lane_is_free = false;
        robots->changed_step = robots->step;
        robots->gap_um = ROBOTS_NEW_GAP_MM * 1000;
        robots->lead_mmps = robots->new_lead_mmps;
    }
}

void robots_move_ahead(const struct robots *robots, struct robot_ahead *ahead, int count)
{
    for (int i = 0; i < count; i++) {
        ahead[i].gap_um = gap_after_um(ahead[i].gap_um, ahead[i].mmps, robots->driven_um);
    }
}

void robots_see_nearest(struct robots *robots, const struct robot_ahead *ahead, int count)
{
    robots->gap_um = ROBOTS_NOBODY_UM;
    robots->lead_mmps = 0;
    for (int i = 0; i < count; i++) {
        if (ahead[i].there && ahead[i].gap_um > 0 && ahead[i].gap_um < robots->gap_um) {
            robots->gap_um = ahead[i].gap_um;
            robots->lead_mmps = ahead[i].mmps;
        }
    }
    if (robots->gap_um < robots->least_gap_um) {
        robots->least_gap_um = robots->gap_um;
    }
}
