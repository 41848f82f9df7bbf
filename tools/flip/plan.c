/* SPDX-License-Identifier: MIT */
#include "plan.h"

#include "random.h"
#include "shared.h"

#include <stdlib.h>

enum { CLOCKS_PER_CYCLE = 12, PERIOD_MS = 60 };

/* What all the functions below need. */
struct planner {
    struct plan *plan;
    const struct arguments *arguments;
    double boot_s, cycles_per_s;
};

void plan_init(struct plan *plan, size_t capacity)
{
    plan->count = 0;
    plan->capacity = capacity;
    plan->cases = shared_get(capacity * sizeof *plan->cases);
}

size_t plan_add(struct plan *plan, const struct fault_case *one)
{
    if (plan->count == plan->capacity) {
        abort();
    }
    plan->cases[plan->count] = *one;
    return plan->count++;
}

/* The cycle T_S after the first trigger (before it where T_S is negative). */
static uint64_t cycle_at(const struct planner *planner, double t_s)
{
    return (uint64_t)((planner->boot_s + t_s) * planner->cycles_per_s);
}

static double period_cycles(const struct planner *planner)
{
    return planner->cycles_per_s / 1000 * PERIOD_MS;
}

/* Faults of one instant spread over a period of the sensor, by the golden ratio, so that each part
 * of the main loop is hit. */
static uint64_t spread(const struct planner *planner, uint64_t cycle, unsigned n)
{
    unsigned period = (unsigned)period_cycles(planner);

    return cycle + (uint64_t)n * (period * 618ULL / 1000 + 1) % period;
}

static void add_bits(const struct planner *planner, double t_s)
{
    const struct arguments *arguments = planner->arguments;
    unsigned n = 0;

    for (unsigned k = 0; k < 512 * 8; k++) {
        enum where where = k < 256 * 8 ? IN_RAM : IN_SFR;
        uint16_t address = (uint16_t)(k / 8 % 256);

        if (where == IN_RAM ? arguments->rams[address] : arguments->sfrs[address]) {
            plan_add(planner->plan,
                     &(struct fault_case){.where = where,
                                          .address = address,
                                          .bit = (uint8_t)(k % 8),
                                          .cycle = spread(planner, cycle_at(planner, t_s), n++)});
        }
    }
}

static void add_stuck(const struct planner *planner, double t_s)
{
    for (unsigned n = 0; n < MCS52_RAM_BYTES * 16; n++) {
        if (planner->arguments->rams[n >> 4]) {
            plan_add(planner->plan,
                     &(struct fault_case){.where = IN_RAM,
                                          .kind = n & 1 ? MCS52_STUCK_HIGH : MCS52_STUCK_LOW,
                                          .address = (uint16_t)(n >> 4),
                                          .bit = (uint8_t)(n >> 1 & 7),
                                          .cycle = spread(planner, cycle_at(planner, t_s), n)});
        }
    }
}

/* Random places of the code that the image uses, or bits of the program counter. */
static void add_random(const struct planner *planner, const struct hexfile *hex, double t_s,
                       struct random *random)
{
    enum where where = planner->arguments->what == WHAT_PC ? IN_PC : IN_CODE;

    for (long n = 0; n < planner->arguments->count;) {
        struct fault_case one = {.where = where, .cycle = cycle_at(planner, t_s)};

        one.address = (uint16_t)(random_uniform(random) * HEX_CODE_SIZE);
        one.bit = (uint8_t)(random_uniform(random) * (where == IN_PC ? 16 : 8));
        one.cycle += (uint64_t)(random_uniform(random) * period_cycles(planner));
        if (where == IN_PC || hex->used[one.address]) {
            if (where == IN_PC) {
                one.address = 0;
            }
            plan_add(planner->plan, &one);
            n++;
        }
    }
}

static int by_cycle(const void *a, const void *b)
{
    const struct fault_case *p = a, *q = b;

    return p->cycle < q->cycle ? -1 : p->cycle > q->cycle;
}

void plan_sort(struct plan *plan)
{
    qsort(plan->cases, plan->count, sizeof *plan->cases, by_cycle);
}

void plan_make(struct plan *plan, const struct arguments *arguments, const struct hexfile *hex,
               int64_t boot_ns, long clk_hz)
{
    struct planner planner = {.plan = plan,
                              .arguments = arguments,
                              .boot_s = (double)boot_ns * 1e-9,
                              .cycles_per_s = (double)clk_hz / CLOCKS_PER_CYCLE};
    struct random random;

    random_seed(&random, (uint64_t)arguments->seed);
    plan_init(plan, MAX_INSTANTS * (4096 + (size_t)arguments->count));
    for (int i = 0; i < arguments->instants; i++) {
        double t_s = arguments->instants_s[i];

        if (arguments->what == WHAT_BITS) {
            add_bits(&planner, t_s);
        } else if (arguments->what == WHAT_STUCK) {
            add_stuck(&planner, t_s);
        } else {
            add_random(&planner, hex, t_s, &random);
        }
    }
    plan_sort(plan);
}

const char *plan_where_name(enum where where)
{
    static const char *const names[] = {"ram", "sfr", "code", "pc"};

    return names[where];
}
