/* SPDX-License-Identifier: MIT */
#include "sensor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- by the data sheets -------------------------------------------------------------------- */

static const struct {
    const char *name;
    double noise_m, min_m, max_m;
} kinds[] = {
    [SENSOR_HCSR04] = {"hcsr04", 0, 0.02, 5}, [SENSOR_TFLUNA] = {"tfluna", SCENARIO_UNSET, 0.2, 8}};

enum sensor_kind sensor_kind(const struct sensor *sensor)
{
    return sensor->kind < 0 ? SENSOR_HCSR04 : (enum sensor_kind)sensor->kind;
}

const char *sensor_kind_name(enum sensor_kind kind)
{
    return kinds[kind].name;
}

double sensor_noise_m(const struct sensor *sensor)
{
    return sensor->noise_m < 0 ? kinds[sensor_kind(sensor)].noise_m : sensor->noise_m;
}

double sensor_min_m(const struct sensor *sensor)
{
    return sensor->min_m < 0 ? kinds[sensor_kind(sensor)].min_m : sensor->min_m;
}

double sensor_max_m(const struct sensor *sensor)
{
    return sensor->max_m < 0 ? kinds[sensor_kind(sensor)].max_m : sensor->max_m;
}

bool sensor_is_in_range(const struct sensor *sensor, double gap_m)
{
    return gap_m >= sensor_min_m(sensor) && gap_m <= sensor_max_m(sensor);
}

/* --- life --------------------------------------------------------------------------------- */

void sensing_init(struct sensing *sensing, const struct sensor_settings *settings,
                  sensing_look *look, double garbage_m, uint64_t seed)
{
    memset(sensing, 0, sizeof *sensing);
    sensing->sensor = settings->sensor;
    memcpy(sensing->faults, settings->faults, sizeof sensing->faults);
    sensing->look = look;
    sensing->garbage_m = garbage_m;
    sensing->strength_scale = 1;
    random_seed(&sensing->random, seed);
    random_seed(&sensing->rain, seed ^ 0x5241494Eu);
    sensing->last_m = -1;
    sensing->answered_ns = INT64_MIN;
    for (int i = 0; i < SENSOR_FAULTS; i++) {
        sensing->stuck_m[i] = sensing->faults[i].dist_m;
        sensing->glitches_left[i] = (int)sensing->faults[i].readings;
    }
}

void sensing_free(struct sensing *sensing)
{
    free(sensing->past);
    sensing->past = NULL;
    sensing->past_count = sensing->past_capacity = 0;
}

/* --- the past ----------------------------------------------------------------------------- */

void sensing_observe(struct sensing *sensing, int64_t t_ns, double gap_m)
{
    if (sensing->past_count == sensing->past_capacity) {
        sensing->past_capacity = sensing->past_capacity * 2 + 256;
        sensing->past =
            realloc(sensing->past, (size_t)sensing->past_capacity * sizeof sensing->past[0]);
        if (sensing->past == NULL) {
            abort();
        }
    }
    sensing->past[sensing->past_count].t_s = (double)t_ns * 1e-9;
    sensing->past[sensing->past_count++].gap_m = gap_m;
}

static double past_gap_m(const struct sensing *sensing, double t_s)
{
    int i = sensing->past_count - 1;
    double span_s, part;

    while (i > 0 && sensing->past[i].t_s > t_s) {
        i--;
    }
    if (i < 0) {
        return INFINITY;
    }
    if (i + 1 >= sensing->past_count || isinf(sensing->past[i].gap_m) ||
        isinf(sensing->past[i + 1].gap_m)) {
        return sensing->past[i].gap_m;
    }
    span_s = sensing->past[i + 1].t_s - sensing->past[i].t_s;
    part = fmax(t_s - sensing->past[i].t_s, 0) / span_s;
    return sensing->past[i].gap_m + part * (sensing->past[i + 1].gap_m - sensing->past[i].gap_m);
}

/* --- faults in time ------------------------------------------------------------------------ */

static double end_s(const struct fault *fault)
{
    return fault->for_s < 0 || fault->kind == FAULT_GLITCH ? INFINITY
                                                           : fault->from_s + fault->for_s;
}

bool sensing_fault_acts(const struct sensing *sensing, int index, double t_s)
{
    return sensing->faults[index].kind >= 0 && t_s >= sensing->faults[index].from_s &&
           t_s < end_s(&sensing->faults[index]);
}

/* Does the fault keep the sensor silent now? An intermittent one begins with its off time. */
static bool is_off(const struct sensing *sensing, int index, double t_s)
{
    const struct fault *fault = &sensing->faults[index];

    if (!sensing_fault_acts(sensing, index, t_s)) {
        return false;
    }
    if (fault->kind == FAULT_INTERMITTENT) {
        return fmod(t_s - fault->from_s, fault->off_s + fault->on_s) < fault->off_s;
    }
    return fault->kind == FAULT_OFF || fault->kind == FAULT_HIGH;
}

bool sensing_is_silenced(const struct sensing *sensing, double t_s, bool *level)
{
    bool silenced = false;

    *level = false;
    for (int i = 0; i < SENSOR_FAULTS; i++) {
        if (is_off(sensing, i, t_s)) {
            silenced = true;
            *level |= sensing->faults[i].kind == FAULT_HIGH || sensing->faults[i].line == 1;
        }
    }
    return silenced;
}

int64_t sensing_boundary_ns(const struct sensing *sensing, int64_t t_ns)
{
    int64_t first = INT64_MAX;

    for (int i = 0; i < SENSOR_FAULTS; i++) {
        const struct fault *fault = &sensing->faults[i];
        double t_s = (double)t_ns * 1e-9, cycle_s = fault->on_s + fault->off_s;
        double marks_s[4] = {fault->from_s, end_s(fault), INFINITY, INFINITY};

        if (sensing->faults[i].kind < 0) {
            continue;
        }
        if (fault->kind == FAULT_INTERMITTENT) {
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

/* --- readings ------------------------------------------------------------------------------- */

/* The healthy sensor's reading. Always takes the same count of random numbers, so that a fault or a
 * target out of range does not change what noise the later readings get. */
static struct reading measure(struct sensing *sensing, double gap_m)
{
    const struct sensor *sensor = &sensing->sensor;
    bool dropped = random_uniform(&sensing->random) < sensor->dropout;
    double normal = random_normal(&sensing->random);
    struct sight sight = sensing->look(sensing, gap_m);
    struct reading reading = {READ_TARGET, fmax(sight.dist_m + normal * sight.noise_m, 0)};

    if (dropped || !sight.is_seen) {
        reading.kind = READ_NONE;
    }
    if (sensor->step_m > 0) {
        reading.dist_m = round(reading.dist_m / sensor->step_m) * sensor->step_m;
    }
    return reading;
}

/* A drop of rain near the lens, sometimes. */
static void rain_on(struct sensing *sensing, const struct fault *fault, struct reading *reading)
{
    static const double near_m = 1;
    double far_m = fault->dist_m < 0 ? near_m : fault->dist_m;
    bool is_drop = random_uniform(&sensing->rain) < fault->share;
    double dist_m = random_uniform(&sensing->rain) * far_m;

    if (is_drop) {
        *reading = (struct reading){READ_TARGET, fmax(dist_m, sensor_min_m(&sensing->sensor))};
    }
}

/* What a fault whose time it is makes of a reading; GARBAGE is at random, 0..1. */
static void spoil(struct sensing *sensing, int index, int64_t t_ns, double garbage,
                  struct reading *reading)
{
    const struct fault *fault = &sensing->faults[index];

    switch (fault->kind) {
    case FAULT_STUCK: /* at "no target", if the sensor has never seen one */
        if (sensing->stuck_m[index] < 0 && sensing->last_m >= 0) {
            sensing->stuck_m[index] = sensing->last_m;
        } else if (sensing->stuck_m[index] < 0) {
            sensing->stuck_m[index] = reading->kind == READ_TARGET ? reading->dist_m : INFINITY;
        }
        reading->kind = isinf(sensing->stuck_m[index]) ? READ_NONE : READ_TARGET;
        reading->dist_m = sensing->stuck_m[index];
        break;
    case FAULT_GARBAGE:
        *reading = (struct reading){READ_TARGET, garbage * sensing->garbage_m};
        break;
    case FAULT_WRONG:
        reading->dist_m =
            fmax(reading->dist_m * fault->scale + fault->offset_m, sensor_min_m(&sensing->sensor));
        break;
    case FAULT_SLOW:
        if (sensing->answered_ns != INT64_MIN &&
            (double)(t_ns - sensing->answered_ns) * 1e-9 < fault->period_s) {
            reading->kind = READ_SILENT;
        } else {
            sensing->answered_ns = t_ns;
        }
        break;
    case FAULT_GLITCH:
        if (sensing->glitches_left[index] > 0) {
            sensing->glitches_left[index]--;
            *reading = (struct reading){READ_TARGET, fault->dist_m};
        }
        break;
    case FAULT_RAIN:
        rain_on(sensing, fault, reading);
        break;
    default: /* the line's, or in the frame */
        break;
    }
}

/* Age of what a delayed sensor shows, s. */
static double delay_s(const struct sensing *sensing, double t_s)
{
    double delay = 0;

    for (int i = 0; i < SENSOR_FAULTS; i++) {
        if (sensing->faults[i].kind == FAULT_DELAYED && sensing_fault_acts(sensing, i, t_s)) {
            delay += sensing->faults[i].delay_s;
        }
    }
    return delay;
}

struct reading sensing_read(struct sensing *sensing, int64_t t_ns, double gap_m)
{
    double t_s = (double)t_ns * 1e-9, garbage = random_uniform(&sensing->random);
    double delay = delay_s(sensing, t_s);
    struct reading reading = measure(sensing, delay > 0 ? past_gap_m(sensing, t_s - delay) : gap_m);

    for (int i = 0; i < SENSOR_FAULTS; i++) {
        if (sensing_fault_acts(sensing, i, t_s)) {
            spoil(sensing, i, t_ns, garbage, &reading);
        }
    }
    return reading;
}

void sensing_note(struct sensing *sensing, const struct reading *reading)
{
    if (reading->kind == READ_TARGET) {
        sensing->last_m = reading->dist_m;
    }
}
