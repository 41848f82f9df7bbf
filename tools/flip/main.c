/* SPDX-License-Identifier: MIT */
/* flip: one drive, many times, each time with another bit of the chip changed. The drive runs once
 * as it is; then again, and at each instant it forks: the copy of the process is the checkpoint, of
 * chip and world alike. Each copy has one fault and ends as soon as it is again where the drive
 * without a fault was at that time. */
#include "board.h"
#include "diag.h"
#include "fast.h"
#include "hexfile.h"
#include "judge.h"
#include "manual.h"
#include "mcs52.h"
#include "random.h"
#include "rig.h"
#include "run.h"
#include "scenario.h"

#include <argp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

const char *argp_program_version = "fuzzy51 " FUZZY51_VERSION;

enum { MAX_INSTANTS = 64, MAX_ROWS = 2000, MAX_JOBS = 64, LINE = 160 };
enum { CLOCKS_PER_CYCLE = 12, PERIOD_MS = 60 };

/* Where a fault is. CODE is no place of the library's: it changes the program. */
enum where { IN_RAM, IN_SFR, IN_CODE, IN_PC, WHERES };
static const char *const where_names[] = {"ram", "sfr", "code", "pc"};

struct fault_case {
    enum where where;
    enum mcs52_fault_kind kind;
    uint16_t address;
    uint8_t bit;
    uint64_t cycle; /* since power came up */
    /* what came of it */
    bool done;
    enum verdict verdict;
    enum harm harm;
    double min_gap_m;
    int rows; /* until it was as without the fault, or over */
};

struct plan {
    struct fault_case *cases; /* in memory that all processes share */
    size_t count, capacity;
};

/* The drive without a fault. */
struct fair {
    struct judge_row rows[MAX_ROWS];
    double speeds_mps[MAX_ROWS];
    struct mcs52 *chips[MAX_ROWS]; /* at the end of each row */
    int row_count;
    int64_t boot_ns;
    bool impact, fault;
    double min_gap_m;
};

struct arguments {
    const char *hex, *board, *scenario, *output;
    double instants_s[MAX_INSTANTS];
    int instants;
    bool rams[MCS52_RAM_BYTES], sfrs[256]; /* which of them, by address */
    bool has_ram, has_sfr;                 /* some were named */
    int what;                              /* index of kinds[] */
    double least_pct;
    long fault_at, unused_at, told_at, count, jobs, seed;
};

/* What --what may be. */
enum { BITS, STUCK, CODE, PC };
static const char *const kinds[] = {"bits", "stuck", "code", "pc"};

static struct plan plan;
static struct fair fair;
static long clk_hz;
static double least_pct;
static long fault_at;           /* address of the controller's fault_state; -1: not known */
static long unused_at, told_at; /* see --unused and --told */

/* --- the plan ----------------------------------------------------------------------------- */

static void add(const struct fault_case *one)
{
    if (plan.count < plan.capacity) {
        plan.cases[plan.count++] = *one;
    }
}

/* The cycle T_S after the first trigger (before it where T_S is negative). */
static uint64_t cycle_at(double t_s)
{
    return (uint64_t)(((double)fair.boot_ns * 1e-9 + t_s) * (double)clk_hz / CLOCKS_PER_CYCLE);
}

/* Faults of one instant spread over a period of the sensor, by the golden ratio, so that each part
 * of the main loop is hit. */
static uint64_t spread(uint64_t cycle, unsigned n)
{
    unsigned period = (unsigned)(clk_hz / CLOCKS_PER_CYCLE / 1000 * PERIOD_MS);

    return cycle + (uint64_t)n * (period * 618ULL / 1000 + 1) % period;
}

static void plan_bits(const struct arguments *arguments, double t_s)
{
    unsigned n = 0;

    for (unsigned k = 0; k < 512 * 8; k++) {
        enum where where = k < 256 * 8 ? IN_RAM : IN_SFR;
        uint16_t address = (uint16_t)(k / 8 % 256);

        if (where == IN_RAM ? arguments->rams[address] : arguments->sfrs[address]) {
            add(&(struct fault_case){.where = where,
                                     .address = address,
                                     .bit = (uint8_t)(k % 8),
                                     .cycle = spread(cycle_at(t_s), n++)});
        }
    }
}

static void plan_stuck(const struct arguments *arguments, double t_s)
{
    for (unsigned n = 0; n < MCS52_RAM_BYTES * 16; n++) {
        if (arguments->rams[n >> 4]) {
            add(&(struct fault_case){.where = IN_RAM,
                                     .kind = n & 1 ? MCS52_STUCK_HIGH : MCS52_STUCK_LOW,
                                     .address = (uint16_t)(n >> 4),
                                     .bit = (uint8_t)(n >> 1 & 7),
                                     .cycle = spread(cycle_at(t_s), n)});
        }
    }
}

/* Random places of the code that the image uses, or bits of the program counter. */
static void plan_random(const struct arguments *arguments, const struct hexfile *hex, double t_s,
                        struct random *random)
{
    enum where where = arguments->what == PC ? IN_PC : IN_CODE;

    for (long n = 0; n < arguments->count;) {
        struct fault_case one = {.where = where, .cycle = cycle_at(t_s)};

        one.address = (uint16_t)(random_uniform(random) * HEX_CODE_SIZE);
        one.bit = (uint8_t)(random_uniform(random) * (where == IN_PC ? 16 : 8));
        one.cycle += (uint64_t)(random_uniform(random) * (double)clk_hz / CLOCKS_PER_CYCLE / 1000 *
                                PERIOD_MS);
        if (where == IN_PC || hex->used[one.address]) {
            if (where == IN_PC) {
                one.address = 0;
            }
            add(&one);
            n++;
        }
    }
}

static int by_cycle(const void *a, const void *b)
{
    const struct fault_case *p = a, *q = b;

    return p->cycle < q->cycle ? -1 : p->cycle > q->cycle;
}

/* --- one drive ---------------------------------------------------------------------------- */

static struct judge_row row_of(const struct world_class *class, const struct world *world,
                               double *speed_mps)
{
    double values[WORLD_COLUMNS];

    class->values(world, values);
    if (speed_mps != NULL) {
        *speed_mps = values[RIG_OWN_SPEED];
    }
    return (struct judge_row){.gap_m = isnan(values[RIG_GAP]) ? INFINITY : values[RIG_GAP],
                              .demand_pct = values[RIG_BRAKE]};
}

static bool is_in_fault(struct loop *loop)
{
    return fault_at >= 0 && mcs52_ram(fast_chip(run_sim(loop)))[fault_at] != 0;
}

static void record(struct run *run, const struct run_setup *setup)
{
    struct loop *loop = run_begin(run, setup, NULL, 0);

    while (loop != NULL && fair.row_count < MAX_ROWS && run_next(loop)) {
        int row = fair.row_count++;

        fair.rows[row] = row_of(setup->scenario->world, run_world(loop), &fair.speeds_mps[row]);
        fair.fault = fair.fault || is_in_fault(loop);
        fair.chips[row] = mcs52_create(MCS52_INTEL, &(struct mcs52_outside){0});
        mcs52_copy(fair.chips[row], fast_chip(run_sim(loop)));
    }
    fair.boot_ns = run->boot_ns;
    if (loop != NULL) {
        run_end(loop);
        fair.impact = run->outcome.values[METRIC_IMPACT] > 0;
        fair.min_gap_m = run->outcome.values[METRIC_MIN_GAP];
        run_free(run);
    }
}

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

/* The car is where it is without the fault, so its sensor will hear the same. */
static bool is_same_world(const struct judge_row *row, double speed_mps, int at)
{
    const double same = 1e-5;

    return fabs(row->gap_m - fair.rows[at].gap_m) < same &&
           fabs(row->demand_pct - fair.rows[at].demand_pct) < same &&
           fabs(speed_mps - fair.speeds_mps[at]) < same;
}

/* The chip is as without the fault. In RAM that the program does not use a flip stays, and with it
 * the count of such bytes that the controller tells. */
static bool is_same_chip(struct mcs52 *chip, const struct fault_case *one, int at)
{
    uint8_t *ram = mcs52_ram(chip), *fair_ram = mcs52_ram(fair.chips[at]), byte = 0, told = 0;
    bool unused = one->where == IN_RAM && one->address >= unused_at, same;

    if (unused) {
        byte = ram[one->address], told = ram[told_at];
        ram[one->address] = fair_ram[one->address], ram[told_at] = fair_ram[told_at];
    }
    same = mcs52_equal(chip, fair.chips[at]);
    if (unused) {
        ram[one->address] = byte, ram[told_at] = told;
    }
    return same;
}

/* The controller never came as far as a measurement: are the pins safe? Nothing moves them. */
static bool is_brake_on(struct loop *loop, const struct board *board)
{
    const struct mcs52 *chip = fast_chip(run_sim(loop));
    uint8_t pin = board->pins[PIN_STOP];

    return mcs52_pin(chip, (pin - 0x80) >> 4, pin & 7);
}

/* The rest of the drive, in a process of its own. */
static void go_on(struct loop *loop, struct run *run, const struct run_setup *setup,
                  const struct hexfile *hex, struct fault_case *one)
{
    struct mcs52 *chip = fast_chip(run_sim(loop));
    struct judge judge = {0};
    bool fault = false, same = false;
    struct judge_row row;
    double speed_mps, min_gap_m = INFINITY;

    fast_outlive_resets(run_sim(loop));
    inject(chip, one);
    change_code(chip, hex, one);
    while (run_boot(loop))
        ;
    if (!run->triggered) {
        one->harm = is_brake_on(loop, setup->board) ? HARM_NONE : HARM_BRAKE_OFF;
        one->verdict = one->harm != HARM_NONE           ? VERDICT_UNSAFE
                       : fast_resets(run_sim(loop)) > 0 ? VERDICT_WATCHDOG
                                                        : VERDICT_SAFE_STOP;
        one->done = true;
        return;
    }
    while (!same && run_next(loop)) {
        int at = (int)(run->duration_ns / WORLD_ROW_NS) - 1;

        row = row_of(setup->scenario->world, run_world(loop), &speed_mps);
        if (at >= fair.row_count) {
            break;
        }
        judge_take(&judge, &row, &fair.rows[at], least_pct);
        fault = fault || is_in_fault(loop);
        min_gap_m = fmin(min_gap_m, row.gap_m);
        one->rows = at + 1;
        same = one->kind == MCS52_FLIP && mcs52_cycles(chip) > one->cycle &&
               is_same_world(&row, speed_mps, at) && is_same_chip(chip, one, at);
    }
    if (same) {
        one->min_gap_m = fair.min_gap_m;
        one->verdict = judge_end(&judge, false, false, fair.min_gap_m, fair.min_gap_m,
                                 fast_resets(run_sim(loop)), fault && !fair.fault);
    } else {
        int resets = fast_resets(run_sim(loop));

        run_end(loop);
        one->min_gap_m = run->outcome.values[METRIC_MIN_GAP];
        one->verdict = judge_end(&judge, run->outcome.values[METRIC_IMPACT] > 0, fair.impact,
                                 one->min_gap_m, fair.min_gap_m, resets, fault && !fair.fault);
    }
    one->harm = judge.harm;
    one->done = true;
}

/* --- all of them -------------------------------------------------------------------------- */

static long running;

static void await(void)
{
    if (running > 0 && wait(NULL) > 0) {
        running--;
    }
}

/* Forks for all cases before NEXT whose time comes before CYCLE. */
static size_t fork_until(size_t next, uint64_t cycle, struct loop *loop, struct run *run,
                         const struct run_setup *setup, const struct hexfile *hex, long jobs)
{
    while (next < plan.count && plan.cases[next].cycle < cycle) {
        pid_t child;

        while (running >= jobs) {
            await();
        }
        fflush(stdout);
        child = fork();
        if (child == 0) {
            go_on(loop, run, setup, hex, &plan.cases[next]);
            _exit(0);
        }
        if (child < 0) {
            abort();
        }
        running++;
        next++;
    }
    return next;
}

static void run_all(struct run *run, const struct run_setup *setup, const struct hexfile *hex,
                    long jobs)
{
    struct loop *loop = run_power_up(run, setup, NULL, 0);
    struct mcs52 *chip = fast_chip(run_sim(loop));
    uint64_t quantum = (uint64_t)(clk_hz / CLOCKS_PER_CYCLE / 1000 * setup->quantum_us / 1000 + 4);
    uint64_t row = (uint64_t)(clk_hz / CLOCKS_PER_CYCLE / 100 + 4);
    size_t next = 0;

    do {
        next = fork_until(next, mcs52_cycles(chip) + quantum, loop, run, setup, hex, jobs);
    } while (run_boot(loop));
    do {
        next = fork_until(next, mcs52_cycles(chip) + row, loop, run, setup, hex, jobs);
    } while (next < plan.count && run_next(loop));
    while (running > 0) {
        await();
    }
    run_end(loop);
    run_free(run);
}

static int print(const struct arguments *arguments)
{
    static const char *const faults[] = {"flip", "low", "high"};
    struct outfile file = {.stream = stdout};
    FILE *out;

    if (arguments->output != NULL && outfile_open(&file, arguments->output) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    out = file.stream;
    fprintf(out, "place,kind,address,bit,cycle,verdict,harm,min_gap_m,rows\n");
    for (size_t i = 0; i < plan.count; i++) {
        const struct fault_case *one = &plan.cases[i];

        fprintf(out, "%s,%s,0x%02X,%d,%llu,%s,%s,%.2f,%d\n", where_names[one->where],
                faults[one->kind], one->address, one->bit, (unsigned long long)one->cycle,
                one->done ? judge_verdict_name(one->verdict) : "lost", judge_harm_name(one->harm),
                one->min_gap_m, one->rows);
    }
    return arguments->output != NULL ? outfile_commit(&file) : EXIT_FINE;
}

/* --- the command line --------------------------------------------------------------------- */

enum option_key {
    OPT_HEX = 256,
    OPT_BOARD,
    OPT_SCENARIO,
    OPT_AT,
    OPT_WHAT,
    OPT_RAM,
    OPT_SFR,
    OPT_COUNT,
    OPT_LEAST,
    OPT_FAULT,
    OPT_UNUSED,
    OPT_TOLD,
    OPT_SEED
};

static const struct argp_option options[] = {
    {"hex", OPT_HEX, "FILE", 0, "the image (default: build/BOARD/APP.ihx)", 1},
    {"board", OPT_BOARD, "NAME", 0, "the board", 1},
    {"scenario", OPT_SCENARIO, "FILE", 0, "the drive", 1},
    {"what", OPT_WHAT, "KIND", 0,
     "bits (each bit of RAM and of the registers of --sfr), stuck (each bit of RAM, low and high), "
     "code or pc (random ones)",
     2},
    {"at", OPT_AT, "S,...", 0, "instants, seconds after the first trigger; negative ones before it",
     2},
    {"ram", OPT_RAM, "XX,...", 0,
     "addresses of RAM, hexadecimal; XX-YY is a range (default: all, but none with --sfr)", 2},
    {"sfr", OPT_SFR, "XX,...", 0, "addresses of registers, likewise (default: none)", 2},
    {"count", OPT_COUNT, "N", 0, "of code and pc: how many at each instant", 2},
    {"seed", OPT_SEED, "N", 0, "of code and pc", 2},
    {"least", OPT_LEAST, "PCT", 0,
     "the brake must not fall below that where it does not without the fault", 3},
    {"fault-state", OPT_FAULT, "XX", 0, "where RAM says that the controller is in FAULT", 3},
    {"unused", OPT_UNUSED, "XX", 0,
     "the stack, as bound has proven, does not reach this address: from there on a flip changes "
     "nothing but what --told holds",
     3},
    {"told", OPT_TOLD, "XX", 0, "where the controller keeps how much of the stack is unused", 3},
    {"jobs", 'j', "N", 0, "runs at a time (default: one a core)", 4},
    {"output", 'o', "FILE", 0, "the table of all runs, as CSV (default: stdout)", 4},
    {0},
};

static double parse_number(struct argp_state *state, const char *option, const char *text, int base,
                           double low, double high)
{
    char *end;
    double value = base == 16 ? (double)strtoul(text, &end, 16) : strtod(text, &end);

    if (end == text || *end != '\0' || !(value >= low && value <= high)) {
        argp_error(state, "--%s=%s: give %s number in %g..%g", option, text,
                   base == 16 ? "a hexadecimal" : "a", low, high);
    }
    return value;
}

/* A list of addresses and ranges. */
static void parse_addresses(struct argp_state *state, const char *option, const char *text,
                            unsigned low, bool marks[256])
{
    char list[LINE], *next = list, *word;

    snprintf(list, sizeof list, "%s", text);
    while ((word = strsep(&next, ",")) != NULL) {
        char *last = strchr(word, '-');
        unsigned from, to;

        if (last != NULL) {
            *last++ = '\0';
        }
        from = (unsigned)parse_number(state, option, word, 16, low, 255);
        to = last != NULL ? (unsigned)parse_number(state, option, last, 16, from, 255) : from;
        memset(marks + from, true, to - from + 1);
    }
}

static void parse_instants(struct argp_state *state, const char *text, struct arguments *arguments)
{
    char list[LINE], *next = list, *word;

    snprintf(list, sizeof list, "%s", text);
    while ((word = strsep(&next, ",")) != NULL && arguments->instants < MAX_INSTANTS) {
        arguments->instants_s[arguments->instants++] =
            parse_number(state, "at", word, 10, -RUN_BOOT_S, MAX_ROWS * 0.01);
    }
}

static int parse_kind(struct argp_state *state, const char *text)
{
    for (int kind = BITS; kind <= PC; kind++) {
        if (strcmp(text, kinds[kind]) == 0) {
            return kind;
        }
    }
    argp_error(state, "--what=%s: give bits, stuck, code or pc", text);
    return BITS;
}

static error_t take_option(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;

    switch (key) {
    case OPT_HEX:
        arguments->hex = text;
        break;
    case OPT_BOARD:
        arguments->board = text;
        break;
    case OPT_SCENARIO:
        arguments->scenario = text;
        break;
    case OPT_WHAT:
        arguments->what = parse_kind(state, text);
        break;
    case OPT_AT:
        parse_instants(state, text, arguments);
        break;
    case OPT_RAM:
        arguments->has_ram = true;
        parse_addresses(state, "ram", text, 0, arguments->rams);
        break;
    case OPT_SFR:
        arguments->has_sfr = true;
        parse_addresses(state, "sfr", text, 0x80, arguments->sfrs);
        break;
    case OPT_COUNT:
        arguments->count = (long)parse_number(state, "count", text, 10, 1, 1000000);
        break;
    case OPT_SEED:
        arguments->seed = (long)parse_number(state, "seed", text, 10, 0, 4294967295.0);
        break;
    case OPT_LEAST:
        arguments->least_pct = parse_number(state, "least", text, 10, 0, 100);
        break;
    case OPT_FAULT:
        arguments->fault_at = (long)parse_number(state, "fault-state", text, 16, 0, 255);
        break;
    case OPT_UNUSED:
        arguments->unused_at = (long)parse_number(state, "unused", text, 16, 0, 255);
        break;
    case OPT_TOLD:
        arguments->told_at = (long)parse_number(state, "told", text, 16, 0, 255);
        break;
    case 'j':
        arguments->jobs = (long)parse_number(state, "jobs", text, 10, 1, MAX_JOBS);
        break;
    case 'o':
        arguments->output = text;
        break;
    case ARGP_KEY_END:
        if (arguments->board == NULL || arguments->scenario == NULL || arguments->instants == 0) {
            argp_error(state, "give --board, --scenario and --at");
        }
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static const struct argp parser = {
    .options = options,
    .parser = take_option,
    .doc = "Changes bits of the chip that runs a controller's real image, one a run, and says what "
           "each came to: none, corrected, safe-stop, FAULT, watchdog or unsafe.\v"
           "The rows of the table are sorted by time. `rows` is how long the run took, in rows of "
           "10 ms, until it was as without the fault, or over. Unsafe is an impact, 0.3 m less "
           "gap, the brake off or below --least for more than 120 ms, or a false full brake of a "
           "second."};

static const struct manual manual = {
    .program = "flip",
    .brief = "what each bit of the chip does to a drive when it flips",
    .about = "",
    .command = &(const struct manual_command){.argp = &parser},
    .commands = 1,
};

static void make_plan(const struct arguments *arguments, const struct hexfile *hex)
{
    struct random random;

    random_seed(&random, (uint64_t)arguments->seed);
    plan.capacity = MAX_INSTANTS * 4096 + (size_t)arguments->count * MAX_INSTANTS;
    plan.cases = mmap(NULL, plan.capacity * sizeof *plan.cases, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (plan.cases == MAP_FAILED) {
        abort();
    }
    for (int i = 0; i < arguments->instants; i++) {
        double t_s = arguments->instants_s[i];

        if (arguments->what == BITS) {
            plan_bits(arguments, t_s);
        } else if (arguments->what == STUCK) {
            plan_stuck(arguments, t_s);
        } else {
            plan_random(arguments, hex, t_s, &random);
        }
    }
    qsort(plan.cases, plan.count, sizeof *plan.cases, by_cycle);
}

int main(int argc, char **argv)
{
    struct arguments arguments = {.fault_at = -1,
                                  .unused_at = MCS52_RAM_BYTES,
                                  .count = 100,
                                  .jobs = sysconf(_SC_NPROCESSORS_ONLN),
                                  .seed = 1};
    static struct scenario scenario;
    static struct hexfile hex;
    static struct run run;
    struct run_setup setup = {.engine = &fast_engine,
                              .scenario = &scenario,
                              .quantum_us = RUN_QUANTUM_US,
                              .step_us = WORLD_STEP_NS / 1000};
    char image[SCENARIO_TEXT + 64];
    int status;

    argp_err_exit_status = EXIT_USAGE;
    if (argc == 2 && manual_option(&manual, argv[1], &status)) {
        return status;
    }
    argp_parse(&parser, argc, argv, 0, NULL, &arguments);
    if (!arguments.has_ram && !arguments.has_sfr) {
        memset(arguments.rams, true, sizeof arguments.rams);
    }
    setup.board = board_find(arguments.board);
    if (setup.board == NULL) {
        diag_error(NULL, 0, "no board '%s'; the boards are: %s", arguments.board, board_names());
        return EXIT_USAGE;
    }
    if (scenario_read(&scenario, arguments.scenario, NULL, 0) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    setup.hex = arguments.hex;
    if (setup.hex == NULL) {
        snprintf(image, sizeof image, "build/%s/%s.ihx", setup.board->name, scenario.app);
        setup.hex = image;
    }
    if (hexfile_read(&hex, setup.hex) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    setup.seed = (uint64_t)scenario.seed;
    clk_hz = setup.board->clk_hz;
    least_pct = arguments.least_pct;
    fault_at = arguments.fault_at;
    unused_at = arguments.unused_at;
    told_at = arguments.told_at;
    record(&run, &setup);
    if (fair.row_count == 0) {
        diag_error(setup.hex, 0, "the drive without a fault does not begin");
        return EXIT_USAGE;
    }
    make_plan(&arguments, &hex);
    run_all(&run, &setup, &hex, arguments.jobs);
    return print(&arguments);
}
