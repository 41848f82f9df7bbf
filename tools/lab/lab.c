/* SPDX-License-Identifier: MIT */
#include "lab.h"

#include "brake_world.h"
#include "loop.h"
#include "world.h"

#include <math.h>

/* Peaks are sampled once a step, and the motion within one is exact. */
enum { STEP_US = 5000 };

struct scenario lab_situation(const struct image *image, double speed_mps, double duration_s)
{
    struct scenario scenario;
    struct sensor *sensor = &brake_settings(&scenario)->sensing.sensor;

    scenario_defaults(&scenario, &brake_world);
    scenario.duration_s = duration_s;
    scenario.hold_s = 0.5;
    scenario.ego.speed_mps = speed_mps;
    scenario.lead.present = true;
    sensor->kind = image_is_tfluna(image) ? SENSOR_TFLUNA : SENSOR_HCSR04;
    sensor->noise_m = image_is_tfluna(image) ? 0.02 : 0.01;
    sensor->dropout = 0.02;
    return scenario;
}

static void add(struct figures *figures, const struct image *image, const struct scenario *scenario,
                int run, int runs)
{
    struct outcome outcome;
    const double *value = outcome.values;
    double gap_m, part = 1.0 / runs;

    loop_run(image, scenario, (uint64_t)run + 1, STEP_US, &outcome);
    gap_m = value[METRIC_IMPACT] > 0 ? -value[METRIC_IMPACT_MPS] * value[METRIC_IMPACT_MPS] / 16
                                     : value[METRIC_MIN_GAP];
    if (run == 0) {
        *figures = (struct figures){.runs = runs, .gap_min_m = INFINITY};
    }
    figures->impacts += value[METRIC_IMPACT] > 0;
    figures->gap_min_m = fmin(figures->gap_min_m, gap_m);
    figures->gap_mean_m += part * gap_m;
    figures->gap_short_m += part * fmax(0.25 - gap_m, 0);
    figures->jerk_worst_mps3 = fmax(figures->jerk_worst_mps3, value[METRIC_PEAK_JERK]);
    figures->jerk_mean_mps3 += part * value[METRIC_PEAK_JERK];
    figures->decel_mean_mps2 += part * value[METRIC_PEAK_DECEL];
    figures->rms_mps2 += part * value[METRIC_RMS_ACCEL];
    figures->stuck_worst_s = fmax(figures->stuck_worst_s, value[METRIC_STUCK]);
}

/* Parts of one, evenly spread however many are taken. */
static double spread(int run)
{
    return fmod(run * 0.6180339887498949, 1);
}

struct figures lab_standing(const struct image *image, double speed_mps, int runs)
{
    struct scenario scenario = lab_situation(image, speed_mps, 20);
    double far_m = sensor_max_m(&brake_settings(&scenario)->sensing.sensor);
    struct figures figures = {0};

    for (int run = 0; run < runs; run++) {
        /* any phase of the sensor */
        scenario.lead.gap_m = far_m + 1.5 + spread(run) * 0.06 * speed_mps;
        add(&figures, image, &scenario, run, runs);
    }
    return figures;
}

struct figures lab_lead_brakes(const struct image *image, double decel_mps2, int runs)
{
    struct scenario scenario = lab_situation(image, 10, 12);
    struct figures figures = {0};

    scenario.lead.gap_m = 5;
    scenario.lead.speed_mps = 10;
    scenario.lead.change_mps2 = -decel_mps2;
    for (int run = 0; run < runs; run++) {
        scenario.lead.change_s = 0.5 + spread(run) * 0.06;
        add(&figures, image, &scenario, run, runs);
    }
    return figures;
}

struct figures lab_stop_and_go(const struct image *image, double driver_mps2, int runs)
{
    struct scenario scenario = lab_situation(image, 0, 120);
    struct figures figures = {0};

    scenario.hold_s = SCENARIO_UNSET;
    scenario.ego.driver_mps = 8;
    scenario.ego.driver_mps2 = driver_mps2;
    scenario.lead.gap_m = 3;
    for (int i = 0; i < 12; i++) {
        static const double from_s[] = {14, 20, 34, 40};
        static const double speed_mps[] = {0, 3, 3, 0};

        scenario.lead.profile.points[i].t_s = i / 4 * 40 + from_s[i % 4];
        scenario.lead.profile.points[i].speed_mps = speed_mps[i % 4];
    }
    scenario.lead.profile.count = 12;
    for (int run = 0; run < runs; run++) {
        add(&figures, image, &scenario, run, runs);
    }
    return figures;
}

/* --- what controllers come to ---------------------------------------------------------------- */

static const double step_mps = 0.1;

/* Highest speeds without an impact in any of the runs, and in half of them. */
static void print_limits(FILE *out, const struct image *image, int runs)
{
    double safe_mps = 0, median_mps = 0;
    bool is_safe = true;

    for (int k = 30; k <= 100; k++) {
        struct figures figures = lab_standing(image, k * step_mps, runs);

        is_safe = is_safe && figures.impacts == 0;
        if (is_safe) {
            safe_mps = k * step_mps;
        }
        if (2 * figures.impacts <= runs) {
            median_mps = k * step_mps;
        }
    }
    fprintf(out,
            "  standing car: no impact in %d runs up to %.1f m/s, in half of them up to %.1f m/s\n",
            runs, safe_mps, median_mps);
}

static void print_image(FILE *out, const struct image *image, int runs)
{
    double from_mps = image_is_tfluna(image) ? 8.4 : 6.2;

    fprintf(out, "%s\n", image->path);
    print_limits(out, image, runs);
    for (double speed_mps = from_mps; speed_mps < from_mps + 0.7; speed_mps += 0.2) {
        fprintf(out, "  standing car, %.1f m/s: %d impacts in %d runs\n", speed_mps,
                lab_standing(image, speed_mps, 1000).impacts, 1000);
    }
    for (int speed_mps = 1; speed_mps <= (int)from_mps; speed_mps++) {
        struct figures f = lab_standing(image, speed_mps, runs);

        fprintf(out,
                "  standing car, %d m/s: jerk %.1f (worst %.1f) m/s3, deceleration %.1f m/s2, gap "
                "%.2f (least %.2f) m\n",
                speed_mps, f.jerk_mean_mps3, f.jerk_worst_mps3, f.decel_mean_mps2, f.gap_mean_m,
                f.gap_min_m);
    }
    for (int decel_mps2 = 2; decel_mps2 <= 8; decel_mps2++) {
        struct figures f = lab_lead_brakes(image, decel_mps2, runs);

        fprintf(out,
                "  both at 10 m/s, the car ahead brakes at %d m/s2: %d impacts in %d runs, least "
                "gap %.2f m\n",
                decel_mps2, f.impacts, runs, fmax(f.gap_min_m, 0));
    }
    for (int driver_mps2 = 1; driver_mps2 <= 2; driver_mps2++) {
        struct figures f = lab_stop_and_go(image, driver_mps2, 8);

        fprintf(out,
                "  stop-and-go, driver of %d m/s2: %.2f m/s2 rms, stuck %.1f s of 120 s, %d "
                "impacts in 8 runs\n",
                driver_mps2, f.rms_mps2, f.stuck_worst_s, f.impacts);
    }
}

void lab_print(FILE *out, const struct image *images, int count, int runs)
{
    for (int i = 0; i < count; i++) {
        print_image(out, &images[i], runs);
    }
}
