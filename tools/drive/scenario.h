/* A scenario: who drives where, what the sensor does, and what must come of it. Read from an INI
 * file in which every section, key and value is checked; tests/loop holds examples, README.md the
 * list of keys. */
#ifndef FUZZY51_SCENARIO_H
#define FUZZY51_SCENARIO_H

#include "expect.h"

#include <stdbool.h>
#include <stdint.h>

enum { SCENARIO_FAULTS = 4, SCENARIO_POINTS = 32, SCENARIO_TEXT = 128 };

/* A value that the file left out. */
#define SCENARIO_UNSET (-1.0)

struct ego {
    double speed_mps;      /* at t = 0 */
    double brake_max_mps2; /* what 100 % brake comes to */
    double brake_lag_s;    /* first order, after the dead time */
    double brake_dead_s;
    double rolling_mps2; /* resistance while it rolls */
    int driver;          /* enum driver */
    double driver_mps;   /* the speed that he holds; unset: speed_mps */
    double driver_mps2;  /* the most that he accelerates */
};

enum driver { DRIVER_HOLDS, DRIVER_COASTS };

struct point {
    double t_s, speed_mps;
};

struct lead {
    bool present;
    double gap_m;                                /* at t = 0, or when it appears */
    double speed_mps;                            /* at t = 0 */
    double change_s, change_mps2, change_to_mps; /* one change of speed */
    struct point profile[SCENARIO_POINTS]; /* or its speed over time, straight lines between */
    int points;
    double appears_s, leaves_s; /* cuts in, cuts out; unset: always there */
};

struct sensor {
    double noise_m; /* standard deviation of one reading */
    double dropout; /* probability that a reading finds no target */
    double step_m;  /* readings are rounded to it; 0: not */
    double temp_c;  /* of the air; sets the speed of sound */
    double min_m, max_m;
    double delay_us;   /* trigger's end to echo's rise */
    double no_echo_us; /* length of the pulse that says: no target */
    int no_target;     /* enum no_target */
};

enum no_target {
    NO_TARGET_PULSE, /* HC-SR04 */
    NO_TARGET_SILENT,
    NO_TARGET_HIGH /* HC-SR04P: the echo line stays high until a target is there */
};

enum fault_kind {
    FAULT_OFF,          /* answers nothing; the line rests at `line` */
    FAULT_STUCK,        /* always dist_m, or the last reading before the fault */
    FAULT_GARBAGE,      /* readings have nothing to do with the distance */
    FAULT_WRONG,        /* scale * distance + offset_m */
    FAULT_SLOW,         /* at most one answer every period_s */
    FAULT_DELAYED,      /* readings are delay_s old */
    FAULT_INTERMITTENT, /* works for on_s, is off for off_s, and so on */
    FAULT_GLITCH,       /* so many readings of dist_m: a passing object, a stray echo */
    FAULT_HIGH,         /* the echo line stands high */
    FAULT_KINDS
};

struct fault {
    int kind;             /* enum fault_kind, or -1: no fault */
    double from_s, for_s; /* unset for_s: to the end */
    double dist_m, scale, offset_m, period_s, delay_s, on_s, off_s, readings;
    int line; /* 0: low, 1: high */
};

struct scenario {
    char file[256];
    char title[SCENARIO_TEXT];
    double duration_s;
    double hold_s;  /* ends once both cars have stood that long; unset: runs to its end */
    double event_s; /* ..._within_s counts from here */
    double seed;
    struct ego ego;
    struct lead lead;
    struct sensor sensor;
    struct fault faults[SCENARIO_FAULTS];
    struct {
        double from_s, for_s; /* the driver holds the override; unset: never */
    } override;
    struct {
        double at_s; /* bytes sent to the controller; unset: none */
        char send[SCENARIO_TEXT];
    } uart;
    struct expectation expect[EXPECT_MAX];
    int expect_count;
};

/* Reads FILE; then applies SETTINGS, each "section.key=value", COUNT of them. Returns EXIT_FINE, or
 * EXIT_INPUT after one message for each fault found. */
int scenario_read(struct scenario *scenario, const char *file, char *const *settings, int count);

#endif
