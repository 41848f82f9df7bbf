/* SPDX-License-Identifier: MIT */
/* The follower's world: a robot behind others, and a lane beside them. Robots move in steps of
 * 0.1 s, each begun by the controller's trigger: what its pins say when the next one comes is the
 * acceleration of the step between. */
#include "base.h"
#include "car.h"
#include "pwm.h"
#include "robots.h"
#include "servo.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The frames of firmware/frames/frame.h and follow.h: lengths in mm, speeds in mm/s. */
enum { KIND = 3, PAYLOAD_BYTES = 9, GAP_MAX_MM = 20000, SPEED_MAX_MMPS = 2500 };

struct follow_settings {
    struct {
        double lead_mps; /* of the robot in the other lane; unset: that lane is taken */
        double change_m; /* what the head says: nearer, the robot does not change lanes */
    } lane;
    struct head_noise noise;
    struct head_settings head;
};

#define AT(member)                                                                                 \
    offsetof(struct follow_settings, lane.member) - offsetof(struct follow_settings, lane)
static const struct key lane_keys[] = {
    {.name = "lead_mps",
     .meaning = "speed of the robot in the other lane",
     .at = AT(lead_mps),
     .high = 2,
     .initial = SCENARIO_UNSET,
     .unset = "the lane is taken"},
    {.name = "change_m",
     .meaning = "the change distance that the head says: nearer, the robot slows down instead",
     .at = AT(change_m),
     .low = 0.5,
     .high = 1.9,
     .initial = 1},
};
#undef AT

static const struct section lane_section = {.name = "lane",
                                            .meaning = "the other lane",
                                            SECTION_KEYS(lane_keys),
                                            .size = sizeof(((struct follow_settings *)NULL)->lane)};

static const struct section_use sections[] = {
    {.section = &scenario_section, .required = true},
    {.section = &ego_section, AT_SCENARIO(ego), .required = true, .only = "speed_mps"},
    {.section = &lead_section,
     AT_SCENARIO(leads),
     .required = true,
     .copies = LEADS_MAX,
     .only = "gap_m speed_mps change_s change_mps2 change_to_mps profile appears_s leaves_s"},
    {.section = &lane_section, AT_SETTINGS(struct follow_settings, lane)},
    {.section = &head_noise_section,
     AT_SETTINGS(struct follow_settings, noise),
     .only = "gap_m own_mps lead_mps"},
    HEAD_SECTIONS(struct follow_settings, head, NULL),
    FLIP_SECTION,
};
WORLD_SETTINGS_FIT(struct follow_settings);

struct world {
    struct base base;
    struct robots robots;
    struct lead leads[LEADS_MAX];
    struct robot_ahead ahead[LEADS_MAX]; /* those of leads */
    struct follow_settings settings;
    struct head head;
    struct pwm pwm;
    struct servo servo;
    bool levels[BOARD_OUTPUTS];
    bool started, stepping; /* stepping: the first trigger of the scenario is over */
    int64_t now_ns, event_ns;
    double event_s, hold_s;
    double accel_mmps2; /* of the last step */
    /* what is measured */
    double max_brake_pct, min_brake_pct, counted_pct, duty_steps, stop_toggles;
    double asked_s, changed_s, first_fault_s, alarm_s, warnings, impact_mps, rest_s;
    /* on bad frames; seen_pct: before them */
    double seen_pct, blind_fall_pct, blind_rise_pct, blind_asks;
};

static const struct world_column columns[] = {
    {"gap_m", 3},        {"ego_mps", 3}, {"lead_mps", 3}, {"accel_mps2", 2}, {"brake_pct", 1},
    {"throttle_pct", 1}, {"stop", 0},    {"lamp", 0},     {"asks_lane", 0},  {"lane", 0},
};

enum {
    COLUMN_GAP,
    COLUMN_OWN_SPEED,
    COLUMN_LEAD_SPEED,
    COLUMN_ACCEL,
    COLUMN_BRAKE,
    COLUMN_THROTTLE,
    COLUMN_STOP,
    COLUMN_LAMP,
    COLUMN_ASKS_LANE,
    COLUMN_LANE
};

static const char *const reported[] = {"command", "change"};

static double seconds(int64_t t_ns)
{
    return (double)t_ns * 1e-9;
}

/* --- actuators ---------------------------------------------------------------------------- */

static double brake_pct(const struct world *world)
{
    return world->levels[PIN_STOP] ? 100 : world->pwm.duty_pct;
}

static bool asks_for_lane(const struct world *world)
{
    return !world->levels[PIN_LANE];
}

/* The controller cannot know more than before. */
static bool is_blind(const struct world *world)
{
    return head_blind_ns(&world->head) <= world->now_ns;
}

static void note_demand(struct world *world)
{
    double brake = brake_pct(world);
    double demand = brake > 0 ? brake : -servo_throttle_pct(&world->servo);

    if (is_blind(world)) {
        world->blind_fall_pct = fmax(world->blind_fall_pct, world->seen_pct - demand);
        world->blind_rise_pct = fmax(world->blind_rise_pct, demand - world->seen_pct);
    } else {
        world->seen_pct = demand;
    }
    world->max_brake_pct = fmax(world->max_brake_pct, brake);
    if (world->now_ns >= world->event_ns) {
        world->min_brake_pct = fmin(world->min_brake_pct, brake);
    }
    if (fabs(demand - world->counted_pct) > 2) {
        world->counted_pct = demand;
        world->duty_steps++;
    }
}

/* --- time --------------------------------------------------------------------------------- */

static void advance(struct world *world, int64_t t_ns)
{
    while (world->now_ns < t_ns) {
        int64_t steady = pwm_steady_ns(&world->pwm);

        world->now_ns = steady < t_ns ? steady : t_ns;
        if (steady <= t_ns) {
            pwm_settle(&world->pwm);
        }
        note_demand(world);
    }
}

/* The robots in the own lane as they are at the beginning of a step. */
static void set_ahead(struct world *world)
{
    double t_s = world->robots.step * ROBOTS_STEP_MS / 1000.0, speed_mps;

    if (world->robots.changed_step >= 0 || world->robots.collided) {
        return;
    }
    for (int i = 0; i < LEADS_MAX; i++) {
        struct robot_ahead *ahead = &world->ahead[i];
        bool is_there = car_lead_is_there(&world->leads[i], t_s);

        if (is_there && !ahead->there) {
            ahead->gap_um = (int32_t)lround(world->leads[i].gap_m * 1e6);
        }
        ahead->there = is_there;
        car_lead_path_m(&world->leads[i], t_s, &speed_mps);
        ahead->mmps = (int)lround(speed_mps * 1000);
    }
    robots_see_nearest(&world->robots, world->ahead, LEADS_MAX);
}

static void step(struct world *world)
{
    double brake = brake_pct(world), throttle = servo_throttle_pct(&world->servo);
    bool was_changed = world->robots.changed_step >= 0;

    if (world->robots.collided) {
        return;
    }
    world->accel_mmps2 = (brake > 0 ? -brake : throttle) / 100 * ROBOTS_ACCEL_MAX_MMPS2;
    robots_step(&world->robots, world->accel_mmps2, asks_for_lane(world));
    robots_move_ahead(&world->robots, world->ahead, LEADS_MAX);
    if (world->robots.collided) {
        world->impact_mps = (world->robots.own_mmps - world->robots.lead_mmps) / 1000.0;
    }
    if (world->robots.changed_step >= 0 && !was_changed) {
        world->changed_s = seconds(world->now_ns);
    }
    set_ahead(world);
    if (world->robots.own_mmps > 0 || world->robots.lead_mmps > 0) {
        world->rest_s = INFINITY;
    } else if (isinf(world->rest_s)) {
        world->rest_s = seconds(world->now_ns);
    }
}

static long speed_mmps(struct world *world, int speed_mmps, double deviation_mps)
{
    return head_limited(head_speed(&world->head, speed_mmps, deviation_mps * 1000), 0,
                        SPEED_MAX_MMPS);
}

/* A trigger ends the step before it and measures the result. */
static void sense(struct world *world, uint8_t payload[HEAD_PAYLOAD_MAX])
{
    const struct follow_settings *settings = &world->settings;
    double gap_mm;

    if (world->stepping) {
        step(world);
    }
    world->stepping = world->started;
    gap_mm =
        head_distance(&world->head, robots_gap_mm(&world->robots), settings->noise.gap_m * 1000);
    head_put_16(payload, head_limited(gap_mm, 0, GAP_MAX_MM));
    head_put_16(payload + 2, speed_mmps(world, world->robots.own_mmps, settings->noise.own_mps));
    head_put_16(payload + 4, speed_mmps(world, world->robots.lead_mmps, settings->noise.lead_mps));
    payload[6] = !world->robots.lane_is_free;
    head_put_16(payload + 7, lround(settings->lane.change_m * 1000));
}

/* --- pins --------------------------------------------------------------------------------- */

static void pin_changed(struct world *world, int64_t t_ns, enum board_pin pin, bool level)
{
    if (!world->started) { /* the head answers a trigger, nothing moves */
        world->now_ns = t_ns;
        if (pin == PIN_TRIGGER) {
            base_trigger(world, t_ns, level);
        }
        if (pin == PIN_SERVO) {
            servo_edge(&world->servo, t_ns, level);
        }
        return;
    }
    advance(world, t_ns);
    world->levels[pin] = level;
    switch (pin) {
    case PIN_PWM:
        pwm_edge(&world->pwm, t_ns, level);
        break;
    case PIN_STOP:
        world->stop_toggles++;
        break;
    case PIN_SERVO:
        servo_edge(&world->servo, t_ns, level);
        break;
    case PIN_TRIGGER:
        base_trigger(world, t_ns, level);
        break;
    case PIN_LANE:
        if (!level && isinf(world->asked_s)) {
            world->asked_s = seconds(t_ns);
        }
        world->blind_asks += !level && is_blind(world);
        break;
    case PIN_LAMP:
    case PIN_BUZZER:
        world->warnings += !level;
        if (!level && pin == PIN_BUZZER && t_ns >= world->event_ns) {
            world->alarm_s = fmin(world->alarm_s, seconds(t_ns));
        }
        break;
    default:
        break;
    }
    note_demand(world);
}

/* --- life and outcome --------------------------------------------------------------------- */

static void spoil(struct random *random, uint8_t *payload)
{
    static const struct head_value impossible[] = {{0, 2, GAP_MAX_MM + 1},
                                                   {2, 2, SPEED_MAX_MMPS + 1},
                                                   {4, 2, 65535},
                                                   {6, 1, 2},
                                                   {7, 2, 499},
                                                   {7, 2, 1901}};

    head_spoil_one(random, payload, impossible, sizeof impossible / sizeof impossible[0]);
}

static struct world *create(const struct scenario *scenario, uint64_t seed, int64_t step_ns)
{
    struct world *world = base_create(sizeof *world);

    (void)step_ns;
    memcpy(&world->settings, scenario->settings, sizeof world->settings);
    world->base = (struct base){.head = &world->head, .sense = sense};
    memcpy(world->leads, scenario->leads, sizeof world->leads);
    world->robots = (struct robots){
        .gap_um = ROBOTS_NOBODY_UM,
        .own_mmps = (int)lround(scenario->ego.speed_mps * 1000),
        .lane_is_free = world->settings.lane.lead_mps >= 0,
        .new_lead_mmps = (int)lround(fmax(world->settings.lane.lead_mps, 0) * 1000),
    };
    robots_start(&world->robots);
    set_ahead(world);
    head_init(&world->head, &world->settings.head, seed, KIND, PAYLOAD_BYTES, spoil);
    world->event_s = scenario->event_s;
    world->event_ns = (int64_t)llround(scenario->event_s * 1e9);
    world->hold_s = scenario->hold_s;
    world->min_brake_pct = INFINITY;
    world->asked_s = world->changed_s = world->first_fault_s = INFINITY;
    world->alarm_s = world->rest_s = INFINITY;
    return world;
}

static void start(struct world *world, const bool levels[BOARD_OUTPUTS])
{
    world->started = true;
    world->now_ns = 0;
    memcpy(world->levels, levels, sizeof world->levels);
    base_start(world);
    pwm_init(&world->pwm, 0, levels[PIN_PWM]);
    servo_restart(&world->servo, levels[PIN_SERVO]);
    note_demand(world);
}

static void state_reported(struct world *world, int64_t t_ns, const char *state)
{
    if (strcmp(state, "FAULT") == 0 && t_ns >= world->event_ns && isinf(world->first_fault_s)) {
        world->first_fault_s = seconds(t_ns);
    }
}

static bool is_over(const struct world *world)
{
    return world->robots.collided ||
           (world->hold_s >= 0 && seconds(world->now_ns) - world->rest_s >= world->hold_s);
}

/* A gap in metres, or NOBODY_M if there is no robot ahead. */
static double gap_m(int32_t gap_um, double nobody_m)
{
    return gap_um == ROBOTS_NOBODY_UM ? nobody_m : gap_um / 1e6;
}

static void values(const struct world *world, double row[WORLD_COLUMNS])
{
    row[COLUMN_GAP] = gap_m(world->robots.gap_um, NAN);
    row[COLUMN_OWN_SPEED] = world->robots.own_mmps / 1e3;
    row[COLUMN_LEAD_SPEED] = isnan(row[COLUMN_GAP]) ? NAN : world->robots.lead_mmps / 1e3;
    row[COLUMN_ACCEL] = world->accel_mmps2 / 1e3;
    row[COLUMN_BRAKE] = brake_pct(world);
    row[COLUMN_THROTTLE] = servo_throttle_pct(&world->servo);
    row[COLUMN_STOP] = world->levels[PIN_STOP];
    row[COLUMN_LAMP] = !world->levels[PIN_LAMP];
    row[COLUMN_ASKS_LANE] = asks_for_lane(world);
    row[COLUMN_LANE] = world->robots.changed_step >= 0;
}

static void measure(const struct world *world, int64_t t_ns, struct outcome *outcome)
{
    double *value = outcome->values, since_s = world->event_s;

    value[METRIC_IMPACT] = world->robots.collided;
    value[METRIC_IMPACT_MPS] = world->impact_mps;
    value[METRIC_MIN_GAP] = gap_m(world->robots.least_gap_um, INFINITY);
    value[METRIC_FINAL_GAP] = gap_m(world->robots.gap_um, INFINITY);
    value[METRIC_FINAL_SPEED] = world->robots.own_mmps / 1e3;
    value[METRIC_MAX_BRAKE] = world->max_brake_pct;
    value[METRIC_MIN_BRAKE] = world->min_brake_pct;
    value[METRIC_FINAL_BRAKE] = brake_pct(world);
    value[METRIC_BLIND_FALL] = world->blind_fall_pct;
    value[METRIC_BLIND_RISE] = world->blind_rise_pct;
    value[METRIC_ALARM_WITHIN] = world->alarm_s - since_s;
    value[METRIC_BLIND_ASKS] = world->blind_asks;
    value[METRIC_DUTY_STEPS] = world->duty_steps / seconds(t_ns);
    value[METRIC_STOP_TOGGLES] = world->stop_toggles;
    value[METRIC_FAULT_WITHIN] = world->first_fault_s - since_s;
    value[METRIC_ASKS_LANE_AT] = world->asked_s;
    value[METRIC_CHANGES_LANE_AT] = world->changed_s;
    value[METRIC_WARNINGS] = world->warnings;
}

static void tell(const struct outcome *outcome, const struct scenario *scenario)
{
    const double *value = outcome->values;

    printf("%s: ", scenario->title);
    if (isfinite(value[METRIC_CHANGES_LANE_AT])) {
        printf("changes lanes at %.2f s, ", value[METRIC_CHANGES_LANE_AT]);
    }
    if (value[METRIC_IMPACT] > 0) {
        printf("hits the robot ahead at %.2f m/s\n", value[METRIC_IMPACT_MPS]);
    } else {
        if (value[METRIC_FINAL_SPEED] > 0) {
            printf("drives at %.2f m/s in the end, ", value[METRIC_FINAL_SPEED]);
        } else {
            printf("stands in the end, ");
        }
        if (isinf(value[METRIC_FINAL_GAP])) {
            puts("with no robot ahead");
        } else {
            printf("%.2f m behind the robot ahead\n", value[METRIC_FINAL_GAP]);
        }
    }
    printf("  least gap %.2f m, most brake %.0f %%\n", value[METRIC_MIN_GAP],
           value[METRIC_MAX_BRAKE]);
}

/* Both lanes; the robot keeps to the lower one until it changes. */
static void draw(struct picture *picture, const struct scenario *scenario, const double *values,
                 const struct telemetry *telemetry)
{
    const struct follow_settings *settings = (const void *)scenario->settings;
    bool is_changed = values[COLUMN_LANE] > 0;

    (void)telemetry;
    picture_rail(picture);
    if (is_changed) {
        picture_lane(picture, true, values[COLUMN_GAP], NAN);
    } else if (settings->lane.lead_mps >= 0) {
        picture_lane(picture, false, NAN, NAN);
    } else {
        picture_closed_lane(picture, 'x');
    }
    picture_rail(picture);
    picture_lane(picture, !is_changed, is_changed ? NAN : values[COLUMN_GAP], NAN);
    picture_rail(picture);
    picture_bar(picture, "gap", values[COLUMN_GAP], "m", values[COLUMN_GAP] / picture->view_m);
    picture_bar(picture, "brake", values[COLUMN_BRAKE], "%", values[COLUMN_BRAKE] / 100);
    picture_bar(picture, "throttle", values[COLUMN_THROTTLE], "%", values[COLUMN_THROTTLE] / 100);
    picture_text(picture, " speed    %7.2f m/s", values[COLUMN_OWN_SPEED]);
    picture_end(picture);
}

const struct world_class follow_world = {
    .name = "follow",
    .meaning = "follows a robot and changes lanes",
    WORLD_SECTIONS(sections),
    BASE_TRACE(columns, reported),
    .create = create,
    .destroy = base_destroy,
    .start = start,
    .pin_changed = pin_changed,
    .advance = advance,
    .is_warm = base_is_warm,
    BASE_HEAD_FUNCTIONS,
    .state_reported = state_reported,
    .is_over = is_over,
    .values = values,
    .draw = draw,
    .tell = tell,
    .measure = measure,
};
