/* SPDX-License-Identifier: MIT */
#include "run.h"

#include "diag.h"
#include "pwm.h"
#include "sim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    CLOCKS_PER_CYCLE = 12,
    INPUTS = BOARD_PINS - BOARD_OUTPUTS,
    PAST_NS = 2000 /* a mark is passed up to a cycle late */
};

_Static_assert(WORLD_FIRST_INPUT_NS >= (RUN_QUANTUM_US + RUN_MARGIN_US) * 1000,
               "a world's first input must not be due before the loop knows of the first trigger");

struct loop {
    struct run *run;
    const struct run_setup *setup;
    const struct world_class *class;
    const struct run_observer *observers;
    int observer_count;
    struct sim *sim;
    struct world *world;
    bool levels[BOARD_OUTPUTS];
    int64_t start_ns; /* of the scenario, in the simulator's time */
    bool is_unasked;  /* no trigger begins it */
    int64_t calm_ns;  /* then it begins here; INT64_MAX: not known yet */
    bool has_bytes;   /* the world sends some */
    int64_t now_ns;   /* of the scenario */
    bool sent;        /* the scenario's bytes for the serial line */
    enum sim_status status;
    bool guess, late; /* an input would have been due before the present: the guess was wrong */
    struct {
        int64_t t_ns;
        enum board_pin pin;
        bool level;
    } inputs[16]; /* since the last sync, still to be shown among the edges */
    int input_count;
};

static int64_t ns_from_s(double time_s)
{
    return (int64_t)llround(time_s * 1e9);
}

static double wall_s(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

/* --- flips --------------------------------------------------------------------------------- */

static uint8_t pin_address(const struct board *board, int pin)
{
    enum { RXD = 0xB0, TXD = 0xB1 };

    return pin == FLIP_RXD ? RXD : pin == FLIP_TXD ? TXD : board->pins[pin];
}

/* START_CYCLE: when the scenario began, for a flip that says at_s. */
static struct sim_flip sim_flip_of(const struct flip *flip, const struct board *board,
                                   uint64_t start_cycle)
{
    static const enum sim_flip_kind kinds[] = {[FLIP_ONCE] = SIM_FLIP,
                                               [FLIP_STUCK_LOW] = SIM_STUCK_LOW,
                                               [FLIP_STUCK_HIGH] = SIM_STUCK_HIGH,
                                               [FLIP_PIN_LOW] = SIM_PIN_LOW,
                                               [FLIP_PIN_HIGH] = SIM_PIN_HIGH,
                                               [FLIP_PINS_TIED] = SIM_PINS_TIED,
                                               [FLIP_POWER_DIP] = SIM_POWER_DIP,
                                               [FLIP_CLOCK_STOP] = SIM_CLOCK_STOP,
                                               [FLIP_INTERRUPTS] = SIM_INTERRUPTS};
    static const enum sim_flip_place places[] = {[FLIP_RAM] = SIM_RAM,
                                                 [FLIP_SFR] = SIM_SFR,
                                                 [FLIP_REGISTER] = SIM_REGISTER,
                                                 [FLIP_PC] = SIM_PC,
                                                 [FLIP_XDATA] = SIM_XDATA};
    double cycles_per_s = (double)board->clk_hz / CLOCKS_PER_CYCLE;
    bool of_pin = flip->kind >= FLIP_PIN_LOW && flip->kind <= FLIP_PINS_TIED;

    return (struct sim_flip){
        .kind = kinds[flip->kind],
        .place = places[flip->place],
        .address = of_pin ? pin_address(board, flip->pin) : (uint16_t)fmax(flip->address, 0),
        .other = flip->kind == FLIP_PINS_TIED ? pin_address(board, flip->to) : 0,
        .bit = (int)flip->bit,
        .counts_instructions = flip->at_instruction >= 0,
        .when = flip->at_instruction >= 0 ? (uint64_t)flip->at_instruction
                : flip->at_cycle >= 0     ? (uint64_t)flip->at_cycle
                                          : start_cycle + (uint64_t)(flip->at_s * cycles_per_s),
        .cycles = flip->for_s >= 0 ? (uint64_t)ceil(flip->for_s * cycles_per_s) : 0};
}

static bool has_flip(const struct flip *flip)
{
    return flip->at_s >= 0 || flip->at_cycle >= 0 || flip->at_instruction >= 0;
}

/* --- what the controller does -------------------------------------------------------------- */

static void show_pin(const struct loop *loop, int64_t t_ns, enum board_pin pin, bool level)
{
    for (int i = 0; i < loop->observer_count; i++) {
        if (loop->observers[i].pin != NULL) {
            loop->observers[i].pin(loop->observers[i].user, t_ns, pin, level);
        }
    }
}

/* Shows the inputs until T_NS. */
static void show_inputs(struct loop *loop, int64_t t_ns)
{
    int shown = 0;

    while (shown < loop->input_count && loop->inputs[shown].t_ns <= t_ns) {
        show_pin(loop, loop->inputs[shown].t_ns, loop->inputs[shown].pin,
                 loop->inputs[shown].level);
        shown++;
    }
    loop->input_count -= shown;
    memmove(loop->inputs, loop->inputs + shown, (size_t)loop->input_count * sizeof loop->inputs[0]);
}

static void show_row(const struct loop *loop, int64_t t_ns)
{
    double values[WORLD_COLUMNS];

    loop->class->values(loop->world, values);
    for (int i = 0; i < loop->observer_count; i++) {
        if (loop->observers[i].row != NULL) {
            loop->observers[i].row(loop->observers[i].user, t_ns, values, &loop->run->telemetry);
        }
    }
}

/* The scenario begins: what happens to the chip at times of the scenario. */
static void plan_flips(struct loop *loop)
{
    uint64_t start_cycle = sim_cycle(loop->sim, loop->start_ns);

    for (int i = 0; i < SCENARIO_FLIPS; i++) {
        const struct flip *flip = &loop->setup->scenario->flips[i];
        struct sim_flip one = sim_flip_of(flip, loop->setup->board, start_cycle);

        if (flip->at_s >= 0 && !sim_flip(loop->sim, &one)) {
            abort(); /* the reader of the scenario has checked it */
        }
    }
}

static void start_world(struct loop *loop, int64_t start_ns)
{
    loop->run->triggered = true;
    loop->run->boot_ns = loop->start_ns = start_ns;
    plan_flips(loop);
    loop->class->start(loop->world, loop->levels);
    for (int pin = 0; pin < BOARD_OUTPUTS; pin++) {
        if (pin != PIN_TRIGGER) {
            show_pin(loop, 0, (enum board_pin)pin, loop->levels[pin]);
        }
    }
    show_row(loop, 0);
}

/* Edges before the first trigger only set the levels at the start. */
static void take_edges(struct loop *loop)
{
    for (size_t i = 0; i < loop->sim->edge_count && !loop->sim->edges[i].after_reset; i++) {
        const struct sim_edge *edge = &loop->sim->edges[i];

        loop->levels[edge->pin] = edge->level;
        if (edge->pin == PIN_STOP && !edge->level && loop->calm_ns == INT64_MAX) {
            loop->calm_ns = edge->time_ns + RUN_CALM_MS * 1000000LL;
        }
        if (!loop->run->triggered && !loop->is_unasked && edge->pin == PIN_TRIGGER && edge->level &&
            (loop->class->is_warm == NULL || loop->class->is_warm(loop->world))) {
            start_world(loop, edge->time_ns);
        }
        if (!loop->run->triggered) {
            if (loop->class->is_warm != NULL) {
                loop->class->pin_changed(loop->world, edge->time_ns, (enum board_pin)edge->pin,
                                         edge->level);
            }
        } else {
            int64_t t_ns = edge->time_ns - loop->start_ns;

            show_inputs(loop, t_ns);
            loop->class->pin_changed(loop->world, t_ns, (enum board_pin)edge->pin, edge->level);
            show_pin(loop, t_ns, (enum board_pin)edge->pin, edge->level);
        }
    }
}

static void note_state(struct loop *loop, const char *state)
{
    struct outcome *outcome = &loop->run->outcome;
    char word[TELEMETRY_FIELD_SIZE + 2];

    snprintf(outcome->final_state, sizeof outcome->final_state, "%s", state);
    snprintf(word, sizeof word, "%s ", state);
    if (strstr(outcome->states, word) == NULL &&
        strlen(outcome->states) + strlen(word) < sizeof outcome->states) {
        strcat(outcome->states, word);
    }
}

static void take_line(void *user, const struct telemetry *telemetry)
{
    struct loop *loop = user;
    const char *state = telemetry_value(telemetry, "state");

    if (!loop->run->triggered) {
        return;
    }
    for (int i = 0; i < loop->observer_count; i++) {
        if (loop->observers[i].line != NULL) {
            loop->observers[i].line(loop->observers[i].user, telemetry);
        }
    }
    if (state[0] != '\0') {
        loop->class->state_reported(loop->world, telemetry->line_ns, state);
        note_state(loop, state);
    }
}

static void take_uart(struct loop *loop)
{
    char bytes[512];
    size_t got;

    while ((got = sim_receive(loop->sim, bytes, sizeof bytes)) > 0) {
        telemetry_take(&loop->run->telemetry, loop->now_ns, loop->class->measured_ns(loop->world),
                       bytes, got, take_line, loop);
    }
}

/* --- lockstep ----------------------------------------------------------------------------- */

/* How far the simulator may run from NOW_NS on before the world must be asked again. */
static int64_t next_sync_ns(const struct loop *loop, int64_t t_ns)
{
    /* The sensor answers after its delay at the earliest: so far the simulator may run alone. A
     * shorter quantum makes that shorter. */
    int64_t margin_ns = (RUN_QUANTUM_US + RUN_MARGIN_US - loop->setup->quantum_us) * 1000LL;
    int64_t mark_ns = loop->class->mark_ns(loop->world);
    int64_t next_ns = loop->guess ? loop->class->guess_ns(loop->world, loop->now_ns)
                                  : loop->class->horizon_ns(loop->world, loop->now_ns);

    next_ns -= margin_ns;
    if (mark_ns < next_ns) {
        next_ns = mark_ns;
    }
    if (t_ns < next_ns) {
        next_ns = t_ns;
    }
    return sim_grid_ns(loop->sim, loop->start_ns + next_ns);
}

/* Hands the inputs that are due until UNTIL_NS to the simulator. */
static void take_inputs(struct loop *loop, int64_t until_ns)
{
    int64_t t_ns;
    enum board_pin pin;
    bool level;

    while (loop->class->next_input != NULL &&
           loop->class->next_input(loop->world, until_ns, &t_ns, &pin, &level)) {
        if (t_ns < loop->now_ns - PAST_NS) {
            loop->late = true;
        }
        sim_set_pin(loop->sim, loop->start_ns + t_ns, (int)pin - BOARD_OUTPUTS, level);
        loop->inputs[loop->input_count].t_ns = t_ns;
        loop->inputs[loop->input_count].pin = pin;
        loop->inputs[loop->input_count++].level = level;
    }
}

/* The world's own mark, if the present has come to it: the bytes that go out now. */
static void pass_mark(struct loop *loop)
{
    uint8_t bytes[WORLD_BYTES];
    int64_t mark_ns = loop->class->mark_ns(loop->world);

    if (mark_ns > loop->now_ns) {
        return;
    }
    if (mark_ns < loop->now_ns - PAST_NS) {
        loop->late = true;
    }
    loop->class->advance(loop->world, mark_ns);
    if (loop->has_bytes) {
        size_t count = loop->class->take_bytes(loop->world, mark_ns, bytes);

        sim_send(loop->sim, (const char *)bytes, count);
    }
}

/* Runs the simulator to T_NS of the scenario. The world is advanced only to the controller's edges
 * and to times that are its own, so that the quantum leaves no trace in its numbers. */
static enum sim_status run_to(struct loop *loop, int64_t t_ns)
{
    while (loop->now_ns < t_ns) {
        int64_t sync_ns = next_sync_ns(loop, t_ns);
        enum sim_status status;

        take_inputs(loop, sync_ns - loop->start_ns);
        if (loop->late) {
            return SIM_FAILED;
        }
        status = sim_run_to(loop->sim, sync_ns);
        loop->run->syncs++;
        take_edges(loop);
        show_inputs(loop, INT64_MAX);
        if (status != SIM_RAN) {
            return status;
        }
        loop->now_ns = loop->sim->now_ns - loop->start_ns;
        pass_mark(loop);
    }
    loop->class->advance(loop->world, t_ns);
    return SIM_RAN;
}

static bool is_booting(const struct loop *loop)
{
    return loop->status == SIM_RAN && !loop->run->triggered &&
           loop->now_ns < RUN_BOOT_S * 1000000000LL;
}

static enum sim_status boot_quantum(struct loop *loop)
{
    int64_t next_ns = loop->now_ns + (int64_t)loop->setup->quantum_us * 1000;
    bool is_fed = loop->has_bytes && !loop->is_unasked; /* before the scenario begins */
    enum sim_status status;

    if (is_fed && loop->class->mark_ns(loop->world) < next_ns) {
        next_ns = loop->class->mark_ns(loop->world);
    }
    if (loop->is_unasked && loop->calm_ns < next_ns) {
        next_ns = loop->calm_ns;
    }
    status = sim_run_to(loop->sim, next_ns);
    loop->run->syncs++;
    take_edges(loop);
    if (status != SIM_RAN) {
        return status;
    }
    if (loop->is_unasked && loop->sim->now_ns >= loop->calm_ns) {
        start_world(loop, loop->calm_ns);
    }
    loop->now_ns = loop->sim->now_ns - loop->start_ns;
    if (!loop->run->triggered && is_fed) {
        pass_mark(loop);
    }
    return SIM_RAN;
}

bool run_boot(struct loop *loop)
{
    if (is_booting(loop)) {
        loop->status = boot_quantum(loop);
    }
    if (is_booting(loop)) {
        return true;
    }
    if (loop->status == SIM_RAN && !loop->run->triggered) {
        take_uart(loop);
    }
    return false;
}

static void send_bytes(struct loop *loop, int64_t t_ns)
{
    const struct scenario *scenario = loop->setup->scenario;

    if (loop->sent || scenario->uart.at_s < 0 || t_ns < ns_from_s(scenario->uart.at_s)) {
        return;
    }
    sim_send(loop->sim, scenario->uart.send, strlen(scenario->uart.send));
    loop->sent = true;
}

static bool is_over(const struct loop *loop)
{
    return loop->run->duration_ns >= ns_from_s(loop->setup->scenario->duration_s) ||
           loop->class->is_over(loop->world);
}

static enum sim_status play_row(struct loop *loop)
{
    int64_t t_ns = loop->run->duration_ns + WORLD_ROW_NS;
    enum sim_status status;

    send_bytes(loop, loop->run->duration_ns);
    status = run_to(loop, t_ns);
    loop->run->duration_ns = t_ns;
    take_uart(loop);
    if (status == SIM_RAN) {
        show_row(loop, t_ns);
    }
    return status;
}

/* --- after a reset by the watchdog ---------------------------------------------------------- */

/* The least that the pins demand while the controller starts again. A pin that says nothing yet is
 * high, as reset leaves it: full brake. */
static double lowest_demand_pct(const struct sim *sim)
{
    bool stop = true;
    struct pwm pwm;
    double lowest = 100;

    pwm_init(&pwm, 0, true);
    for (size_t i = 0; i < sim->edge_count; i++) {
        const struct sim_edge *edge = &sim->edges[i];

        if (!edge->after_reset) {
            continue;
        }
        if (edge->time_ns > pwm_steady_ns(&pwm)) {
            pwm_settle(&pwm);
        }
        if (!stop) {
            lowest = fmin(lowest, pwm.duty_pct);
        }
        if (edge->pin == PIN_PWM) {
            pwm_edge(&pwm, edge->time_ns, edge->level);
        } else if (edge->pin == PIN_STOP) {
            stop = edge->level;
        }
    }
    if (sim->last_ns > pwm_steady_ns(&pwm)) {
        pwm_settle(&pwm);
    }
    return stop ? lowest : fmin(lowest, pwm.duty_pct);
}

static enum sim_status watch_reset(struct loop *loop)
{
    double *values = loop->run->outcome.values;
    enum sim_status status = sim_run_after_reset(loop->sim, RUN_RESET_WATCH_MS * 1000000LL);

    values[METRIC_RESETS] = 1;
    values[METRIC_RESET_BRAKE] = lowest_demand_pct(loop->sim);
    if (values[METRIC_RESET_BRAKE] >= 100 && isinf(values[METRIC_FULL_BRAKE_WITHIN])) {
        values[METRIC_FULL_BRAKE_WITHIN] =
            (double)loop->run->duration_ns * 1e-9 - loop->setup->scenario->event_s;
    }
    take_uart(loop);
    return status;
}

/* --- outside ------------------------------------------------------------------------------ */

/* Those that count from power up. Returns their number. */
static int list_flips(const struct loop *loop, struct sim_flip flips[SCENARIO_FLIPS])
{
    int count = 0;

    for (int i = 0; i < SCENARIO_FLIPS; i++) {
        const struct flip *flip = &loop->setup->scenario->flips[i];

        if (has_flip(flip) && flip->at_s < 0) {
            flips[count++] = sim_flip_of(flip, loop->setup->board, 0);
        }
    }
    return count;
}

/* Returns EXIT_FINE, or EXIT_USAGE after a message: there are flips, and the engine has none. */
static int check_flips(const struct loop *loop)
{
    for (int i = 0; i < SCENARIO_FLIPS; i++) {
        if (has_flip(&loop->setup->scenario->flips[i]) && !loop->setup->engine->can_flip) {
            diag_error(loop->setup->scenario->file, 0,
                       "[flip] changes what is inside the chip, which %s cannot do; give "
                       "--engine=fast",
                       loop->setup->engine->name);
            return EXIT_USAGE;
        }
    }
    return EXIT_FINE;
}

static int start_simulator(struct loop *loop)
{
    const struct board *board = loop->setup->board;
    struct sim_flip flips[SCENARIO_FLIPS];
    const struct sim_setup setup = {
        .hex = loop->setup->hex,
        .s51_type = board->s51_type,
        .watchdog = board->watchdog,
        .clk_hz = board->clk_hz,
        .watch = board->pins,
        .watch_count = BOARD_OUTPUTS,
        .drive = board->pins + BOARD_OUTPUTS,
        .drive_count = INPUTS,
        /* override not held; echo low, or open where no sensor is wired to it */
        .levels = 1u << (PIN_OVERRIDE - BOARD_OUTPUTS) | (unsigned)loop->is_unasked
                                                             << (PIN_ECHO - BOARD_OUTPUTS),
        .uart_in = loop->setup->scenario->uart.at_s >= 0 || loop->has_bytes,
        .flips = flips,
        .flip_count = list_flips(loop, flips),
        .cover = loop->setup->cover,
    };

    return sim_start(loop->setup->engine, &loop->sim, &setup);
}

/* The controller stands at reset, the world before the scenario's begin. */
static int power_up(struct loop *loop)
{
    struct run *run = loop->run;
    const struct run_setup *setup = loop->setup;

    telemetry_init(&run->telemetry);
    outcome_clear(&run->outcome);
    loop->calm_ns = INT64_MAX;
    loop->is_unasked = loop->class->is_unasked != NULL && loop->class->is_unasked(setup->scenario);
    loop->has_bytes =
        loop->class->take_bytes != NULL && (loop->class->is_unasked == NULL || loop->is_unasked);
    run->outcome.uart = run->telemetry.log;
    if (check_flips(loop) != EXIT_FINE || start_simulator(loop) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    loop->world = loop->class->create(setup->scenario, setup->seed, (int64_t)setup->step_us * 1000);
    memset(loop->levels, true, sizeof loop->levels);
    loop->status = SIM_RAN;
    return EXIT_FINE;
}

static bool next_row(struct loop *loop)
{
    if (loop->status != SIM_RAN || !loop->run->triggered || is_over(loop)) {
        return false;
    }
    loop->status = play_row(loop);
    return loop->status == SIM_RAN;
}

/* The outcome; the simulator and the world are gone then. */
static int end(struct loop *loop)
{
    struct run *run = loop->run;
    enum sim_status status = loop->status;

    loop->class->measure(loop->world, run->duration_ns, &run->outcome);
    for (int metric = 0; metric < METRIC_COUNT; metric++) {
        run->outcome.values[metric] += 0.0; /* no -0 */
    }
    if (status == SIM_RESET) {
        status = watch_reset(loop);
    }
    run->outcome.uart = run->telemetry.log;
    loop->class->destroy(loop->world);
    sim_stop(loop->sim);
    return status == SIM_FAILED && !loop->late ? EXIT_USAGE : EXIT_FINE;
}

static int run_once(struct loop *loop)
{
    if (power_up(loop) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    while (run_boot(loop))
        ;
    while (next_row(loop))
        ;
    return end(loop);
}

struct loop *run_power_up(struct run *run, const struct run_setup *setup,
                          const struct run_observer *observers, int observer_count)
{
    struct loop *loop = calloc(1, sizeof *loop);

    if (loop == NULL) {
        abort();
    }
    memset(run, 0, sizeof *run);
    loop->run = run;
    loop->setup = setup;
    loop->class = setup->scenario->world;
    loop->observers = observers;
    loop->observer_count = observer_count;
    if (power_up(loop) != EXIT_FINE) {
        free(loop);
        return NULL;
    }
    return loop;
}

struct loop *run_begin(struct run *run, const struct run_setup *setup,
                       const struct run_observer *observers, int observer_count)
{
    struct loop *loop = run_power_up(run, setup, observers, observer_count);

    while (loop != NULL && run_boot(loop))
        ;
    return loop;
}

bool run_next(struct loop *loop)
{
    return next_row(loop);
}

struct world *run_world(struct loop *loop)
{
    return loop->world;
}

struct sim *run_sim(struct loop *loop)
{
    return loop->sim;
}

int run_end(struct loop *loop)
{
    int status = end(loop);

    free(loop);
    return status;
}

int run_scenario(struct run *run, const struct run_setup *setup,
                 const struct run_observer *observers, int observer_count)
{
    double begin_s = wall_s();
    bool late = false;
    int restarts = 0, status;

    do {
        struct loop loop = {.run = run,
                            .setup = setup,
                            .class = setup->scenario->world,
                            .observers = observers,
                            .observer_count = observer_count,
                            .guess = setup->guess && !late};

        if (late) {
            restarts++;
            run_free(run);
            for (int i = 0; i < observer_count; i++) {
                if (observers[i].restart != NULL) {
                    observers[i].restart(observers[i].user);
                }
            }
        }
        memset(run, 0, sizeof *run);
        run->restarts = restarts;
        status = run_once(&loop);
        late = loop.late;
    } while (late && restarts == 0);
    if (late) {
        diag_error(NULL, 0, "the plant answers too late; that is a fault of drive");
        status = EXIT_USAGE;
    }
    run->wall_s = wall_s() - begin_s;
    return status;
}

void run_free(struct run *run)
{
    telemetry_free(&run->telemetry);
}
