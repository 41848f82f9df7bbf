/* SPDX-License-Identifier: MIT */
#include "fast.h"

#include "diag.h"
#include "hexfile.h"
#include "mcs52.h"

#include <stdlib.h>
#include <string.h>

enum { CLOCKS_PER_CYCLE = 12, BAUD = 9600, NO_PIN = -1 };

struct fast {
    struct sim base;
    struct mcs52 *chip;
    int watched[4][8];           /* the index of a pin in setup.watch, or NO_PIN */
    uint8_t drive[SIM_MAX_PINS]; /* bit addresses */
    bool was_reset;
    bool outlives_resets;
    int resets; /* outlived */
    uint64_t reset_cycle;
    uint64_t line_free; /* the serial line to the chip is free from this cycle on */
    char *sent;         /* by the chip, not yet read */
    size_t sent_count, sent_capacity;
};

static struct fast *fast_of(struct sim *sim)
{
    return (struct fast *)sim;
}

static int port_of(uint8_t bit_address)
{
    return (bit_address - 0x80) >> 4;
}

/* --- time --------------------------------------------------------------------------------- */

/* The begin of a cycle, rounded to 1 ns. */
static int64_t ns_of_cycle(const struct fast *fast, uint64_t cycle)
{
    const __int128 cycle_ns = CLOCKS_PER_CYCLE * (__int128)1000000000; /* times Hz */

    return (int64_t)(((__int128)cycle * cycle_ns + fast->base.clk_hz / 2) / fast->base.clk_hz);
}

static uint64_t cycle_of_ns(const struct fast *fast, int64_t time_ns)
{
    return sim_cycle(&fast->base, time_ns);
}

/* --- what the chip does ------------------------------------------------------------------- */

static void note_edge(void *user, uint64_t cycle, int port, int bit, bool level)
{
    struct fast *fast = user;
    uint64_t from = fast->was_reset ? fast->reset_cycle : 0;
    struct sim_edge edge = {.time_ns = ns_of_cycle(fast, cycle - from),
                            .pin = fast->watched[port][bit],
                            .level = level,
                            .after_reset = fast->was_reset};

    fast->base.last_ns = edge.time_ns;
    sim_add_edge(&fast->base, &edge);
}

static void note_byte(void *user, uint64_t cycle, uint8_t byte)
{
    struct fast *fast = user;

    (void)cycle;
    if (fast->sent_count == fast->sent_capacity) {
        fast->sent_capacity = fast->sent_capacity * 2 + 256;
        fast->sent = realloc(fast->sent, fast->sent_capacity);
        if (fast->sent == NULL) {
            abort();
        }
    }
    fast->sent[fast->sent_count++] = (char)byte;
}

static void note_reset(void *user, uint64_t cycle)
{
    struct fast *fast = user;

    if (fast->outlives_resets) {
        fast->resets++;
    } else if (!fast->was_reset) {
        fast->was_reset = true;
        fast->reset_cycle = cycle;
        fast->base.last_ns = 0;
        mcs52_stop(fast->chip);
    }
}

/* --- the engine --------------------------------------------------------------------------- */

static int check(void)
{
    return EXIT_FINE; /* the tests have */
}

static void stop(struct sim *sim)
{
    struct fast *fast = fast_of(sim);

    mcs52_destroy(fast->chip);
    free(fast->sent);
    free(sim->edges);
    free(fast);
}

static enum mcs52_part part_of(const char *watchdog)
{
    return strcmp(watchdog, "at89s52") == 0 ? MCS52_AT89S52
           : strcmp(watchdog, "stc89") == 0 ? MCS52_STC89
                                            : MCS52_INTEL;
}

static bool flip(struct sim *sim, const struct sim_flip *flip)
{
    static const enum mcs52_place places[] = {[SIM_RAM] = MCS52_IN_RAM,
                                              [SIM_SFR] = MCS52_IN_SFR,
                                              [SIM_REGISTER] = MCS52_IN_REGISTER,
                                              [SIM_PC] = MCS52_IN_PC,
                                              [SIM_XDATA] = MCS52_IN_XDATA};
    static const enum mcs52_fault_kind kinds[] = {[SIM_FLIP] = MCS52_FLIP,
                                                  [SIM_STUCK_LOW] = MCS52_STUCK_LOW,
                                                  [SIM_STUCK_HIGH] = MCS52_STUCK_HIGH,
                                                  [SIM_PIN_LOW] = MCS52_PIN_LOW,
                                                  [SIM_PIN_HIGH] = MCS52_PIN_HIGH,
                                                  [SIM_PINS_TIED] = MCS52_PINS_TIED,
                                                  [SIM_POWER_DIP] = MCS52_POWER_DIP,
                                                  [SIM_CLOCK_STOP] = MCS52_CLOCK_STOP,
                                                  [SIM_INTERRUPTS] = MCS52_INTERRUPTS};
    const struct mcs52_fault fault = {.kind = kinds[flip->kind],
                                      .place = places[flip->place],
                                      .address = flip->address,
                                      .other = flip->other,
                                      .bit = flip->bit,
                                      .counts_instructions = flip->counts_instructions,
                                      .when = flip->when,
                                      .cycles = flip->cycles};

    return mcs52_inject(fast_of(sim)->chip, &fault);
}

/* Returns EXIT_FINE, or EXIT_USAGE after a message. */
static int inject(struct fast *fast, const struct sim_setup *setup)
{
    for (int i = 0; i < setup->flip_count; i++) {
        if (!flip(&fast->base, &setup->flips[i])) {
            diag_error(NULL, 0, "fast: flip %d names a bit that the chip does not have", i + 1);
            return EXIT_USAGE;
        }
    }
    return EXIT_FINE;
}

static int start(struct sim **sim, const struct sim_setup *setup)
{
    struct hexfile *hex = malloc(sizeof *hex);
    struct fast *fast = calloc(1, sizeof *fast);
    struct mcs52_outside outside = {
        .user = fast, .edge = note_edge, .byte = note_byte, .reset = note_reset};
    int status = hex != NULL && fast != NULL ? hexfile_read(hex, setup->hex) : EXIT_USAGE;

    if (status == EXIT_FINE) {
        fast->base.engine = &fast_engine;
        fast->base.clk_hz = setup->clk_hz;
        fast->chip = mcs52_create(part_of(setup->watchdog), &outside);
        mcs52_load(fast->chip, 0, hex->code, sizeof hex->code);
        memset(fast->watched, NO_PIN, sizeof fast->watched);
        for (int i = 0; i < setup->watch_count; i++) {
            fast->watched[port_of(setup->watch[i])][setup->watch[i] & 7] = i;
            mcs52_watch(fast->chip, port_of(setup->watch[i]), setup->watch[i] & 7);
        }
        for (int i = 0; i < setup->drive_count; i++) {
            fast->drive[i] = setup->drive[i];
            mcs52_set_pin(fast->chip, 0, port_of(setup->drive[i]), setup->drive[i] & 7,
                          setup->levels >> i & 1);
        }
        mcs52_cover(fast->chip, setup->cover);
        status = inject(fast, setup);
    }
    if (status == EXIT_FINE) {
        *sim = &fast->base;
    } else if (fast != NULL) {
        mcs52_destroy(fast->chip);
        free(fast);
    }
    free(hex);
    return status;
}

static void set_pin(struct sim *sim, int64_t time_ns, int drive, bool level)
{
    struct fast *fast = fast_of(sim);
    uint64_t cycle = cycle_of_ns(fast, sim_grid_ns(sim, time_ns)) + 1;

    if (!mcs52_set_pin(fast->chip, cycle, port_of(fast->drive[drive]), fast->drive[drive] & 7,
                       level)) {
        abort(); /* no world has that many events in a quantum */
    }
}

static enum sim_status run_to(struct sim *sim, int64_t time_ns)
{
    struct fast *fast = fast_of(sim);
    int64_t next_ns = sim_grid_ns(sim, time_ns);

    mcs52_run(fast->chip, cycle_of_ns(fast, next_ns));
    sim->now_ns = next_ns;
    return fast->was_reset ? SIM_RESET : SIM_RAN;
}

static enum sim_status run_after_reset(struct sim *sim, int64_t window_ns)
{
    struct fast *fast = fast_of(sim);

    mcs52_run(fast->chip, fast->reset_cycle + cycle_of_ns(fast, window_ns));
    sim->last_ns = window_ns;
    return SIM_RAN;
}

static size_t receive(struct sim *sim, char *bytes, size_t size)
{
    struct fast *fast = fast_of(sim);
    size_t count = fast->sent_count < size ? fast->sent_count : size;

    memcpy(bytes, fast->sent, count);
    memmove(fast->sent, fast->sent + count, fast->sent_count - count);
    fast->sent_count -= count;
    return count;
}

static void send(struct sim *sim, const char *bytes, size_t size)
{
    struct fast *fast = fast_of(sim);
    double bit_cycles = (double)sim->clk_hz / CLOCKS_PER_CYCLE / BAUD;
    uint64_t at = cycle_of_ns(fast, sim->now_ns) + 1;

    if (fast->line_free > at) {
        at = fast->line_free;
    }
    for (size_t i = 0; i < size; i++) {
        at = mcs52_feed(fast->chip, at, (uint8_t)bytes[i], bit_cycles);
        if (at == 0) {
            abort(); /* no world sends that much at a time */
        }
    }
    fast->line_free = at;
}

struct mcs52 *fast_chip(struct sim *sim)
{
    return fast_of(sim)->chip;
}

void fast_outlive_resets(struct sim *sim)
{
    fast_of(sim)->outlives_resets = true;
}

int fast_resets(const struct sim *sim)
{
    return ((const struct fast *)sim)->resets;
}

const struct sim_engine fast_engine = {.name = "fast",
                                       .can_flip = true,
                                       .can_cover = true,
                                       .check = check,
                                       .start = start,
                                       .set_pin = set_pin,
                                       .run_to = run_to,
                                       .run_after_reset = run_after_reset,
                                       .receive = receive,
                                       .send = send,
                                       .stop = stop,
                                       .flip = flip};
