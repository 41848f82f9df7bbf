/* SPDX-License-Identifier: MIT */
#include "fly.h"

#include "fast.h"
#include "hash.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    CLOCKS_PER_CYCLE = 12,
    ROWS_PER_S = 100,
    MEET_ROWS = 4 /* to look each row would cost more than it saves */
};

/* --- a drive with a fault ----------------------------------------------------------------- */

static void inject(struct mcs52 *chip, const struct fault_case *one)
{
    const enum mcs52_place places[] = {
        [IN_RAM] = MCS52_IN_RAM, [IN_SFR] = MCS52_IN_SFR, [IN_PC] = MCS52_IN_PC};

    if (one->where != IN_CODE) {
        const struct mcs52_fault fault = {.kind = one->kind,
                                          .place = places[one->where],
                                          .address = one->address,
                                          .bit = one->bit,
                                          .when = one->cycle};

        mcs52_inject(chip, &fault);
    }
}

/* A code byte changes between two rows. */
static void change_code(struct mcs52 *chip, const struct hexfile *hex, const struct fault_case *one)
{
    uint8_t byte = (uint8_t)(hex->code[one->address] ^ 1u << one->bit);

    if (one->where == IN_CODE) {
        mcs52_load(chip, one->address, &byte, 1);
    }
}

/* The chip is as without the fault. In RAM that the program does not use a flip stays, and with it
 * the count of such bytes that the controller tells. */
static bool is_same_chip(const struct flight *flight, struct mcs52 *chip,
                         const struct fault_case *one, int at)
{
    bool unused = one->where == IN_RAM && one->address >= flight->arguments->unused_at;
    const long excused[2] = {unused ? one->address : -1, unused ? flight->arguments->told_at : -1};

    return fair_is_same_chip(chip, flight->fair->chips[at], excused);
}

/* The controller never came as far as a measurement: are the pins safe? Nothing moves them. */
static bool is_brake_on(struct loop *loop, const struct board *board)
{
    const struct mcs52 *chip = fast_chip(run_sim(loop));
    uint8_t pin = board->pins[PIN_STOP];

    return mcs52_pin(chip, (pin - 0x80) >> 4, pin & 7);
}

static void judge_boot(struct loop *loop, const struct board *board, struct fault_case *one)
{
    one->harm = is_brake_on(loop, board) ? HARM_NONE : HARM_BRAKE_OFF;
    one->verdict = one->harm != HARM_NONE           ? VERDICT_UNSAFE
                   : fast_resets(run_sim(loop)) > 0 ? VERDICT_WATCHDOG
                                                    : VERDICT_SAFE_STOP;
    one->done = true;
}

/* The case before this one that was at the end of row AT where this one is now, chip, world and
 * judge, so that both go on alike; this one, if there is none. */
static size_t find_met(const struct flight *flight, struct mcs52 *chip,
                       const struct fault_case *one, const struct judge_row *row, double speed_mps,
                       uint64_t judged, int at)
{
    size_t index = (size_t)(one - flight->plan->cases);
    const double same = 1e-5;
    struct mcs52_snapshot snapshot;
    uint64_t key = hash_mix((uint64_t)at, judged);

    if (at % MEET_ROWS != 0 || one->kind != MCS52_FLIP || one->where == IN_CODE ||
        mcs52_cycles(chip) <= one->cycle || mcs52_is_asleep(chip) ||
        memcmp(mcs52_xdata(chip), mcs52_xdata(flight->fair->chips[at]), MCS52_XDATA_BYTES) != 0) {
        return index;
    }
    mcs52_snapshot(chip, &snapshot);
    key = hash_mix(key, isinf(row->gap_m) ? 0 : (uint64_t)llround(row->gap_m / same));
    key = hash_mix(key, (uint64_t)llround(row->demand_pct / same));
    key = hash_mix(key, (uint64_t)llround(speed_mps / same));
    return meet_at(flight->meet, hash_bytes(key, &snapshot, sizeof snapshot), index);
}

/* How a drive goes. */
struct progress {
    struct judge judge;
    bool fault;
    bool same; /* as without the fault */
};

/* One more row. Returns false when the drive need not go on. */
static bool take_row(const struct flight *flight, struct loop *loop, struct fault_case *one,
                     struct progress *progress)
{
    const struct fair *fair = flight->fair;
    struct mcs52 *chip = fast_chip(run_sim(loop));
    int at = (int)(flight->run->duration_ns / WORLD_ROW_NS) - 1;
    double speed_mps;
    struct judge_row row = fair_row_of(flight->setup->scenario->world, run_world(loop), &speed_mps);
    uint64_t judged;
    size_t met;

    if (at >= fair->row_count) {
        return false;
    }
    judge_take(&progress->judge, &row, &fair->rows[at], flight->arguments->least_pct);
    progress->fault = progress->fault || fair_is_in_fault(loop, flight->arguments->fault_at);
    one->rows = at + 1;
    progress->same = one->kind == MCS52_FLIP && mcs52_cycles(chip) > one->cycle &&
                     fair_is_same_world(fair, &row, speed_mps, at) &&
                     is_same_chip(flight, chip, one, at);
    if (progress->same) {
        return false;
    }
    judged = hash_mix(judge_key(&progress->judge),
                      (uint64_t)fast_resets(run_sim(loop)) << 1 | progress->fault);
    met = find_met(flight, chip, one, &row, speed_mps, judged, at);
    if (&flight->plan->cases[met] != one) {
        one->met = met + 1;
    }
    return one->met == 0;
}

/* The rest of the drive, in a process of its own. */
static void go_on(struct flight *flight, struct loop *loop, struct fault_case *one)
{
    struct mcs52 *chip = fast_chip(run_sim(loop));
    struct run *run = flight->run;
    const struct fair *fair = flight->fair;
    struct progress progress = {.fault = false};
    int resets;
    bool impact = fair->impact;

    fast_outlive_resets(run_sim(loop));
    inject(chip, one);
    change_code(chip, flight->hex, one);
    while (run_boot(loop))
        ;
    if (!run->triggered) {
        judge_boot(loop, flight->setup->board, one);
        return;
    }
    while (run_next(loop) && take_row(flight, loop, one, &progress))
        ;
    one->done = true;
    if (one->met > 0) {
        return;
    }
    resets = fast_resets(run_sim(loop));
    one->min_gap_m = fair->min_gap_m;
    if (!progress.same) {
        run_end(loop);
        impact = run->outcome.values[METRIC_IMPACT] > 0;
        one->min_gap_m = run->outcome.values[METRIC_MIN_GAP];
    }
    one->verdict = judge_end(&progress.judge, impact, fair->impact, one->min_gap_m, fair->min_gap_m,
                             resets, progress.fault && !fair->fault);
    one->harm = progress.judge.harm;
}

/* --- all of them -------------------------------------------------------------------------- */

static void await(struct flight *flight)
{
    if (flight->running > 0 && wait(NULL) > 0) {
        flight->running--;
    }
}

/* Those that met another one come to the same. */
static void share(struct plan *plan)
{
    for (size_t i = 0; i < plan->count; i++) {
        struct fault_case *one = &plan->cases[i];
        const struct fault_case *last = one;

        while (last->met > 0) {
            last = &plan->cases[last->met - 1];
        }
        one->done = last->done;
        one->verdict = last->verdict;
        one->harm = last->harm;
        one->min_gap_m = last->min_gap_m;
    }
}

/* Forks for all cases from NEXT on whose time comes before CYCLE. Returns the first of the others.
 */
static size_t fork_until(struct flight *flight, struct loop *loop, size_t next, uint64_t cycle)
{
    while (next < flight->plan->count && flight->plan->cases[next].cycle < cycle) {
        pid_t child;

        while (flight->running >= flight->arguments->jobs) {
            await(flight);
        }
        fflush(stdout);
        child = fork();
        if (child == 0) {
            go_on(flight, loop, &flight->plan->cases[next]);
            _exit(0);
        }
        if (child < 0) {
            abort();
        }
        flight->running++;
        next++;
    }
    return next;
}

void fly(struct flight *flight)
{
    struct loop *loop = run_power_up(flight->run, flight->setup, NULL, 0);
    struct mcs52 *chip = fast_chip(run_sim(loop));
    double cycles_per_s = (double)flight->setup->board->clk_hz / CLOCKS_PER_CYCLE;
    uint64_t quantum = (uint64_t)(cycles_per_s * 1e-6 * flight->setup->quantum_us) + 4;
    uint64_t row = (uint64_t)(cycles_per_s / ROWS_PER_S) + 4;
    size_t next = 0;

    do {
        next = fork_until(flight, loop, next, mcs52_cycles(chip) + quantum);
    } while (run_boot(loop));
    do {
        next = fork_until(flight, loop, next, mcs52_cycles(chip) + row);
    } while (next < flight->plan->count && run_next(loop));
    while (flight->running > 0) {
        await(flight);
    }
    share(flight->plan);
    run_end(loop);
    run_free(flight->run);
}
