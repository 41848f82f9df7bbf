/* The brake controller's world: two cars on a lane, an ultrasonic sensor, a brake that follows the
 * PWM and the stop line, a lamp and a buzzer. */
#include "world.h"

#include "car.h"
#include "pwm.h"
#include "sonar.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Hard braking is what UN R152 asks of emergency braking. */
static const double hard_braking_mps2 = 5.0;
static const double duty_step_pct = 2.0;
static const int64_t max_pause_ns = 1000000000;
static const int64_t guess_margin_ns = 2000000; /* that a trigger may come earlier than ever */

struct world {
    struct car car;
    struct sonar sonar;
    struct pwm pwm;
    bool levels[BOARD_OUTPUTS];
    double event_s, hold_s; /* as in the scenario */
    int64_t now_ns, event_ns;
    int64_t trigger_rise_ns;
    int64_t trigger_fall_ns, trigger_pause_ns; /* the last one; the shortest pause so far */
    int64_t mark_ns;                           /* the next boundary of a fault */
    struct {
        int64_t at_ns[2];
        int next;
    } override;
    /* what is measured beside the car's own record */
    double max_brake_pct, min_brake_pct, full_brake_s, counted_duty_pct, duty_steps;
    double stop_toggles, stop_on_s, stop_rise_s, stop_fall_s;
    double warnings, first_warning_s, hard_braking_s, first_fault_s;
    bool blind; /* readings are missing */
    double blind_from_pct, blind_fall_pct;
};

static const struct world_column columns[] = {
    {"gap_m", 4},     {"ego_mps", 4}, {"lead_mps", 4}, {"accel_mps2", 3},
    {"brake_pct", 1}, {"stop", 0},    {"lamp", 0},     {"buzzer", 0},
};

static double seconds(int64_t t_ns)
{
    return (double)t_ns * 1e-9;
}

/* --- the brake ---------------------------------------------------------------------------- */

static double demand_pct(const struct world *world)
{
    return world->levels[PIN_STOP] ? 100 : world->pwm.duty_pct;
}

static void note_demand(struct world *world)
{
    double demand = world->car.demand_pct, t_s = seconds(world->now_ns);

    world->max_brake_pct = fmax(world->max_brake_pct, demand);
    if (world->now_ns >= world->event_ns) {
        world->min_brake_pct = fmin(world->min_brake_pct, demand);
        if (demand >= 100 && isinf(world->full_brake_s))
            world->full_brake_s = t_s;
    }
    if (isinf(world->hard_braking_s) &&
        demand / 100 * world->car.ego.brake_max_mps2 >= hard_braking_mps2)
        world->hard_braking_s = t_s;
    if (fabs(demand - world->counted_duty_pct) > duty_step_pct) {
        world->counted_duty_pct = demand;
        world->duty_steps++;
    }
    if (world->blind)
        world->blind_fall_pct = fmax(world->blind_fall_pct, world->blind_from_pct - demand);
}

static void update_demand(struct world *world)
{
    double demand = demand_pct(world);

    if (demand < world->car.demand_pct || demand > world->car.demand_pct) {
        car_demand(&world->car, world->now_ns, demand);
        note_demand(world);
    }
}

/* --- time --------------------------------------------------------------------------------- */

static void advance(struct world *world, int64_t t_ns)
{
    while (world->now_ns < t_ns) {
        int64_t next = t_ns, steady = pwm_steady_ns(&world->pwm);

        if (steady < next)
            next = steady;
        if (world->mark_ns < next)
            next = world->mark_ns;
        if (world->event_ns > world->now_ns && world->event_ns < next)
            next = world->event_ns;
        car_advance(&world->car, next);
        world->now_ns = next;
        if (next == steady && pwm_settle(&world->pwm))
            update_demand(world);
        if (next == world->event_ns)
            note_demand(world);
        if (next == world->mark_ns) {
            sonar_pass_boundary(&world->sonar, next);
            world->mark_ns = sonar_boundary_ns(&world->sonar, next);
        }
        if (world->now_ns % WORLD_ROW_NS == 0)
            sonar_observe(&world->sonar, world->now_ns, car_gap_m(&world->car));
    }
}

static int64_t horizon_ns(const struct world *world, int64_t t_ns)
{
    return sonar_horizon_ns(&world->sonar, t_ns);
}

static int64_t guess_ns(const struct world *world, int64_t t_ns)
{
    int64_t next_ns = world->trigger_fall_ns + world->trigger_pause_ns - guess_margin_ns;

    return sonar_horizon_ns(&world->sonar, next_ns > t_ns ? next_ns : t_ns);
}

static int64_t mark_ns(const struct world *world)
{
    return world->mark_ns;
}

/* --- pins --------------------------------------------------------------------------------- */

static void trigger_ends(struct world *world)
{
    double gap = car_gap_m(&world->car);
    double closing = isinf(gap) ? 0 : world->car.v_mps - car_lead_mps(&world->car);
    enum sonar_answer answer = sonar_trigger(&world->sonar, world->now_ns,
                                             world->now_ns - world->trigger_rise_ns, gap, closing);
    int64_t pause_ns = world->now_ns - world->trigger_fall_ns;

    /* A pause of more than a second says nothing about the pace. */
    if (world->trigger_fall_ns > 0 && pause_ns < max_pause_ns &&
        (world->trigger_pause_ns == 0 || pause_ns < world->trigger_pause_ns))
        world->trigger_pause_ns = pause_ns;
    world->trigger_fall_ns = world->now_ns;
    if (answer == SONAR_MISSING && !world->blind) {
        world->blind = true;
        world->blind_from_pct = world->car.demand_pct;
    } else if (answer == SONAR_TARGET || answer == SONAR_NONE) {
        world->blind = false;
    }
}

static void warning_goes_on(struct world *world)
{
    bool both = !world->levels[PIN_LAMP] && !world->levels[PIN_BUZZER];

    if (!both) /* the first of the two */
        world->warnings++;
    if (isinf(world->first_warning_s))
        world->first_warning_s = seconds(world->now_ns);
}

static void stop_line_changes(struct world *world, bool level)
{
    world->stop_toggles++;
    if (level) {
        world->stop_rise_s = seconds(world->now_ns);
        world->stop_fall_s = INFINITY;
    } else {
        world->stop_fall_s = seconds(world->now_ns);
        world->stop_on_s += world->stop_fall_s - world->stop_rise_s;
    }
    update_demand(world);
}

static void pin_changed(struct world *world, int64_t t_ns, enum board_pin pin, bool level)
{
    advance(world, t_ns);
    world->levels[pin] = level;
    switch (pin) {
    case PIN_PWM:
        if (pwm_edge(&world->pwm, world->now_ns, level))
            update_demand(world);
        break;
    case PIN_STOP:
        stop_line_changes(world, level);
        break;
    case PIN_TRIGGER:
        if (level)
            world->trigger_rise_ns = world->now_ns;
        else
            trigger_ends(world);
        break;
    default:
        if (!level)
            warning_goes_on(world);
        break;
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

static struct world *create(const struct scenario *scenario, uint64_t seed, int64_t step_ns)
{
    struct world *world = calloc(1, sizeof *world);

    if (world == NULL)
        abort();
    car_init(&world->car, scenario, step_ns);
    sonar_init(&world->sonar, scenario, seed);
    world->event_s = scenario->event_s;
    world->event_ns = (int64_t)llround(scenario->event_s * 1e9);
    world->hold_s = scenario->hold_s;
    world->override.next = scenario->override.from_s >= 0 ? 0 : 2;
    world->override.at_ns[0] = (int64_t)llround(scenario->override.from_s * 1e9);
    world->override.at_ns[1] =
        (int64_t)llround((scenario->override.from_s + scenario->override.for_s) * 1e9);
    world->min_brake_pct = INFINITY;
    world->full_brake_s = world->hard_braking_s = world->first_warning_s = INFINITY;
    world->stop_fall_s = world->first_fault_s = INFINITY;
    return world;
}

static void destroy(struct world *world)
{
    sonar_free(&world->sonar);
    free(world);
}

static void start(struct world *world, const bool levels[BOARD_OUTPUTS])
{
    memcpy(world->levels, levels, sizeof world->levels);
    pwm_init(&world->pwm, 0, levels[PIN_PWM]);
    car_demand(&world->car, 0, demand_pct(world));
    world->counted_duty_pct = world->car.demand_pct;
    note_demand(world);
    if (!levels[PIN_LAMP] || !levels[PIN_BUZZER])
        world->warnings = 1, world->first_warning_s = 0;
    sonar_observe(&world->sonar, 0, car_gap_m(&world->car));
    world->mark_ns = sonar_boundary_ns(&world->sonar, -1);
    if (world->mark_ns == 0) {
        sonar_pass_boundary(&world->sonar, 0);
        world->mark_ns = sonar_boundary_ns(&world->sonar, 0);
    }
}

static void state_reported(struct world *world, int64_t t_ns, const char *state)
{
    double t_s = seconds(t_ns);

    if (strcmp(state, "FAULT") == 0 && t_ns >= world->event_ns && isinf(world->first_fault_s))
        world->first_fault_s = t_s;
}

static bool is_over(const struct world *world)
{
    const struct car_record *record = &world->car.record;

    return record->impact ||
           (world->hold_s >= 0 && seconds(world->now_ns) - record->still_s >= world->hold_s);
}

static void values(const struct world *world, double row[WORLD_COLUMNS])
{
    double gap = car_gap_m(&world->car);

    row[0] = isinf(gap) ? NAN : gap;
    row[1] = world->car.v_mps;
    row[2] = isinf(gap) ? NAN : car_lead_mps(&world->car);
    row[3] = world->car.accel_mps2;
    row[4] = world->car.demand_pct;
    row[5] = world->levels[PIN_STOP];
    row[6] = !world->levels[PIN_LAMP];
    row[7] = !world->levels[PIN_BUZZER];
}

static void measure(const struct world *world, int64_t t_ns, struct outcome *outcome)
{
    const struct car_record *record = &world->car.record;
    double *value = outcome->values, t_s = seconds(t_ns), since_s = world->event_s;

    outcome->rest_s = record->rest_s;
    value[METRIC_IMPACT] = record->impact;
    value[METRIC_IMPACT_MPS] = record->impact_mps;
    value[METRIC_MIN_GAP] = record->min_gap_m;
    value[METRIC_STOP_GAP] = record->rest_gap_m;
    value[METRIC_STOP_WITHIN] = record->first_rest_s - since_s;
    value[METRIC_FINAL_SPEED] = world->car.v_mps;
    value[METRIC_PEAK_DECEL] = record->peak_decel_mps2;
    value[METRIC_PEAK_JERK] = record->peak_jerk_mps3;
    value[METRIC_RMS_ACCEL] = sqrt(record->square_mps3 / t_s);
    value[METRIC_STUCK] = record->stuck_s;
    value[METRIC_MAX_BRAKE] = world->max_brake_pct;
    value[METRIC_MIN_BRAKE] = fmin(world->min_brake_pct, world->car.demand_pct);
    value[METRIC_FINAL_BRAKE] = world->car.demand_pct;
    value[METRIC_FULL_BRAKE_WITHIN] = world->full_brake_s - since_s;
    value[METRIC_BLIND_FALL] = world->blind_fall_pct;
    value[METRIC_DUTY_STEPS] = world->duty_steps / t_s;
    value[METRIC_STOP_TOGGLES] = world->stop_toggles;
    value[METRIC_STOP_ON] =
        world->stop_on_s + (world->levels[PIN_STOP] ? t_s - world->stop_rise_s : 0);
    value[METRIC_RELEASE_WITHIN] = world->stop_fall_s - since_s;
    value[METRIC_FAULT_WITHIN] = world->first_fault_s - since_s;
    value[METRIC_WARNINGS] = world->warnings;
    value[METRIC_WARNING_LEAD] =
        isinf(world->hard_braking_s) ? INFINITY : world->hard_braking_s - world->first_warning_s;
}

const struct world_class brake_world = {
    .columns = columns,
    .column_count = sizeof columns / sizeof columns[0],
    .create = create,
    .destroy = destroy,
    .start = start,
    .pin_changed = pin_changed,
    .advance = advance,
    .next_input = next_input,
    .horizon_ns = horizon_ns,
    .guess_ns = guess_ns,
    .mark_ns = mark_ns,
    .state_reported = state_reported,
    .is_over = is_over,
    .values = values,
    .measure = measure,
};
