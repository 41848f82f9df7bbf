/* SPDX-License-Identifier: MIT */
/* One scenario, from the controller's reset to the judged outcome: the simulator and the world in
 * lockstep. */
#ifndef FUZZY51_RUN_H
#define FUZZY51_RUN_H

#include "board.h"
#include "expect.h"
#include "scenario.h"
#include "sim.h"
#include "telemetry.h"
#include "world.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    RUN_QUANTUM_US = 400, /* longest time between two syncs while the sensor listens */
    RUN_MARGIN_US = 50,   /* kept between a sync and the first event that may follow from it */
    RUN_BOOT_S = 10,      /* the scenario must begin until then */
    RUN_CALM_MS = 20,     /* for is_unasked: two periods of the PWM, so that the duty is out */
    RUN_RESET_WATCH_MS = 500
};

struct run_setup {
    const struct sim_engine *engine;
    const char *hex;
    const struct board *board;
    const struct scenario *scenario;
    uint64_t seed;
    int quantum_us;
    int step_us;
    uint8_t *cover; /* sim_setup.cover; NULL: not wanted */
    bool guess;     /* run ahead while no trigger is expected; begin again without, if one comes */
};

/* Someone who watches the run, such as the trace. Each function may be NULL. Times are of the
 * scenario. */
struct run_observer {
    void *user;
    void (*restart)(void *user); /* the run begins again: forget all */
    void (*pin)(void *user, int64_t t_ns, enum board_pin pin, bool level);
    void (*line)(void *user,
                 const struct telemetry *telemetry); /* the controller sent a CSV line */
    void (*row)(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
                const struct telemetry *telemetry);
};

struct run {
    struct outcome outcome;
    struct telemetry telemetry;
    int64_t boot_ns;     /* reset to the scenario's begin */
    int64_t duration_ns; /* of the scenario */
    int64_t syncs;
    int restarts; /* 1: a guess was wrong, and the run is a second one without guesses */
    double wall_s;
    bool triggered; /* the controller came as far as its first trigger; the scenario has begun */
};

/* Runs the scenario. Returns EXIT_FINE when it was run (whatever came of it), EXIT_USAGE after a
 * message when the simulator failed. Call run_free in both cases. */
int run_scenario(struct run *run, const struct run_setup *setup,
                 const struct run_observer *observers, int observer_count);

void run_free(struct run *run);

/* The same in steps, for someone who shows the run at a pace of their own. It takes no guesses. */
struct loop;

/* From reset to the scenario's begin. RUN, SETUP and OBSERVERS stay in use until run_end. Returns
 * NULL after a message when the simulator failed. */
struct loop *run_begin(struct run *run, const struct run_setup *setup,
                       const struct run_observer *observers, int observer_count);

/* The same, but the controller still stands before its first instruction. run_boot then runs it for
 * one quantum, and returns false when the scenario has begun, or will not. */
struct loop *run_power_up(struct run *run, const struct run_setup *setup,
                          const struct run_observer *observers, int observer_count);
bool run_boot(struct loop *loop);

/* Runs for one row, WORLD_ROW_NS. Returns false when the run is over, whatever the reason. */
bool run_next(struct loop *loop);

/* The world of the run, to be changed between two steps. */
struct world *run_world(struct loop *loop);

/* The simulator of the run, likewise. */
struct sim *run_sim(struct loop *loop);

/* Measures the outcome and frees LOOP. Returns what run_scenario does; run_free is still due. */
int run_end(struct loop *loop);

#endif
