/* SPDX-License-Identifier: MIT */
/* Under test: tools/bound/rounds.c, how often the loops of small programs, written as bytes, go
 * back, and how many instructions are followed for that: against runs of them in the simulator, and
 * by hand where the data decide. */
#include "unity.h"

#include "bound/graph.h"
#include "bound/rounds.h"
#include "sim/mcs52.h"

#include <stdlib.h>
#include <string.h>

enum { WORK = 0x100, CALLEE = 0x200, OTHER_CALLEE = 0x210, SP_AT_START = 0x2F, SP = 0x81 };

static struct hexfile hex;
static struct listing listing;
static struct flow flow;

static void put(uint16_t address, const uint8_t *code, size_t count)
{
    memcpy(&hex.code[address], code, count);
    memset(&hex.used[address], true, count);
}
#define PUT(address, ...)                                                                          \
    put(address, (const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))

/* mov sp,#0x2f; lcall WORK; sjmp . */
void setUp(void)
{
    memset(&hex, 0, sizeof hex);
    listing_init(&listing);
    flow_init(&flow, &hex, &listing, "image");
    PUT(0, 0x75, 0x81, SP_AT_START, 0x12, 0x01, 0x00, 0x80, 0xFE);
    PUT(CALLEE, 0x7E, 0x01, 0x22);       /* mov r6,#1; ret */
    PUT(OTHER_CALLEE, 0x8E, 0x07, 0x22); /* mov 7,r6; ret */
}

void tearDown(void)
{
    flow_free(&flow);
    listing_free(&listing);
}

/* A function at WORK with a loop in it. */
struct loop {
    const char *what;
    uint8_t code[32];
    int header, first, last; /* of the loop's instructions, from WORK on */
    long rounds, steps;
};

/* What the loop's `rounds` are if STEPS_MAX instructions may be followed. */
static long count(const struct loop *loop, long steps_max)
{
    int members[HEX_CODE_SIZE / 64], member_count = 0, header = NONE;
    struct function *function;
    long rounds;

    tearDown();
    setUp();
    put(WORK, loop->code, sizeof loop->code);
    TEST_ASSERT_TRUE_MESSAGE(flow_follow(&flow), loop->what);
    flow.steps_max = steps_max;
    function = flow.functions[WORK];
    TEST_ASSERT_TRUE(graph_settle(&flow, function));
    for (int i = 1; i < function->node_count; i++) {
        int at = function->nodes[i].address - WORK;

        if (at >= loop->first && at <= loop->last) {
            members[member_count++] = i;
        }
        if (at == loop->header) {
            header = i;
        }
    }
    rounds = rounds_count(&flow, function, members, member_count, header);
    graph_forget(function);
    return rounds;
}

static void check(const struct loop *loop)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(loop->rounds, count(loop, loop->steps), loop->what);
    if (loop->rounds >= 0) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(NONE, count(loop, loop->steps - 1), loop->what);
    }
}

/* The times that the simulator comes back to the header, and the loop's instructions that it takes,
 * those of callees aside. */
static void run(const struct loop *loop, long *rounds, long *steps)
{
    struct mcs52 *chip = mcs52_create(MCS52_INTEL, NULL);

    TEST_ASSERT_NOT_NULL(chip);
    put(WORK, loop->code, sizeof loop->code);
    mcs52_load(chip, 0, hex.code, sizeof hex.code);
    *rounds = -1;
    *steps = 0;
    while (mcs52_pc(chip) != 6) {
        int at = mcs52_pc(chip) - WORK;

        *rounds += at == loop->header;
        *steps += at >= loop->first && at <= loop->last;
        TEST_ASSERT_LESS_THAN_MESSAGE(100000, mcs52_cycles(chip), loop->what);
        mcs52_step(chip);
    }
    mcs52_destroy(chip);
}

static void test_counted_loops_go_back_as_often_as_in_the_simulator(void)
{
    static const struct loop loops[] = {
        {"mov r7,#5; nop; djnz r7", {0x7F, 5, 0x00, 0xDF, 0xFD, 0x22}, 2, 2, 3, 4, 0},
        {"mov 0x20,#1; djnz 0x20: never back",
         {0x75, 0x20, 1, 0xD5, 0x20, 0xFD, 0x22},
         3,
         3,
         3,
         0,
         0},
        {"mov r7,#0; djnz r7", {0x7F, 0, 0xDF, 0xFE, 0x22}, 2, 2, 2, 255, 0},
        {"up: mov r7,#0; inc r7; cjne r7,#10",
         {0x7F, 0, 0x0F, 0xBF, 10, 0xFC, 0x22},
         2,
         2,
         3,
         9,
         0},
        {"up, by the carry: inc r7; cjne r7,#10,next; jc",
         {0x7F, 0, 0x0F, 0xBF, 10, 0, 0x40, 0xFA, 0x22},
         2,
         2,
         6,
         9,
         0},
        {"up, by subb: inc r7; clr c; mov a,r7; subb a,#10; jc",
         {0x7F, 0, 0x0F, 0xC3, 0xEF, 0x94, 10, 0x40, 0xF9, 0x22},
         2,
         2,
         7,
         9,
         0},
        {"down: mov r7,#10; dec r7; mov a,r7; jnz",
         {0x7F, 10, 0x1F, 0xEF, 0x70, 0xFC, 0x22},
         2,
         2,
         4,
         9,
         0},
        {"two bytes: djnz r6; djnz r7",
         {0x7E, 44, 0x7F, 2, 0xDE, 0xFE, 0xDF, 0xFC, 0x22},
         4,
         4,
         6,
         43 + 1 + 255,
         0},
        {"16 bits: inc dptr; mov a,dpl; cjne a,#0x10; mov a,dph; cjne a,#2",
         {0x90, 0, 0, 0xA3, 0xE5, 0x82, 0xB4, 0x10, 0xFA, 0xE5, 0x83, 0xB4, 2, 0xF5, 0x22},
         3,
         3,
         11,
         0x210 - 1,
         0},
        {"a bit: mov 0x20,#0; cpl 0x20.1; jb 0x20.1",
         {0x75, 0x20, 0, 0xB2, 1, 0x20, 1, 0xFB, 0x22},
         3,
         3,
         5,
         1,
         0},
        {"a call that leaves the counter: lcall; djnz r7",
         {0x7F, 5, 0x12, 0x02, 0x00, 0xDF, 0xFB, 0x22},
         2,
         2,
         5,
         4,
         0},
        {"the inner loop counts anew: mov r6,#1; djnz r6; djnz r7",
         {0x7F, 3, 0x7E, 1, 0xDE, 0xFE, 0xDF, 0xFA, 0x22},
         2,
         2,
         6,
         2,
         0},
        {"a switch's ret: push dpl; push dph; ret; djnz r7",
         {0x7F, 5, 0x90, 0x01, 0x0A, 0xC0, 0x82, 0xC0, 0x83, 0x22, 0xDF, 0xF6, 0x22},
         2,
         2,
         10,
         4,
         0},
        {"a jump to what is known: mov dptr; clr a; jmp @a+dptr; djnz r7",
         {0x7F, 5, 0x90, 0x01, 0x07, 0xE4, 0x73, 0xDF, 0xF9, 0x22},
         2,
         2,
         7,
         4,
         0},
        {"what two ways into the loop both know: jz; mov r7,#5; sjmp; mov r7,#5; djnz r7",
         {0x60, 4, 0x7F, 5, 0x80, 2, 0x7F, 5, 0xDF, 0xFE, 0x22},
         8,
         8,
         8,
         4,
         0},
    };

    for (size_t i = 0; i < sizeof loops / sizeof loops[0]; i++) {
        struct loop loop = loops[i];
        long rounds;

        tearDown();
        setUp();
        run(&loop, &rounds, &loop.steps);
        TEST_ASSERT_EQUAL_INT_MESSAGE(loop.rounds, rounds, loop.what);
        check(&loop);
    }
}

/* The steps are counted by hand: each instruction of each round, once for each time that less is
 * known before it. */
static void test_loops_in_which_the_data_decide(void)
{
    static const struct loop loops[] = {
        {"an unknown way round an instruction: jz; nop; djnz r7",
         {0x7F, 5, 0x60, 1, 0x00, 0xDF, 0xFB, 0x22},
         2,
         2,
         5,
         4,
         5 * 3},
        {"an unknown way out: jz; djnz r7",
         {0x7F, 5, 0x60, 2, 0xDF, 0xFC, 0x22},
         2,
         2,
         4,
         4,
         5 * 2},
        {"the ways leave different values: jz; inc r6; djnz r7; in the second round r6 is unknown",
         {0x7E, 1, 0x7F, 5, 0x60, 1, 0x0E, 0xDF, 0xFB, 0x22},
         4,
         4,
         7,
         4,
         5 * 3 + 1},
        {"a node told twice before its turn: header: jz other; djnz r7; other: inc r6; sjmp back",
         {0x7E, 1, 0x7F, 5, 0x80, 3, 0x0E, 0x80, 2, 0x60, 0xFB, 0xDF, 0xFC, 0x22},
         9,
         6,
         11,
         4,
         5 * 4},
        {"a switch of three: mov dptr; jmp @a+dptr; ljmp, ljmp, ljmp to djnz r7",
         {0x7F, 5, 0x90, 0x01, 0x06, 0x73, 0x02, 0x01, 0x0F, 0x02, 0x01, 0x0F, 0x02, 0x01, 0x0F,
          0xDF, 0xF1, 0x22},
         2,
         2,
         15,
         4,
         5 * 6},
        {"at the entry: jc; setb c; sjmp", {0x40, 3, 0xD3, 0x80, 0xFB, 0x22}, 0, 0, 3, 1, 3 + 1},
        {"jbc asks for what is not known afterwards: mov r7,#3; jbc 0; djnz r7",
         {0x7F, 3, 0x10, 0, 2, 0xDF, 0xFB, 0x22},
         2,
         2,
         5,
         2,
         3 * 2},
    };

    for (size_t i = 0; i < sizeof loops / sizeof loops[0]; i++) {
        check(&loops[i]);
    }
}

static void test_loops_that_have_no_count(void)
{
    static const struct loop loops[] = {
        {"an unknown counter: djnz r7", {0xDF, 0xFE, 0x22}, 0, 0, 0, NONE, 1000},
        {"the data decide how it counts: jz; dec r7; djnz r7",
         {0x7F, 5, 0x60, 1, 0x1F, 0xDF, 0xFB, 0x22},
         2,
         2,
         5,
         NONE,
         1000},
        {"the ways into it know different counts: jz; mov r7,#5; sjmp; mov r7,#6; djnz r7",
         {0x60, 4, 0x7F, 5, 0x80, 2, 0x7F, 6, 0xDF, 0xFE, 0x22},
         8,
         8,
         8,
         NONE,
         1000},
        {"a call changes the counter: lcall; djnz r7",
         {0x7F, 5, 0x12, 0x02, 0x10, 0xDF, 0xFB, 0x22},
         2,
         2,
         5,
         NONE,
         1000},
        {"it never ends: mov a,#1; jnz", {0x74, 1, 0x70, 0xFE, 0x22}, 2, 2, 2, NONE, 1000},
        {"it never ends, and turns a bit: clr c; cpl c; sjmp",
         {0xC3, 0xB3, 0x80, 0xFD},
         1,
         1,
         2,
         NONE,
         1000},
        /* push 8; mov 8,sp; mov r0,#0x30; mov r7,#3; then mov @r0,a; mov sp,8; mov r0,#8; djnz r7:
         * in the second round the frame pointer is overwritten. */
        {"the stack is lost",
         {0xC0, 0x08, 0x85, SP,   0x08, 0x78, 0x30, 0x7F, 3,    0xF6,
          0x85, 0x08, SP,   0x78, 0x08, 0xDF, 0xF8, 0xD0, 0x08, 0x22},
         9,
         9,
         15,
         NONE,
         1000},
    };

    for (size_t i = 0; i < sizeof loops / sizeof loops[0]; i++) {
        check(&loops[i]);
    }
}

static void test_a_delay_of_two_bytes_is_counted_by_default(void)
{
    flow_init(&flow, &hex, &listing, "image");
    TEST_ASSERT_EQUAL_INT(2000000, flow.steps_max);
}

/* Long division takes a round for each of 32 bits, that of int 16; a float's mantissa is shifted by
 * bytes first. */
static void test_what_is_known_of_the_library(void)
{
    static const struct {
        const char *name;
        long rounds;
    } known[] = {{"_divulong", 32},  {"_divlong", 32}, {"_modulong", 32},
                 {"_modlong", 32},   {"__ultoa", 32},  {"_moduint", 16},
                 {"_modint", 16},    {"__uitoa", 16},  {"fs_lshift_a", 8},
                 {"fs_rshift_a", 7}, {"strlen", NONE}, {"_fs_cordic_rshift_r765_unsigned", 7}};

    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(known[i].rounds, rounds_of_library(known[i].name),
                                      known[i].name);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_counted_loops_go_back_as_often_as_in_the_simulator);
    RUN_TEST(test_loops_in_which_the_data_decide);
    RUN_TEST(test_loops_that_have_no_count);
    RUN_TEST(test_a_delay_of_two_bytes_is_counted_by_default);
    RUN_TEST(test_what_is_known_of_the_library);
    return UNITY_END();
}
