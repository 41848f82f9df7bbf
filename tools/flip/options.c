/* SPDX-License-Identifier: MIT */
#include "options.h"

#include "number.h"
#include "run.h"

#include <stddef.h>
#include <string.h>
#include <unistd.h>

enum { MAX_JOBS = 64, LAST_S = 20 /* of an instant */ };

static const char *const kinds[WHATS] = {"bits", "stuck", "code", "pc", "space"};

enum option_key {
    OPT_HEX = 256,
    OPT_BOARD,
    OPT_SCENARIO,
    OPT_AT,
    OPT_WHAT,
    OPT_RAM,
    OPT_SFR,
    OPT_COUNT,
    OPT_LEAST,
    OPT_FAULT,
    OPT_UNUSED,
    OPT_TOLD,
    OPT_SEED,
    OPT_WINDOW,
    OPT_SAMPLE
};

static const struct argp_option options[] = {
    {"hex", OPT_HEX, "FILE", 0, "the image (default: build/BOARD/APP.ihx)", 1},
    {"board", OPT_BOARD, "NAME", 0, "the board", 1},
    {"scenario", OPT_SCENARIO, "FILE", 0, "the drive", 1},
    {"what", OPT_WHAT, "KIND", 0,
     "bits (each bit of RAM and of the registers of --sfr), stuck (each bit of RAM, low and high), "
     "code or pc (random ones), space (each bit at each cycle of --window)",
     2},
    {"at", OPT_AT, "S,...", 0, "instants, seconds after the first trigger; negative ones before it",
     2},
    {"ram", OPT_RAM, "XX,...", 0,
     "addresses of RAM, hexadecimal; XX-YY is a range (default: all, but none with --sfr)", 2},
    {"sfr", OPT_SFR, "XX,...", 0, "addresses of registers, likewise (default: none)", 2},
    {"count", OPT_COUNT, "N", 0, "of code and pc: how many at each instant", 2},
    {"seed", OPT_SEED, "N", 0, "of code, pc and --sample", 2},
    {"window", OPT_WINDOW, "MS", 0, "of space: how long from the instant on (default: 60)", 2},
    {"sample", OPT_SAMPLE, "N", 0,
     "of space: so many bits and cycles by chance run by themselves, to be compared", 2},
    {"least", OPT_LEAST, "PCT", 0,
     "the brake must not fall below that where it does not without the fault", 3},
    {"fault-state", OPT_FAULT, "XX", 0, "where RAM says that the controller is in FAULT", 3},
    {"unused", OPT_UNUSED, "XX", 0,
     "the stack, as bound has proven, does not reach this address: from there on a flip changes "
     "nothing but what --told holds",
     3},
    {"told", OPT_TOLD, "XX", 0, "where the controller keeps how much of the stack is unused", 3},
    {"jobs", 'j', "N", 0, "runs at a time (default: one a core)", 4},
    {"output", 'o', "FILE", 0, "the table of all runs, as CSV (default: stdout)", 4},
    {0},
};

/* A list of addresses and ranges. */
static void parse_addresses(struct argp_state *state, const char *option, const char *text,
                            unsigned low, bool marks[256])
{
    char *next = strdupa(text), *word;

    while ((word = strsep(&next, ",")) != NULL) {
        char *last = strchr(word, '-');
        unsigned from, to;

        if (last != NULL) {
            *last++ = '\0';
        }
        from = (unsigned)parse_hex(state, option, word, low, 255);
        to = last != NULL ? (unsigned)parse_hex(state, option, last, from, 255) : from;
        memset(marks + from, true, to - from + 1);
    }
}

static void parse_instants(struct argp_state *state, const char *text, struct arguments *arguments)
{
    char *next = strdupa(text), *word;

    while ((word = strsep(&next, ",")) != NULL && arguments->instants < MAX_INSTANTS) {
        arguments->instants_s[arguments->instants++] =
            parse_number(state, "at", word, -RUN_BOOT_S, LAST_S);
    }
}

static int parse_kind(struct argp_state *state, const char *text)
{
    for (int kind = 0; kind < WHATS; kind++) {
        if (strcmp(text, kinds[kind]) == 0) {
            return kind;
        }
    }
    argp_error(state, "--what=%s: give bits, stuck, code, pc or space", text);
    return WHAT_BITS;
}

/* Options with a whole number or a hexadecimal address. */
static const struct number_option {
    int key;
    const char *name;
    long (*parse)(struct argp_state *, const char *, const char *, long, long);
    long low, high;
    size_t offset; /* in struct arguments */
} numbers[] = {
    {OPT_COUNT, "count", parse_count, 1, 1000000, offsetof(struct arguments, count)},
    {OPT_SEED, "seed", parse_count, 0, 4294967295, offsetof(struct arguments, seed)},
    {OPT_WINDOW, "window", parse_count, 1, 1000, offsetof(struct arguments, window_ms)},
    {OPT_SAMPLE, "sample", parse_count, 1, 100000, offsetof(struct arguments, sample)},
    {OPT_FAULT, "fault-state", parse_hex, 0, 255, offsetof(struct arguments, fault_at)},
    {OPT_UNUSED, "unused", parse_hex, 0, 255, offsetof(struct arguments, unused_at)},
    {OPT_TOLD, "told", parse_hex, 0, 255, offsetof(struct arguments, told_at)},
    {'j', "jobs", parse_count, 1, MAX_JOBS, offsetof(struct arguments, jobs)},
};

static error_t take_number(int key, const char *text, struct argp_state *state)
{
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        const struct number_option *one = &numbers[i];

        if (one->key == key) {
            *(long *)((char *)state->input + one->offset) =
                one->parse(state, one->name, text, one->low, one->high);
            return 0;
        }
    }
    return ARGP_ERR_UNKNOWN;
}

static error_t take_option(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;

    switch (key) {
    case OPT_HEX:
        arguments->hex = text;
        return 0;
    case OPT_BOARD:
        arguments->board = text;
        return 0;
    case OPT_SCENARIO:
        arguments->scenario = text;
        return 0;
    case OPT_WHAT:
        arguments->what = parse_kind(state, text);
        return 0;
    case OPT_AT:
        parse_instants(state, text, arguments);
        return 0;
    case OPT_LEAST:
        arguments->least_pct = parse_number(state, "least", text, 0, 100);
        return 0;
    case OPT_RAM:
        arguments->has_ram = true;
        parse_addresses(state, "ram", text, 0, arguments->rams);
        return 0;
    case OPT_SFR:
        arguments->has_sfr = true;
        parse_addresses(state, "sfr", text, 0x80, arguments->sfrs);
        return 0;
    case 'o':
        arguments->output = text;
        return 0;
    case ARGP_KEY_END:
        if (arguments->board == NULL || arguments->scenario == NULL || arguments->instants == 0) {
            argp_error(state, "give --board, --scenario and --at");
        }
        if (!arguments->has_ram && !arguments->has_sfr) {
            memset(arguments->rams, true, sizeof arguments->rams);
        }
        return 0;
    default:
        return take_number(key, text, state);
    }
}

const struct argp options_parser = {
    .options = options,
    .parser = take_option,
    .doc = "Changes bits of the chip that runs a controller's real image, one a run, and says what "
           "each came to: none, corrected, safe-stop, FAULT, watchdog or unsafe.\v"
           "The rows of the table are sorted by time. `rows` is how long the run took, in rows of "
           "10 ms, until it was as without the fault, or over. Unsafe is an impact, 0.3 m less "
           "gap, the brake off or below --least for more than 120 ms, or a false full brake of a "
           "second."};

void options_defaults(struct arguments *arguments)
{
    *arguments = (struct arguments){.fault_at = -1,
                                    .unused_at = MCS52_RAM_BYTES,
                                    .count = 100,
                                    .jobs = sysconf(_SC_NPROCESSORS_ONLN),
                                    .seed = 1,
                                    .window_ms = 60};
}
