/* SPDX-License-Identifier: MIT */
/* Runs each start of the follower's grid, with the firmware's own decision compiled for the host
 * and drive's model of the robots. Prints one line of CSV a start. make builds it once for each
 * rule set. */
#include "follow.h"
#include "robots.h"

#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

#include "diag.h"

/* 0.3..9.5 m, 0..2 m/s, 0..2 m/s; the other lane is taken. */
enum {
    GAPS = 24,
    OWN_SPEEDS = 9,
    LEAD_SPEEDS = 5,
    GAP_FIRST_MM = 300,
    GAP_STEP_MM = 400,
    OWN_STEP_MMPS = 250,
    LEAD_STEP_MMPS = 500,
};

const char *argp_program_version = "fuzzy51 " FUZZY51_VERSION;

struct arguments {
    int steps, every;
};

static const struct argp_option options[] = {
    {"duration-s", 'd', "N", 0, "seconds that each run takes at most, 1..3600 (60)", 0},
    {"every", 'e', "N", 0, "only every Nth start, beginning with the first (1)", 0},
    {0},
};

static error_t take_option(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    char *end = NULL;
    long number = 0;

    if (key == 'd' || key == 'e') {
        errno = 0;
        number = strtol(text, &end, 10);
        if (errno != 0 || end == text || *end != '\0' || number < 1 || number > 3600) {
            argp_error(state, "'%s': give a whole number in 1..3600", text);
        }
    }
    switch (key) {
    case 'd':
        arguments->steps = (int)number * 1000 / ROBOTS_STEP_MS;
        return 0;
    case 'e':
        arguments->every = (int)number;
        return 0;
    case ARGP_KEY_ARG:
        argp_usage(state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp parser = {
    .options = options,
    .parser = take_option,
    .doc =
        "Runs the follower from each start of its grid, with no lane to change to, and prints CSV.",
};

static void decide(const struct robots *robots)
{
    int gap_mm = robots_gap_mm(robots);

    follow.gap_mm = (uint16_t)(gap_mm < (int)FOLLOW_GAP_MAX_MM ? gap_mm : (int)FOLLOW_GAP_MAX_MM);
    follow.own_mmps = (uint16_t)robots->own_mmps;
    follow.lead_mmps = (uint16_t)robots->lead_mmps;
    follow.lane_is_taken = !robots->lane_is_free;
    follow_decide();
}

static double accel_mmps2(void)
{
    double throttle = (follow.throttle_us - (int)FOLLOW_THROTTLE_CLOSED_US) /
                      (double)(FOLLOW_THROTTLE_FULL_US - FOLLOW_THROTTLE_CLOSED_US);

    return (throttle - follow.brake_pct / 100.0) * ROBOTS_ACCEL_MAX_MMPS2;
}

/* Would the start end in contact even if the robot braked fully from the first step on? */
static bool is_unavoidable(struct robots robots)
{
    while (!robots.collided && robots.own_mmps > 0) {
        robots_step(&robots, -ROBOTS_ACCEL_MAX_MMPS2, false);
    }
    return robots.collided;
}

static void run(struct robots robots, int steps)
{
    bool unavoidable;

    robots_start(&robots);
    unavoidable = is_unavoidable(robots);
    printf("%d,%d,%d,", robots_gap_mm(&robots), robots.own_mmps, robots.lead_mmps);
    decide(&robots); /* the frames before the start say the same */
    for (int step = 0; step < steps && !robots.collided; step++) {
        decide(&robots);
        robots_step(&robots, accel_mmps2(), follow.asks_for_lane);
    }
    printf("%d,%.1f,%.3f,%.3f,%d\n", robots.collided,
           robots.collided ? robots.step * ROBOTS_STEP_MS / 1000.0 : 0.0, robots.least_gap_um / 1e6,
           robots.gap_um / 1e6, unavoidable);
}

int main(int argc, char **argv)
{
    struct arguments arguments = {.steps = 600, .every = 1};

    argp_err_exit_status = EXIT_USAGE;
    argp_parse(&parser, argc, argv, 0, NULL, &arguments);
    follow_init();
    puts("gap_mm,own_mmps,lead_mmps,collided,collided_s,least_gap_m,last_gap_m,unavoidable");
    for (int start = 0; start < GAPS * OWN_SPEEDS * LEAD_SPEEDS; start += arguments.every) {
        run(
            (struct robots){
                .gap_um = (GAP_FIRST_MM + GAP_STEP_MM * (start / LEAD_SPEEDS / OWN_SPEEDS)) * 1000,
                .own_mmps = OWN_STEP_MMPS * (start / LEAD_SPEEDS % OWN_SPEEDS),
                .lead_mmps = LEAD_STEP_MMPS * (start % LEAD_SPEEDS),
            },
            arguments.steps);
    }
    return ferror(stdout) != 0 || fflush(stdout) != 0 ? EXIT_INPUT : EXIT_FINE;
}
