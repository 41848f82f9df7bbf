/* SPDX-License-Identifier: MIT */
/* The radar controller's world: two cars on a road that may bend, a radar front end that answers
 * each trigger with a frame, a brake that follows the PWM, a throttle that can be cut. */
#include "base.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The frames of firmware/frames/frame.h and radar.h. */
enum {
    KIND = 1,
    PAYLOAD_BYTES = 5,
    TARGET_BYTES = 8,
    NO_TARGET = -32768, /* the azimuth of an empty place */
    FLAG_SIGNED = 0x10,
    MIN_RADIUS_M = 31,
    CURVATURE_MAX_UPM = 32767,
    OWN_MAX_DKMH = 2500
};

/* The front end: carrier, sweep from peak to peak, duration of a triangle. */
static const double light_mps = 299792458, carrier_hz = 77e9, sweep_hz = 150e6, triangle_s = 2e-3;

static const double turn = 65536; /* the unit of angles in frames */
static const double degree = M_PI / 180;

struct radar_settings {
    struct {
        double radius_m; /* of the ego lane's centre, positive in a bend to the left; 0: straight */
        double lane_m;   /* width of a lane */
        double
            begins_m;   /* the bend, so far ahead of the start; unset: it is there from the start */
        double entry_m; /* the curvature grows from there to its end value in this length */
    } road;
    struct {
        double range_noise_m, closing_noise_mps, azimuth_noise_deg; /* standard deviations */
        double yaw_noise_dps;
        double dropout; /* probability that a target is not seen */
        double targets; /* places for targets in a frame */
        double max_m;   /* range */
        double fov_deg; /* it sees so far to each side */
        int beats;      /* enum beats */
    } front;
    struct head_settings head;
};

enum beats {
    BEATS_SIGNED,  /* with I and Q: a beat may be negative */
    BEATS_UNSIGNED /* a mixer alone shows its size */
};

#define AT(member)                                                                                 \
    offsetof(struct radar_settings, road.member) - offsetof(struct radar_settings, road)
static const struct key road_keys[] = {
    {.name = "radius_m",
     .meaning = "radius of the own lane, positive in a bend to the left; 0: straight",
     .at = AT(radius_m),
     .low = -10000,
     .high = 10000,
     .required = true},
    {.name = "lane_m",
     .meaning = "width of a lane",
     .at = AT(lane_m),
     .low = 2,
     .high = 6,
     .initial = 3.75},
    {.name = "begins_m",
     .meaning = "where the bend begins, from the start on",
     .at = AT(begins_m),
     .high = 10000,
     .initial = SCENARIO_UNSET,
     .unset = "the start is in the bend"},
    {.name = "entry_m",
     .meaning = "length in which the curvature grows from 0 to its end value",
     .at = AT(entry_m),
     .high = 1000},
};
#undef AT

static void check_road(struct section_check *check, const void *values)
{
    double radius_m = fabs(*(const double *)values);

    if (section_line(check, "entry_m") != 0 && section_line(check, "begins_m") == 0) {
        section_complain(
            check, "entry_m",
            "entry_m has no effect where the start is in the bend; give begins_m, too");
    }

    if (radius_m > 0 && radius_m < MIN_RADIUS_M) {
        section_complain(check, "radius_m",
                         "radius_m is below %d m, for which no frame has a curvature",
                         MIN_RADIUS_M);
    }
}

static const struct section road_section = {.name = "road",
                                            .meaning = "the road ahead",
                                            SECTION_KEYS(road_keys),
                                            .size = sizeof(((struct radar_settings *)NULL)->road),
                                            .check = check_road};

#define AT(member)                                                                                 \
    offsetof(struct radar_settings, front.member) - offsetof(struct radar_settings, front)
static const struct key front_keys[] = {
    {.name = "range_noise_m",
     .meaning = "standard deviation of the range",
     .at = AT(range_noise_m),
     .high = 10},
    {.name = "closing_noise_mps",
     .meaning = "standard deviation of the closing speed",
     .at = AT(closing_noise_mps),
     .high = 5},
    {.name = "azimuth_noise_deg",
     .meaning = "standard deviation of the azimuth",
     .at = AT(azimuth_noise_deg),
     .high = 5},
    {.name = "yaw_noise_dps",
     .meaning = "standard deviation of the yaw rate, degrees a second",
     .at = AT(yaw_noise_dps),
     .high = 2},
    {.name = "dropout",
     .meaning = "probability that a target is not seen",
     .at = AT(dropout),
     .high = 1},
    {.name = "targets",
     .meaning = "places for targets in each frame; the nearest ones are sent",
     .kind = VALUE_COUNT,
     .at = AT(targets),
     .low = 1,
     .high = CAR_TARGETS,
     .initial = 1},
    {.name = "max_m",
     .meaning = "farthest distance that it sees",
     .at = AT(max_m),
     .low = 1,
     .high = 500,
     .initial = 300},
    {.name = "fov_deg",
     .meaning = "it sees so far to each side",
     .at = AT(fov_deg),
     .low = 1,
     .high = 44,
     .initial = 30},
    {.name = "beats",
     .meaning = "signed: a mixer with I and Q; unsigned: one that shows the size of a beat alone",
     .kind = VALUE_CHOICE,
     .at = AT(beats),
     .choices = "signed unsigned"},
};
#undef AT

static const struct section front_section = {.name = "front",
                                             .meaning = "the radar",
                                             SECTION_KEYS(front_keys),
                                             .size =
                                                 sizeof(((struct radar_settings *)NULL)->front)};

static const struct section_use sections[] = {
    {.section = &scenario_section, .required = true},
    {.section = &ego_section, AT_SCENARIO(ego), .required = true},
    {.section = &lead_section,
     AT_SCENARIO(leads),
     .copies = LEADS_MAX,
     .only = LEAD_KEYS_OF_A_HEAD},
    {.section = &road_section, AT_SETTINGS(struct radar_settings, road)},
    {.section = &front_section, AT_SETTINGS(struct radar_settings, front)},
    HEAD_SECTIONS(struct radar_settings, head, NULL),
    FLIP_SECTION,
};
WORLD_SETTINGS_FIT(struct radar_settings);

struct sight {
    bool target;
    double range_m, closing_mps, azimuth_rad; /* azimuth: positive to the left */
};

struct world {
    struct base base;
    struct rig rig;
    struct head head;
    struct radar_settings settings;
    struct random random;
    struct sight seen; /* at the last trigger: the nearest target in the own lane, or else of all */
};

static const struct world_column columns[] = {RIG_COLUMN_NAMES,   {"range_m", 3},
                                              {"closing_mps", 3}, {"azimuth_deg", 3},
                                              {"cut", 0},         {"way_m", 1}};
static const char *const reported[] = {"range_cm", "closing_dkmh", "safe_cm", "level"};

/* --- what the front end sees -------------------------------------------------------------- */

/* The lane's curvature, positive to the left, WAY_M from the start. */
static double curvature_at(const struct radar_settings *settings, double way_m)
{
    double radius_m = settings->road.radius_m, begins_m = settings->road.begins_m;
    double entry_m = settings->road.entry_m;

    if (fabs(radius_m) <= 0) {
        return 0;
    }
    if (begins_m < 0) {
        return 1 / radius_m;
    }
    if (entry_m <= 0) {
        return way_m < begins_m ? 0 : 1 / radius_m;
    }
    return fmin(fmax((way_m - begins_m) / entry_m, 0), 1) / radius_m;
}

struct place {
    double ahead_m, left_m, heading_rad;
};

/* The middle of the lane AHEAD_M after WAY_M, as seen from there. */
static struct place lane_ahead(const struct radar_settings *settings, double way_m, double ahead_m)
{
    static const double step_m = 0.25;
    struct place place = {0};
    double curvature = curvature_at(settings, way_m), even_m = ahead_m; /* so far it stays so */

    if (settings->road.begins_m >= 0 && fabs(settings->road.radius_m) > 0) {
        even_m = fmin(ahead_m, fmax(settings->road.begins_m - way_m, 0));
    }
    place.heading_rad = even_m * curvature;
    place.ahead_m = fabs(curvature) > 0 ? sin(place.heading_rad) / curvature : even_m;
    place.left_m = fabs(curvature) > 0 ? (1 - cos(place.heading_rad)) / curvature : 0;
    way_m += even_m;
    ahead_m -= even_m;
    while (ahead_m > 0) {
        double part_m = fmin(step_m, ahead_m);
        double bend = part_m * curvature_at(settings, way_m + part_m / 2);

        place.ahead_m += part_m * cos(place.heading_rad + bend / 2);
        place.left_m += part_m * sin(place.heading_rad + bend / 2);
        place.heading_rad += bend;
        way_m += part_m;
        ahead_m -= part_m;
    }
    return place;
}

/* What it sees of the target of that INDEX. */
static struct sight look(const struct world *world, int index)
{
    const struct car *car = &world->rig.car;
    double gap_m = car_target_gap_m(car, index), lead_mps = car_target_mps(car, index);
    double aside_m = car->targets[index].lead.lane * world->settings.road.lane_m;
    struct sight sight = {.target = false};
    struct place place;
    double x, y;

    if (!(gap_m <= world->settings.front.max_m * 2)) {
        return sight;
    }
    place = lane_ahead(&world->settings, car->x_m, gap_m);
    x = place.ahead_m - aside_m * sin(place.heading_rad);
    y = place.left_m + aside_m * cos(place.heading_rad);
    sight.range_m = hypot(x, y);
    if (!(sight.range_m <= world->settings.front.max_m) ||
        !(fabs(atan2(y, x)) <= world->settings.front.fov_deg * degree)) {
        return sight;
    }
    sight.target = true;
    sight.azimuth_rad = atan2(y, x);
    sight.closing_mps = ((car->v_mps - lead_mps * cos(place.heading_rad)) * x -
                         lead_mps * sin(place.heading_rad) * y) /
                        sight.range_m;
    return sight;
}

static void add_noise(struct world *world, struct sight *sight)
{
    const struct radar_settings *settings = &world->settings;
    struct random *random = &world->random;

    sight->range_m =
        sight->range_m * world->head.scale + settings->front.range_noise_m * random_normal(random);
    sight->closing_mps = sight->closing_mps * world->head.speed_scale +
                         settings->front.closing_noise_mps * random_normal(random);
    sight->azimuth_rad += settings->front.azimuth_noise_deg * degree * random_normal(random);
    if (random_uniform(random) < settings->front.dropout) {
        sight->target = false;
    }
    if (sight->range_m < 0) {
        sight->range_m = 0;
    }
}

static void measure_beats(const struct world *world, const struct sight *sight, uint8_t *target)
{
    double range_hz = 4 * sweep_hz * sight->range_m / (light_mps * triangle_s);
    double speed_hz = 2 * carrier_hz * sight->closing_mps / light_mps;
    double up_hz = range_hz - speed_hz, down_hz = range_hz + speed_hz;

    if (world->settings.front.beats == BEATS_UNSIGNED) {
        up_hz = fabs(up_hz);
        down_hz = fabs(down_hz);
    }
    head_put_24(target, lround(up_hz));
    head_put_24(target + 3, lround(down_hz));
    head_put_16(target + 6, lround(sight->azimuth_rad / (2 * M_PI) * turn));
}

/* Those with a target first, the nearest first. */
static int by_range(const void *a, const void *b)
{
    const struct sight *one = a, *other = b;

    if (one->target != other->target) {
        return one->target ? -1 : 1;
    }
    return (one->range_m > other->range_m) - (one->range_m < other->range_m);
}

/* The own curvature, which the yaw rate says. */
static long measured_upm(struct world *world)
{
    const struct car *car = &world->rig.car;
    double curvature = curvature_at(&world->settings, car->x_m);

    if (world->settings.front.yaw_noise_dps > 0 && car->v_mps > 1) {
        curvature += world->settings.front.yaw_noise_dps * degree * random_normal(&world->random) /
                     car->v_mps;
    }
    return head_limited(curvature * 1e6, -CURVATURE_MAX_UPM, CURVATURE_MAX_UPM);
}

static void measure_all(struct world *world, uint8_t payload[HEAD_PAYLOAD_MAX])
{
    struct sight sights[CAR_TARGETS] = {{.target = false}};
    int places = (int)world->settings.front.targets, nearest = car_nearest(&world->rig.car);

    world->seen.target = false;
    for (int i = 0; i < CAR_TARGETS; i++) {
        if (!world->rig.car.targets[i].lead.present) {
            continue;
        }
        sights[i] = look(world, i);
        add_noise(world, &sights[i]);
        if (i == nearest) {
            world->seen = sights[i];
        }
    }
    qsort(sights, CAR_TARGETS, sizeof sights[0], by_range);
    head_put_16(payload, head_limited(head_speed(&world->head, world->rig.car.v_mps, 0) * 36, 0,
                                      OWN_MAX_DKMH));
    head_put_16(payload + 2, measured_upm(world));
    payload[4] =
        (uint8_t)(places | (world->settings.front.beats == BEATS_SIGNED ? FLAG_SIGNED : 0));
    for (int i = 0; i < places; i++) {
        uint8_t *target = payload + PAYLOAD_BYTES + i * TARGET_BYTES;

        memset(target, 0, TARGET_BYTES);
        head_put_16(target + 6, NO_TARGET);
        if (sights[i].target) {
            measure_beats(world, &sights[i], target);
        }
    }
}

static void spoil(struct random *random, uint8_t *payload)
{
    uint8_t *target = payload + PAYLOAD_BYTES;

    head_put_16(target + 6, 0);
    switch ((int)(random_uniform(random) * 7)) {
    case 0:
        head_put_16(payload, 2501); /* own speed */
        break;
    case 1:
        head_put_16(target + 6, 8193); /* azimuth */
        break;
    case 2:
        head_put_16(target + 6, -32767);
        break;
    case 3:
        head_put_16(payload + 2, -32768); /* curvature */
        break;
    case 4:
        payload[4] |= 0x40; /* an undefined flag */
        break;
    case 5:
        head_put_24(target, 700000); /* 524 m and more */
        head_put_24(target + 3, 700000);
        break;
    default:
        head_put_24(target, -60000); /* a negative range */
        head_put_24(target + 3, 50000);
        break;
    }
}

/* --- pins --------------------------------------------------------------------------------- */

static void pin_changed(struct world *world, int64_t t_ns, enum board_pin pin, bool level)
{
    base_advance(world, t_ns);
    rig_pin(&world->rig, t_ns, pin, level);
    if (pin == PIN_CUT && world->rig.started) {
        car_cut(&world->rig.car, t_ns, level);
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
    head_init(&world->head, &world->settings.head, seed, KIND,
              PAYLOAD_BYTES + TARGET_BYTES * (int)world->settings.front.targets, spoil);
    random_seed(&world->random, seed);
    return world;
}

static void start(struct world *world, const bool levels[BOARD_OUTPUTS])
{
    base_start(world);
    rig_start(&world->rig, levels);
    car_cut(&world->rig.car, 0, levels[PIN_CUT]);
}

static void values(const struct world *world, double row[WORLD_COLUMNS])
{
    const struct sight *seen = &world->seen;

    rig_values(&world->rig, row);
    row[RIG_COLUMNS] = seen->target ? seen->range_m : NAN;
    row[RIG_COLUMNS + 1] = seen->target ? seen->closing_mps : NAN;
    row[RIG_COLUMNS + 2] = seen->target ? seen->azimuth_rad / degree : NAN;
    row[RIG_COLUMNS + 3] = world->rig.levels[PIN_CUT];
    row[RIG_COLUMNS + 4] = world->rig.car.x_m;
}

static void tell(const struct outcome *outcome, const struct scenario *scenario)
{
    const double *value = outcome->values;

    printf("%s: ", scenario->title);
    if (value[METRIC_IMPACT] > 0) {
        printf("impact at %.1f km/h, closing at %.1f km/h\n", value[METRIC_FINAL_SPEED] * 3.6,
               value[METRIC_IMPACT_MPS] * 3.6);
    } else if (isinf(value[METRIC_BRAKE_GAP])) {
        printf("the driver kept control\n");
    } else if (isinf(value[METRIC_RELEASE_GAP])) {
        printf("brakes from %.1f m on, to the end\n", value[METRIC_BRAKE_GAP]);
    } else {
        printf("brakes from %.1f m on, lets go at %.1f m and %.1f km/h\n", value[METRIC_BRAKE_GAP],
               value[METRIC_RELEASE_GAP], value[METRIC_RELEASE_KMH]);
    }
    printf("  peak deceleration %.2f m/s2, most brake %.0f %%\n", value[METRIC_PEAK_DECEL],
           value[METRIC_MAX_BRAKE]);
}

/* CHARACTER at a place of the road: in the row that is nearest, as far from that row's middle of
 * the lane as it is from its own. */
static void put_on_road(struct picture *picture, const double middles_m[PLAN_ROWS_MAX],
                        double forward_m, double beside_m, char character)
{
    int row = (int)lround(forward_m / picture->row_m);

    if (row >= 0 && row < PLAN_ROWS_MAX) {
        plan_put(picture, -middles_m[row] - beside_m, row * picture->row_m, character);
    }
}

/* How far to the left the middle of the lane is at FORWARD_M straight ahead. */
static double middle_m(const struct radar_settings *settings, double way_m, double forward_m)
{
    double low = forward_m, high = forward_m * 1.6;

    if (fabs(settings->road.radius_m) <= 0) {
        return 0;
    }
    for (int i = 0; i < 12; i++) {
        double half = (low + high) / 2;

        *(lane_ahead(settings, way_m, half).ahead_m < forward_m ? &low : &high) = half;
    }
    return lane_ahead(settings, way_m, high).left_m;
}

/* The road from above: the sides of the own lane, the own car below, the car ahead, and where the
 * radar sees it. */
static void draw(struct picture *picture, const struct scenario *scenario, const double *values,
                 const struct telemetry *telemetry)
{
    const struct radar_settings *settings = (const void *)scenario->settings;
    double lane_m = settings->road.lane_m, way_m = values[RIG_COLUMNS + 4];
    double gap_m = values[RIG_GAP], range_m = values[RIG_COLUMNS];
    double row_m = picture->view_m / (PLAN_ROWS_MAX - 1), middles_m[PLAN_ROWS_MAX] = {0};

    (void)telemetry;
    plan_begin(picture, PLAN_ROWS_MAX, row_m, lane_m / 4, PLAN_ROWS_MAX - 1);
    for (int row = 1; row < PLAN_ROWS_MAX; row++) {
        middles_m[row] = middle_m(settings, way_m, row * row_m);
        plan_put(picture, -middles_m[row] - lane_m / 2, row * row_m, '|');
        plan_put(picture, -middles_m[row] + lane_m / 2, row * row_m, '|');
    }
    plan_put(picture, 0, 0, '^');
    if (!isnan(gap_m)) { /* the gap is as long as the lane between */
        put_on_road(picture, middles_m, lane_ahead(settings, way_m, gap_m).ahead_m,
                    scenario->lead.lane * lane_m, '#');
    }
    if (!isnan(range_m)) {
        double azimuth_rad = values[RIG_COLUMNS + 2] * degree;
        double forward_m = range_m * cos(azimuth_rad);

        put_on_road(picture, middles_m, forward_m,
                    range_m * sin(azimuth_rad) - middle_m(settings, way_m, forward_m), 'o');
    }
    plan_draw(picture);
    rig_draw_bars(picture, values);
}

const struct world_class radar_world = {
    .name = "radar",
    .meaning = "takes over from the driver behind what a radar sees",
    WORLD_SECTIONS(sections),
    BASE_TRACE(columns, reported),
    .create = create,
    .destroy = base_destroy,
    .start = start,
    .pin_changed = pin_changed,
    .advance = base_advance,
    .is_warm = base_is_warm,
    BASE_HEAD_FUNCTIONS,
    BASE_RIG_FUNCTIONS,
    .values = values,
    .draw = draw,
    .tell = tell,
    .measure = base_measure,
};
