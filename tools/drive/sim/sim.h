/* SPDX-License-Identifier: MIT */
/* The seam between drive and what runs the controller's image: a simulator, or later a board.
 *
 * Times are nanoseconds since the chip's reset. The engine runs ahead of the world: sim_run_to
 * brings it to a time, and all that the chip did on the way is then there to be read. Nobody may
 * rely on the engine standing still in between: sim->now_ns is where it is, which may be later than
 * what was asked for, and a pin that is set for a time in the past changes at once. */
#ifndef FUZZY51_SIM_H
#define FUZZY51_SIM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SIM_MAX_PINS = 12, SIM_COVER_BYTES = 0x10000 / 8 };

struct sim_setup {
    const char *hex;      /* the image */
    const char *s51_type; /* the chip, as s51 calls it */
    const char *watchdog; /* the chip's: "none", "at89s52" or "stc89" */
    long clk_hz;
    const uint8_t *watch; /* bit addresses of the pins that are reported */
    int watch_count;
    const uint8_t *drive; /* bit addresses of the pins that are driven */
    int drive_count;
    uint32_t levels;              /* bit k: level of drive[k] from the start */
    bool uart_in;                 /* sim_send will be used */
    const struct sim_flip *flips; /* of an engine that can flip bits */
    int flip_count;
    uint8_t *cover; /* of an engine that can cover: SIM_COVER_BYTES; bit A%8 of cover[A/8] is set
                     * when the instruction at address A is run; NULL: not wanted */
};

enum sim_flip_place { SIM_RAM, SIM_SFR, SIM_REGISTER, SIM_PC, SIM_XDATA };
enum sim_flip_kind {
    SIM_FLIP,
    SIM_STUCK_LOW,
    SIM_STUCK_HIGH,
    SIM_PIN_LOW,
    SIM_PIN_HIGH,
    SIM_PINS_TIED,
    SIM_POWER_DIP,
    SIM_CLOCK_STOP,
    SIM_INTERRUPTS
};

/* A bit of the chip that changes once, or sticks; a pin that is shorted; or the whole chip: as
 * mcs52.h says. */
struct sim_flip {
    enum sim_flip_kind kind;
    enum sim_flip_place place; /* of a bit */
    uint16_t address;          /* 0..7 for R0..R7 of the bank in use; of a pin, its bit address */
    uint8_t other;             /* the pin that this one is tied to */
    int bit;
    bool counts_instructions;
    uint64_t when;   /* before the first instruction at or after this machine cycle since power came
                    * up, or before the instruction of this number */
    uint64_t cycles; /* how long, of pins and the whole chip; 0: for good */
};

struct sim_edge {
    int64_t time_ns;
    int pin; /* index into watch */
    bool level;
    bool after_reset; /* the time counts from the watchdog's reset */
};

enum sim_status {
    SIM_RAN,
    SIM_RESET, /* a watchdog reset */
    SIM_FAILED /* the engine does not go on; a message has been printed */
};

/* What each engine has first in its own structure. */
struct sim {
    const struct sim_engine *engine;
    long clk_hz;
    int64_t now_ns;         /* the chip stands here */
    int64_t last_ns;        /* of the last change that was read; after a reset, from there */
    struct sim_edge *edges; /* since the last call of sim_run_to, in order of time */
    size_t edge_count, edge_capacity;
};

struct sim_engine {
    const char *name;
    bool can_flip;  /* bits of the chip: sim_setup.flips */
    bool can_cover; /* sim_setup.cover */
    int (*check)(void);
    int (*start)(struct sim **sim, const struct sim_setup *setup);
    void (*set_pin)(struct sim *sim, int64_t time_ns, int drive, bool level);
    enum sim_status (*run_to)(struct sim *sim, int64_t time_ns);
    enum sim_status (*run_after_reset)(struct sim *sim, int64_t window_ns);
    size_t (*receive)(struct sim *sim, char *bytes, size_t size);
    void (*send)(struct sim *sim, const char *bytes, size_t size);
    void (*stop)(struct sim *sim);
    bool (*flip)(struct sim *sim, const struct sim_flip *flip); /* if it can_flip */
};

/* The engine of that name, or NULL; the known names, separated by blanks, in a static buffer. */
const struct sim_engine *sim_engine(const char *name);
const char *sim_engine_names(void);

/* Whether the engine can be trusted with time, where that is not sure. Returns EXIT_FINE, or
 * EXIT_USAGE after a message. */
int sim_check(const struct sim_engine *engine);

/* Starts the image, with the driven pins at their levels. Returns EXIT_FINE, or EXIT_USAGE after a
 * message, with nothing left behind. */
int sim_start(const struct sim_engine *engine, struct sim **sim, const struct sim_setup *setup);

/* First sync time at or after TIME_NS: half way between two machine cycles, where rounding cannot
 * move an event across one. */
int64_t sim_grid_ns(const struct sim *sim, int64_t time_ns);

/* A signal handler may set it: the run then ends with SIM_FAILED and a message. */
extern volatile bool sim_is_interrupted;

/* Sets pin DRIVE (index into setup.drive) at TIME_NS, rounded to the grid. Calls come in order of
 * time. */
void sim_set_pin(struct sim *sim, int64_t time_ns, int drive, bool level);

/* Lets the chip run to the grid point at or after TIME_NS and collects the edges on the way. */
enum sim_status sim_run_to(struct sim *sim, int64_t time_ns);

/* After SIM_RESET: collects edges until WINDOW_NS after the reset, or as far as the engine can.
 * Input is not possible any more. */
enum sim_status sim_run_after_reset(struct sim *sim, int64_t window_ns);

/* Of an engine that can flip: FLIP, while the chip runs. Returns false when the chip has no such
 * bit or pin, or too many flips. */
bool sim_flip(struct sim *sim, const struct sim_flip *flip);

/* The machine cycle in which TIME_NS lies, since power came up. */
uint64_t sim_cycle(const struct sim *sim, int64_t time_ns);

/* Reads serial bytes that came out since the last call. Returns their number. */
size_t sim_receive(struct sim *sim, char *bytes, size_t size);

/* Queues serial bytes for the chip; they arrive at line rate from the next sim_run_to on. Bytes
 * must not be queued while earlier ones are still on their way. */
void sim_send(struct sim *sim, const char *bytes, size_t size);

/* Ends the engine and removes what it needed; NULL is harmless. */
void sim_stop(struct sim *sim);

/* For engines: notes an edge. */
void sim_add_edge(struct sim *sim, const struct sim_edge *edge);

/* For engines that wait: prints that the run was interrupted, and returns SIM_FAILED. */
enum sim_status sim_interrupted(const struct sim *sim);

#endif
