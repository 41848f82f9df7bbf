/* SPDX-License-Identifier: MIT */
#include "sonar.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const int64_t trigger_min_ns = 10000;

double sonar_sound_mps(double temp_c)
{
    return 343.2 * sqrt((temp_c + 273.15) / 293.15);
}

static struct sight look(const struct sensing *sensing, double gap_m)
{
    return (struct sight){.is_seen = sensor_is_in_range(&sensing->sensor, gap_m),
                          .dist_m = gap_m,
                          .noise_m = sensor_noise_m(&sensing->sensor)};
}

void sonar_init(struct sonar *sonar, const struct sensor_settings *settings, uint64_t seed)
{
    memset(sonar, 0, sizeof *sonar);
    sonar->sound_mps = sonar_sound_mps(settings->sensor.temp_c);
    /* A reading at random: any echo time up to the no-target pulse. */
    sensing_init(&sonar->sensing, settings, look,
                 settings->sensor.no_echo_us * 1e-6 * sonar->sound_mps / 2, seed);
}

/* --- the echo line ------------------------------------------------------------------------ */

static void push_event(struct sonar *sonar, int64_t t_ns, bool level)
{
    if (sonar->event_count == SONAR_EVENTS) {
        abort(); /* a trigger and a boundary push at most four */
    }
    sonar->events[sonar->event_count].at_ns = t_ns;
    sonar->events[sonar->event_count++].level = level;
}

static void cancel_events(struct sonar *sonar)
{
    sonar->event_count = 0;
}

static void force_line(struct sonar *sonar, int64_t t_ns, bool level)
{
    cancel_events(sonar);
    if (sonar->level != level) {
        push_event(sonar, t_ns, level);
    }
}

void sonar_pass_boundary(struct sonar *sonar, int64_t t_ns)
{
    /* A hair later, so that rounding cannot put the mark on the wrong side. */
    double t_s = (double)t_ns * 1e-9 + 1e-9;
    bool level;

    if (sensing_is_silenced(&sonar->sensing, t_s, &level)) {
        force_line(sonar, t_ns, level);
        sonar->busy_ns = t_ns;
    } else if (sonar->event_count == 0) {
        force_line(sonar, t_ns, false);
    }
}

bool sonar_next_event(struct sonar *sonar, int64_t until_ns, int64_t *t_ns, bool *level)
{
    if (sonar->event_count == 0 || sonar->events[0].at_ns > until_ns) {
        return false;
    }
    *t_ns = sonar->events[0].at_ns;
    *level = sonar->level = sonar->events[0].level;
    sonar->event_count--;
    memmove(&sonar->events[0], &sonar->events[1],
            (size_t)sonar->event_count * sizeof sonar->events[0]);
    return true;
}

int64_t sonar_horizon_ns(const struct sonar *sonar, int64_t t_ns)
{
    int64_t heard = sonar->busy_ns > t_ns ? sonar->busy_ns : t_ns;

    return heard + (int64_t)(sonar->sensing.sensor.delay_us * 1000);
}

/* --- one measurement ---------------------------------------------------------------------- */

/* Puts the answer on the line. */
static void answer(struct sonar *sonar, int64_t t_ns, const struct reading *reading)
{
    int64_t rise_ns = t_ns + (int64_t)(sonar->sensing.sensor.delay_us * 1000);
    double length_s = 2 * reading->dist_m / sonar->sound_mps;

    if (sonar->level) { /* a line that was left high falls before the next measurement */
        push_event(sonar, rise_ns, false);
        rise_ns += 50000;
    }
    if (reading->kind == READ_SILENT ||
        (reading->kind == READ_NONE && sonar->sensing.sensor.no_target == NO_TARGET_SILENT)) {
        sonar->busy_ns = t_ns;
        return;
    }
    push_event(sonar, rise_ns, true);
    if (reading->kind == READ_NONE) {
        length_s = sonar->sensing.sensor.no_echo_us * 1e-6;
        if (sonar->sensing.sensor.no_target == NO_TARGET_HIGH) {
            sonar->busy_ns = rise_ns;
            return; /* until the next trigger that meets a target */
        }
    }
    sonar->busy_ns = rise_ns + (int64_t)llround(length_s * 1e9);
    push_event(sonar, sonar->busy_ns, false);
}

enum sensor_answer sonar_trigger(struct sonar *sonar, int64_t t_ns, int64_t width_ns, double gap_m,
                                 double closing_mps)
{
    bool in_range = sensor_is_in_range(&sonar->sensing.sensor, gap_m), level;
    struct reading reading;

    if (width_ns < trigger_min_ns || t_ns < sonar->busy_ns) {
        return SENSOR_DEAF;
    }
    reading = sensing_read(&sonar->sensing, t_ns,
                           gap_m * sonar->sound_mps / (sonar->sound_mps + closing_mps));
    if (sensing_is_silenced(&sonar->sensing, (double)t_ns * 1e-9, &level)) {
        return in_range ? SENSOR_MISSING : SENSOR_NONE;
    }
    if (sonar->level && reading.kind == READ_NONE) {
        return SENSOR_NONE; /* the line is still high from the last time */
    }
    answer(sonar, t_ns, &reading);
    sensing_note(&sonar->sensing, &reading);
    if (reading.kind == READ_TARGET) {
        return SENSOR_TARGET;
    }
    return in_range ? SENSOR_MISSING : SENSOR_NONE;
}
