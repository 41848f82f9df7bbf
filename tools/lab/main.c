/* SPDX-License-Identifier: MIT */
/* lab: the closed loop without the simulator, thousands of runs a second, to look for better
 * tables. */
#include "diag.h"
#include "lab.h"
#include "loop.h"
#include "number.h"
#include "world.h"

#include <argp.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS = 8, SETTINGS = 32, MOST = 1000000 };
enum { OPT_SCENARIO = 256, OPT_SET, OPT_SEED, OPT_RUNS, OPT_ROUNDS };

const char *argp_program_version = "fuzzy51 " FUZZY51_VERSION;

struct arguments {
    const char *words[WORDS];
    int word_count;
    const char *scenario, *output;
    char *settings[SETTINGS];
    int setting_count;
    long seed, runs, rounds; /* runs 0: as the command does by itself */
};

static const struct argp_option options[] = {
    {"scenario", OPT_SCENARIO, "FILE", 0, "run: the scenario", 1},
    {"set", OPT_SET, "SECTION.KEY=VALUE", 0, "run: replaces a value of it; may be repeated", 1},
    {"seed", OPT_SEED, "N", 0, "run: of the noise (the scenario's); tune: of the walk (1)", 1},
    {"runs", OPT_RUNS, "N", 0,
     "figures, attack: runs of each situation (60); trouble: likewise (500)", 1},
    {"rounds", OPT_ROUNDS, "N", 0, "tune: steps of the walk (1500)", 1},
    {"output", 'o', "FILE.fis", 0, "tune: where the best system goes", 1},
    {0},
};

static error_t take_option(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;

    switch (key) {
    case OPT_SCENARIO:
        arguments->scenario = text;
        return 0;
    case OPT_SET:
        if (arguments->setting_count == SETTINGS) {
            argp_error(state, "more than %d --set; write a scenario file", SETTINGS);
        }
        arguments->settings[arguments->setting_count++] = text;
        return 0;
    case OPT_SEED:
        arguments->seed = parse_count(state, "seed", text, 0, MOST);
        return 0;
    case OPT_RUNS:
        arguments->runs = parse_count(state, "runs", text, 1, MOST);
        return 0;
    case OPT_ROUNDS:
        arguments->rounds = parse_count(state, "rounds", text, 0, MOST);
        return 0;
    case 'o':
        arguments->output = text;
        return 0;
    case ARGP_KEY_ARG:
        if (arguments->word_count == WORDS) {
            argp_error(state, "too many arguments");
        }
        arguments->words[arguments->word_count++] = text;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp parser = {
    .options = options,
    .parser = take_option,
    .args_doc = "run CONTROLLER.so --scenario=FILE\nfigures CONTROLLER.so...\n"
                "trouble CONTROLLER.so...\nattack FIRST.so CONTROLLER.so...\n"
                "attack build/BOARD/IMAGE.ihx...\n"
                "tune TUNED.so REFERENCE.so -o FILE.fis",
    .doc =
        "Runs the firmware's control logic on this machine in drive's own world.\vrun prints what "
        "drive would measure; figures, what controllers come to; tune looks for a better table; "
        "trouble, what stray, missing and coarse readings do to them; attack looks for odd drives "
        "and "
        "fails if one in a thousand is odd. make puts the controllers into build/lab-images.\n\n"
        "Exit status: 0 fine, 1 bad input, 2 bad usage.",
};

static int command_run(const struct image *image, const struct arguments *arguments)
{
    static const enum metric shown[] = {METRIC_IMPACT_MPS, METRIC_MIN_GAP,   METRIC_STOP_GAP,
                                        METRIC_PEAK_DECEL, METRIC_PEAK_JERK, METRIC_RMS_ACCEL,
                                        METRIC_STUCK,      METRIC_MAX_BRAKE};
    struct scenario scenario;
    struct outcome outcome;

    if (scenario_read(&scenario, arguments->scenario, (char *const *)arguments->settings,
                      arguments->setting_count) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (scenario.world != &brake_world) {
        return diag_error(arguments->scenario, 0,
                          "app = %s; the laboratory has the brake's world alone, so use drive",
                          scenario.app);
    }
    loop_run(image, &scenario,
             arguments->seed >= 0 ? (uint64_t)arguments->seed : (uint64_t)scenario.seed, 1000,
             &outcome);
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
        printf("%s %.4f\n", expect_name(shown[i]), outcome.values[shown[i]]);
    }
    return EXIT_FINE;
}

static bool is_hex(const char *word)
{
    size_t length = strlen(word);

    return length > 4 && strcmp(word + length - 4, ".ihx") == 0;
}

/* build/BOARD/IMAGE.ihx says which board and which app it is. */
static int attack_images(const struct arguments *arguments)
{
    bool is_fine = true;

    for (int i = 1; i < arguments->word_count; i++) {
        const char *hex = arguments->words[i];
        char board_name[32] = "", app[32] = "";
        const struct board *board;
        long flagged;

        if (sscanf(hex, "build/%31[^/]/%31[a-z_].ihx", board_name, app) != 2 ||
            (board = board_find(board_name)) == NULL) {
            return diag_error(hex, 0, "name an image as build/BOARD/IMAGE.ihx; the boards are: %s",
                              board_names());
        }
        flagged = lab_attack_head(stdout, hex, app, board,
                                  arguments->seed >= 0 ? arguments->seed : 1, arguments->runs);
        if (flagged < 0) {
            return EXIT_INPUT;
        }
        is_fine &= flagged * 1000L < arguments->runs;
    }
    return is_fine ? EXIT_FINE : EXIT_INPUT;
}

int main(int argc, char **argv)
{
    struct arguments arguments = {.seed = -1, .rounds = 1500};
    struct image images[WORDS];
    const char *command;
    int count_of_images;

    argp_err_exit_status = EXIT_USAGE;
    argp_parse(&parser, argc, argv, 0, NULL, &arguments);
    command = arguments.word_count > 0 ? arguments.words[0] : "";
    if (arguments.runs == 0) {
        arguments.runs = strcmp(command, "trouble") == 0 ? 500 : 60;
    }
    count_of_images = arguments.word_count - 1;
    if (!(strcmp(command, "run") == 0 && count_of_images == 1 && arguments.scenario != NULL) &&
        !(strcmp(command, "figures") == 0 && count_of_images >= 1) &&
        !(strcmp(command, "trouble") == 0 && count_of_images >= 1) &&
        !(strcmp(command, "attack") == 0 &&
          (count_of_images >= 2 || (count_of_images == 1 && is_hex(arguments.words[1])))) &&
        !(strcmp(command, "tune") == 0 && count_of_images == 2 && arguments.output != NULL)) {
        diag_error(NULL, 0,
                   "say what to do: run, figures, trouble, attack or tune, and with which "
                   "controllers; see lab --help");
        return EXIT_USAGE;
    }
    if (strcmp(command, "attack") == 0 && is_hex(arguments.words[1])) {
        return attack_images(&arguments);
    }
    for (int i = 0; i < count_of_images; i++) {
        if (image_load(&images[i], arguments.words[i + 1]) != EXIT_FINE) {
            return EXIT_INPUT;
        }
    }
    if (strcmp(command, "run") == 0) {
        return command_run(&images[0], &arguments);
    }
    if (strcmp(command, "tune") == 0) {
        return lab_tune(&images[0], &images[1],
                        arguments.seed >= 0 ? (unsigned long)arguments.seed : 1, arguments.rounds,
                        arguments.output);
    }
    if (strcmp(command, "trouble") == 0) {
        lab_print_trouble(stdout, images, count_of_images, (int)arguments.runs);
        return EXIT_FINE;
    }
    if (strcmp(command, "attack") == 0) {
        bool is_fine = true;

        for (int i = 1; i < count_of_images; i++) {
            is_fine &= lab_attack(stdout, &images[i], &images[0],
                                  arguments.seed >= 0 ? arguments.seed : 1, arguments.runs) *
                           1000L <
                       arguments.runs;
        }
        return is_fine ? EXIT_FINE : EXIT_INPUT;
    }
    lab_print(stdout, images, count_of_images, (int)arguments.runs);
    return EXIT_FINE;
}
