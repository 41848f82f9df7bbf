/* SPDX-License-Identifier: MIT */
/* A scenario: who drives where, what the sensor does, and what must come of it. Read from an INI
 * file in which every section, key and value is checked. tests/loop holds examples; `drive keys`
 * and docs/drive.md list all sections and keys. */
#ifndef FUZZY51_SCENARIO_H
#define FUZZY51_SCENARIO_H

#include "expect.h"
#include "keys.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    PROFILE_POINTS = 32,
    SCENARIO_SETTINGS = 1024,
    SCENARIO_FLIPS = SECTION_COPIES,
    LEADS_MAX = 8
};

struct world_class;

/* Section [ego]: the own car. */
struct ego {
    double speed_mps;      /* at t = 0 */
    double brake_max_mps2; /* deceleration at 100 % brake */
    double brake_lag_s;    /* first order, after the dead time */
    double brake_dead_s;
    double rolling_mps2; /* resistance while it rolls */
    int driver;          /* enum driver */
    double driver_mps;   /* the speed that the driver holds; unset: speed_mps */
    double driver_mps2;  /* the driver's strongest acceleration */
};

enum driver { DRIVER_HOLDS, DRIVER_COASTS };

/* A speed over time, with straight lines between its points. */
struct profile {
    struct {
        double t_s, speed_mps;
    } points[PROFILE_POINTS];
    int count; /* 0: there is none */
};

/* Section [lead], [lead2], ...: a car ahead. */
struct lead {
    bool present;
    double gap_m;     /* at t = 0, or when it appears */
    double speed_mps; /* at t = 0 */
    double lane;      /* 0: the ego's; 1: the next one to the left; -1: to the right */
    double change_s, change_mps2, change_to_mps; /* one change of speed; change_s unset: none */
    struct profile profile;                      /* or its speed over time */
    double appears_s, leaves_s;                  /* cuts in, cuts out; unset: always there */
    double missed; /* share of the readings in which it gives no echo */
};

/* Section [uart]. */
struct uart {
    double at_s; /* bytes sent to the controller; unset: none */
    char send[SCENARIO_TEXT];
};

/* Section [flip]: one bit of the chip that changes once, or sticks; a pin that is shorted; or what
 * befalls the whole chip. */
struct flip {
    int kind;        /* enum flip_kind */
    int place;       /* enum flip_place, of a bit */
    double address;  /* unset: a PC has none */
    double bit;      /* 0: the lowest */
    int pin, to;     /* enum flip_pin */
    double at_s;     /* since the first trigger; this or one of the next two is set, or no flip */
    double at_cycle; /* since power came up */
    double at_instruction; /* likewise */
    double for_s;          /* of pins and the whole chip; unset: for good */
};

enum flip_kind {
    FLIP_ONCE,
    FLIP_STUCK_LOW,
    FLIP_STUCK_HIGH,
    FLIP_PIN_LOW,
    FLIP_PIN_HIGH,
    FLIP_PINS_TIED,
    FLIP_POWER_DIP,
    FLIP_CLOCK_STOP,
    FLIP_INTERRUPTS
};
enum flip_place { FLIP_RAM, FLIP_SFR, FLIP_REGISTER, FLIP_PC, FLIP_XDATA };

/* The pins of the board in the order of enum board_pin, then those of the serial line. */
enum flip_pin { FLIP_RXD = 10, FLIP_TXD };

struct scenario {
    char file[256];
    char title[SCENARIO_TEXT];
    char app[SCENARIO_TEXT]; /* the image's name: a controller's, or that and _ and a variant */
    const struct world_class *world;
    double duration_s;
    double hold_s;  /* ends once both cars have stood that long; unset: runs to its end */
    double event_s; /* ..._within_s counts from here */
    double seed;
    int demo; /* 1: `make demo` shows this one */
    struct ego ego;
    union {
        struct lead leads[LEADS_MAX];
        struct {
            struct lead lead, lead2; /* the first two of them */
        };
    };
    struct uart uart;
    struct flip flips[SCENARIO_FLIPS];
    struct expectation expect[EXPECT_MAX];
    int expect_count;
    /* The settings struct of the world: its own sections' values. */
    _Alignas(max_align_t) unsigned char settings[SCENARIO_SETTINGS];
};

/* The sections that worlds share. */
extern const struct section scenario_section, ego_section, lead_section, uart_section, flip_section;

/* Each world lets bits of its chip flip. */
#define FLIP_SECTION {.section = &flip_section, AT_SCENARIO(flips), .copies = SCENARIO_FLIPS}

/* The keys of [lead] for a sensor that never misses an echo. */
#define LEAD_KEYS_OF_A_HEAD                                                                        \
    "gap_m speed_mps lane change_s change_mps2 change_to_mps profile appears_s leaves_s"

/* For a struct section_use: where the values go, in struct scenario or in a world's settings. */
#define AT_SCENARIO(member)       .at = offsetof(struct scenario, member)
#define AT_SETTINGS(type, member) .at = offsetof(struct scenario, settings) + offsetof(type, member)

/* An empty scenario of WORLD: every key has its initial value. */
void scenario_defaults(struct scenario *scenario, const struct world_class *world);

/* Reads FILE; then applies SETTINGS, each "section.key=value", COUNT of them. Returns EXIT_FINE, or
 * EXIT_INPUT after one message for each fault found. */
int scenario_read(struct scenario *scenario, const char *file, char *const *settings, int count);

/* The same without a file: a scenario of SETTINGS alone. */
int scenario_from(struct scenario *scenario, char *const *settings, int count);

/* Which metrics a run of SCENARIO measures: the others are NAN in OUTCOME, which is otherwise of no
 * use. */
void scenario_measures(const struct scenario *scenario, struct outcome *outcome);

#endif
