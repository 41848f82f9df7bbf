/* SPDX-License-Identifier: MIT */
#include "fair.h"

#include "fast.h"
#include "rig.h"
#include "shared.h"
#include "sim.h"

#include <math.h>
#include <stdlib.h>

struct judge_row fair_row_of(const struct world_class *class, const struct world *world,
                             double *speed_mps)
{
    double values[WORLD_COLUMNS];

    class->values(world, values);
    *speed_mps = values[RIG_OWN_SPEED];
    return (struct judge_row){.gap_m = isnan(values[RIG_GAP]) ? INFINITY : values[RIG_GAP],
                              .demand_pct = values[RIG_BRAKE]};
}

bool fair_is_in_fault(struct loop *loop, long fault_at)
{
    return fault_at >= 0 && mcs52_ram(fast_chip(run_sim(loop)))[fault_at] != 0;
}

/* --- the inputs --------------------------------------------------------------------------- */

struct recorder {
    struct fair *fair;
    const struct run *run;
    const struct board *board;
    struct loop *loop;
};

/* As the engine does it: the change comes in the cycle after the grid point. */
static void note_input(void *user, int64_t t_ns, enum board_pin pin, bool level)
{
    struct recorder *recorder = user;
    struct fair *fair = recorder->fair;
    const struct sim *sim;
    int64_t grid_ns;

    if (pin < BOARD_OUTPUTS || recorder->loop == NULL) {
        return;
    }
    sim = run_sim(recorder->loop);
    if (fair->input_count == FAIR_INPUTS) {
        abort();
    }
    grid_ns = sim_grid_ns(sim, recorder->run->boot_ns + t_ns);
    fair->inputs[fair->input_count++] =
        (struct fair_input){.cycle = sim_cycle(sim, grid_ns) + 1,
                            .port = (uint8_t)((recorder->board->pins[pin] - 0x80) >> 4),
                            .bit = recorder->board->pins[pin] & 7,
                            .level = level};
}

/* --- the drive ---------------------------------------------------------------------------- */

/* In memory that all processes share: to fork is cheap then. */
static struct mcs52 *copy_of(const struct mcs52 *chip)
{
    struct mcs52 *copy = shared_get(mcs52_size());

    mcs52_copy(copy, chip);
    return copy;
}

/* From power up to the first trigger. */
static void record_boot(struct fair *fair, struct loop *loop)
{
    const uint64_t apart_mc = 10000;
    struct mcs52 *chip = fast_chip(run_sim(loop));
    uint64_t next = 0;

    do {
        if (mcs52_cycles(chip) >= next && fair->boot_count < FAIR_BOOTS) {
            fair->boots[fair->boot_count++] = copy_of(chip);
            next += apart_mc;
        }
    } while (run_boot(loop));
}

void fair_record(struct fair *fair, struct run *run, const struct run_setup *setup, long fault_at)
{
    struct recorder recorder = {.fair = fair, .run = run, .board = setup->board};
    const struct run_observer observer = {.user = &recorder, .pin = note_input};
    struct loop *loop = run_power_up(run, setup, &observer, 1);

    recorder.loop = loop;
    if (loop != NULL) {
        record_boot(fair, loop);
    }
    while (loop != NULL && fair->row_count < FAIR_ROWS && run_next(loop)) {
        int row = fair->row_count++;

        fair->rows[row] =
            fair_row_of(setup->scenario->world, run_world(loop), &fair->speeds_mps[row]);
        fair->fault = fair->fault || fair_is_in_fault(loop, fault_at);
        fair->chips[row] = copy_of(fast_chip(run_sim(loop)));
    }
    fair->boot_ns = run->boot_ns;
    if (loop != NULL) {
        run_end(loop);
        fair->impact = run->outcome.values[METRIC_IMPACT] > 0;
        fair->min_gap_m = run->outcome.values[METRIC_MIN_GAP];
        run_free(run);
    }
}

struct mcs52 *fair_start_before(const struct fair *fair, uint64_t cycle)
{
    struct mcs52 *start = fair->boots[0];

    for (int i = 0; i < fair->boot_count && mcs52_cycles(fair->boots[i]) <= cycle; i++) {
        start = fair->boots[i];
    }
    for (int i = 0; i < fair->row_count && mcs52_cycles(fair->chips[i]) <= cycle; i++) {
        start = fair->chips[i];
    }
    return start;
}

/* --- the same? ---------------------------------------------------------------------------- */

bool fair_is_same_world(const struct fair *fair, const struct judge_row *row, double speed_mps,
                        int at)
{
    const double same = 1e-5;

    return fabs(row->gap_m - fair->rows[at].gap_m) < same &&
           fabs(row->demand_pct - fair->rows[at].demand_pct) < same &&
           fabs(speed_mps - fair->speeds_mps[at]) < same;
}

bool fair_is_same_chip(struct mcs52 *chip, const struct mcs52 *fair_chip, const long excused[2])
{
    static struct mcs52 *own; /* to compare brings both up to date, and other processes read that */

    if (mcs52_cycles(chip) != mcs52_cycles(fair_chip) || mcs52_pc(chip) != mcs52_pc(fair_chip)) {
        return false;
    }
    if (own == NULL) {
        own = mcs52_create(MCS52_INTEL, NULL);
    }
    mcs52_copy(own, fair_chip);
    for (int i = 0; i < 2; i++) {
        if (excused[i] >= 0) {
            mcs52_ram(own)[excused[i]] = mcs52_ram(chip)[excused[i]];
        }
    }
    return mcs52_equal(chip, own);
}
