/* SPDX-License-Identifier: MIT */
/* An ultrasonic module of the HC-SR04 class. A trigger pulse of 10 us or more makes it send; after
 * delay_us the echo line rises and stays high as long as the sound is on its way. Triggers that
 * come before the echo line has fallen are not heard. The cone is not modelled: the caller says
 * what is nearest in it, and that is seen up to max_m. */
#ifndef FUZZY51_SONAR_H
#define FUZZY51_SONAR_H

#include "sensor.h"

enum { SONAR_EVENTS = 8 };

struct sonar {
    struct sensing sensing;
    double sound_mps;
    struct {
        int64_t at_ns;
        bool level;
    } events[SONAR_EVENTS]; /* of the echo line, still to come, in order of time */
    int event_count;
    bool level;      /* of the echo line, after the events that were taken */
    int64_t busy_ns; /* the echo in flight ends then */
};

void sonar_init(struct sonar *sonar, const struct sensor_settings *settings, uint64_t seed);

/* Speed of sound in air of TEMP_C: 343.2 m/s at 20 C, with the root of the absolute temperature. */
double sonar_sound_mps(double temp_c);

/* A trigger pulse of WIDTH_NS ends at T_NS. Sound that leaves at a gap closing with CLOSING_MPS
 * comes back after 2 gap / (c + closing), the gap at which it meets the target. */
enum sensor_answer sonar_trigger(struct sonar *sonar, int64_t t_ns, int64_t width_ns, double gap_m,
                                 double closing_mps);

/* The line at a boundary of the faults: one that holds it takes effect, or ends. */
void sonar_pass_boundary(struct sonar *sonar, int64_t t_ns);

/* Takes the next change of the echo line that is due until UNTIL_NS. */
bool sonar_next_event(struct sonar *sonar, int64_t until_ns, int64_t *t_ns, bool *level);

/* Nothing that the controller does after T_NS moves the echo line before this time. */
int64_t sonar_horizon_ns(const struct sonar *sonar, int64_t t_ns);

#endif
