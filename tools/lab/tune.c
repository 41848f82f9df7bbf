/* SPDX-License-Identifier: MIT */
/* Looks for a better table: a walk that keeps each step that makes things better. */
#include "lab.h"

#include "diag.h"
#include "loop.h"
#include "random.h"
#include "table.h"

#include <math.h>
#include <string.h>

/* What may move: where the sets of distance and closing speed reach 1, and where the four brakes
 * stand. Their number, order and rules are those of brake.fis. */
enum {
    NEAR,
    FAIRLY_NEAR,
    NEAR_M,
    NORMAL,
    SMALL,
    MEDIUM,
    LARGE,
    FAIRLY_SMALL,
    MODERATE,
    FAIRLY_LARGE,
    PARAMETERS
};

struct walk {
    const char *name;
    double near_m, far_m, fast_mps; /* of the table */
    struct {
        double start, low, high, step, grid;
    } parameter[PARAMETERS];
    double hits_mps[3];   /* standing cars that are nearly hit: the first ones count most */
    double smooth_mps[2]; /* and here at most 25 m/s3 */
};

/* One for each kind of sensor. */
static const struct walk walks[] = {
    {.name = "brake_tuned",
     .near_m = 1,
     .far_m = 5,
     .fast_mps = 7,
     .parameter = {[NEAR] = {1.5, 1, 5.5, 0.3, 0.05},
                   [FAIRLY_NEAR] = {2.2, 1, 5.5, 0.4, 0.05},
                   [NEAR_M] = {3.2, 1, 5.5, 0.4, 0.05},
                   [NORMAL] = {5, 1, 5.5, 0.3, 0.05},
                   [SMALL] = {2, 1, 6.9, 0.4, 0.05},
                   [MEDIUM] = {3.5, 1, 6.9, 0.4, 0.05},
                   [LARGE] = {6, 1, 6.9, 0.4, 0.05},
                   [FAIRLY_SMALL] = {0, 0, 10, 2, 1},
                   [MODERATE] = {30, 0, 97, 8, 1},
                   [FAIRLY_LARGE] = {65, 0, 97, 8, 1}},
     .hits_mps = {6.4, 6.6, 6.8},
     .smooth_mps = {4, 4}},
    {.name = "brake_far",
     .near_m = 0.5,
     .far_m = 8,
     .fast_mps = 9,
     .parameter = {[NEAR] = {1.2, 0.8, 8.5, 0.4, 0.05},
                   [FAIRLY_NEAR] = {2.6, 0.8, 8.5, 0.6, 0.05},
                   [NEAR_M] = {3.45, 0.8, 8.5, 0.6, 0.05},
                   [NORMAL] = {4.95, 0.8, 8.5, 0.5, 0.05},
                   [SMALL] = {1, 1, 8.9, 0.5, 0.05},
                   [MEDIUM] = {3.8, 1, 8.9, 0.5, 0.05},
                   [LARGE] = {5.55, 1, 8.9, 0.5, 0.05},
                   [FAIRLY_SMALL] = {4, 0, 10, 2, 1},
                   [MODERATE] = {33, 0, 97, 8, 1},
                   [FAIRLY_LARGE] = {36, 0, 97, 8, 1}},
     .hits_mps = {8.6, 8.8, 9},
     .smooth_mps = {4, 8.5}},
};
static const struct walk *walk;

static void write_fis(FILE *out, const double *p)
{
    fprintf(out,
            "[System]\nName='%s'\nType='mamdani'\nVersion=2.0\nNumInputs=2\nNumOutputs=1\n"
            "NumRules=16\nAndMethod='prod'\nOrMethod='max'\nImpMethod='prod'\nAggMethod='max'\n"
            "DefuzzMethod='centroid'\n\n",
            walk->name);
    fprintf(
        out,
        "%% distance to the car in front, m\n[Input1]\nName='distance_m'\nRange=[%g %g]\nNumMFs=4\n"
        "MF1='very_near':'trapmf',[-1 0 %g %g]\nMF2='fairly_near':'trimf',[%g %g %g]\n"
        "MF3='near':'trimf',[%g %g %g]\nMF4='normal':'trapmf',[%g %g %g %g]\n\n",
        walk->near_m, walk->far_m, p[NEAR], p[FAIRLY_NEAR], p[NEAR], p[FAIRLY_NEAR], p[NEAR_M],
        p[FAIRLY_NEAR], p[NEAR_M], p[NORMAL], p[NEAR_M], p[NORMAL], walk->far_m + 1,
        walk->far_m + 2);
    fprintf(out,
            "%% closing speed, m/s\n[Input2]\nName='closing_mps'\nRange=[0 %g]\nNumMFs=4\n"
            "MF1='very_small':'trimf',[0 0 %g]\nMF2='small':'trimf',[0 %g %g]\n"
            "MF3='medium':'trimf',[%g %g %g]\nMF4='large':'trapmf',[%g %g %g %g]\n\n",
            walk->fast_mps, p[SMALL], p[SMALL], p[MEDIUM], p[SMALL], p[MEDIUM], p[LARGE], p[MEDIUM],
            p[LARGE], walk->fast_mps + 1, walk->fast_mps + 2);
    fprintf(out,
            "%% brake force, percent\n[Output1]\nName='brake_pct'\nRange=[0 100]\nNumMFs=4\n"
            "MF1='fairly_small':'trimf',[%g %g %g]\nMF2='moderate':'trimf',[%g %g %g]\n"
            "MF3='fairly_large':'trimf',[%g %g %g]\nMF4='very_large':'trimf',[99 100 101]\n\n",
            p[FAIRLY_SMALL] - 1, p[FAIRLY_SMALL], p[FAIRLY_SMALL] + 1, p[MODERATE] - 1, p[MODERATE],
            p[MODERATE] + 1, p[FAIRLY_LARGE] - 1, p[FAIRLY_LARGE], p[FAIRLY_LARGE] + 1);
    fprintf(out, "%% distance, closing speed, brake\n[Rules]\n");
    for (int speed = 1; speed <= 4; speed++) {
        for (int distance = 1; distance <= 4; distance++) {
            fprintf(out, "%d %d, %d (1) : 1\n", distance, speed,
                    speed - distance >= 0 ? 4 : 4 + speed - distance);
        }
    }
}

/* Puts the table of these parameters into the image. Returns how many neighbours are in the wrong
 * order, or -1 when it is no table. */
static int put_table(const struct image *image, const double *p)
{
    static char text[4000];
    FILE *stream = fmemopen(text, sizeof text, "w");
    const unsigned rows = *image->rows, cols = *image->cols;
    const struct table_options options = {
        .infer = {.samples = INFER_SAMPLES}, .dims = {rows, cols}, .levels = 100};
    struct table table;
    struct fis fis;
    int wrong = 0;

    if (stream == NULL) {
        return -1;
    }
    write_fis(stream, p);
    fclose(stream);
    if (fis_parse("tuned", text, strlen(text), &fis) != EXIT_FINE) {
        return -1;
    }
    if (table_make(&fis, &options, &table) != EXIT_FINE) {
        fis_free(&fis);
        return -1;
    }
    for (unsigned row = 0; row < rows; row++) {
        for (unsigned col = 0; col < cols; col++) {
            const int *cell = &table.cell[0][row * cols + col];

            image->cells[row * cols + col] = (uint8_t)*cell;
            wrong += row > 0 && *(cell - cols) < *cell;
            wrong += col > 0 && *(cell - 1) > *cell;
        }
    }
    table_free(&table);
    fis_free(&fis);
    return wrong;
}

/* --- what is bad about a table --------------------------------------------------------------- */

enum { GENTLE_SPEEDS = 6 };                  /* 1, 1.5 ... 3.5 m/s */
static struct figures gentle[GENTLE_SPEEDS]; /* of the reference */

static double low_mps(int k)
{
    return 1 + 0.5 * k;
}

/* Impacts near the limit, and hard braking where 25 m/s3 is the most. */
static double cost_of_standing(const struct image *image)
{
    static const double weights[] = {12, 4, 2};
    double cost = 0;

    for (int k = 0; k < 3; k++) {
        cost += weights[k] * lab_standing(image, walk->hits_mps[k], 120).gap_short_m;
    }
    for (int k = 0; k < 2; k++) {
        struct figures f = lab_standing(image, walk->smooth_mps[k], 120);

        cost += 0.25 * fmax(f.jerk_worst_mps3 - 24, 0) + 0.01 * f.jerk_mean_mps3;
    }
    return cost;
}

/* Braking harder than the reference at low speed, stopping by STOP, stopping far away. */
static double cost_of_comfort(const struct image *image)
{
    double cost = 0;

    for (int k = 0; k < 10; k++) {
        struct figures f = lab_standing(image, low_mps(k), 24);

        cost += 8 * fmax(1.12 - f.gap_min_m, 0) + 0.05 * fmax(f.gap_mean_m - 2, 0);
        if (k < GENTLE_SPEEDS) {
            cost += 0.03 * fmax(f.jerk_mean_mps3 - gentle[k].jerk_mean_mps3, 0) +
                    0.3 * fmax(f.decel_mean_mps2 - gentle[k].decel_mean_mps2, 0) +
                    0.01 * f.decel_mean_mps2;
        }
    }
    return cost;
}

static double cost_of_leads(const struct image *image)
{
    return 4 * fmax(1 - lab_lead_brakes(image, 4, 24).gap_min_m, 0) +
           4 * fmax(0.6 - lab_lead_brakes(image, 5, 24).gap_min_m, 0) +
           0.6 * fmax(0.3 - lab_lead_brakes(image, 6, 24).gap_min_m, 0) +
           0.2 * fmax(0.3 - lab_lead_brakes(image, 7, 24).gap_min_m, 0);
}

static double cost_of_following(const struct image *image)
{
    struct figures f = lab_stop_and_go(image, 1, 2);

    return 3 * f.rms_mps2 + 0.1 * fmax(f.stuck_worst_s - 4, 0) + 5 * f.impacts;
}

static double cost_of(const struct image *image, const double *p)
{
    int wrong = put_table(image, p);

    if (wrong < 0) {
        return INFINITY;
    }
    return 0.003 * wrong + cost_of_standing(image) + cost_of_comfort(image) + cost_of_leads(image) +
           cost_of_following(image);
}

/* --- the walk -------------------------------------------------------------------------------- */

/* Onto the grid, within the limits, and the sets of each variable in their order. */
static void tidy(double *p)
{
    for (int i = 0; i < PARAMETERS; i++) {
        double low = walk->parameter[i].low;

        if (i != NEAR && i != SMALL && i != FAIRLY_SMALL) {
            low = fmax(low, p[i - 1] + (i > LARGE ? 3 : 0.3));
        }
        p[i] = fmin(fmax(p[i], low), walk->parameter[i].high);
        p[i] = round(p[i] / walk->parameter[i].grid) * walk->parameter[i].grid;
    }
}

int lab_tune(const struct image *image, const struct image *reference, unsigned long seed,
             long rounds, const char *path)
{
    struct random random;
    double best[PARAMETERS], trial[PARAMETERS], best_cost, reach = 1;
    struct outfile out;

    walk = &walks[image_is_tfluna(image)];
    random_seed(&random, seed);
    for (int k = 0; k < GENTLE_SPEEDS; k++) {
        gentle[k] = lab_standing(reference, low_mps(k), 24);
    }
    for (int i = 0; i < PARAMETERS; i++) {
        best[i] = walk->parameter[i].start;
    }
    best_cost = cost_of(image, best);
    for (long round = 1; round <= rounds; round++) {
        double cost;

        memcpy(trial, best, sizeof trial);
        for (int i = 0; i < PARAMETERS; i++) {
            if (random_uniform(&random) < 0.4) {
                trial[i] += random_normal(&random) * walk->parameter[i].step * reach;
            }
        }
        tidy(trial);
        cost = cost_of(image, trial);
        reach = cost < best_cost ? fmin(reach * 1.3, 1.2) : fmax(reach * 0.985, 0.15);
        if (cost < best_cost) {
            best_cost = cost;
            memcpy(best, trial, sizeof best);
            fprintf(stderr, "%ld: %.4f\n", round, cost);
        }
    }
    if (outfile_open(&out, path) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    write_fis(out.stream, best);
    return outfile_commit(&out);
}
