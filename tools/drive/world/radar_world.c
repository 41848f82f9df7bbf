/* SPDX-License-Identifier: MIT */
/* The radar controller's world: two cars on a road that may bend, a radar front end that answers
 * each trigger with a frame, a brake that follows the PWM, a throttle that can be cut. */
#include "base.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The frames of firmware/frames/frame.h and radar.h. */
enum {
    KIND = 1,
    PAYLOAD_BYTES = 13,
    FLAG_TARGET = 1,
    FLAG_SIGNED = 2,
    MIN_RADIUS_M = 31,
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
    } road;
    struct {
        double range_noise_m, closing_noise_mps, azimuth_noise_deg; /* standard deviations */
        double dropout; /* probability that a target is not seen */
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
};
#undef AT

static void check_road(struct section_check *check, const void *values)
{
    double radius_m = fabs(*(const double *)values);

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
    {.name = "dropout",
     .meaning = "probability that a target is not seen",
     .at = AT(dropout),
     .high = 1},
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
    {.section = &lead_section, AT_SCENARIO(lead), .only = LEAD_KEYS_OF_A_HEAD},
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
    struct sight seen; /* at the last trigger */
};

static const struct world_column columns[] = {
    RIG_COLUMN_NAMES, {"range_m", 3}, {"closing_mps", 3}, {"azimuth_deg", 3}, {"cut", 0}};
static const char *const reported[] = {"range_cm", "closing_dkmh", "safe_cm", "level"};

/* --- what the front end sees -------------------------------------------------------------- */

/* The lead stands GAP further along the lanes, LANE_M to the side of the ego's lane centre. In a
 * bend to the right the picture is that of the bend to the left, mirrored. */
static struct sight look(const struct world *world)
{
    const struct car *car = &world->rig.car;
    double gap = car_gap_m(car), lead_mps = car_lead_mps(car);
    double radius = fabs(world->settings.road.radius_m),
           side = world->settings.road.radius_m < 0 ? -1 : 1;
    bool is_straight = radius <= 0;
    double aside_m = side * car->targets[0].lead.lane * world->settings.road.lane_m;
    double bend = is_straight ? 0 : gap / radius;
    double x = is_straight ? gap : (radius - aside_m) * sin(bend);
    double y = is_straight ? aside_m : radius - (radius - aside_m) * cos(bend);
    struct sight sight = {.range_m = hypot(x, y)};

    if (!(sight.range_m <= world->settings.front.max_m) ||
        !(fabs(atan2(y, x)) <= world->settings.front.fov_deg * degree)) {
        return sight;
    }
    sight.target = true;
    sight.azimuth_rad = side * atan2(y, x);
    sight.closing_mps =
        ((car->v_mps - lead_mps * cos(bend)) * x - lead_mps * sin(bend) * y) / sight.range_m;
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

static void measure_beats(const struct world *world, const struct sight *sight, uint8_t *payload)
{
    double range_hz = 4 * sweep_hz * sight->range_m / (light_mps * triangle_s);
    double speed_hz = 2 * carrier_hz * sight->closing_mps / light_mps;
    double up_hz = range_hz - speed_hz, down_hz = range_hz + speed_hz;

    if (world->settings.front.beats == BEATS_UNSIGNED) {
        up_hz = fabs(up_hz);
        down_hz = fabs(down_hz);
    }
    head_put_24(payload, lround(up_hz));
    head_put_24(payload + 3, lround(down_hz));
    head_put_16(payload + 6, lround(sight->azimuth_rad / (2 * M_PI) * turn));
}

static void measure_all(struct world *world, uint8_t payload[HEAD_PAYLOAD_MAX])
{
    double radius = world->settings.road.radius_m;

    for (int i = 0; i < PAYLOAD_BYTES; i++) {
        payload[i] = 0;
    }
    world->seen = look(world);
    add_noise(world, &world->seen);
    if (world->seen.target) {
        measure_beats(world, &world->seen, payload);
    }
    head_put_16(payload + 8, head_limited(head_speed(&world->head, world->rig.car.v_mps, 0) * 36, 0,
                                          OWN_MAX_DKMH));
    head_put_16(payload + 10, fabs(radius) > 0 ? lround(1e6 / radius) : 0);
    payload[12] = (uint8_t)((world->seen.target ? FLAG_TARGET : 0) |
                            (world->settings.front.beats == BEATS_SIGNED ? FLAG_SIGNED : 0));
}

static void spoil(struct random *random, uint8_t *payload)
{
    payload[12] |= FLAG_TARGET;
    switch ((int)(random_uniform(random) * 7)) {
    case 0:
        head_put_16(payload + 8, 2501); /* own speed */
        break;
    case 1:
        head_put_16(payload + 6, 8193); /* azimuth */
        break;
    case 2:
        head_put_16(payload + 6, -32768);
        break;
    case 3:
        head_put_16(payload + 10, -32768); /* curvature */
        break;
    case 4:
        payload[12] |= 0x40; /* an undefined flag */
        break;
    case 5:
        head_put_24(payload, 700000); /* 524 m and more */
        head_put_24(payload + 3, 700000);
        break;
    default:
        head_put_24(payload, -60000); /* a negative range */
        head_put_24(payload + 3, 50000);
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
    head_init(&world->head, &world->settings.head, seed, KIND, PAYLOAD_BYTES, spoil);
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

/* How far to the left the middle of a lane of that radius is, FORWARD_M straight ahead. */
static double bend_m(double radius_m, double forward_m)
{
    double size_m = fabs(radius_m);

    if (size_m <= 0) {
        return 0;
    }
    return copysign(size_m - sqrt(fmax(size_m * size_m - forward_m * forward_m, 0)), radius_m);
}

/* CHARACTER at a place of the road: in the row that is nearest, as far from that row's middle of
 * the lane as it is from its own. */
static void put_on_road(struct picture *picture, double radius_m, double forward_m, double left_m,
                        char character)
{
    double row_m = round(forward_m / picture->row_m) * picture->row_m;
    double beside_m = left_m - bend_m(radius_m, forward_m);

    plan_put(picture, -bend_m(radius_m, row_m) - beside_m, row_m, character);
}

/* The bend from above: the sides of the own lane, the own car below, the car ahead, and where the
 * radar sees it. */
static void draw(struct picture *picture, const struct scenario *scenario, const double *values,
                 const struct telemetry *telemetry)
{
    const struct radar_settings *settings = (const void *)scenario->settings;
    double radius_m = settings->road.radius_m, lane_m = settings->road.lane_m;
    double gap_m = values[RIG_GAP], range_m = values[RIG_COLUMNS];
    double row_m = picture->view_m / (PLAN_ROWS_MAX - 1);

    (void)telemetry;
    plan_begin(picture, PLAN_ROWS_MAX, row_m, lane_m / 4, PLAN_ROWS_MAX - 1);
    for (int row = 1; row < PLAN_ROWS_MAX; row++) {
        double centre_m = -bend_m(radius_m, row * row_m);

        plan_put(picture, centre_m - lane_m / 2, row * row_m, '|');
        plan_put(picture, centre_m + lane_m / 2, row * row_m, '|');
    }
    plan_put(picture, 0, 0, '^');
    if (!isnan(gap_m)) { /* the gap is as long as the lane between */
        double size_m = fabs(radius_m);
        double forward_m = size_m > 0 ? size_m * sin(gap_m / size_m) : gap_m;

        put_on_road(picture, radius_m, forward_m,
                    bend_m(radius_m, forward_m) + scenario->lead.lane * lane_m, '#');
    }
    if (!isnan(range_m)) {
        double azimuth_rad = values[RIG_COLUMNS + 2] * degree;

        put_on_road(picture, radius_m, range_m * cos(azimuth_rad), range_m * sin(azimuth_rad), 'o');
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
