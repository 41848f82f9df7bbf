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
    robots->gap_um += (2 * robots->lead_mmps - before_mmps - robots->own_mmps) * ROBOTS_STEP_MS / 2;
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
