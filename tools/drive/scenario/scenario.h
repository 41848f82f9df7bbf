/* A scenario: who drives where, what the sensor does, and what must come of it. Read from an INI
 * file in which every section, key and value is checked; tests/loop holds examples, the table in
 * scenario.c all keys with their ranges, expect.h all outcomes. */
#ifndef FUZZY51_SCENARIO_H
#define FUZZY51_SCENARIO_H

#include "expect.h"

#include <stdbool.h>
#include <stdint.h>

/* What the controller is for; each has a world of its own. */
enum world_kind { WORLD_BRAKE, WORLD_RADAR, WORLD_GAP, WORLD_FOLLOW, WORLD_PARK, WORLD_KINDS };

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
    double gap_m;     /* at t = 0, or when it appears */
    double speed_mps; /* at t = 0 */
    double lane;      /* 0: the ego's; 1: the next one to the left; -1: to the right */
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

/* The road as a radar sees it. */
struct road {
    double radius_m; /* of the ego lane's centre, positive in a bend to the left; 0: straight */
    double lane_m;   /* width of a lane */
};

/* The radar's front end. */
struct front {
    double range_noise_m, closing_noise_mps, azimuth_noise_deg; /* standard deviations */
    double dropout; /* probability that a target is not seen */
    double max_m;   /* range */
    double fov_deg; /* it sees so far to each side */
    int beats;      /* enum beats */
};

enum beats {
    BEATS_SIGNED,  /* with I and Q: a beat may be negative */
    BEATS_UNSIGNED /* a mixer alone shows its size */
};

/* A car that parks backwards: the rear axle's midpoint, the axis against +x, the place at the
 * origin along +y. */
struct parking {
    double x_m, y_m, heading_deg;
    double speed_mps; /* backwards */
    double length_m;  /* from axle to axle */
    double steer_deg; /* for a pulse of 2 ms */
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

/* What may be wrong with the frames of a sensor head. */
enum frame_fault_kind {
    FRAME_SILENCE,  /* no answer */
    FRAME_CORRUPT,  /* one to three bits are wrong */
    FRAME_TRUNCATE, /* the end is missing */
    FRAME_INSERT,   /* a byte too much */
    FRAME_RESYNC,   /* the beginning is missing */
    FRAME_REPEAT,   /* the last good frame again */
    FRAME_RANGE,    /* a value that cannot be, with a right check sum */
    FRAME_NOISE,    /* as many bytes, each of them random */
};

struct frame_fault {
    int kind;             /* enum frame_fault_kind, or -1: no fault */
    double from_s, for_s; /* unset for_s: to the end */
    double share;         /* of the frames, at random */
    double every, first;  /* or the first-th frame of that time and each every-th after it; unset
                             every: by share */
};

struct scenario {
    char file[256];
    char title[SCENARIO_TEXT];
    char app[SCENARIO_TEXT]; /* the image's name: a controller's, or that and _ and a variant */
    int world;               /* enum world_kind */
    double duration_s;
    double hold_s;  /* ends once both cars have stood that long; unset: runs to its end */
    double event_s; /* ..._within_s counts from here */
    double seed;
    struct ego ego;
    struct lead lead;
    struct sensor sensor;
    struct road road;
    struct front front;
    struct parking park;
    struct fault faults[SCENARIO_FAULTS];
    struct {
        double lead_mps; /* of the robot in the other lane; unset: that lane is taken */
    } lane;
    struct {
        double warm_up;  /* frames answered before t = 0, so that the link is up by then */
        double delay_ms; /* from a trigger to the answer */
    } head;
    struct frame_fault frames[SCENARIO_FAULTS];
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
