/* SPDX-License-Identifier: MIT */
/* The brake controller's world: a car behind one or two others, an ultrasonic sensor or a lidar, a
 * brake that follows the PWM and the STOP pin, a lamp and a buzzer. */
#include "brake_world.h"

#include "base.h"
#include "sonar.h"
#include "tfluna.h"

#include <math.h>

/* What a lidar's last frame says reaches the brake that is measured at the pin within four frames'
 * time: 9.4 ms on the line, up to two periods of the PWM, and the chip's own time. */
enum { FRAMES_UNDER_WAY = 3 };

struct world {
    struct base base;
    struct rig rig;
    struct sensing *sensing; /* of the sensor that there is, one of these two */
    struct sonar sonar;
    struct tfluna tfluna;
    bool is_lidar;
    int missing;          /* readings in a row */
    struct random missed; /* decides which targets give no echo */
    int64_t now_ns;
    int64_t trigger_rise_ns;
    int64_t echo_end_ns; /* of the last echo; 0: there was none */
    int64_t mark_ns;     /* the next boundary of a fault */
    struct {
        int64_t at_ns[2];
        int next;
    } override;
};

static const struct world_column columns[] = {RIG_COLUMN_NAMES};
static const char *const reported[] = {"dist_mm", "closing_mmps"};

#define AT(member)                                                                                 \
    offsetof(struct brake_settings, override.member) - offsetof(struct brake_settings, override)
static const struct key override_keys[] = {
    {.name = "from_s",
     .meaning = "when the driver presses it",
     .at = AT(from_s),
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .required = true},
    {.name = "for_s",
     .meaning = "how long the driver holds it",
     .at = AT(for_s),
     .low = 0.001,
     .high = 3600,
     .required = true},
};
#undef AT

static const struct section override_section = {
    .name = "override",
    .meaning = "the driver's override input",
    SECTION_KEYS(override_keys),
    .size = sizeof(((struct brake_settings *)NULL)->override)};

static const struct section_use sections[] = {
    {.section = &scenario_section, .required = true},
    {.section = &ego_section, AT_SCENARIO(ego), .required = true},
    {.section = &lead_section, AT_SCENARIO(lead), .copies = 2},
    {.section = &sensor_section, AT_SETTINGS(struct brake_settings, sensing.sensor)},
    {.section = &fault_section,
     AT_SETTINGS(struct brake_settings, sensing.faults),
     .copies = SENSOR_FAULTS},
    {.section = &override_section, AT_SETTINGS(struct brake_settings, override)},
    {.section = &uart_section, AT_SCENARIO(uart)},
    FLIP_SECTION,
};
WORLD_SETTINGS_FIT(struct brake_settings);

struct brake_settings *brake_settings(struct scenario *scenario)
{
    return (void *)scenario->settings;
}

/* --- time --------------------------------------------------------------------------------- */

/* The target whose echo comes first: the nearest one that is not missed; what is nearer than the
 * sensor can see counts only when there is nothing else. -1: there is none. */
static int heard_target(const struct world *world, const bool is_missed[CAR_TARGETS])
{
    int heard = -1;
    double heard_m = INFINITY;

    for (int i = 0; i < CAR_TARGETS; i++) {
        double gap_m = car_target_gap_m(&world->rig.car, i);
        bool rather =
            heard_m < sensor_min_m(&world->sensing->sensor) ? gap_m > heard_m : gap_m < heard_m;

        if (world->rig.car.targets[i].there && !is_missed[i] && (heard < 0 || rather)) {
            heard = i;
            heard_m = gap_m;
        }
    }
    return heard;
}

static double gap_to_m(const struct world *world, int target)
{
    return target < 0 ? INFINITY : car_target_gap_m(&world->rig.car, target);
}

static bool is_anything_in_range(const struct world *world)
{
    static const bool none_missed[CAR_TARGETS] = {false};
    double gap_m = gap_to_m(world, heard_target(world, none_missed));

    return world->is_lidar ? tfluna_is_seen(&world->tfluna, gap_m)
                           : sensor_is_in_range(&world->sensing->sensor, gap_m);
}

/* The true distances of the past, for a sensor whose readings are old. */
static void observe(struct world *world, int64_t t_ns)
{
    static const bool none_missed[CAR_TARGETS] = {false};

    sensing_observe(world->sensing, t_ns, gap_to_m(world, heard_target(world, none_missed)));
}

static void advance(struct world *world, int64_t t_ns)
{
    while (world->now_ns < t_ns) {
        int64_t row_ns = (world->now_ns / WORLD_ROW_NS + 1) * WORLD_ROW_NS, next = t_ns;

        if (world->mark_ns < next) {
            next = world->mark_ns;
        }
        if (row_ns < next) {
            next = row_ns;
        }
        rig_advance(&world->rig, next);
        world->now_ns = next;
        if (next == world->mark_ns) {
            if (!world->is_lidar) {
                sonar_pass_boundary(&world->sonar, next);
            }
            world->mark_ns = sensing_boundary_ns(world->sensing, next);
        }
        if (next == row_ns) {
            observe(world, next);
        }
    }
}

static int64_t horizon_ns(const struct world *world, int64_t t_ns)
{
    /* A lidar sends at times of its own, which mark_ns says. */
    return world->is_lidar ? t_ns + world->tfluna.period_ns : sonar_horizon_ns(&world->sonar, t_ns);
}

static int64_t guess_ns(const struct world *world, int64_t t_ns)
{
    return world->is_lidar ? horizon_ns(world, t_ns)
                           : sonar_horizon_ns(&world->sonar, pace_next_ns(&world->base.pace, t_ns));
}

static int64_t mark_ns(const struct world *world)
{
    return world->is_lidar && world->tfluna.due_ns < world->mark_ns ? world->tfluna.due_ns
                                                                    : world->mark_ns;
}

/* --- pins --------------------------------------------------------------------------------- */

/* The target that the measurement of now meets, -1: none, and how fast it closes. */
static int measured_target(struct world *world, double *closing_mps)
{
    const struct car *car = &world->rig.car;
    bool is_missed[CAR_TARGETS];
    int heard;

    for (int i = 0; i < CAR_TARGETS; i++) {
        is_missed[i] = random_uniform(&world->missed) < car->targets[i].lead.missed;
    }
    heard = heard_target(world, is_missed);
    *closing_mps = heard >= 0 ? car->v_mps - car_target_mps(car, heard) : 0;
    return heard;
}

static void note_answer(struct world *world, enum sensor_answer answer)
{
    if (answer == SENSOR_NONE && is_anything_in_range(world)) {
        answer = SENSOR_MISSING; /* there is a target, but it gave no echo */
    }
    if (answer == SENSOR_MISSING) {
        world->missing++;
        if (!world->is_lidar || world->missing > FRAMES_UNDER_WAY) {
            rig_blind(&world->rig, true);
        }
    } else if (answer == SENSOR_TARGET || answer == SENSOR_NONE) {
        world->missing = 0;
        rig_blind(&world->rig, false);
    }
}

static void trigger_ends(struct world *world)
{
    double closing_mps;
    int heard = measured_target(world, &closing_mps);

    note_answer(world,
                sonar_trigger(&world->sonar, world->now_ns, world->now_ns - world->trigger_rise_ns,
                              gap_to_m(world, heard), closing_mps));
    pace_note(&world->base.pace, world->now_ns);
}

/* The lidar's frame, if one is due now. */
static size_t take_bytes(struct world *world, int64_t t_ns, uint8_t bytes[WORLD_BYTES])
{
    enum sensor_answer answer;
    double closing_mps;
    size_t count;
    int heard;

    if (!world->is_lidar || world->tfluna.due_ns > t_ns) {
        return 0;
    }
    heard = measured_target(world, &closing_mps);
    count = tfluna_take(&world->tfluna, gap_to_m(world, heard), closing_mps, bytes, &answer);
    note_answer(world, answer);
    return count;
}

static void pin_changed(struct world *world, int64_t t_ns, enum board_pin pin, bool level)
{
    advance(world, t_ns);
    rig_pin(&world->rig, t_ns, pin, level);
    if (pin != PIN_TRIGGER || world->is_lidar) {
        return;
    }
    if (level) {
        world->trigger_rise_ns = world->now_ns;
    } else {
        trigger_ends(world);
    }
}

static bool next_input(struct world *world, int64_t until_ns, int64_t *t_ns, enum board_pin *pin,
                       bool *level)
{
    int next = world->override.next;

    /* Whichever is due first; the override comes last among equals. */
    if (next < 2 && world->override.at_ns[next] <= until_ns &&
        (world->sonar.event_count == 0 ||
         world->override.at_ns[next] < world->sonar.events[0].at_ns)) {
        *t_ns = world->override.at_ns[next];
        *pin = PIN_OVERRIDE;
        *level = next == 1;
        world->override.next++;
        return true;
    }
    *pin = PIN_ECHO;
    if (!sonar_next_event(&world->sonar, until_ns, t_ns, level)) {
        return false;
    }
    if (!*level) {
        world->echo_end_ns = *t_ns;
    }
    return true;
}

static int64_t measured_ns(const struct world *world)
{
    return world->is_lidar ? world->tfluna.sent_ns : world->echo_end_ns;
}

/* --- life and outcome --------------------------------------------------------------------- */

static int64_t not_too_early(int64_t t_ns)
{
    return t_ns < WORLD_FIRST_INPUT_NS ? WORLD_FIRST_INPUT_NS : t_ns;
}

static const char *sensor(const struct scenario *scenario)
{
    const struct brake_settings *settings = (const void *)scenario->settings;

    return settings->sensing.sensor.kind < 0
               ? NULL
               : sensor_kind_name(sensor_kind(&settings->sensing.sensor));
}

static bool is_unasked(const struct scenario *scenario)
{
    const struct brake_settings *settings = (const void *)scenario->settings;

    return sensor_kind(&settings->sensing.sensor) == SENSOR_TFLUNA;
}

static struct world *create(const struct scenario *scenario, uint64_t seed, int64_t step_ns)
{
    const struct brake_settings *settings = (const void *)scenario->settings;
    struct world *world = base_create(sizeof *world);

    world->base = (struct base){.rig = &world->rig};
    rig_init(&world->rig, scenario, step_ns);
    world->is_lidar = is_unasked(scenario);
    if (world->is_lidar) {
        tfluna_init(&world->tfluna, &settings->sensing, seed);
        world->sensing = &world->tfluna.sensing;
    } else {
        sonar_init(&world->sonar, &settings->sensing, seed);
        world->sensing = &world->sonar.sensing;
    }
    random_seed(&world->missed, seed ^ 0x4D495353u);
    world->override.next = settings->override.from_s >= 0 ? 0 : 2;
    world->override.at_ns[0] = not_too_early((int64_t)llround(settings->override.from_s * 1e9));
    world->override.at_ns[1] =
        (int64_t)llround((settings->override.from_s + settings->override.for_s) * 1e9);
    return world;
}

static void destroy(struct world *world)
{
    sensing_free(world->sensing);
    base_destroy(world);
}

static void start(struct world *world, const bool levels[BOARD_OUTPUTS])
{
    rig_start(&world->rig, levels);
    observe(world, 0);
    world->mark_ns = not_too_early(sensing_boundary_ns(world->sensing, -1));
}

static void values(const struct world *world, double row[WORLD_COLUMNS])
{
    rig_values(&world->rig, row);
}

static void draw(struct picture *picture, const struct scenario *scenario, const double *values,
                 const struct telemetry *telemetry)
{
    (void)scenario;
    (void)telemetry;
    rig_draw_road(picture, values, NAN);
    rig_draw_bars(picture, values);
}

const struct world_class brake_world = {
    .name = "brake",
    .meaning = "brakes behind what an ultrasonic sensor or a lidar sees",
    WORLD_SECTIONS(sections),
    BASE_TRACE(columns, reported),
    .sensor = sensor,
    .is_unasked = is_unasked,
    .create = create,
    .destroy = destroy,
    .start = start,
    .pin_changed = pin_changed,
    .advance = advance,
    .next_input = next_input,
    .horizon_ns = horizon_ns,
    .guess_ns = guess_ns,
    .mark_ns = mark_ns,
    .take_bytes = take_bytes,
    .measured_ns = measured_ns,
    BASE_RIG_FUNCTIONS,
    .values = values,
    .draw = draw,
    .measure = base_measure,
};
