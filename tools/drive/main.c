/* SPDX-License-Identifier: MIT */
/* drive: runs a controller's real image in the simulator, in a closed loop with a modelled car. */
#include "board.h"
#include "canary.h"
#include "cpu.h"
#include "diag.h"
#include "hexfile.h"
#include "identity.h"
#include "list.h"
#include "live.h"
#include "keys_page.h"
#include "manual.h"
#include "number.h"
#include "plot.h"
#include "protocols.h"
#include "run.h"
#include "s51.h"
#include "sim.h"
#include "trace.h"

#include <argp.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SETTINGS = 32 };

const char *argp_program_version = "fuzzy51 " FUZZY51_VERSION;

enum option_key {
    OPT_HEX = 256,
    OPT_BOARD,
    OPT_SCENARIO,
    OPT_CSV,
    OPT_VCD,
    OPT_JSON,
    OPT_LIVE,
    OPT_UART,
    OPT_COVERAGE,
    OPT_QUANTUM,
    OPT_STEP,
    OPT_SEED,
    OPT_SET,
    OPT_BRIEF,
    OPT_STATS,
    OPT_ENGINE,
    OPT_MAP
};

static const struct argp_option options[] = {
    {"hex", OPT_HEX, "FILE", 0,
     "the controller's image, Intel HEX (build/BOARD/APP.ihx, with the scenario's app)", 1},
    {"board", OPT_BOARD, "NAME", 0, "the board that the image was built for", 1},
    {"engine", OPT_ENGINE, "NAME", 0,
     "what runs the image: s51, uCsim's simulator, or fast, our own ($ENGINE, else s51)", 1},
    {"scenario", OPT_SCENARIO, "FILE", 0, "the scenario file", 1},
    {"set", OPT_SET, "SECTION.KEY=VALUE", 0, "replaces a value of the scenario; may be repeated",
     1},
    {"csv", OPT_CSV, "FILE", 0, "writes one line every 10 ms", 2},
    {"vcd", OPT_VCD, "FILE", 0, "writes pins and quantities for GTKWave", 2},
    {"json", OPT_JSON, "FILE", 0, "writes the outcome and all columns of CSV", 2},
    {"uart", OPT_UART, "FILE", 0, "writes what the controller sent on its serial line", 2},
    {"coverage", OPT_COVERAGE, "FILE", 0,
     "writes the address of each instruction that was run, one a line; --engine=fast only", 2},
    {"live", OPT_LIVE, NULL, 0, "shows a picture while it runs", 2},
    {"brief", OPT_BRIEF, NULL, 0, "prints test lines only: PLACE:LINE:NAME:PASS or FAIL", 2},
    {"stats", OPT_STATS, NULL, 0, "prints how long the run took", 2},
    {"quantum-us", OPT_QUANTUM, "N", 0,
     "longest time between two syncs, 10..400 (default: as needed)", 3},
    {"step-us", OPT_STEP, "N", 0, "longest step of the model, 10..10000 (default: 1000)", 3},
    {"seed", OPT_SEED, "N", 0, "seed of all random numbers (default: the scenario's)", 3},
    {"output", 'o', "FILE", 0, "plot: the figure, an .svg or .png", 4},
    {"map", OPT_MAP, "FINENESS", 0,
     "scenarios: how fine the avoidance map is: coarse, normal or fine", 4},
    {0},
};

struct arguments {
    const char *hex, *board, *scenario, *engine, *map, *output;
    struct trace_paths paths;
    bool live, brief, stats, has_seed, guess;
    int quantum_us, step_us;
    unsigned long seed;
    char *settings[MAX_SETTINGS + 1]; /* and one for the image's sensor */
    int setting_count;
    char *words[2];
    int word_count;
};

static error_t take_option(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;

    switch (key) {
    case OPT_HEX:
        arguments->hex = text;
        break;
    case OPT_ENGINE:
        arguments->engine = text;
        break;
    case OPT_BOARD:
        arguments->board = text;
        break;
    case OPT_SCENARIO:
        arguments->scenario = text;
        break;
    case OPT_CSV:
        arguments->paths.csv = text;
        break;
    case OPT_VCD:
        arguments->paths.vcd = text;
        break;
    case OPT_JSON:
        arguments->paths.json = text;
        break;
    case OPT_UART:
        arguments->paths.uart = text;
        break;
    case OPT_COVERAGE:
        arguments->paths.coverage = text;
        break;
    case OPT_LIVE:
        arguments->live = true;
        break;
    case 'o':
        arguments->output = text;
        break;
    case OPT_MAP:
        arguments->map = text;
        break;
    case OPT_BRIEF:
        arguments->brief = true;
        break;
    case OPT_STATS:
        arguments->stats = true;
        break;
    case OPT_QUANTUM:
        arguments->guess = false;
        arguments->quantum_us = (int)parse_count(state, "quantum-us", text, 10, RUN_QUANTUM_US);
        break;
    case OPT_STEP:
        arguments->step_us = (int)parse_count(state, "step-us", text, 10, 10000);
        break;
    case OPT_SEED:
        arguments->seed = (unsigned long)parse_count(state, "seed", text, 0, 4294967295);
        arguments->has_seed = true;
        break;
    case OPT_SET:
        if (arguments->setting_count == MAX_SETTINGS) {
            argp_error(state, "more than %d --set; write a scenario file", MAX_SETTINGS);
        }
        arguments->settings[arguments->setting_count++] = text;
        break;
    case ARGP_KEY_ARG:
        if (arguments->word_count == 2) {
            argp_error(state, "too many arguments");
        }
        arguments->words[arguments->word_count++] = text;
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static const struct argp parser = {
    .options = options,
    .parser = take_option,
    .args_doc = "run --board=NAME --scenario=FILE\nlist DIR\nkeys [APP]\nplot FILE -o "
                "FILE.svg\nscenarios DIR\ncanary",
    .doc =
        "Runs a controller's real image in a simulator, in a closed loop with a modelled "
        "car, road and sensor.\vrun judges the scenario's stated outcomes and prints each with "
        "its value; list prints the scenarios of a folder; keys prints what a scenario file may "
        "hold; plot draws a run's CSV or JSON; scenarios writes those of the report; canary checks "
        "that s51 keeps time.\n"
        "\nExit status: 0 all outcomes hold, 1 one does not, or bad input; 2 bad usage, no image "
        "to run, or the simulator failed.",
};

/* --- the outcome --------------------------------------------------------------------------- */

static const char *stem(const char *path)
{
    static char name[128];
    const char *base = strrchr(path, '/');

    snprintf(name, sizeof name, "%s", base != NULL ? base + 1 : path);
    if (strrchr(name, '.') != NULL) {
        *strrchr(name, '.') = '\0';
    }
    return name;
}

/* The run in one sentence or two. */
static void print_summary(const struct run *run, const struct scenario *scenario)
{
    const double *value = run->outcome.values;

    printf("%s: ", scenario->title);
    if (value[METRIC_RESETS] > 0) {
        printf("the watchdog reset the controller after %.2f s\n", (double)run->duration_ns * 1e-9);
    } else if (value[METRIC_IMPACT] > 0) {
        printf("impact at %.2f m/s after %.2f s\n", value[METRIC_IMPACT_MPS],
               (double)run->duration_ns * 1e-9);
    } else if (value[METRIC_FINAL_SPEED] > 0) {
        printf("drives at %.2f m/s after %.2f s\n", value[METRIC_FINAL_SPEED],
               (double)run->duration_ns * 1e-9);
    } else if (isfinite(value[METRIC_STOP_GAP])) {
        printf("stopped %.2f m behind the car ahead after %.2f s\n", value[METRIC_STOP_GAP],
               run->outcome.rest_s);
    } else {
        printf("stopped after %.2f s, with nothing ahead\n", run->outcome.rest_s);
    }
    printf("  peak deceleration %.2f m/s2, peak jerk %.1f m/s3, most brake %.0f %%\n",
           value[METRIC_PEAK_DECEL], value[METRIC_PEAK_JERK], value[METRIC_MAX_BRAKE]);
}

static bool judge(const struct expectation *expectation, const struct outcome *outcome,
                  const struct arguments *arguments)
{
    bool holds = expect_holds(expectation, outcome);
    char expected[EXPECT_VALUE + 64], value[EXPECT_VALUE + 64];

    expect_format(expectation, expected, sizeof expected);
    expect_value(expectation->metric, outcome, value, sizeof value);
    if (!arguments->brief) {
        printf("  %s  %-36s %s\n", holds ? "holds" : "FAILS", expected, value);
    } else if (holds) {
        printf("%s:%d:%s %s %s:PASS\n", arguments->scenario, expectation->line, arguments->board,
               stem(arguments->scenario), expected);
    } else {
        printf("%s:%d:%s %s %s:FAIL: it is %s\n", arguments->scenario, expectation->line,
               arguments->board, stem(arguments->scenario), expected, value);
    }
    return holds;
}

static bool is_stated(const struct scenario *scenario, enum metric metric)
{
    for (int i = 0; i < scenario->expect_count; i++) {
        if (scenario->expect[i].metric == metric) {
            return true;
        }
    }
    return false;
}

/* A run is judged by `impact = none` and `resets = 0` even when its file does not say so, where its
 * world measures them. */
static void add_understood(struct scenario *scenario)
{
    static const struct expectation understood[] = {
        {.metric = METRIC_IMPACT, .op = '=', .text = "none"},
        {.metric = METRIC_RESETS, .op = '=', .text = "0", .limit = 0},
    };
    struct outcome measured;

    scenario_measures(scenario, &measured);
    for (size_t k = 0; k < sizeof understood / sizeof understood[0]; k++) {
        if (!is_stated(scenario, understood[k].metric) &&
            !isnan(measured.values[understood[k].metric]) && scenario->expect_count < EXPECT_MAX) {
            scenario->expect[scenario->expect_count++] = understood[k];
        }
    }
}

static int report(const struct run *run, const struct scenario *scenario,
                  const struct arguments *arguments)
{
    const struct world_class *class = scenario->world;
    int status = EXIT_FINE;

    if (!run->triggered) {
        return diag_error(arguments->hex, 0,
                          "no trigger pulse within %d s; does the image fit board %s, and does its "
                          "self-test pass? It said: '%.80s'",
                          RUN_BOOT_S, arguments->board, run->telemetry.log);
    }
    if (!arguments->brief && class->tell != NULL && run->outcome.values[METRIC_RESETS] <= 0) {
        class->tell(&run->outcome, scenario);
    } else if (!arguments->brief) {
        print_summary(run, scenario);
    }
    for (int i = 0; i < scenario->expect_count; i++) {
        if (!judge(&scenario->expect[i], &run->outcome, arguments)) {
            status = EXIT_INPUT;
        }
    }
    if (!arguments->brief && arguments->paths.image != NULL) {
        printf("  image: %s\n", arguments->paths.image);
    }
    if (arguments->stats) {
        printf("  %.2f s simulated in %.2f s: %.2f times real time, %lld syncs%s\n",
               (double)(run->boot_ns + run->duration_ns) * 1e-9, run->wall_s,
               (double)(run->boot_ns + run->duration_ns) * 1e-9 / run->wall_s,
               (long long)run->syncs, run->restarts > 0 ? ", begun again" : "");
    }
    return status;
}

/* --- commands ------------------------------------------------------------------------------ */

static int run_and_report(struct run_setup *setup, struct scenario *scenario,
                          const struct arguments *arguments)
{
    const struct world_class *class = scenario->world;
    struct trace trace;
    struct live live;
    struct run run;
    struct run_observer observers[] = {
        {.user = &trace, trace_restart, trace_pin, trace_line, trace_row},
        {.user = &live, .row = live_row},
    };
    int status;

    if (trace_open(&trace, &arguments->paths, class) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (arguments->paths.coverage != NULL) {
        setup->cover = trace.covered;
    }
    if (arguments->live) {
        live_begin(&live, scenario, stdout);
    } else {
        cpu_claim();
    }
    status = run_scenario(&run, setup, observers, arguments->live ? 2 : 1);
    if (arguments->live) {
        live_end(&live);
    }
    if (status == EXIT_FINE) {
        status = report(&run, scenario, arguments);
        if (run.triggered && trace_commit(&trace, &run, setup) != EXIT_FINE) {
            status = EXIT_INPUT;
        }
    }
    trace_abandon(&trace);
    run_free(&run);
    return status;
}

/* The image's sensor is the scenario's: reads the scenario again with it, where the file names none
 * and the world has more than one. An image that does not say who it is has any sensor. */
static int match_sensor(struct arguments *arguments, struct scenario *scenario,
                        const struct identity *identity)
{
    static char setting[IDENTITY_WORD + 16];
    const char *sensor;

    if (scenario->world->sensor == NULL || identity->sensor[0] == '\0') {
        return EXIT_FINE;
    }
    sensor = scenario->world->sensor(scenario);
    if (sensor != NULL && strcmp(sensor, identity->sensor) != 0) {
        diag_error(arguments->hex, 0,
                   "this image reads a %s, and the sensor of %s is a %s; build one with SENSOR=%s",
                   identity->sensor, scenario->file, sensor, sensor);
        return EXIT_USAGE;
    }
    if (sensor != NULL) {
        return EXIT_FINE;
    }
    snprintf(setting, sizeof setting, "sensor.kind=%s", identity->sensor);
    arguments->settings[arguments->setting_count] = setting;
    return scenario_read(scenario, arguments->scenario, arguments->settings,
                         arguments->setting_count + 1);
}

/* Lets the run use what the image says of itself, or refuses the image. */
static int take_identity(struct arguments *arguments, const struct run_setup *setup,
                         struct scenario *scenario, struct board *board)
{
    static struct hexfile hex;
    static struct identity identity;
    int status = hexfile_read(&hex, setup->hex);

    if (status != EXIT_FINE) {
        return status;
    }
    identity_find(&identity, &hex);
    if (identity.text[0] != '\0') {
        arguments->paths.image = identity.text;
        board->clk_hz = identity.clk_hz;
    }
    status = identity_check(&identity, setup->hex, board->name, scenario->world->name);
    return status == EXIT_FINE ? match_sensor(arguments, scenario, &identity) : status;
}

/* The engine of that name; of $ENGINE, or s51, for NULL. Returns NULL after a message. */
static const struct sim_engine *find_engine(const char *name)
{
    const char *chosen = getenv("ENGINE");
    const struct sim_engine *engine;

    if (name == NULL) {
        name = chosen != NULL && chosen[0] != '\0' ? chosen : s51_engine.name;
    }
    engine = sim_engine(name);
    if (engine == NULL) {
        diag_error(NULL, 0, "no engine '%s'; the engines are: %s", name, sim_engine_names());
    }
    return engine;
}

static int command_run(struct arguments *arguments)
{
    struct board board;
    char image[SCENARIO_TEXT + 64];
    struct scenario scenario;
    struct run_setup setup = {.hex = arguments->hex,
                              .scenario = &scenario,
                              .quantum_us = arguments->quantum_us,
                              .step_us = arguments->step_us};
    int status;

    if (arguments->board == NULL || arguments->scenario == NULL) {
        diag_error(NULL, 0, "run wants --board and --scenario; see drive --help");
        return EXIT_USAGE;
    }
    setup.board = board_find(arguments->board);
    if (setup.board == NULL) {
        diag_error(NULL, 0, "no board '%s'; the boards are: %s", arguments->board, board_names());
        return EXIT_USAGE;
    }
    if (scenario_read(&scenario, arguments->scenario, arguments->settings,
                      arguments->setting_count) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (arguments->hex == NULL) {
        snprintf(image, sizeof image, "build/%s/%s.ihx", setup.board->name, scenario.app);
        setup.hex = arguments->hex = image;
    }
    board = *setup.board;
    setup.board = &board;
    status = take_identity(arguments, &setup, &scenario, &board);
    if (status != EXIT_FINE) {
        return status;
    }
    add_understood(&scenario);
    setup.guess = arguments->guess && !arguments->live;
    setup.seed = arguments->has_seed ? arguments->seed : (uint64_t)scenario.seed;
    setup.engine = find_engine(arguments->engine);
    if (setup.engine == NULL || sim_check(setup.engine) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    if (arguments->paths.coverage != NULL && !setup.engine->can_cover) {
        diag_error(
            NULL, 0,
            "%s does not tell which instructions it runs; give --engine=fast with --coverage",
            setup.engine->name);
        return EXIT_USAGE;
    }
    return run_and_report(&setup, &scenario, arguments);
}

static const struct manual manual = {
    .program = "drive",
    .brief = "a controller's image in the simulator, in a closed loop with a modelled car",
    .about = "",
    .command = &(const struct manual_command){.argp = &parser},
    .commands = 1,
};

static void interrupt(int number)
{
    (void)number;
    sim_is_interrupted = true;
}

/* An interrupted run cleans up: the simulator ends, and a terminal gets its cursor back. */
static void catch_signals(void)
{
    struct sigaction action = {.sa_handler = interrupt};

    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    signal(SIGPIPE, SIG_IGN);
}

int main(int argc, char **argv)
{
    struct arguments arguments = {.map = "normal",
                                  .guess = true,
                                  .quantum_us = RUN_QUANTUM_US,
                                  .step_us = WORLD_STEP_NS / 1000};
    const char *command;
    int status;

    argp_err_exit_status = EXIT_USAGE;
    if (argc == 2 && manual_option(&manual, argv[1], &status)) {
        return status;
    }
    argp_parse(&parser, argc, argv, 0, NULL, &arguments);
    catch_signals();
    command = arguments.word_count > 0 ? arguments.words[0] : "";
    if (strcmp(command, "run") == 0 && arguments.word_count == 1) {
        return command_run(&arguments);
    }
    if (strcmp(command, "list") == 0 && arguments.word_count == 2) {
        return list_scenarios(arguments.words[1]);
    }
    if (strcmp(command, "scenarios") == 0 && arguments.word_count == 2) {
        return protocols_write(arguments.words[1], arguments.map);
    }
    if (strcmp(command, "keys") == 0) {
        return keys_page_print(arguments.word_count == 2 ? arguments.words[1] : NULL);
    }
    if (strcmp(command, "plot") == 0 && arguments.word_count == 2 && arguments.output != NULL) {
        return plot_run(arguments.words[1], arguments.output);
    }
    if (strcmp(command, "canary") == 0 && arguments.word_count == 1) {
        return canary_run();
    }
    diag_error(
        NULL, 0,
        "say what to do: run, list DIR, keys, plot, scenarios DIR or canary; see drive --help");
    return EXIT_USAGE;
}
