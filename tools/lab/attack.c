/* SPDX-License-Identifier: MIT */
/* A random search for drives in which a controller does what nobody would expect of a brake. Each
 * drive is plausible by itself: some car ahead, noise, missing echoes, a stray one or two. */
#include "lab.h"

#include "brake_world.h"
#include "loop.h"
#include "random.h"

#include "../../firmware/brake/range.h"

#include <math.h>

enum { STEP_US = 5000, MEMORY = 4 /* readings */ };

/* What is flagged. */
enum flag {
    FLAG_IMPACT, /* and full braking from first sight would have kept 0.5 m */
    FLAG_BLIND,  /* no brake for a target that is near and closes */
    FLAG_FAULT,  /* FAULT begins, though no two of the last four readings were bad */
    FLAG_FULL,   /* full brake with nothing near */
    FLAGS
};
static const char *const flag_names[FLAGS] = {
    "impacts that full braking from first sight avoids with 0.5 m to spare",
    "brake 0 with a target near", "FAULT without a cause", "full brake with nothing near"};

static const double spare_m = 0.5;

/* A law that keeps less than this before a good sensor is at its limit: at 5 m/s one missing echo
 * costs 0.3 m. */
static const double law_limit_m = 0.3;

/* Impacts at the limit of a law. */
struct limits {
    long all, with_good_sensor; /* these hit before a good sensor, too */
};

struct drive {
    const struct image *image;
    long count;       /* of readings looked at */
    bool bad[MEMORY]; /* the last readings */
    bool was_fault;
    double last_near_s; /* when a target was there within 4.5 m */
    double last_stop_s; /* and within 1.3 m */
    double blind_since_s, full_since_s;
    bool flags[FLAGS];
};

static struct random chance;

static double between(double low, double high)
{
    return low + (high - low) * random_uniform(&chance);
}

static bool happens(double probability)
{
    return random_uniform(&chance) < probability;
}

/* --- scenarios -------------------------------------------------------------------------------- */

static void add_strays(struct scenario *scenario, int count)
{
    for (int i = 0; i < count; i++) {
        struct fault *fault = &brake_settings(scenario)->sensing.faults[i];

        *fault = (struct fault){.kind = FAULT_GLITCH,
                                .from_s = between(0, scenario->duration_s),
                                .for_s = SCENARIO_UNSET,
                                .dist_m = between(0.05, 4.9),
                                .scale = 1,
                                .readings = 1};
    }
}

static void add_lead(struct scenario *scenario)
{
    struct lead *lead = &scenario->lead;
    double speed_mps = scenario->ego.speed_mps;

    lead->gap_m = between(5.2, 8);
    switch ((int)between(0, 7)) {
    case 0: /* it stands */
    case 1:
        break;
    case 2: /* it is slower */
        lead->speed_mps = between(0, speed_mps);
        break;
    case 3: /* it brakes */
        lead->speed_mps = speed_mps;
        lead->gap_m = between(2, 5);
        lead->change_s = between(0.5, 2);
        lead->change_mps2 = -between(1, 4);
        break;
    case 4: /* it cuts in, and does not stand */
        lead->speed_mps = between(0.5, 1) * speed_mps;
        lead->gap_m = between(1.5, 4);
        lead->appears_s = between(0.5, 2);
        break;
    case 5: /* it drives off */
        lead->gap_m = between(0.8, 5);
        scenario->ego.speed_mps = 0;
        lead->change_s = between(1, 3);
        lead->change_mps2 = between(0.5, 3);
        lead->change_to_mps = between(1, 8);
        break;
    case 6: /* it leaves: it turns off, or crosses */
        lead->gap_m = between(0.5, 6);
        lead->speed_mps = between(0.8, 1.2) * speed_mps;
        lead->appears_s = between(0, 1);
        lead->leaves_s = lead->appears_s + between(0.1, 3);
        break;
    default:
        lead->present = false;
    }
}

static struct scenario any_scenario(const struct image *image)
{
    static const double steps_m[] = {0, 0.001, 0.003, 0.01};
    struct scenario scenario = lab_situation(image, between(0.5, 6), 8);
    struct sensor *sensor = &brake_settings(&scenario)->sensing.sensor;

    scenario.hold_s = SCENARIO_UNSET;
    scenario.ego.brake_max_mps2 = between(7, 9);
    scenario.ego.brake_lag_s = between(0.15, 0.25);
    scenario.ego.driver = happens(0.7) ? DRIVER_HOLDS : DRIVER_COASTS;
    sensor->noise_m = happens(0.3) ? 0 : between(0, 0.02);
    sensor->dropout = happens(0.3) ? 0 : between(0, 0.1);
    sensor->step_m = steps_m[(int)between(0, 4)];
    scenario.lead.present = happens(0.9);
    if (scenario.lead.present) {
        add_lead(&scenario);
    }
    add_strays(&scenario, (int)between(0, 3));
    return scenario;
}

/* The same drive before a sensor without faults. */
static struct scenario with_good_sensor(struct scenario scenario)
{
    struct sensor_settings *sensing = &brake_settings(&scenario)->sensing;

    sensing->sensor.noise_m = sensing->sensor.dropout = sensing->sensor.step_m = 0;
    for (int i = 0; i < SENSOR_FAULTS; i++) {
        sensing->faults[i].kind = -1;
    }
    return scenario;
}

/* --- flags ------------------------------------------------------------------------------------ */

/* A reading that says nothing true of the target. That a near one vanished counts, too: the sensor
 * cannot tell that from a missing echo. */
static bool is_bad(const struct drive *drive, double t_s, double gap_m,
                   const struct loop_reading *reading)
{
    if (reading->kind == RANGE_NO_TARGET) {
        return (gap_m > 0.02 && gap_m < 5.1) || t_s - drive->last_near_s < 2;
    }
    return reading->kind != RANGE_ECHO || !(fabs(reading->dist_mm / 1000.0 - gap_m) < 0.25);
}

static void look(void *user, double t_s, const double *values, const struct loop_reading *reading)
{
    struct drive *drive = user;
    double gap_m = values[0], closing_mps = values[1] - values[2], brake_pct = values[4];
    bool is_fault = drive->image->brake->state == BRAKE_FAULT;
    bool is_there = !isnan(gap_m), is_near, is_far;
    int bad = 0;

    if (is_there && gap_m < 4.5) {
        drive->last_near_s = t_s;
    }
    if (is_there && gap_m < 1.3) {
        drive->last_stop_s = t_s;
    }
    if (reading->count != drive->count) {
        drive->bad[reading->count % MEMORY] = is_bad(drive, t_s, gap_m, reading);
        drive->count = reading->count;
    }
    for (int i = 0; i < MEMORY; i++) {
        bad += drive->bad[i];
    }
    drive->flags[FLAG_FAULT] |= is_fault && !drive->was_fault && bad < 2;
    drive->was_fault = is_fault;

    /* The safe distance of the classic law, less what noise and one period make of it. */
    is_near = is_there && closing_mps > 0.3 &&
              gap_m < 0.7 + 0.2 * closing_mps + closing_mps * closing_mps / 16;
    if (!is_near || brake_pct > 0) {
        drive->blind_since_s = t_s;
    }
    drive->flags[FLAG_BLIND] |= t_s - drive->blind_since_s > 0.4;

    /* STOP is held for 2 s, a near target that vanished for 1.2 s: it may be there. */
    is_far = t_s - drive->last_stop_s > 2.3 && (is_there || t_s - drive->last_near_s > 1.5) &&
             (!is_there || (gap_m > 2.5 && closing_mps * closing_mps < 2 * (gap_m - 1)));
    if (!is_far || brake_pct < 100) {
        drive->full_since_s = t_s;
    }
    drive->flags[FLAG_FULL] |= t_s - drive->full_since_s > 0.5;
}

/* --- runs ------------------------------------------------------------------------------------- */

static double gap_left_m(const struct image *image, const struct scenario *scenario, uint64_t seed)
{
    struct outcome outcome;

    loop_run(image, scenario, seed, STEP_US, &outcome);
    return outcome.values[METRIC_IMPACT] > 0 ? -1 : outcome.values[METRIC_MIN_GAP];
}

/* The controller hits where full braking from first sight does not, and would not with a good
 * sensor: else it is a limit of its law, counted in LIMITS. */
static bool is_impact_flagged(const struct image *image, const struct image *first,
                              const struct scenario *scenario, uint64_t seed, struct limits *limits)
{
    struct scenario good = with_good_sensor(*scenario);
    double left_m;

    if (gap_left_m(first, scenario, seed) < spare_m) {
        return false;
    }
    left_m = gap_left_m(image, &good, seed);
    if (left_m >= law_limit_m) {
        return true;
    }
    limits->all++;
    limits->with_good_sensor += left_m < 0;
    return false;
}

static void tell(FILE *out, const struct scenario *scenario, uint64_t seed, enum flag flag)
{
    const struct sensor_settings *sensing = &brake_settings((struct scenario *)scenario)->sensing;
    const struct lead *lead = &scenario->lead;

    fprintf(out, "  seed %llu: %s: ego %.2f m/s", (unsigned long long)seed, flag_names[flag],
            scenario->ego.speed_mps);
    if (lead->present) {
        fprintf(out,
                "; lead at %.2f m, %.2f m/s, change %.2f s %.2f m/s2, there from %.2f to %.2f s",
                lead->gap_m, lead->speed_mps, lead->change_s, lead->change_mps2, lead->appears_s,
                lead->leaves_s);
    }
    fprintf(out, "; noise %.3f m, %.0f %% missing, step %.0f mm", sensing->sensor.noise_m,
            sensing->sensor.dropout * 100, sensing->sensor.step_m * 1000);
    for (int i = 0; i < SENSOR_FAULTS; i++) {
        if (sensing->faults[i].kind >= 0) {
            fprintf(out, "; stray %.2f m at %.2f s", sensing->faults[i].dist_m,
                    sensing->faults[i].from_s);
        }
    }
    fprintf(out, "\n");
}

int lab_attack(FILE *out, const struct image *image, const struct image *first, long seed,
               long runs)
{
    long flagged = 0, counts[FLAGS] = {0};
    struct limits limits = {0};

    fprintf(out, "%s\n", image->path);
    for (long run = 0; run < runs; run++) {
        uint64_t number = (uint64_t)(seed * 1000000 + run);
        struct drive drive = {.image = image, .last_near_s = -INFINITY, .last_stop_s = -INFINITY};
        struct scenario scenario;
        struct outcome outcome;
        bool any = false;

        random_seed(&chance, number);
        scenario = any_scenario(image);
        loop_run_watched(image, &scenario, number, STEP_US, &outcome, look, &drive);
        drive.flags[FLAG_IMPACT] = outcome.values[METRIC_IMPACT] > 0 &&
                                   is_impact_flagged(image, first, &scenario, number, &limits);
        for (enum flag flag = 0; flag < FLAGS; flag++) {
            if (drive.flags[flag]) {
                tell(out, &scenario, number, flag);
                counts[flag]++;
                any = true;
            }
        }
        flagged += any;
    }
    for (enum flag flag = 0; flag < FLAGS; flag++) {
        fprintf(out, "  %ld %s\n", counts[flag], flag_names[flag]);
    }
    fprintf(
        out,
        "  %ld of %ld drives flagged; %ld impacts more at a limit of the law itself, %ld of them "
        "before a perfect sensor, too\n",
        flagged, runs, limits.all, limits.with_good_sensor);
    return (int)flagged;
}
