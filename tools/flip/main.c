/* SPDX-License-Identifier: MIT */
/* flip: one drive, many times, each time with another bit of the chip changed. */
#include "board.h"
#include "diag.h"
#include "fair.h"
#include "fast.h"
#include "fly.h"
#include "hexfile.h"
#include "judge.h"
#include "manual.h"
#include "options.h"
#include "plan.h"
#include "run.h"
#include "scenario.h"
#include "space.h"

#include <stdio.h>
#include <stdlib.h>

enum { MAX_CLASSES = 10000000 }; /* memory is taken only for those that there are */

const char *argp_program_version = "fuzzy51 " FUZZY51_VERSION;

static const struct manual manual = {
    .program = "flip",
    .brief = "what each bit of the chip does to a drive when it flips",
    .about = "",
    .command = &(const struct manual_command){.argp = &options_parser},
    .commands = 1,
};

static void print_cases(FILE *out, const struct plan *plan)
{
    static const char *const faults[] = {"flip", "low", "high"};

    fprintf(out, "place,kind,address,bit,cycle,verdict,harm,min_gap_m,rows\n");
    for (size_t i = 0; i < plan->count; i++) {
        const struct fault_case *one = &plan->cases[i];

        fprintf(out, "%s,%s,0x%02X,%d,%llu,%s,%s,%.2f,%d\n", plan_where_name(one->where),
                faults[one->kind], one->address, one->bit, (unsigned long long)one->cycle,
                one->done ? judge_verdict_name(one->verdict) : "lost", judge_harm_name(one->harm),
                one->min_gap_m, one->rows);
    }
}

static int print(const struct arguments *arguments, const struct plan *plan, struct space *space)
{
    struct outfile file = {.stream = stdout};

    if (arguments->output != NULL && outfile_open(&file, arguments->output) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (space != NULL) {
        space_print(file.stream, space, plan);
    } else {
        print_cases(file.stream, plan);
    }
    return arguments->output != NULL ? outfile_commit(&file) : EXIT_FINE;
}

/* What the command line names: board, scenario and image. Returns EXIT_FINE, or another status
 * after a message. */
static int load(struct run_setup *setup, const struct arguments *arguments,
                struct scenario *scenario, struct hexfile *hex)
{
    static char image[SCENARIO_TEXT + 64];

    setup->board = board_find(arguments->board);
    if (setup->board == NULL) {
        diag_error(NULL, 0, "no board '%s'; the boards are: %s", arguments->board, board_names());
        return EXIT_USAGE;
    }
    if (scenario_read(scenario, arguments->scenario, NULL, 0) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    setup->scenario = scenario;
    setup->seed = (uint64_t)scenario->seed;
    setup->hex = arguments->hex;
    if (setup->hex == NULL) {
        snprintf(image, sizeof image, "build/%s/%s.ihx", setup->board->name, scenario->app);
        setup->hex = image;
    }
    return hexfile_read(hex, setup->hex);
}

int main(int argc, char **argv)
{
    struct arguments arguments;
    static struct scenario scenario;
    static struct hexfile hex;
    static struct fair fair;
    static struct run run;
    struct plan plan;
    struct space *space = NULL;
    struct run_setup setup = {
        .engine = &fast_engine, .quantum_us = RUN_QUANTUM_US, .step_us = WORLD_STEP_NS / 1000};
    struct flight flight = {.run = &run,
                            .setup = &setup,
                            .hex = &hex,
                            .arguments = &arguments,
                            .fair = &fair,
                            .plan = &plan};
    int status;

    argp_err_exit_status = EXIT_USAGE;
    if (argc == 2 && manual_option(&manual, argv[1], &status)) {
        return status;
    }
    options_defaults(&arguments);
    argp_parse(&options_parser, argc, argv, 0, NULL, &arguments);
    status = load(&setup, &arguments, &scenario, &hex);
    if (status != EXIT_FINE) {
        return status;
    }
    fair_record(&fair, &run, &setup, arguments.fault_at);
    if (fair.row_count == 0) {
        diag_error(setup.hex, 0, "the drive without a fault does not begin");
        return EXIT_USAGE;
    }
    if (arguments.what == WHAT_SPACE) {
        plan_init(&plan, MAX_CLASSES);
        space = space_search(&fair, setup.board, &hex, &arguments, &plan);
        if (space == NULL) {
            return EXIT_INPUT;
        }
    } else {
        plan_make(&plan, &arguments, &hex, fair.boot_ns, setup.board->clk_hz);
    }
    flight.meet = meet_create();
    fly(&flight);
    return print(&arguments, &plan, space);
}
