/* SPDX-License-Identifier: MIT */
/* What every range sensor of the brake has in common: its settings, what may be wrong with it and
 * when, and what it reads. How a reading comes to the controller is each sensor's own: sonar.h,
 * tfluna.h. */
#ifndef FUZZY51_SENSOR_H
#define FUZZY51_SENSOR_H

#include "keys.h"
#include "random.h"

#include <stdbool.h>
#include <stdint.h>

enum { SENSOR_FAULTS = SECTION_COPIES };

/* The kinds of sensor; sensor_kind_name has their names. */
enum sensor_kind { SENSOR_HCSR04, SENSOR_TFLUNA };

/* Section [sensor]. Unset: what sensor_kind, sensor_noise_m, sensor_min_m and sensor_max_m say. */
struct sensor {
    int kind;            /* enum sensor_kind, or -1: unset */
    double noise_m;      /* standard deviation of one reading; may be unset */
    double dropout;      /* probability that a reading finds no target */
    double step_m;       /* readings are rounded to it; 0: not */
    double min_m, max_m; /* may be unset */
    /* of an HC-SR04 */
    double temp_c;     /* of the air; sets the speed of sound */
    double delay_us;   /* trigger's end to echo's rise */
    double no_echo_us; /* length of the pulse that says: no target */
    int no_target;     /* enum no_target */
    /* of a TF-Luna */
    double reflectivity_pct; /* of what is ahead */
    double rate_hz;          /* frames a second */
    double start_up_s;       /* from t = 0 to the first frame */
};

enum no_target {
    NO_TARGET_PULSE, /* HC-SR04 */
    NO_TARGET_SILENT,
    NO_TARGET_HIGH /* HC-SR04P: the echo line stays high until a target is there */
};

enum fault_kind {
    FAULT_OFF,          /* answers nothing; the line rests at `line` */
    FAULT_STUCK,        /* always dist_m, or the last distance read before the fault */
    FAULT_GARBAGE,      /* readings have nothing to do with the distance */
    FAULT_WRONG,        /* scale * distance + offset_m */
    FAULT_SLOW,         /* at most one answer every period_s */
    FAULT_DELAYED,      /* readings are delay_s old */
    FAULT_INTERMITTENT, /* works for on_s, is off for off_s, and so on */
    FAULT_GLITCH,       /* so many readings of dist_m: a passing object, a stray echo */
    FAULT_HIGH,         /* the echo line of an HC-SR04 stands high */
    /* of a TF-Luna */
    FAULT_BLIND, /* sunlight: strength 65535, and a distance at random */
    FAULT_RAIN,  /* strength times scale; a share of the readings is a drop nearer than dist_m */
    FAULT_SUM,   /* a share of the frames has a wrong check sum */
    FAULT_TORN   /* a share of the frames lacks a byte */
};

/* Section [fault], [fault2], ... */
struct fault {
    int kind;             /* enum fault_kind, or -1: no fault */
    double from_s, for_s; /* unset for_s: to the end */
    double dist_m, scale, offset_m, period_s, delay_s, on_s, off_s, readings, share;
    int line; /* 0: low, 1: high */
};

struct sensor_settings {
    struct sensor sensor;
    struct fault faults[SENSOR_FAULTS];
};

extern const struct section sensor_section, fault_section;

/* The kind: an unset one is an HC-SR04. */
enum sensor_kind sensor_kind(const struct sensor *sensor);
const char *sensor_kind_name(enum sensor_kind kind);

/* What [sensor] says, or what this kind has by its data sheet. Noise: 0 for an HC-SR04, negative
 * (by the strength) for a TF-Luna. */
double sensor_noise_m(const struct sensor *sensor);
double sensor_min_m(const struct sensor *sensor);
double sensor_max_m(const struct sensor *sensor);

/* Whether something at GAP_M is where the sensor can tell its distance. */
bool sensor_is_in_range(const struct sensor *sensor, double gap_m);

/* --- readings ----------------------------------------------------------------------------- */

enum sensor_answer {
    SENSOR_DEAF,   /* the trigger was too short, or came while an echo was on its way */
    SENSOR_TARGET, /* a reading of a distance, right or wrong */
    SENSOR_NONE,   /* "no target", and there is none within range */
    SENSOR_MISSING /* nothing, or "no target", although there is one */
};

struct reading {
    enum { READ_TARGET, READ_NONE, READ_SILENT } kind;
    double dist_m;
};

struct sensing;

/* What a healthy sensor makes of a target at GAP_M: whether it sees it, the distance that it shows
 * and the deviation of the noise on that. */
struct sight {
    bool is_seen;
    double dist_m, noise_m;
};
typedef struct sight sensing_look(const struct sensing *sensing, double gap_m);

struct sensing {
    struct sensor sensor;
    struct fault faults[SENSOR_FAULTS];
    sensing_look *look;
    double garbage_m;      /* a reading at random is of 0 up to this */
    double strength_scale; /* rain makes it less than 1 */
    struct random random;
    struct random rain;            /* apart, so that rain does not change the noise */
    double last_m;                 /* last reading of a distance; negative: none yet */
    double stuck_m[SENSOR_FAULTS]; /* negative: not decided yet; INFINITY: at "no target" */
    int64_t answered_ns;           /* last answer of a slow sensor */
    int glitches_left[SENSOR_FAULTS];
    struct {
        double t_s, gap_m;
    } *past; /* for the delayed sensor */
    int past_count, past_capacity;
};

void sensing_init(struct sensing *sensing, const struct sensor_settings *settings,
                  sensing_look *look, double garbage_m, uint64_t seed);
void sensing_free(struct sensing *sensing);

/* The true gap at T_NS, for a sensor whose readings are old; call it at a steady pace. */
void sensing_observe(struct sensing *sensing, int64_t t_ns, double gap_m);

/* The reading of a target at GAP_M at T_NS, with all faults that are not about the line. Call
 * sensing_note when the controller gets it. */
struct reading sensing_read(struct sensing *sensing, int64_t t_ns, double gap_m);
void sensing_note(struct sensing *sensing, const struct reading *reading);

/* Is the sensor silent, and at which level does its line rest then? */
bool sensing_is_silenced(const struct sensing *sensing, double t_s, bool *level);

/* Whether the fault of that INDEX (0 .. SENSOR_FAULTS - 1) is there, and it is its time. */
bool sensing_fault_acts(const struct sensing *sensing, int index, double t_s);

/* The next time after T_NS at which a fault begins or ends; INT64_MAX: none. */
int64_t sensing_boundary_ns(const struct sensing *sensing, int64_t t_ns);

#endif
