/* SPDX-License-Identifier: MIT */
/* The sensor: an ultrasonic module of the HC-SR04 class, and what may be wrong with it. A trigger
 * pulse of 10 us or more makes it send; after delay_us the echo line rises and stays high as long
 * as the sound is on its way. Triggers that come before the echo line has fallen are not heard. The
 * cone is not modelled: the caller says what is nearest in it, and that is seen up to max_m. */
#ifndef FUZZY51_SONAR_H
#define FUZZY51_SONAR_H

#include "keys.h"
#include "random.h"

#include <stdbool.h>
#include <stdint.h>

enum { SONAR_EVENTS = 8, SONAR_FAULTS = SECTION_COPIES };

/* Section [sensor]. */
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
    FAULT_STUCK,        /* always dist_m, or the last distance read before the fault */
    FAULT_GARBAGE,      /* readings have nothing to do with the distance */
    FAULT_WRONG,        /* scale * distance + offset_m */
    FAULT_SLOW,         /* at most one answer every period_s */
    FAULT_DELAYED,      /* readings are delay_s old */
    FAULT_INTERMITTENT, /* works for on_s, is off for off_s, and so on */
    FAULT_GLITCH,       /* so many readings of dist_m: a passing object, a stray echo */
    FAULT_HIGH          /* the echo line stands high */
};

/* Section [fault], [fault2], ... */
struct fault {
    int kind;             /* enum fault_kind, or -1: no fault */
    double from_s, for_s; /* unset for_s: to the end */
    double dist_m, scale, offset_m, period_s, delay_s, on_s, off_s, readings;
    int line; /* 0: low, 1: high */
};

struct sonar_settings {
    struct sensor sensor;
    struct fault faults[SONAR_FAULTS];
};

extern const struct section sensor_section, fault_section;

enum sonar_answer {
    SONAR_DEAF,   /* the trigger was too short, or came while an echo was on its way */
    SONAR_TARGET, /* a reading of a distance, right or wrong */
    SONAR_NONE,   /* "no target", and there is none within range */
    SONAR_MISSING /* nothing, or "no target", although there is one */
};

struct sonar {
    struct sensor sensor;
    struct fault faults[SONAR_FAULTS];
    double sound_mps;
    struct random random;
    struct {
        int64_t at_ns;
        bool level;
    } events[SONAR_EVENTS]; /* of the echo line, still to come, in order of time */
    int event_count;
    bool level;                   /* of the echo line, after the events that were taken */
    int64_t busy_ns;              /* the echo in flight ends then */
    double last_m;                /* last reading of a distance; negative: none yet */
    double stuck_m[SONAR_FAULTS]; /* negative: not decided yet; INFINITY: at "no target" */
    int64_t answered_ns;          /* last answer of a slow sensor */
    int glitches_left[SONAR_FAULTS];
    struct {
        double t_s, gap_m;
    } *past; /* for the delayed sensor */
    int past_count, past_capacity;
};

void sonar_init(struct sonar *sonar, const struct sonar_settings *settings, uint64_t seed);
void sonar_free(struct sonar *sonar);

/* Speed of sound in air of TEMP_C: 343.2 m/s at 20 C, with the root of the absolute temperature. */
double sonar_sound_mps(double temp_c);

/* The true gap at T_NS, for a sensor whose readings are old; call it at a steady pace. */
void sonar_observe(struct sonar *sonar, int64_t t_ns, double gap_m);

/* A trigger pulse of WIDTH_NS ends at T_NS. Sound that leaves at a gap closing with CLOSING_MPS
 * comes back after 2 gap / (c + closing), the gap at which it meets the target. */
enum sonar_answer sonar_trigger(struct sonar *sonar, int64_t t_ns, int64_t width_ns, double gap_m,
                                double closing_mps);

/* The next time after T_NS at which a fault begins or ends; INT64_MAX: none. */
int64_t sonar_boundary_ns(const struct sonar *sonar, int64_t t_ns);

/* The line at a boundary: a fault that holds it takes effect, or ends. */
void sonar_pass_boundary(struct sonar *sonar, int64_t t_ns);

/* Takes the next change of the echo line that is due until UNTIL_NS. */
bool sonar_next_event(struct sonar *sonar, int64_t until_ns, int64_t *t_ns, bool *level);

/* Nothing that the controller does after T_NS moves the echo line before this time. */
int64_t sonar_horizon_ns(const struct sonar *sonar, int64_t t_ns);

#endif
