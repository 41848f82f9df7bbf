/* The sensor: an ultrasonic module of the HC-SR04 class, and what may be wrong with it. A trigger
 * pulse of 10 us or more makes it send; after delay_us the echo line rises and stays high as long
 * as the sound is on its way. Triggers that come before the echo line has fallen are not heard. The
 * cone is not modelled: what is ahead on the lane is seen up to max_m. */
#ifndef FUZZY51_SONAR_H
#define FUZZY51_SONAR_H

#include "random.h"
#include "scenario.h"

#include <stdbool.h>
#include <stdint.h>

enum { SONAR_EVENTS = 8 };

enum sonar_answer {
    SONAR_DEAF,   /* the trigger was too short, or came while an echo was on its way */
    SONAR_TARGET, /* a reading of a distance, right or wrong */
    SONAR_NONE,   /* "no target", and there is none within range */
    SONAR_MISSING /* nothing, or "no target", although there is one */
};

struct sonar {
    struct sensor sensor;
    struct fault faults[SCENARIO_FAULTS];
    double sound_mps;
    struct random random;
    struct {
        int64_t at_ns;
        bool level;
    } events[SONAR_EVENTS]; /* of the echo line, still to come, in order of time */
    int event_count;
    bool level;      /* of the echo line, after the events that were taken */
    int64_t busy_ns; /* the echo in flight ends then */
    double last_m;   /* last reading of a distance; negative: none yet */
    double stuck_m[SCENARIO_FAULTS];
    int64_t answered_ns; /* last answer of a slow sensor */
    int glitches_left[SCENARIO_FAULTS];
    struct {
        double t_s, gap_m;
    } *past; /* for the delayed sensor */
    int past_count, past_capacity;
};

void sonar_init(struct sonar *sonar, const struct scenario *scenario, uint64_t seed);
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
