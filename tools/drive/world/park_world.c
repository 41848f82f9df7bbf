/* SPDX-License-Identifier: MIT */
/* The parking controller's world: a car that drives backwards while the STOP pin lets it, steered
 * by a servo, and a head that tells where it stands. */
#include "base.h"
#include "servo.h"
#include "truck.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The frames of firmware/frames/frame.h and park.h. */
enum { KIND = 4, PAYLOAD_BYTES = 6 };
static const double unit_per_m = 512, turn = 65536;

static const double servo_mid_us = 1500, servo_span_us = 500;
static const double degree = M_PI / 180;
static const int check_frames = 360; /* PLAN_STEPS_MAX of firmware/park/plan.h, and some */
static const double dwell_s = 0.3;   /* what is shown of the car in its place */

struct park_settings {
    struct {
        double x_m, y_m, heading_deg; /* at the start: rear axle's midpoint, axis against +x */
        double speed_mps;             /* backwards */
        double length_m;              /* from axle to axle */
        double width_m, overhang_m;   /* of the car's outline: beyond each axle */
        double place_m;               /* width of the place */
        double steer_deg;             /* for a pulse of 2 ms */
    } park;
    struct {
        double west_m, east_m, south_m, north_m; /* SCENARIO_UNSET: no wall */
    } lot;
    struct {
        double place_m, heading_deg; /* standard deviations */
    } noise;
    struct head_settings head;
};

#define AT(member)                                                                                 \
    offsetof(struct park_settings, park.member) - offsetof(struct park_settings, park)
static const struct key park_keys[] = {
    {.name = "x_m",
     .meaning = "rear axle at the start, beside the place",
     .at = AT(x_m),
     .low = -39,
     .high = 39,
     .required = true},
    {.name = "y_m",
     .meaning = "rear axle at the start, before the place",
     .at = AT(y_m),
     .low = 0.1,
     .high = 39,
     .required = true},
    {.name = "heading_deg",
     .meaning = "direction of the car at the start; 90: that of the place",
     .at = AT(heading_deg),
     .low = -360,
     .high = 360,
     .required = true},
    {.name = "speed_mps",
     .meaning = "speed, backwards",
     .at = AT(speed_mps),
     .low = 0.1,
     .high = 10,
     .initial = 5},
    {.name = "length_m",
     .meaning = "from axle to axle",
     .at = AT(length_m),
     .low = 1,
     .high = 10,
     .initial = 4},
    {.name = "width_m",
     .meaning = "width of the car",
     .at = AT(width_m),
     .low = 0.5,
     .high = 5,
     .initial = 2},
    {.name = "overhang_m",
     .meaning = "how far the car reaches beyond each axle",
     .at = AT(overhang_m),
     .high = 5,
     .initial = 0.9},
    {.name = "place_m",
     .meaning = "width of the place",
     .at = AT(place_m),
     .low = 0.5,
     .high = 10,
     .initial = 3},
    {.name = "steer_deg",
     .meaning = "steering angle at a pulse of 2 ms",
     .at = AT(steer_deg),
     .low = 1,
     .high = 80,
     .initial = 45},
};
#undef AT

static const struct section park_section = {
    .name = "park",
    .meaning = "a car that drives backwards to its place, at x = 0 and y = 0",
    SECTION_KEYS(park_keys),
    .size = sizeof(((struct park_settings *)NULL)->park)};

#define AT(member) offsetof(struct park_settings, lot.member) - offsetof(struct park_settings, lot)
static const struct key lot_keys[] = {
    {.name = "west_m",
     .meaning = "how far the wall at negative x is from the middle of the place",
     .at = AT(west_m),
     .low = 0.1,
     .high = 100,
     .initial = SCENARIO_UNSET,
     .unset = "no wall"},
    {.name = "east_m",
     .meaning = "the same of the wall at positive x",
     .at = AT(east_m),
     .low = 0.1,
     .high = 100,
     .initial = SCENARIO_UNSET,
     .unset = "no wall"},
    {.name = "south_m",
     .meaning = "how far the wall behind the place is from y = 0",
     .at = AT(south_m),
     .low = 0.1,
     .high = 100,
     .initial = SCENARIO_UNSET,
     .unset = "no wall"},
    {.name = "north_m",
     .meaning = "the same of the wall at positive y",
     .at = AT(north_m),
     .low = 0.1,
     .high = 100,
     .initial = SCENARIO_UNSET,
     .unset = "no wall"},
};
#undef AT

static const struct section lot_section = {
    .name = "lot",
    .meaning = "walls around a parking lot; the car drives on when it touches one",
    SECTION_KEYS(lot_keys),
    .size = sizeof(((struct park_settings *)NULL)->lot)};

#define AT(member)                                                                                 \
    offsetof(struct park_settings, noise.member) - offsetof(struct park_settings, noise)
static const struct key noise_keys[] = {
    {.name = "place_m", .meaning = "standard deviation of x and y", .at = AT(place_m), .high = 5},
    {.name = "heading_deg",
     .meaning = "standard deviation of the heading",
     .at = AT(heading_deg),
     .high = 45},
};
#undef AT

static const struct section noise_section = {.name = "noise",
                                             .meaning = "noise of what the head measures",
                                             SECTION_KEYS(noise_keys),
                                             .size = sizeof(((struct park_settings *)NULL)->noise)};

static const struct section_use sections[] = {
    {.section = &scenario_section,
     .required = true,
     .only = "title app duration_s event_s seed demo"},
    {.section = &park_section, AT_SETTINGS(struct park_settings, park), .required = true},
    {.section = &lot_section, AT_SETTINGS(struct park_settings, lot)},
    {.section = &noise_section, AT_SETTINGS(struct park_settings, noise)},
    HEAD_SECTIONS(struct park_settings, head, "warm_up delay_ms dropout age_frames scale"),
    FLIP_SECTION,
};
WORLD_SETTINGS_FIT(struct park_settings);

struct world {
    struct base base;
    struct truck truck;
    struct lot lot;
    struct park_settings settings;
    struct head head;
    struct servo servo;
    bool levels[BOARD_OUTPUTS];
    bool started, arrived, touches;
    int frames; /* asked for */
    int64_t now_ns, step_ns;
    double event_s, full_steer_rad;
    double steer_rad, seen_rad; /* now; while frames were good */
    double arrived_s, end_x_m, end_turn_rad, stood_s, first_fault_s, alarm_s;
    double blind_steer_rad, stop_toggles, contacts;
};

static const struct world_column columns[] = {
    {"x_m", 4},  {"y_m", 4},  {"heading_deg", 3}, {"steer_deg", 3},
    {"stop", 0}, {"lamp", 0}, {"buzzer", 0},
};
static const char *const reported[] = {"dist_mm", "weight", "servo_us"};

static double now_s(const struct world *world)
{
    return (double)world->now_ns * 1e-9;
}

/* --- the car ------------------------------------------------------------------------------ */

static void note_contact(struct world *world)
{
    bool touches = truck_touches(&world->truck, &world->lot);

    world->contacts += touches && !world->touches;
    world->touches = touches;
}

static void drive(struct world *world, double dt_s)
{
    double used_s = truck_drive(&world->truck, world->steer_rad, dt_s);

    note_contact(world);
    if (world->truck.y_m > 0) {
        return;
    }
    world->arrived = true;
    world->arrived_s = now_s(world) + used_s;
    world->end_x_m = world->truck.x_m;
    world->end_turn_rad = truck_turn_rad(&world->truck);
}

static void advance(struct world *world, int64_t t_ns)
{
    while (world->started && world->now_ns < t_ns) {
        int64_t next_ns = (world->now_ns / world->step_ns + 1) * world->step_ns;
        bool stands = world->levels[PIN_STOP] || world->arrived;

        if (next_ns > t_ns) {
            next_ns = t_ns;
        }
        if (stands && now_s(world) >= world->event_s && isinf(world->stood_s)) {
            world->stood_s = now_s(world);
        }
        if (!stands) {
            drive(world, (double)(next_ns - world->now_ns) * 1e-9);
        }
        world->now_ns = next_ns;
    }
}

static void steer(struct world *world)
{
    double part = (world->servo.pulse_us - servo_mid_us) / servo_span_us;

    world->steer_rad = fmin(fmax(part, -1), 1) * world->full_steer_rad;
    if (!world->started || world->now_ns < head_blind_ns(&world->head)) {
        world->seen_rad = world->steer_rad;
    }
    world->blind_steer_rad = fmax(world->blind_steer_rad, fabs(world->steer_rad - world->seen_rad));
}

/* --- frames ------------------------------------------------------------------------------- */

/* A place in m with noise, as the frame's sixteen bits hold it. */
static long measured(struct world *world, double place_m)
{
    double noisy_m = head_distance(&world->head, place_m, world->settings.noise.place_m);

    return head_limited(noisy_m * unit_per_m, -32768, 32767);
}

static void measure_place(struct world *world, uint8_t payload[HEAD_PAYLOAD_MAX])
{
    double deviation_rad = world->settings.noise.heading_deg * degree;

    world->frames++;
    head_put_16(payload, measured(world, world->truck.x_m));
    head_put_16(payload + 2, measured(world, world->truck.y_m));
    head_put_16(payload + 4,
                lround(head_noisy(&world->head, world->truck.heading_rad, deviation_rad) /
                       (2 * M_PI) * turn));
}

static void spoil(struct random *random, uint8_t *payload)
{
    static const struct head_value impossible[] = {
        {0, 2, 20481}, {0, 2, -20481}, {2, 2, 20481}, {2, 2, -513}, {2, 2, -32768}};

    head_spoil_one(random, payload, impossible, sizeof impossible / sizeof impossible[0]);
}

/* --- pins --------------------------------------------------------------------------------- */

static void pin_changed(struct world *world, int64_t t_ns, enum board_pin pin, bool level)
{
    advance(world, t_ns);
    world->levels[pin] = level;
    switch (pin) {
    case PIN_SERVO:
        if (servo_edge(&world->servo, t_ns, level)) {
            steer(world);
        }
        break;
    case PIN_STOP:
        world->stop_toggles += world->started;
        break;
    case PIN_BUZZER:
        if (!level && world->started && now_s(world) >= world->event_s) {
            world->alarm_s = fmin(world->alarm_s, now_s(world));
        }
        break;
    case PIN_TRIGGER:
        base_trigger(world, t_ns, level);
        break;
    default:
        break;
    }
}

/* --- life and outcome --------------------------------------------------------------------- */

static double wall_m(double setting_m)
{
    return setting_m > 0 ? setting_m : INFINITY;
}

static struct world *create(const struct scenario *scenario, uint64_t seed, int64_t step_ns)
{
    struct world *world = base_create(sizeof *world);

    memcpy(&world->settings, scenario->settings, sizeof world->settings);
    world->base = (struct base){.head = &world->head, .sense = measure_place};
    world->truck = (struct truck){.x_m = world->settings.park.x_m,
                                  .y_m = world->settings.park.y_m,
                                  .heading_rad = world->settings.park.heading_deg * degree,
                                  .speed_mps = world->settings.park.speed_mps,
                                  .length_m = world->settings.park.length_m,
                                  .width_m = world->settings.park.width_m,
                                  .overhang_m = world->settings.park.overhang_m};
    world->lot = (struct lot){.west_m = -wall_m(world->settings.lot.west_m),
                              .east_m = wall_m(world->settings.lot.east_m),
                              .south_m = -wall_m(world->settings.lot.south_m),
                              .north_m = wall_m(world->settings.lot.north_m)};
    world->full_steer_rad = world->settings.park.steer_deg * degree;
    world->event_s = scenario->event_s;
    world->step_ns = step_ns;
    world->arrived_s = world->stood_s = world->first_fault_s = world->alarm_s = INFINITY;
    world->end_x_m = world->end_turn_rad = INFINITY;
    memset(world->levels, true, sizeof world->levels);
    servo_init(&world->servo, true);
    head_init(&world->head, &world->settings.head, seed, KIND, PAYLOAD_BYTES, spoil);
    return world;
}

static void start(struct world *world, const bool levels[BOARD_OUTPUTS])
{
    memcpy(world->levels, levels, sizeof world->levels);
    world->started = true;
    base_start(world);
    note_contact(world);
}

/* The controller checks the start before it drives: the scenario begins when it lets go of the
 * brake, or when it will not. */
static bool is_warm(const struct world *world)
{
    return base_is_warm(world) && (!world->levels[PIN_STOP] || world->frames >= check_frames ||
                                   world->settings.head.head.warm_up <= 0);
}

static void state_reported(struct world *world, int64_t t_ns, const char *state)
{
    double t_s = (double)t_ns * 1e-9;

    if (strcmp(state, "FAULT") == 0 && t_s >= world->event_s) {
        world->first_fault_s = fmin(world->first_fault_s, t_s);
    }
}

static bool is_over(const struct world *world)
{
    return world->arrived && world->levels[PIN_STOP] && now_s(world) > world->arrived_s + dwell_s;
}

static void values(const struct world *world, double row[WORLD_COLUMNS])
{
    row[0] = world->truck.x_m;
    row[1] = world->truck.y_m;
    row[2] = remainder(world->truck.heading_rad, 2 * M_PI) / degree;
    row[3] = world->steer_rad / degree;
    row[4] = world->levels[PIN_STOP];
    row[5] = !world->levels[PIN_LAMP];
    row[6] = !world->levels[PIN_BUZZER];
}

static void tell(const struct outcome *outcome, const struct scenario *scenario)
{
    const double *value = outcome->values;

    printf("%s: ", scenario->title);
    if (isinf(value[METRIC_ARRIVES_WITHIN])) {
        printf("never came to Y = 0\n");
    } else {
        printf("%s, %.3f m beside the place and turned by %.2f degrees, after %.2f s\n",
               value[METRIC_PARKED] > 0 ? "parked" : "not parked, the start is in the dead zone",
               value[METRIC_END_X], value[METRIC_END_TURN],
               value[METRIC_ARRIVES_WITHIN] + scenario->event_s);
    }
}

static void measure(const struct world *world, int64_t t_ns, struct outcome *outcome)
{
    double *value = outcome->values;

    (void)t_ns;
    value[METRIC_PARKED] =
        world->arrived && truck_fits(&world->truck, world->settings.park.place_m);
    value[METRIC_CONTACTS] = world->contacts;
    value[METRIC_END_X] = world->end_x_m;
    value[METRIC_END_TURN] = world->end_turn_rad / degree;
    value[METRIC_ARRIVES_WITHIN] = world->arrived_s - world->event_s;
    value[METRIC_STOP_WITHIN] = world->stood_s - world->event_s;
    value[METRIC_STOP_TOGGLES] = world->stop_toggles;
    value[METRIC_FAULT_WITHIN] = world->first_fault_s - world->event_s;
    value[METRIC_ALARM_WITHIN] = world->alarm_s - world->event_s;
    value[METRIC_BLIND_STEER] = world->blind_steer_rad / degree;
}

/* A line in that direction: one of - / | \ */
static char stroke(double angle_deg)
{
    return "-/|\\"[(int)(lround(angle_deg / 45) % 4 + 4) % 4];
}

/* The yard from above: the place at x = y = 0, the car, the way that its rear axle has gone, its
 * front wheels. */
static void draw(struct picture *picture, const struct scenario *scenario, const double *values,
                 const struct telemetry *telemetry)
{
    static const double margin = 1.25, half_place_m = 1;
    enum { BELOW_ROWS = 2 }; /* room below y = 0 */
    const struct park_settings *settings = (const void *)scenario->settings;
    double length_m = settings->park.length_m;
    double high_m = margin * (settings->park.y_m + length_m) / (PLAN_ROWS_MAX - BELOW_ROWS);
    double wide_m = 4 * (margin * fabs(settings->park.x_m) + length_m) / picture->width;
    double row_m = fmax(high_m, wide_m); /* a character is half as wide as it is high */
    double x_m = values[0], y_m = values[1], heading_deg = values[2], steer_deg = values[3];
    double along_x = cos(heading_deg * degree), along_y = sin(heading_deg * degree);

    (void)telemetry;
    plan_begin(picture, PLAN_ROWS_MAX, row_m, row_m / 2, PLAN_ROWS_MAX - 1 - BELOW_ROWS);
    plan_mark(picture, x_m, y_m, '.');
    for (double part_m = 0; part_m <= length_m; part_m += row_m / 4) {
        plan_put(picture, -half_place_m - row_m / 4, part_m, '[');
        plan_put(picture, half_place_m + row_m / 4, part_m, ']');
    }
    for (double part_m = 0; part_m <= length_m; part_m += row_m / 4) {
        plan_put(picture, x_m + part_m * along_x, y_m + part_m * along_y, '#');
    }
    plan_put(picture, x_m, y_m, 'o');
    plan_put(picture, x_m + length_m * along_x, y_m + length_m * along_y,
             stroke(heading_deg + steer_deg));
    plan_draw(picture);
    picture_text(picture, " x %6.2f m  y %6.2f m  steering %5.1f deg", x_m, y_m, steer_deg);
    picture_end(picture);
}

const struct world_class park_world = {
    .name = "park",
    .meaning = "parks a car backwards",
    WORLD_SECTIONS(sections),
    BASE_TRACE(columns, reported),
    .create = create,
    .destroy = base_destroy,
    .start = start,
    .pin_changed = pin_changed,
    .advance = advance,
    BASE_HEAD_FUNCTIONS,
    .is_warm = is_warm,
    .state_reported = state_reported,
    .is_over = is_over,
    .values = values,
    .draw = draw,
    .tell = tell,
    .measure = measure,
};
