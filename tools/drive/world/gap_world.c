/* SPDX-License-Identifier: MIT */
/* The gap controller's world: two cars on a lane, a head that measures gap and speeds, a brake that
 * follows the PWM and a throttle that follows a servo's pulses. */
#include "base.h"
#include "servo.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The frames of firmware/frames/frame.h and gap.h: lengths in cm, speeds in cm/s. */
enum {
    KIND = 2,
    PAYLOAD_BYTES = 9,
    GAP_MAX_CM = 25000,
    SPEED_MAX_CMPS = 5000,
    ACCEL_MAX_CMPS2 = 1500,
    SET_STEP_CMPS = 20
};

static const double slope_s = 0.001; /* over which the head takes the lead's acceleration */

enum { SHAPE_NS = 10000000 };

struct gap_settings {
    struct {
        double set_mps;
    } cruise;
    struct head_noise noise;
    struct head_settings head;
};

static const struct key cruise_keys[] = {
    {.name = "set_mps",
     .meaning = "the speed that the driver has set, in steps of 0.2 m/s",
     .at = 0,
     .high = 45,
     .initial = 45},
};

static const struct section cruise_section = {.name = "cruise",
                                              .meaning = "what the driver wants",
                                              SECTION_KEYS(cruise_keys),
                                              .size =
                                                  sizeof(((struct gap_settings *)NULL)->cruise)};

static const struct section_use sections[] = {
    {.section = &scenario_section, .required = true},
    {.section = &ego_section, AT_SCENARIO(ego), .required = true},
    {.section = &lead_section, AT_SCENARIO(lead), .only = LEAD_KEYS_OF_A_HEAD},
    {.section = &cruise_section, AT_SETTINGS(struct gap_settings, cruise)},
    {.section = &head_noise_section, AT_SETTINGS(struct gap_settings, noise)},
    HEAD_SECTIONS(struct gap_settings, head, NULL),
    FLIP_SECTION,
};
WORLD_SETTINGS_FIT(struct gap_settings);

/* The run's shape, looked at every SHAPE_NS. */
struct shape {
    int64_t next_ns;
    double event_accel_mps2;             /* at event_s */
    double peak_mps2, peak_s;            /* the hardest braking */
    double least_since_mps2, again_mps2; /* after it: the least, and the most that it grew again */
    double top_mps, closing_mps, closing_s;
};

struct world {
    struct base base;
    struct rig rig;
    struct head head;
    struct gap_settings settings;
    struct servo servo;
    struct shape shape;
};

static const struct world_column columns[] = {RIG_COLUMN_NAMES, {"throttle_pct", 1}};
static const char *const reported[] = {"gap_cm", "safe_cm", "accel_cmps2"};

/* --- what the head measures --------------------------------------------------------------- */

static double lead_accel_mps2(const struct car *car)
{
    double now_s = (double)car->now_ns * 1e-9, before_mps, after_mps;

    if (!car->targets[0].there) {
        return 0;
    }
    car_lead_path_m(&car->targets[0].lead, now_s, &before_mps);
    car_lead_path_m(&car->targets[0].lead, now_s + slope_s, &after_mps);
    return (after_mps - before_mps) / slope_s;
}

static long speed_cmps(struct world *world, double speed_mps, double deviation_mps)
{
    return head_limited(head_speed(&world->head, speed_mps, deviation_mps) * 100, 0,
                        SPEED_MAX_CMPS);
}

/* Without a car ahead: the end of the range, at the own speed. */
static void measure_all(struct world *world, uint8_t payload[HEAD_PAYLOAD_MAX])
{
    const struct gap_settings *settings = &world->settings;
    const struct car *car = &world->rig.car;
    double lead_mps = car->targets[0].there ? car_lead_mps(car) : car->v_mps;

    double gap_m = head_distance(&world->head, car_gap_m(car), settings->noise.gap_m);
    double accel_mps2 = head_noisy(&world->head, lead_accel_mps2(car), settings->noise.lead_mps2);

    head_put_16(payload, head_limited(gap_m * 100, 0, GAP_MAX_CM));
    head_put_16(payload + 2, speed_cmps(world, car->v_mps, settings->noise.own_mps));
    head_put_16(payload + 4, speed_cmps(world, lead_mps, settings->noise.lead_mps));
    head_put_16(payload + 6, head_limited(accel_mps2 * 100, -ACCEL_MAX_CMPS2, ACCEL_MAX_CMPS2));
    payload[8] = (uint8_t)lround(settings->cruise.set_mps * 100 / SET_STEP_CMPS);
}

static void spoil(struct random *random, uint8_t *payload)
{
    static const struct head_value impossible[] = {
        {0, 2, GAP_MAX_CM + 1}, {2, 2, SPEED_MAX_CMPS + 1},
        {4, 2, 65535},          {6, 2, ACCEL_MAX_CMPS2 + 1},
        {6, 2, -32768},         {8, 1, 226}};

    head_spoil_one(random, payload, impossible, sizeof impossible / sizeof impossible[0]);
}

/* --- time and pins ------------------------------------------------------------------------ */

static void note_shape(struct world *world)
{
    struct shape *shape = &world->shape;
    const struct car *car = &world->rig.car;
    double t_s = (double)shape->next_ns * 1e-9;
    double decel_mps2 = -car->accel_mps2, closing_mps = car->v_mps - car_lead_mps(car);

    if (isinf(shape->event_accel_mps2) && shape->next_ns >= world->rig.event_ns) {
        shape->event_accel_mps2 = car->accel_mps2;
    }
    if (decel_mps2 > shape->peak_mps2) {
        shape->peak_mps2 = shape->least_since_mps2 = decel_mps2;
        shape->peak_s = t_s;
        shape->again_mps2 = 0;
    }
    shape->least_since_mps2 = fmin(shape->least_since_mps2, decel_mps2);
    shape->again_mps2 = fmax(shape->again_mps2, decel_mps2 - shape->least_since_mps2);
    shape->top_mps = fmax(shape->top_mps, car->v_mps);
    if (closing_mps > shape->closing_mps) {
        shape->closing_mps = closing_mps;
        shape->closing_s = t_s;
    }
}

static void advance(struct world *world, int64_t t_ns)
{
    while (world->rig.started && world->shape.next_ns <= t_ns) {
        rig_advance(&world->rig, world->shape.next_ns);
        note_shape(world);
        world->shape.next_ns += SHAPE_NS;
    }
    base_advance(world, t_ns);
}

static void pin_changed(struct world *world, int64_t t_ns, enum board_pin pin, bool level)
{
    advance(world, t_ns);
    rig_pin(&world->rig, t_ns, pin, level);
    if (pin == PIN_SERVO && servo_edge(&world->servo, t_ns, level)) {
        rig_throttle(&world->rig, servo_throttle_pct(&world->servo));
    }
    if (pin == PIN_TRIGGER) {
        base_trigger(world, t_ns, level);
    }
}

/* --- life and outcome --------------------------------------------------------------------- */

static struct world *create(const struct scenario *scenario, uint64_t seed, int64_t step_ns)
{
    struct world *world = base_create(sizeof *world);

    world->base = (struct base){.rig = &world->rig, .head = &world->head, .sense = measure_all};
    rig_init(&world->rig, scenario, step_ns);
    memcpy(&world->settings, scenario->settings, sizeof world->settings);
    head_init(&world->head, &world->settings.head, seed, KIND, PAYLOAD_BYTES, spoil);
    world->shape =
        (struct shape){.event_accel_mps2 = INFINITY, .peak_s = INFINITY, .closing_s = INFINITY};
    return world;
}

static void start(struct world *world, const bool levels[BOARD_OUTPUTS])
{
    base_start(world);
    servo_restart(&world->servo, levels[PIN_SERVO]);
    rig_throttle(&world->rig, servo_throttle_pct(&world->servo));
    rig_start(&world->rig, levels);
}

static void values(const struct world *world, double row[WORLD_COLUMNS])
{
    rig_values(&world->rig, row);
    row[RIG_COLUMNS] = world->rig.throttle_pct;
}

static void measure(const struct world *world, int64_t t_ns, struct outcome *outcome)
{
    double *value = outcome->values;

    rig_measure(&world->rig, t_ns, outcome);
    value[METRIC_EVENT_ACCEL] = world->shape.event_accel_mps2;
    value[METRIC_PEAK_DECEL_AT] = world->shape.peak_s;
    value[METRIC_DECEL_AGAIN] = world->shape.again_mps2;
    value[METRIC_TOP_SPEED] = world->shape.top_mps;
    value[METRIC_CLOSING_PEAK_AT] = world->shape.closing_s;
}

/* The road, with a mark where the safe distance ends. */
static void draw(struct picture *picture, const struct scenario *scenario, const double *values,
                 const struct telemetry *telemetry)
{
    const char *safe_cm = telemetry_value(telemetry, "safe_cm");
    double safe_m = safe_cm[0] == '\0' ? NAN : strtod(safe_cm, NULL) / 100;

    (void)scenario;
    rig_draw_road(picture, values, safe_m);
    picture_bar(picture, "safe |", safe_m, "m", isnan(safe_m) ? 0 : safe_m / picture->view_m);
    picture_bar(picture, "throttle", values[RIG_COLUMNS], "%", values[RIG_COLUMNS] / 100);
    rig_draw_bars(picture, values);
}

const struct world_class gap_world = {
    .name = "gap",
    .meaning = "keeps a safe distance by throttle and brake",
    WORLD_SECTIONS(sections),
    BASE_TRACE(columns, reported),
    .create = create,
    .destroy = base_destroy,
    .start = start,
    .pin_changed = pin_changed,
    .advance = advance,
    .is_warm = base_is_warm,
    BASE_HEAD_FUNCTIONS,
    BASE_RIG_FUNCTIONS,
    .values = values,
    .draw = draw,
    .measure = measure,
};
