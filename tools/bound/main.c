/* SPDX-License-Identifier: MIT */
/* bound: the most stack and the most time that an image can take, for all inputs. */
#include "diag.h"
#include "manual.h"
#include "flow.h"

#include <argp.h>
#include <errno.h>
#include <stdlib.h>

enum { WORDS = 64, NAMES = 64, OPT_CYCLES = 256, OPT_ROUND, OPT_LOOP, OPT_IRAM };

const char *argp_program_version = "fuzzy51 " FUZZY51_VERSION;

struct arguments {
    const char *words[WORDS];
    int word_count;
    const char *names[NAMES];
    bool is_round[NAMES];
    int name_count;
    const char *loops[NAMES]; /* "FUNCTION:N" */
    int loop_count;
    int iram;
};

static const struct argp_option options[] = {
    {"cycles", OPT_CYCLES, "FUNCTION", 0,
     "also print the most machine cycles of this function; may be repeated", 0},
    {"round", OPT_ROUND, "FUNCTION", 0,
     "also print the most machine cycles of one round of this function's endless loop", 0},
    {"loop", OPT_LOOP, "FUNCTION:N", 0,
     "each loop of this function without a `rounds:` comment has at most N rounds each time that "
     "it "
     "is entered; may be repeated",
     0},
    {"iram", OPT_IRAM, "N", 0, "bytes of the chip's internal RAM, 128..256 (default 256)", 0},
    {0},
};

static error_t take_option(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    char *end;

    switch (key) {
    case OPT_CYCLES:
    case OPT_ROUND:
        if (arguments->name_count == NAMES) {
            argp_error(state, "more than %d functions", NAMES);
        }
        arguments->is_round[arguments->name_count] = key == OPT_ROUND;
        arguments->names[arguments->name_count++] = text;
        return 0;
    case OPT_LOOP:
        if (arguments->loop_count == NAMES) {
            argp_error(state, "more than %d loops", NAMES);
        }
        arguments->loops[arguments->loop_count++] = text;
        return 0;
    case OPT_IRAM:
        arguments->iram = (int)strtol(text, &end, 10);
        if (end == text || *end != '\0' || arguments->iram < 128 || arguments->iram > 256) {
            argp_error(state, "--iram=%s: give a whole number in 128..256", text);
        }
        return 0;
    case ARGP_KEY_ARG:
        if (arguments->word_count == WORDS) {
            argp_error(state, "more than %d files", WORDS);
        }
        arguments->words[arguments->word_count++] = text;
        return 0;
    case ARGP_KEY_END:
        if (arguments->word_count == 0) {
            argp_usage(state);
        }
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp parser = {
    .options = options,
    .parser = take_option,
    .args_doc = "IMAGE.ihx [LISTING...]",
    .doc = "Follows every path through an 8051 image and says how much stack it can take, and how "
           "long "
           "its functions can take.\vListings are the linker's .map and .rst files: they name "
           "functions, "
           "and a source line of the form `while (...) { /* rounds: 8 */` bounds its loop. Exit "
           "status: 0 "
           "fine; 1 the stack does not fit, or the image cannot be followed; 2 bad usage.",
};

/* Prints the deepest path from ENTRY on: "measure > control_step > brake_step". */
static void print_path(const struct flow *flow, long entry)
{
    printf("%s", listing_name(flow->listing, (uint16_t)entry));
    while ((entry = flow_deepest(flow, (uint16_t)entry)) >= 0) {
        printf(" > %s", listing_name(flow->listing, (uint16_t)entry));
    }
}

/* Two interrupts of one priority level never run at the same time; one of the high level may
 * interrupt one of the low level. Sets *STACK to what they take together. An interrupt without a
 * bound in time has one in stack. */
static int print_interrupts(struct flow *flow, int *stack)
{
    int most[2] = {0, 0}, status = EXIT_FINE;

    for (int n = 0; n < FLOW_INTERRUPTS; n++) {
        uint16_t entry;
        long cycles;
        int level = flow->high >> n & 1;

        if (!flow_interrupt(flow, n, &entry)) {
            continue;
        }
        printf("%s: interrupt at 0x%02X, %s level, %d bytes", listing_name(flow->listing, entry),
               8 * n + 3, level ? "high" : "low", flow_stack(flow, entry));
        if (flow_cycles(flow, entry, false, &cycles)) {
            printf(", at most %ld cycles\n", cycles);
        } else {
            printf("\n");
            status = EXIT_INPUT;
        }
        if (flow_stack(flow, entry) > most[level]) {
            most[level] = flow_stack(flow, entry);
        }
    }
    *stack = most[0] + most[1];
    return status;
}

static int print_stack(struct flow *flow, int iram)
{
    int room = iram - 1 - flow->stack_base, most, interrupts;
    int status = print_interrupts(flow, &interrupts);

    most = flow_stack(flow, 0) - FLOW_RETURN_ADDRESS + interrupts; /* nothing called the reset */
    printf("stack: at most %d of %d bytes, %d for interrupts; deepest ", most, room, interrupts);
    print_path(flow, flow_deepest(flow, 0) < 0 ? 0 : flow_deepest(flow, 0));
    putchar('\n');
    if (most < room) { /* the last byte tells the firmware of an overflow */
        return status;
    }
    return diag_error(
        flow->path, 0,
        "the stack may take %d bytes, and %d are free, of which one byte must stay free; call less "
        "deeply, or use less RAM",
        most, room);
}

/* The address of the function NAME, as C knows it or as the assembler does, with one more
 * underscore; or -1 after a message. */
static long find(const struct flow *flow, const char *name)
{
    long entry = listing_find(flow->listing, name);

    if (entry < 0 && name[0] == '_') {
        entry = listing_find(flow->listing, name + 1);
    }
    if (entry < 0) {
        diag_error(flow->path, 0,
                   "no function '%s' in it; its .map and .rst files name those that are", name);
    }
    return entry;
}

static int print_cycles(struct flow *flow, const struct arguments *arguments)
{
    for (int i = 0; i < arguments->name_count; i++) {
        const char *name = arguments->names[i];
        long entry = find(flow, name), cycles;

        if (entry < 0) {
            return EXIT_INPUT;
        }
        if (!flow_cycles(flow, (uint16_t)entry, arguments->is_round[i], &cycles)) {
            return EXIT_INPUT;
        }
        printf("%s: at most %ld cycles%s\n", name, cycles,
               arguments->is_round[i] ? " a round" : "");
    }
    return EXIT_FINE;
}

/* "FUNCTION:N" of --loop. */
static int take_loops(struct flow *flow, const struct arguments *arguments)
{
    for (int i = 0; i < arguments->loop_count; i++) {
        char name[256], rest;
        long rounds, entry;

        if (sscanf(arguments->loops[i], "%255[^:]:%ld%c", name, &rounds, &rest) != 2 ||
            rounds < 1 || rounds > LISTING_MOST_ROUNDS) {
            diag_error("bound", 0, "--loop=%s: give FUNCTION:N, N in 1..%d", arguments->loops[i],
                       LISTING_MOST_ROUNDS);
            return EXIT_USAGE;
        }
        entry = find(flow, name);
        if (entry < 0) {
            return EXIT_INPUT;
        }
        flow->rounds[entry] = rounds;
    }
    return EXIT_FINE;
}

static const struct manual manual = {
    .program = "bound",
    .brief = "the most stack and time that an 8051 image can take",
    .about = "",
    .command = &(const struct manual_command){.argp = &parser},
    .commands = 1,
};

int main(int argc, char **argv)
{
    static struct arguments arguments = {.iram = 256};
    static struct hexfile hex;
    static struct listing listing;
    static struct flow flow;
    int status;

    argp_err_exit_status = EXIT_USAGE;
    if (argc == 2 && manual_option(&manual, argv[1], &status)) {
        return status;
    }
    argp_parse(&parser, argc, argv, 0, NULL, &arguments);
    if (hexfile_read(&hex, arguments.words[0]) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    listing_init(&listing);
    flow_init(&flow, &hex, &listing, arguments.words[0]);
    status = EXIT_FINE;
    for (int i = 1; i < arguments.word_count && status == EXIT_FINE; i++) {
        status = listing_read(&listing, &hex, arguments.words[i]);
    }
    if (status == EXIT_FINE) {
        status = take_loops(&flow, &arguments);
    }
    if (status == EXIT_FINE) {
        status = flow_follow(&flow) ? print_stack(&flow, arguments.iram) : EXIT_INPUT;
    }
    if (status == EXIT_FINE) {
        status = print_cycles(&flow, &arguments);
    }
    flow_free(&flow);
    listing_free(&listing);
    return status;
}
