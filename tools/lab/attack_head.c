/* SPDX-License-Identifier: MIT */
/* A random search for drives in which a frame-fed controller does what nobody would expect of it:
 * its real image in the fast engine, in drive's own world. Each drive is plausible by itself: a car
 * ahead, noise, missing answers, a scale that is a little wrong, bad frames for a while. A flagged
 * drive is left as a scenario file, to be looked at with drive. */
#include "lab.h"

#include "diag.h"
#include "fast.h"
#include "random.h"
#include "run.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { LINES = 40, LINE = 80, STEP_US = 1000 };
#define FOLDER "build/attack"

enum flag {
    FLAG_IMPACT, /* and full braking from the same reading would have kept spare_m, as does the
                    controller with a perfect head: else it is a limit of its law */
    FLAG_NEAR,   /* no brake for a target that is too near */
    FLAG_FAULT,  /* FAULT, though each frame was good */
    FLAG_DEAD,   /* FAULT at the end, though the frames were good again for long */
    FLAG_RESET,  /* the watchdog had to help */
    FLAG_ASTRAY, /* a start that passed the check does not end in the place */
    FLAGS
};
static const char *const flag_names[FLAGS] = {
    "impacts that full braking from the same reading avoids",
    "no brake with a target near",
    "FAULT without a cause",
    "FAULT for good",
    "resets by the watchdog",
    "starts that pass the check and do not park"};

/* What belongs to one kind of controller. */
struct kind {
    const char *world;
    void (*draw)(void);
    double spare_m; /* that full braking must leave, for an impact to be flagged */
    double limit_m; /* a law that leaves less than this before a perfect head is near its limit */
    double brake_mps2; /* of the own car at full brake, at least */
    double late_s;     /* from a reading to the brake, at most */
};

/* The drive's settings, "section.key=value". */
static char lines[LINES][LINE];
static int line_count;
static struct random chance;

/* Three good frames in a row end a FAULT: so long after the last bad one it must be over. */
static const double back_s = 3;
static bool is_aside;       /* the car ahead drives in another lane */
static double reason_s;     /* when there is first a reason to brake */
static double last_fault_s; /* when the last bad frame may come; 0: none does */

static double between(double low, double high)
{
    return low + (high - low) * random_uniform(&chance);
}

static bool happens(double probability)
{
    return random_uniform(&chance) < probability;
}

__attribute__((format(printf, 1, 2))) static void set(const char *format, ...)
{
    va_list arguments;

    if (line_count == LINES) {
        abort();
    }
    va_start(arguments, format);
    vsnprintf(lines[line_count++], LINE, format, arguments);
    va_end(arguments);
}

/* --- drives ----------------------------------------------------------------------------------- */

/* Half of the drives have a perfect head, so that what is found there is the controller's own. */
static void draw_head(double duration_s, bool has_speeds)
{
    static const char *const faults[] = {"silence", "corrupt", "truncate", "insert",
                                         "resync",  "repeat",  "range",    "noise",
                                         "frozen",  "old",     "unasked"};

    last_fault_s = 0;
    if (happens(0.5)) {
        return;
    }
    set("head.age_frames=%d", happens(0.2));
    set("head.scale=%.4f", between(0.98, 1.02));
    if (has_speeds) {
        set("head.speed_scale=%.4f", between(0.98, 1.02));
    }
    if (happens(0.5)) {
        set("head.dropout=%.3f", between(0, 0.1));
        last_fault_s = duration_s;
    }
    if (happens(0.5)) {
        double from_s = between(0.2, duration_s / 2), for_s = between(0.05, 1.5);

        set("frame.kind=%s", faults[(int)between(0, sizeof faults / sizeof faults[0])]);
        set("frame.from_s=%.2f", from_s);
        set("frame.for_s=%.2f", for_s);
        last_fault_s = fmax(last_fault_s, from_s + for_s);
    }
}

/* A car ahead of one that drives OWN_MPS, up to FAR_M away. */
static void draw_lead(double own_mps, double far_m, bool may_be_aside)
{
    double gap_m = between(0.1, 1) * far_m, lead_mps = between(0, 1.1) * own_mps;

    reason_s = 0;
    is_aside = false;
    switch ((int)between(0, 5)) {
    case 0: /* it stands */
        lead_mps = 0;
        break;
    case 1: /* it brakes */
        lead_mps = between(0.8, 1) * own_mps;
        reason_s = between(0.5, 3);
        set("lead.change_s=%.2f", reason_s);
        set("lead.change_mps2=%.2f", -between(1, 8));
        set("lead.change_to_mps=%.2f", between(0, 0.5) * lead_mps);
        break;
    case 2: /* it cuts in */
        lead_mps = between(0.6, 1) * own_mps;
        gap_m = between(0.1, 0.5) * far_m;
        reason_s = between(0.5, 3);
        set("lead.appears_s=%.2f", reason_s);
        break;
    case 3: /* it leaves, or drives beside */
        if (may_be_aside && happens(0.5)) {
            is_aside = true;
            set("lead.lane=%d", happens(0.5) ? 1 : -1);
        } else {
            set("lead.leaves_s=%.2f", between(1, 5));
        }
        break;
    default: /* it is slower */
        break;
    }
    set("lead.gap_m=%.2f", gap_m);
    set("lead.speed_mps=%.2f", fmin(lead_mps, 60));
}

static void draw_car(void)
{
    set("ego.brake_max_mps2=%.2f", between(7.5, 9));
    set("ego.brake_lag_s=%.3f", between(0.15, 0.2));
}

static void draw_radar(void)
{
    double own_mps = between(5, 45);

    set("scenario.duration_s=25");
    set("ego.speed_mps=%.2f", own_mps);
    draw_car();
    if (happens(0.3)) {
        set("road.radius_m=%.0f", (happens(0.5) ? 1 : -1) * between(150, 2000));
    }
    draw_lead(own_mps, 250, true);
    draw_head(25, true);
    if (happens(0.4)) {
        set("front.range_noise_m=%.2f", between(0, 0.5));
        set("front.closing_noise_mps=%.2f", between(0, 0.15));
        set("front.azimuth_noise_deg=%.2f", between(0, 0.1));
    }
}

static void draw_gap(void)
{
    double own_mps = between(0, 30);

    set("scenario.duration_s=15");
    set("ego.speed_mps=%.2f", own_mps);
    draw_car();
    set("cruise.set_mps=%.1f", fmin(own_mps * between(0.9, 1.3), 45));
    draw_lead(own_mps, 5 + 4 * own_mps, false);
    draw_head(15, true);
    if (happens(0.4)) {
        set("noise.gap_m=%.2f", between(0, 0.2));
        set("noise.own_mps=%.2f", between(0, 0.05));
        set("noise.lead_mps=%.2f", between(0, 0.1));
        set("noise.lead_mps2=%.2f", between(0, 0.3));
    }
}

/* A second robot: it cuts in, or the first one leaves the lane before it. */
static void draw_second_robot(double gap_m)
{
    reason_s = between(1, 8);
    if (happens(0.5)) {
        set("lead.leaves_s=%.2f", reason_s);
        set("lead2.gap_m=%.2f", gap_m + between(0.5, 8));
    } else {
        set("lead2.appears_s=%.2f", reason_s);
        set("lead2.gap_m=%.2f", between(0.5, 5));
    }
    set("lead2.speed_mps=%.2f", between(0, 2));
}

static void draw_follow(void)
{
    double gap_m = between(0.3, 9.5);

    set("scenario.duration_s=20");
    set("ego.speed_mps=%.2f", between(0, 2));
    set("lead.gap_m=%.2f", gap_m);
    set("lead.speed_mps=%.2f", between(0, 2));
    reason_s = 0;
    if (happens(0.3)) {
        set("lead.change_s=%.2f", between(1, 8));
        set("lead.change_mps2=%.2f", -between(0.5, 2));
        set("lead.change_to_mps=0");
    }
    if (happens(0.4)) {
        set("lane.lead_mps=%.2f", between(0.5, 2));
    }
    set("lane.change_m=%.2f", between(0.5, 1.5));
    if (happens(0.3)) {
        draw_second_robot(gap_m);
    }
    draw_head(20, true);
    if (happens(0.4)) {
        set("noise.gap_m=%.3f", between(0, 0.02));
        set("noise.own_mps=%.3f", between(0, 0.02));
        set("noise.lead_mps=%.3f", between(0, 0.02));
    }
}

static void draw_park(void)
{
    set("scenario.duration_s=25");
    set("park.x_m=%.2f", between(-39, 39));
    set("park.y_m=%.2f", between(0.1, 39));
    set("park.heading_deg=%.1f", between(-180, 180));
    set("park.speed_mps=%.2f", between(1, 5));
    draw_head(25, false);
    if (happens(0.4)) {
        set("noise.place_m=%.3f", between(0, 0.02));
        set("noise.heading_deg=%.2f", between(0, 0.2));
    }
}

static const struct kind kinds[] = {
    /* The radar's law begins at 100 m, where a scale of 2 % costs 2 m. */
    {"radar", draw_radar, 1, 2, 7.5, 0.7},
    {"gap", draw_gap, 1, 1, 7.5, 0.5},
    {"follow", draw_follow, 0.15, 0.15, 2, 0.4},
    {"park", draw_park, 0, 0, 0, 0},
};

/* --- what full braking would come to ---------------------------------------------------------- */

/* The same world with nobody at the pins but one who brakes fully from BRAKES_S on: the smallest
 * gap, or -1 for an impact. */
static double best_gap_m(const struct scenario *scenario, double brakes_s)
{
    const struct world_class *class = scenario->world;
    struct world *world = class->create(scenario, (uint64_t)scenario->seed, STEP_US * 1000);
    static const int64_t period_ns = 100000000, pulse_ns = 20000;
    bool levels[BOARD_OUTPUTS] = {[PIN_LAMP] = true, [PIN_BUZZER] = true, [PIN_LANE] = true};
    struct outcome outcome;
    int64_t end_ns = (int64_t)(scenario->duration_s * 1e9), t_ns = 0;
    bool brakes = false;

    outcome_clear(&outcome);
    class->start(world, levels);
    for (; t_ns < end_ns && !class->is_over(world); t_ns += period_ns) {
        uint8_t bytes[WORLD_BYTES];

        class->advance(world, t_ns);
        if (!brakes && (double)t_ns * 1e-9 >= brakes_s) {
            brakes = true;
            class->pin_changed(world, t_ns, PIN_STOP, true);
        }
        class->pin_changed(world, t_ns, PIN_TRIGGER, true);
        class->pin_changed(world, t_ns + pulse_ns, PIN_TRIGGER, false);
        class->advance(world, t_ns + period_ns / 2);
        class->take_bytes(world, t_ns + period_ns / 2, bytes);
    }
    class->measure(world, t_ns, &outcome);
    class->destroy(world);
    return outcome.values[METRIC_IMPACT] > 0 ? -1 : outcome.values[METRIC_MIN_GAP];
}

/* --- flags ------------------------------------------------------------------------------------ */

struct watch {
    const struct kind *kind;
    int gap, own, lead, brake; /* columns, or -1 */
    double near_since_s;
    bool is_near_flagged;
};

static int column_of(const struct world_class *class, const char *name)
{
    for (int i = 0; i < class->column_count; i++) {
        if (strcmp(class->columns[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

/* No brake, though the car needs all of it soon. */
static void look(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
                 const struct telemetry *telemetry)
{
    struct watch *watch = user;
    double t_s = (double)t_ns * 1e-9, gap_m = values[watch->gap];
    double closing_mps = values[watch->own] - values[watch->lead];
    bool is_near = !is_aside && !isnan(gap_m) && closing_mps > 0.1 &&
                   gap_m < closing_mps * watch->kind->late_s +
                               closing_mps * closing_mps / 2 / watch->kind->brake_mps2;

    (void)telemetry;
    if (!is_near || values[watch->brake] > 0) {
        watch->near_since_s = t_s;
    }
    watch->is_near_flagged |= t_s - watch->near_since_s > watch->kind->late_s;
}

static bool reached(const struct outcome *outcome, const char *state)
{
    return strstr(outcome->states, state) != NULL;
}

static int run_image(const char *hex, const struct board *board, const struct scenario *scenario,
                     const struct run_observer *observer, struct outcome *outcome, double *end_s)
{
    struct run_setup setup = {.engine = &fast_engine,
                              .hex = hex,
                              .board = board,
                              .scenario = scenario,
                              .seed = (uint64_t)scenario->seed,
                              .quantum_us = RUN_QUANTUM_US,
                              .step_us = STEP_US,
                              .guess = true};
    struct run run;
    int status = run_scenario(&run, &setup, observer, observer != NULL);

    *outcome = run.outcome;
    outcome->uart = "";
    *end_s = (double)run.duration_ns * 1e-9;
    run_free(&run);
    return status;
}

/* The drive's settings without those of the head and its noise. */
static int without_noise(char *settings[LINES])
{
    static const char *const dropped[] = {"head.", "frame.", "noise.", "front."};
    int count = 0;

    for (int i = 0; i < line_count; i++) {
        bool drop = false;

        for (size_t k = 0; k < sizeof dropped / sizeof dropped[0]; k++) {
            drop |= strncmp(lines[i], dropped[k], strlen(dropped[k])) == 0;
        }
        if (!drop) {
            settings[count++] = lines[i];
        }
    }
    return count;
}

static void leave(const char *app, uint64_t number, const char *flag)
{
    char path[64];
    size_t section = 0;
    FILE *file;

    snprintf(path, sizeof path, FOLDER "/%s_%llu.scn", app, (unsigned long long)number);
    mkdir(FOLDER, 0777);
    file = fopen(path, "w");
    if (file == NULL) {
        return;
    }
    fprintf(file, "; SPDX-License-Identifier: MIT\n; make attack: %s\n", flag);
    for (int i = 0; i < line_count; i++) {
        size_t length = strcspn(lines[i], ".");

        if (i == 0 || length != section || strncmp(lines[i], lines[i - 1], length) != 0) {
            fprintf(file, "%s[%.*s]\n", i == 0 ? "" : "\n", (int)length, lines[i]);
        }
        section = length;
        fprintf(file, "%.*s = %s\n", (int)(strcspn(lines[i], "=") - length - 1),
                lines[i] + length + 1, strchr(lines[i], '=') + 1);
    }
    fclose(file);
}

/* --- runs ------------------------------------------------------------------------------------- */

static int by_section(const void *a, const void *b)
{
    const char *one = a, *other = b;
    size_t length = strcspn(one, ".");
    int order = strncmp(one, other, length);

    return order != 0 ? order : (int)length - (int)strcspn(other, ".");
}

int lab_attack_head(FILE *out, const char *hex, const char *app, const struct board *board,
                    long seed, long runs)
{
    const struct kind *kind = NULL;
    long flagged = 0, hits = 0, near_hits = 0, counts[FLAGS] = {0};

    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (strncmp(kinds[i].world, app, strlen(kinds[i].world)) == 0) {
            kind = &kinds[i];
        }
    }
    if (kind == NULL) {
        diag_error(hex, 0,
                   "no drives are known for this image; give one of radar, gap, follow, park");
        return -1;
    }
    fprintf(out, "%s\n", hex);
    for (long run = 0; run < runs; run++) {
        uint64_t number = (uint64_t)(seed * 1000000 + run);
        bool flags[FLAGS] = {false}, any = false;
        struct watch watch = {.kind = kind};
        struct run_observer observer = {.user = &watch, .row = look};
        char *settings[LINES];
        struct scenario scenario;
        struct outcome outcome;
        double end_s;

        random_seed(&chance, number);
        line_count = 0;
        set("scenario.title=A drive of make attack");
        set("scenario.app=%s", app);
        set("scenario.seed=%llu", (unsigned long long)(number % 4294967296));
        set("expect.resets=0");
        kind->draw();
        qsort(lines, (size_t)line_count, LINE, by_section);
        for (int i = 0; i < line_count; i++) {
            settings[i] = lines[i];
        }
        if (scenario_from(&scenario, settings, line_count) != EXIT_FINE) {
            return -1;
        }
        watch.gap = column_of(scenario.world, "gap_m");
        watch.own = column_of(scenario.world, "ego_mps");
        watch.lead = column_of(scenario.world, "lead_mps");
        watch.brake = column_of(scenario.world, "brake_pct");
        if (run_image(hex, board, &scenario, watch.gap >= 0 ? &observer : NULL, &outcome, &end_s) !=
            EXIT_FINE) {
            return -1;
        }
        flags[FLAG_DEAD] = last_fault_s > 0 && end_s > last_fault_s + back_s &&
                           strcmp(outcome.final_state, "FAULT") == 0;
        if (outcome.values[METRIC_IMPACT] > 0 || watch.is_near_flagged) {
            struct scenario calm;
            struct outcome calm_outcome;

            if (best_gap_m(&scenario, reason_s + kind->late_s / 2) >= kind->spare_m) {
                if (scenario_from(&calm, settings, without_noise(settings)) != EXIT_FINE ||
                    run_image(hex, board, &calm, NULL, &calm_outcome, &end_s) != EXIT_FINE) {
                    return -1;
                }
                if (calm_outcome.values[METRIC_IMPACT] > 0) {
                    hits++;
                } else if (calm_outcome.values[METRIC_MIN_GAP] < kind->limit_m) {
                    near_hits++;
                } else {
                    flags[FLAG_IMPACT] = outcome.values[METRIC_IMPACT] > 0;
                    flags[FLAG_NEAR] = watch.is_near_flagged;
                }
            }
        }
        flags[FLAG_FAULT] = last_fault_s <= 0 && reached(&outcome, "FAULT");
        flags[FLAG_RESET] = outcome.values[METRIC_RESETS] > 0;
        flags[FLAG_ASTRAY] =
            watch.gap < 0 && reached(&outcome, "ARRIVED") && outcome.values[METRIC_PARKED] <= 0;
        for (enum flag flag = 0; flag < FLAGS; flag++) {
            if (flags[flag]) {
                fprintf(out, "  seed %llu: %s\n", (unsigned long long)number, flag_names[flag]);
                leave(app, number, flag_names[flag]);
                counts[flag]++;
                any = true;
            }
        }
        flagged += any;
    }
    for (enum flag flag = 0; flag < FLAGS; flag++) {
        fprintf(out, "  %ld %s\n", counts[flag], flag_names[flag]);
    }
    if (kind->limit_m > 0) {
        fprintf(out,
                "  and %ld impacts at the limit of the law: with a perfect head it hits, too\n",
                hits);
        fprintf(out, "  and %ld near that limit: with a perfect head it keeps less than %g m\n",
                near_hits, kind->limit_m);
    }
    fprintf(out, "  %ld of %ld drives flagged\n", flagged, runs);
    return (int)flagged;
}
