/* The brake controller's world: two cars on a lane, an ultrasonic sensor, a brake that follows the
 * PWM and the stop line, a lamp and a buzzer. */
#include "base.h"
#include "sonar.h"

#include <math.h>

struct world {
    struct base base;
    struct rig rig;
    struct sonar sonar;
    int64_t now_ns;
    int64_t trigger_rise_ns;
    int64_t mark_ns; /* the next boundary of a fault */
    struct {
        int64_t at_ns[2];
        int next;
    } override;
};

static const struct world_column columns[] = {RIG_COLUMN_NAMES};
static const char *const reported[] = {"dist_mm", "closing_mmps"};

/* --- time --------------------------------------------------------------------------------- */

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
            sonar_pass_boundary(&world->sonar, next);
            world->mark_ns = sonar_boundary_ns(&world->sonar, next);
        }
        if (next == row_ns) {
            sonar_observe(&world->sonar, next, car_gap_m(&world->rig.car));
        }
    }
}

static int64_t horizon_ns(const struct world *world, int64_t t_ns)
{
    return sonar_horizon_ns(&world->sonar, t_ns);
}

static int64_t guess_ns(const struct world *world, int64_t t_ns)
{
    return sonar_horizon_ns(&world->sonar, pace_next_ns(&world->base.pace, t_ns));
}

static int64_t mark_ns(const struct world *world)
{
    return world->mark_ns;
}

/* --- pins --------------------------------------------------------------------------------- */

static void trigger_ends(struct world *world)
{
    const struct car *car = &world->rig.car;
    double gap = car_gap_m(car);
    double closing = isinf(gap) ? 0 : car->v_mps - car_lead_mps(car);
    enum sonar_answer answer = sonar_trigger(&world->sonar, world->now_ns,
                                             world->now_ns - world->trigger_rise_ns, gap, closing);

    pace_note(&world->base.pace, world->now_ns);
    if (answer == SONAR_MISSING) {
        rig_blind(&world->rig, true);
    } else if (answer == SONAR_TARGET || answer == SONAR_NONE) {
        rig_blind(&world->rig, false);
    }
}

static void pin_changed(struct world *world, int64_t t_ns, enum board_pin pin, bool level)
{
    advance(world, t_ns);
    rig_pin(&world->rig, t_ns, pin, level);
    if (pin != PIN_TRIGGER) {
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
    return sonar_next_event(&world->sonar, until_ns, t_ns, level);
}

/* --- life and outcome --------------------------------------------------------------------- */

static int64_t not_too_early(int64_t t_ns)
{
    return t_ns < WORLD_FIRST_INPUT_NS ? WORLD_FIRST_INPUT_NS : t_ns;
}

static struct world *create(const struct scenario *scenario, uint64_t seed, int64_t step_ns)
{
    struct world *world = base_create(sizeof *world);

    world->base = (struct base){.rig = &world->rig};
    rig_init(&world->rig, scenario, step_ns);
    sonar_init(&world->sonar, scenario, seed);
    world->override.next = scenario->override.from_s >= 0 ? 0 : 2;
    world->override.at_ns[0] = not_too_early((int64_t)llround(scenario->override.from_s * 1e9));
    world->override.at_ns[1] =
        (int64_t)llround((scenario->override.from_s + scenario->override.for_s) * 1e9);
    return world;
}

static void destroy(struct world *world)
{
    sonar_free(&world->sonar);
    base_destroy(world);
}

static void start(struct world *world, const bool levels[BOARD_OUTPUTS])
{
    rig_start(&world->rig, levels);
    sonar_observe(&world->sonar, 0, car_gap_m(&world->rig.car));
    world->mark_ns = not_too_early(sonar_boundary_ns(&world->sonar, -1));
}

static void values(const struct world *world, double row[WORLD_COLUMNS])
{
    rig_values(&world->rig, row);
}

const struct world_class brake_world = {
    BASE_TRACE(columns, reported),
    .create = create,
    .destroy = destroy,
    .start = start,
    .pin_changed = pin_changed,
    .advance = advance,
    .next_input = next_input,
    .horizon_ns = horizon_ns,
    .guess_ns = guess_ns,
    .mark_ns = mark_ns,
    BASE_RIG_FUNCTIONS,
    .values = values,
    .measure = base_measure,
};
