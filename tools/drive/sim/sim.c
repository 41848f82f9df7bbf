/* SPDX-License-Identifier: MIT */
#include "sim.h"

#include "diag.h"
#include "fast.h"
#include "s51.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CLOCKS_PER_CYCLE = 12 };

volatile bool sim_is_interrupted;

static const struct sim_engine *const engines[] = {&s51_engine, &fast_engine};

enum { ENGINE_COUNT = sizeof engines / sizeof engines[0] };

const struct sim_engine *sim_engine(const char *name)
{
    for (int i = 0; i < ENGINE_COUNT; i++) {
        if (strcmp(engines[i]->name, name) == 0) {
            return engines[i];
        }
    }
    return NULL;
}

const char *sim_engine_names(void)
{
    static char names[64];

    names[0] = '\0';
    for (int i = 0; i < ENGINE_COUNT; i++) {
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i > 0 ? " " : "",
                 engines[i]->name);
    }
    return names;
}

/* --- time --------------------------------------------------------------------------------- */

/* Grid point N, half way between two machine cycles, rounded to 1 ns. */
static int64_t grid_point_ns(const struct sim *sim, int64_t n)
{
    const __int128 half_cycle = CLOCKS_PER_CYCLE * (__int128)1000000000 / 2; /* ns times Hz */

    return (int64_t)(((2 * n + 1) * half_cycle + sim->clk_hz / 2) / sim->clk_hz);
}

int64_t sim_grid_ns(const struct sim *sim, int64_t time_ns)
{
    const __int128 cycle = CLOCKS_PER_CYCLE * (__int128)1000000000;
    int64_t n = (int64_t)((__int128)time_ns * sim->clk_hz / cycle);

    while (n > 0 && grid_point_ns(sim, n - 1) >= time_ns) {
        n--;
    }
    while (grid_point_ns(sim, n) < time_ns) {
        n++;
    }
    return grid_point_ns(sim, n);
}

/* --- edges -------------------------------------------------------------------------------- */

void sim_add_edge(struct sim *sim, const struct sim_edge *edge)
{
    if (sim->edge_count == sim->edge_capacity) {
        sim->edge_capacity = sim->edge_capacity * 2 + 64;
        sim->edges = realloc(sim->edges, sim->edge_capacity * sizeof sim->edges[0]);
        if (sim->edges == NULL) {
            abort();
        }
    }
    sim->edges[sim->edge_count++] = *edge;
}

/* --- what the engine does ----------------------------------------------------------------- */

int sim_check(const struct sim_engine *engine)
{
    return engine->check();
}

int sim_start(const struct sim_engine *engine, struct sim **sim, const struct sim_setup *setup)
{
    return engine->start(sim, setup);
}

void sim_set_pin(struct sim *sim, int64_t time_ns, int drive, bool level)
{
    sim->engine->set_pin(sim, time_ns, drive, level);
}

enum sim_status sim_interrupted(const struct sim *sim)
{
    diag_error(sim->engine->name, 0, "interrupted at %.6f s", (double)sim->now_ns * 1e-9);
    return SIM_FAILED;
}

enum sim_status sim_run_to(struct sim *sim, int64_t time_ns)
{
    sim->edge_count = 0;
    if (sim_is_interrupted) {
        return sim_interrupted(sim);
    }
    return sim->engine->run_to(sim, time_ns);
}

enum sim_status sim_run_after_reset(struct sim *sim, int64_t window_ns)
{
    sim->edge_count = 0;
    return sim->engine->run_after_reset(sim, window_ns);
}

bool sim_flip(struct sim *sim, const struct sim_flip *flip)
{
    return sim->engine->flip(sim, flip);
}

uint64_t sim_cycle(const struct sim *sim, int64_t time_ns)
{
    return (uint64_t)((__int128)time_ns * sim->clk_hz / (CLOCKS_PER_CYCLE * (__int128)1000000000));
}

size_t sim_receive(struct sim *sim, char *bytes, size_t size)
{
    return sim->engine->receive(sim, bytes, size);
}

void sim_send(struct sim *sim, const char *bytes, size_t size)
{
    sim->engine->send(sim, bytes, size);
}

void sim_stop(struct sim *sim)
{
    if (sim != NULL) {
        sim->engine->stop(sim);
    }
}
