/* SPDX-License-Identifier: MIT */
/* What stray, missing and coarse readings do to a controller, in many runs. */
#include "lab.h"

#include "brake_world.h"
#include "loop.h"
#include "random.h"

#include <math.h>

/* Peaks are sampled once a step, and the motion within one is exact. */
enum { STEP_US = 5000 };

struct trouble {
    int hits, faults; /* runs with an impact; runs that end in FAULT */
};

static struct random chance;

static double between(double low, double high)
{
    return low + (high - low) * random_uniform(&chance);
}

static void run(const struct image *image, const struct scenario *scenario, uint64_t seed,
                struct trouble *trouble)
{
    struct outcome outcome;

    loop_run(image, scenario, seed, STEP_US, &outcome);
    trouble->hits += outcome.values[METRIC_IMPACT] > 0;
    trouble->faults += image->brake->state == BRAKE_FAULT;
}

enum stray { STRAY_NONE, STRAY_BEFORE, STRAY_LATER, STRAY_SILENT };

/* The sensor hears nothing from there. */
static const double silent_m = 6.5;

/* Approaches to a standing car with one stray reading, up to 0.12 s before the car comes into sight
 * or at any later time; or, as early, with that reading missing. */
static struct trouble stray(const struct image *image, double speed_mps, enum stray when, int runs)
{
    struct trouble trouble = {0};

    for (int i = 0; i < runs; i++) {
        struct scenario scenario = lab_situation(image, speed_mps, 8);
        double sight_s, dist_m, from_s;

        random_seed(&chance, (uint64_t)i);
        scenario.lead.gap_m = between(5.4, 5.9);
        sight_s = (scenario.lead.gap_m - sensor_max_m(&brake_settings(&scenario)->sensing.sensor)) /
                  speed_mps;
        dist_m = between(0.3, 4.8);
        from_s = when == STRAY_LATER ? between(sight_s, sight_s + 8 / speed_mps)
                                     : between(sight_s - 0.12, sight_s);
        if (when != STRAY_NONE) {
            brake_settings(&scenario)->sensing.faults[0] =
                (struct fault){.kind = FAULT_GLITCH,
                               .from_s = fmax(from_s, 0),
                               .for_s = SCENARIO_UNSET,
                               .dist_m = when == STRAY_SILENT ? silent_m : dist_m,
                               .scale = 1,
                               .readings = 1};
        }
        run(image, &scenario, (uint64_t)i, &trouble);
    }
    return trouble;
}

/* Approaches with missing readings. */
static struct trouble missing(const struct image *image, double share, int runs)
{
    struct trouble trouble = {0};

    for (int i = 0; i < runs; i++) {
        struct scenario scenario;

        random_seed(&chance, (uint64_t)i);
        scenario = lab_situation(image, between(4.5, 5.5), 8);
        scenario.lead.gap_m = between(5.2, 6);
        brake_settings(&scenario)->sensing.sensor.dropout = share;
        run(image, &scenario, (uint64_t)i, &trouble);
    }
    return trouble;
}

/* Stops before a standing car with a sensor of that step. */
static struct trouble coarse(const struct image *image, double step_m, double noise_m, int runs)
{
    struct trouble trouble = {0};

    for (int i = 0; i < runs; i++) {
        struct scenario scenario;

        random_seed(&chance, (uint64_t)i);
        scenario = lab_situation(image, between(1, 5.5), 12);
        scenario.hold_s = 2;
        scenario.lead.gap_m = between(5.2, 6);
        brake_settings(&scenario)->sensing.sensor.dropout = 0;
        brake_settings(&scenario)->sensing.sensor.noise_m = noise_m;
        brake_settings(&scenario)->sensing.sensor.step_m = step_m;
        run(image, &scenario, (uint64_t)i, &trouble);
    }
    return trouble;
}

/* Sensors that hang, from a time on, on the way: runs in which that is not found within 0.3 s. */
struct hang {
    double from_s, found_s;
    const struct image *image;
};

static void look_for_fault(void *user, double t_s, const double *values,
                           const struct loop_reading *reading)
{
    struct hang *hang = user;

    (void)values;
    (void)reading;
    if (t_s >= hang->from_s && hang->image->brake->state == BRAKE_FAULT && isinf(hang->found_s)) {
        hang->found_s = t_s;
    }
}

static int unfound(const struct image *image, double step_m, double noise_m, int runs)
{
    int count = 0;

    for (int i = 0; i < runs; i++) {
        struct scenario scenario;
        struct outcome outcome;
        struct hang hang = {.found_s = INFINITY, .image = image};
        double speed_mps;

        random_seed(&chance, (uint64_t)i);
        speed_mps = between(1.5, 5.5);
        scenario = lab_situation(image, speed_mps, 4);
        scenario.lead.gap_m = between(5.2, 6);
        brake_settings(&scenario)->sensing.sensor.dropout = 0;
        brake_settings(&scenario)->sensing.sensor.noise_m = noise_m;
        brake_settings(&scenario)->sensing.sensor.step_m = step_m;
        hang.from_s = (scenario.lead.gap_m - 4.4) / speed_mps;
        brake_settings(&scenario)->sensing.faults[0] = (struct fault){.kind = FAULT_STUCK,
                                                                      .from_s = hang.from_s,
                                                                      .for_s = SCENARIO_UNSET,
                                                                      .dist_m = SCENARIO_UNSET,
                                                                      .scale = 1};
        loop_run_watched(image, &scenario, (uint64_t)i, STEP_US, &outcome, look_for_fault, &hang);
        count += hang.found_s > hang.from_s + 0.36;
    }
    return count;
}

void lab_print_trouble(FILE *out, const struct image *images, int count, int runs)
{
    static const double shares[] = {0.1, 0.2, 0.3}, steps_m[] = {0.001, 0.003, 0.01};

    for (int i = 0; i < count; i++) {
        const struct image *image = &images[i];

        fprintf(out, "%s\n", image->path);
        for (double speed_mps = 5; speed_mps < 6.45; speed_mps += 0.1) {
            fprintf(out,
                    "  %.1f m/s, a stray reading: %d hits of %d without, %d before first sight, "
                    "%d later; with that reading missing instead: %d\n",
                    speed_mps, stray(image, speed_mps, STRAY_NONE, runs).hits, runs,
                    stray(image, speed_mps, STRAY_BEFORE, runs).hits,
                    stray(image, speed_mps, STRAY_LATER, runs).hits,
                    stray(image, speed_mps, STRAY_SILENT, runs).hits);
        }
        for (int k = 0; k < 3; k++) {
            fprintf(out, "  %.0f %% missing: %d hits of %d\n", shares[k] * 100,
                    missing(image, shares[k], runs).hits, runs);
        }
        for (int k = 0; k < 3; k++) {
            for (int noise = 0; noise < 2; noise++) {
                struct trouble stops = coarse(image, steps_m[k], noise * 0.01, runs);

                fprintf(
                    out,
                    "  steps of %.0f mm, noise %d cm: %d of %d stops end in FAULT; a sensor that "
                    "hangs is not found in %d of %d\n",
                    steps_m[k] * 1000, noise, stops.faults, runs,
                    unfound(image, steps_m[k], noise * 0.01, runs), runs);
            }
        }
    }
}
