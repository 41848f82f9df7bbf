/* SPDX-License-Identifier: MIT */
/* Under test: what tools/bound says of SDCC programs, against runs of them. The programs of
 * tests/bound hold what other people's programs do: arithmetic of SDCC's library, floats,
 * switches, frames on the stack, loops, interrupts. Each is compiled in one or two memory models
 * and run in the fast simulator with odd input; no call may take longer, and no stack go deeper,
 * than bound says. */
#include "unity.h"

#include "bound/flow.h"
#include "bound/listing.h"
#include "sim/mcs52.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SP = 0x81,
    FUNCTIONS = 16,
    INPUT_BYTES = 36,
    CALLS = 20,          /* of each function */
    LEAST_CYCLES = 50000 /* where there is none */
};

static const char *const models[] = {"--model-small", "--model-large --stack-auto"};

static struct hexfile hex;
static struct listing listing;
static struct flow flow;

void setUp(void)
{
}

void tearDown(void)
{
}

/* A function whose name begins with work_. */
struct work {
    uint16_t entry;
    const char *name;
    long bound;
    long longest;
    long calls;
};

static struct work works[FUNCTIONS];
static int work_count;

static void build(const char *program, const char *model)
{
    char command[600], path[200];

    snprintf(command, sizeof command,
             "mkdir -p build/tests/bound_runs && sdcc -mmcs51 %s --xram-size 4096 -Itests/bound "
             "--disable-warning 85 tests/bound/%s.c -o build/tests/bound_runs/%s.ihx "
             "2>build/tests/bound_runs/sdcc.log",
             model, program, program);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, system(command), command);
    listing_init(&listing);
    snprintf(path, sizeof path, "build/tests/bound_runs/%s.ihx", program);
    memset(&hex, 0, sizeof hex);
    TEST_ASSERT_EQUAL_INT(0, hexfile_read(&hex, path));
    flow_init(&flow, &hex, &listing, program);
    snprintf(path, sizeof path, "build/tests/bound_runs/%s.map", program);
    TEST_ASSERT_EQUAL_INT(0, listing_read(&listing, &hex, path));
    snprintf(path, sizeof path, "build/tests/bound_runs/%s.rst", program);
    TEST_ASSERT_EQUAL_INT(0, listing_read(&listing, &hex, path));
    TEST_ASSERT_TRUE_MESSAGE(flow_follow(&flow), program);
    work_count = 0;
    for (int i = 0; i < HEX_CODE_SIZE; i++) {
        struct work work = {.entry = (uint16_t)i, .name = listing.names[i]};

        if (work.name == NULL || strncmp(work.name, "work_", 5) != 0) {
            continue;
        }
        TEST_ASSERT_TRUE_MESSAGE(flow_cycles(&flow, work.entry, false, &work.bound), work.name);
        TEST_ASSERT_LESS_THAN_INT(FUNCTIONS, work_count);
        works[work_count++] = work;
    }
}

/* What bound prints as the most bytes of stack. */
static int stack_of_program(void)
{
    int most[2] = {0, 0};

    for (int n = 0; n < FLOW_INTERRUPTS; n++) {
        uint16_t entry;
        int level = flow.high >> n & 1;

        if (flow_interrupt(&flow, n, &entry) && flow_stack(&flow, entry) > most[level]) {
            most[level] = flow_stack(&flow, entry);
        }
    }
    return flow_stack(&flow, 0) - FLOW_RETURN_ADDRESS + most[0] + most[1];
}

/* Bytes of chance, among them many at the ends of their ranges. */
static void fill(uint8_t *input, uint32_t *seed)
{
    static const uint8_t ends[] = {0x00, 0x01, 0x7F, 0x80, 0xFF, 0x3F, 0x42, 0xFE};
    bool is_odd;

    *seed = *seed * 1664525 + 1013904223;
    is_odd = *seed >> 31;
    for (int i = 0; i < INPUT_BYTES; i++) {
        *seed = *seed * 1664525 + 1013904223;
        input[i] = is_odd ? ends[*seed >> 29] : (uint8_t)(*seed >> 24);
    }
}

static bool is_called_less(long calls)
{
    for (int i = 0; i < work_count; i++) {
        if (works[i].calls < calls) {
            return true;
        }
    }
    return false;
}

/* Runs the program and measures its works. Returns the deepest stack. */
static int run(void)
{
    struct mcs52 *chip = mcs52_create(MCS52_INTEL, NULL);
    struct work *under_way = NULL;
    uint64_t began = 0;
    uint8_t sp_at_entry = 0;
    uint32_t seed = 1;
    int deepest = 0;
    bool is_started = false;

    TEST_ASSERT_NOT_NULL(chip);
    mcs52_load(chip, 0, hex.code, sizeof hex.code);
    while (mcs52_cycles(chip) < LEAST_CYCLES || is_called_less(CALLS)) {
        uint8_t sp = mcs52_sfr(chip, SP);
        uint16_t pc = mcs52_pc(chip);

        is_started = is_started || sp == flow.stack_base;
        TEST_ASSERT_LESS_THAN_MESSAGE(10000000, mcs52_cycles(chip), "no end");
        if (is_started && sp - flow.stack_base > deepest) {
            deepest = sp - flow.stack_base;
        }
        if (under_way != NULL && sp < sp_at_entry) {
            long took = (long)(mcs52_cycles(chip) - began);

            under_way->longest = took > under_way->longest ? took : under_way->longest;
            under_way->calls++;
            under_way = NULL;
        }
        for (int i = 0; i < work_count && under_way == NULL; i++) {
            if (pc == works[i].entry) {
                under_way = &works[i];
                began = mcs52_cycles(chip);
                sp_at_entry = sp;
            }
        }
        if (under_way != NULL && pc == under_way->entry) {
            fill(mcs52_xdata(chip), &seed);
        }
        mcs52_step(chip);
    }
    mcs52_destroy(chip);
    return deepest;
}

/* Of SDCC's floating point both models have the same. */
static void check(const char *program, size_t in_models)
{
    for (size_t m = 0; m < in_models; m++) {
        char what[200];
        int deepest;

        build(program, models[m]);
        deepest = run();
        snprintf(what, sizeof what, "%s %s: stack %d, bound %d", program, models[m], deepest,
                 stack_of_program());
        TEST_ASSERT_TRUE_MESSAGE(deepest <= stack_of_program() && deepest > 0, what);
        for (int i = 0; i < work_count; i++) {
            const struct work *work = &works[i];
            bool is_exact = strncmp(work->name, "work_exact_", 11) == 0;

            snprintf(what, sizeof what, "%s %s: %s took %ld in %ld calls, bound %ld", program,
                     models[m], work->name, work->longest, work->calls, work->bound);
            if (getenv("BOUND_SHOW") != NULL) {
                puts(what);
            }
            TEST_ASSERT_TRUE_MESSAGE(
                is_exact ? work->longest == work->bound : work->longest <= work->bound, what);
        }
        flow_free(&flow);
        listing_free(&listing);
    }
}

static void test_integer_arithmetic_stays_within_its_bound(void)
{
    check("integers", 2);
}

static void test_floating_point_stays_within_its_bound(void)
{
    check("floats", 1);
}

static void test_the_functions_of_math_h_stay_within_their_bound(void)
{
    check("math", 1);
}

static void test_switches_stay_within_their_bound(void)
{
    check("switches", 1);
}

static void test_frames_on_the_stack_stay_within_their_bound(void)
{
    check("frames", 2);
}

static void test_counted_loops_take_what_their_bound_says(void)
{
    check("loops", 2);
}

static void test_the_stack_of_interrupts_stays_within_its_bound(void)
{
    check("interrupts", 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_integer_arithmetic_stays_within_its_bound);
    RUN_TEST(test_floating_point_stays_within_its_bound);
    RUN_TEST(test_the_functions_of_math_h_stay_within_their_bound);
    RUN_TEST(test_switches_stay_within_their_bound);
    RUN_TEST(test_frames_on_the_stack_stay_within_their_bound);
    RUN_TEST(test_counted_loops_take_what_their_bound_says);
    RUN_TEST(test_the_stack_of_interrupts_stays_within_its_bound);
    return UNITY_END();
}
