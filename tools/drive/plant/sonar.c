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

void sonar_init(struct sonar *sonar, const struct sonar_settings *settings, uint64_t seed)
{
    memset(sonar, 0, sizeof *sonar);
    sonar->sensor = settings->sensor;
    memcpy(sonar->faults, settings->faults, sizeof sonar->faults);
    sonar->sound_mps = sonar_sound_mps(sonar->sensor.temp_c);
    random_seed(&sonar->random, seed);
    sonar->last_m = -1;
    sonar->answered_ns = INT64_MIN;
    for (int i = 0; i < SONAR_FAULTS; i++) {
        sonar->stuck_m[i] = sonar->faults[i].dist_m;
        sonar->glitches_left[i] = (int)sonar->faults[i].readings;
    }
}

void sonar_free(struct sonar *sonar)
{
    free(sonar->past);
    sonar->past = NULL;
    sonar->past_count = sonar->past_capacity = 0;
}

/* --- the past ----------------------------------------------------------------------------- */

void sonar_observe(struct sonar *sonar, int64_t t_ns, double gap_m)
{
    if (sonar->past_count == sonar->past_capacity) {
        sonar->past_capacity = sonar->past_capacity * 2 + 256;
        sonar->past = realloc(sonar->past, (size_t)sonar->past_capacity * sizeof sonar->past[0]);
        if (sonar->past == NULL) {
            abort();
        }
    }
    sonar->past[sonar->past_count].t_s = (double)t_ns * 1e-9;
    sonar->past[sonar->past_count++].gap_m = gap_m;
}

static double past_gap_m(const struct sonar *sonar, double t_s)
{
    int i = sonar->past_count - 1;
    double span_s, part;

    while (i > 0 && sonar->past[i].t_s > t_s) {
        i--;
    }
    if (i < 0) {
        return INFINITY;
    }
    if (i + 1 >= sonar->past_count || isinf(sonar->past[i].gap_m) ||
        isinf(sonar->past[i + 1].gap_m)) {
        return sonar->past[i].gap_m;
    }
    span_s = sonar->past[i + 1].t_s - sonar->past[i].t_s;
    part = fmax(t_s - sonar->past[i].t_s, 0) / span_s;
    return sonar->past[i].gap_m + part * (sonar->past[i + 1].gap_m - sonar->past[i].gap_m);
}

/* --- faults in time ------------------------------------------------------------------------ */

static double end_s(const struct fault *fault)
{
    return fault->for_s < 0 || fault->kind == FAULT_GLITCH ? INFINITY
                                                           : fault->from_s + fault->for_s;
}

static bool is_active(const struct fault *fault, double t_s)
{
    return fault->kind >= 0 && t_s >= fault->from_s && t_s < end_s(fault);
}

/* Does the fault keep the sensor silent now? An intermittent one begins with its off time. */
static bool is_off(const struct fault *fault, double t_s)
{
    if (!is_active(fault, t_s)) {
        return false;
    }
    if (fault->kind == FAULT_INTERMITTENT) {
        return fmod(t_s - fault->from_s, fault->off_s + fault->on_s) < fault->off_s;
    }
    return fault->kind == FAULT_OFF || fault->kind == FAULT_HIGH;
}

/* Is the sensor silent, and at which level does its line rest then? */
static bool is_silenced(const struct sonar *sonar, double t_s, bool *level)
{
    bool silenced = false;

    *level = false;
    for (int i = 0; i < SONAR_FAULTS; i++) {
        if (is_off(&sonar->faults[i], t_s)) {
            silenced = true;
            *level |= sonar->faults[i].kind == FAULT_HIGH || sonar->faults[i].line == 1;
        }
    }
    return silenced;
}

int64_t sonar_boundary_ns(const struct sonar *sonar, int64_t t_ns)
{
    int64_t first = INT64_MAX;

    for (int i = 0; i < SONAR_FAULTS; i++) {
        const struct fault *fault = &sonar->faults[i];
        double t_s = (double)t_ns * 1e-9, cycle_s = fault->on_s + fault->off_s;
        double marks_s[4] = {fault->from_s, end_s(fault), INFINITY, INFINITY};

        if (fault->kind < 0) {
            continue;
        }
        if (fault->kind == FAULT_INTERMITTENT && t_s + cycle_s >= fault->from_s) {
            double cycles = floor(fmax(t_s - fault->from_s, 0) / cycle_s);

            marks_s[2] = fault->from_s + cycles * cycle_s + fault->off_s;
            marks_s[3] = fault->from_s + (cycles + 1) * cycle_s;
        }
        for (int k = 0; k < 4; k++) {
            int64_t mark = isinf(marks_s[k]) ? INT64_MAX : (int64_t)llround(marks_s[k] * 1e9);

            if (mark > t_ns && mark < first) {
                first = mark;
            }
        }
    }
    return first;
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

    if (is_silenced(sonar, t_s, &level)) {
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

    return heard + (int64_t)(sonar->sensor.delay_us * 1000);
}

/* --- one measurement ---------------------------------------------------------------------- */

struct reading {
    enum { READ_TARGET, READ_NONE, READ_SILENT } kind;
    double dist_m;
};

/* The healthy sensor's reading. Always takes the same count of random numbers, so that a fault or a
 * target out of range does not change what noise the later readings get. */
static struct reading measure(struct sonar *sonar, double gap_m)
{
    const struct sensor *sensor = &sonar->sensor;
    bool dropped = random_uniform(&sonar->random) < sensor->dropout;
    double noise_m = random_normal(&sonar->random) * sensor->noise_m;
    struct reading reading = {READ_TARGET, fmax(gap_m + noise_m, 0)};

    if (dropped || !(gap_m >= sensor->min_m && gap_m <= sensor->max_m)) {
        reading.kind = READ_NONE;
    }
    if (sensor->step_m > 0) {
        reading.dist_m = round(reading.dist_m / sensor->step_m) * sensor->step_m;
    }
    return reading;
}

static struct reading spoil(struct sonar *sonar, int index, struct reading reading, int64_t t_ns,
                            double garbage)
{
    const struct fault *fault = &sonar->faults[index];

    switch (fault->kind) {
    case FAULT_STUCK: /* at "no target", if the sensor has never seen one */
        if (sonar->stuck_m[index] < 0 && sonar->last_m >= 0) {
            sonar->stuck_m[index] = sonar->last_m;
        } else if (sonar->stuck_m[index] < 0) {
            sonar->stuck_m[index] = reading.kind == READ_TARGET ? reading.dist_m : INFINITY;
        }
        return isinf(sonar->stuck_m[index]) ? (struct reading){READ_NONE, INFINITY}
                                            : (struct reading){READ_TARGET, sonar->stuck_m[index]};
    case FAULT_GARBAGE: /* any echo time up to the no-target pulse */
        return (struct reading){READ_TARGET,
                                garbage * sonar->sensor.no_echo_us * 1e-6 * sonar->sound_mps / 2};
    case FAULT_WRONG:
        reading.dist_m = fmax(reading.dist_m * fault->scale + fault->offset_m, sonar->sensor.min_m);
        return reading;
    case FAULT_SLOW:
        if (sonar->answered_ns != INT64_MIN &&
            (double)(t_ns - sonar->answered_ns) * 1e-9 < fault->period_s) {
            reading.kind = READ_SILENT;
        } else {
            sonar->answered_ns = t_ns;
        }
        return reading;
    case FAULT_GLITCH:
        if (sonar->glitches_left[index] == 0) {
            return reading;
        }
        sonar->glitches_left[index]--;
        return (struct reading){READ_TARGET, fault->dist_m};
    default:
        return reading;
    }
}

/* Age of what a delayed sensor shows, s. */
static double delay_s(const struct sonar *sonar, double t_s)
{
    double delay = 0;

    for (int i = 0; i < SONAR_FAULTS; i++) {
        if (sonar->faults[i].kind == FAULT_DELAYED && is_active(&sonar->faults[i], t_s)) {
            delay += sonar->faults[i].delay_s;
        }
    }
    return delay;
}

/* Puts the answer on the line. */
static void answer(struct sonar *sonar, int64_t t_ns, const struct reading *reading)
{
    int64_t rise_ns = t_ns + (int64_t)(sonar->sensor.delay_us * 1000);
    double length_s = 2 * reading->dist_m / sonar->sound_mps;

    if (sonar->level) { /* a line that was left high falls before the next measurement */
        push_event(sonar, rise_ns, false);
        rise_ns += 50000;
    }
    if (reading->kind == READ_SILENT ||
        (reading->kind == READ_NONE && sonar->sensor.no_target == NO_TARGET_SILENT)) {
        sonar->busy_ns = t_ns;
        return;
    }
    push_event(sonar, rise_ns, true);
    if (reading->kind == READ_NONE) {
        length_s = sonar->sensor.no_echo_us * 1e-6;
        if (sonar->sensor.no_target == NO_TARGET_HIGH) {
            sonar->busy_ns = rise_ns;
            return; /* until the next trigger that meets a target */
        }
    }
    sonar->busy_ns = rise_ns + (int64_t)llround(length_s * 1e9);
    push_event(sonar, sonar->busy_ns, false);
}

enum sonar_answer sonar_trigger(struct sonar *sonar, int64_t t_ns, int64_t width_ns, double gap_m,
                                double closing_mps)
{
    double t_s = (double)t_ns * 1e-9, garbage, delay;
    bool in_range = gap_m >= sonar->sensor.min_m && gap_m <= sonar->sensor.max_m, level;
    struct reading reading;

    if (width_ns < trigger_min_ns || t_ns < sonar->busy_ns) {
        return SONAR_DEAF;
    }
    garbage = random_uniform(&sonar->random);
    delay = delay_s(sonar, t_s);
    if (delay > 0) {
        reading = measure(sonar, past_gap_m(sonar, t_s - delay));
    } else {
        reading = measure(sonar, gap_m * sonar->sound_mps / (sonar->sound_mps + closing_mps));
    }
    for (int i = 0; i < SONAR_FAULTS; i++) {
        if (is_active(&sonar->faults[i], t_s)) {
            reading = spoil(sonar, i, reading, t_ns, garbage);
        }
    }
    if (is_silenced(sonar, t_s, &level)) {
        return in_range ? SONAR_MISSING : SONAR_NONE;
    }
    if (sonar->level && reading.kind == READ_NONE) {
        return SONAR_NONE; /* the line is still high from the last time */
    }
    answer(sonar, t_ns, &reading);
    if (reading.kind == READ_TARGET) {
        sonar->last_m = reading.dist_m;
        return SONAR_TARGET;
    }
    return in_range ? SONAR_MISSING : SONAR_NONE;
}
