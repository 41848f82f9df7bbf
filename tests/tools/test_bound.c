/* SPDX-License-Identifier: MIT */
/* Under test: tools/bound/flow.c and cycles.c, on small programs written as bytes, whose stack and
 * cycles are counted by hand from the data sheet. */
#include "unity.h"

#include "bound/flow.h"
#include "bound/listing.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct hexfile hex;
static struct listing listing;
static struct flow flow;

/* What is not set holds odd values. */
void setUp(void)
{
    memset(&hex, 0, sizeof hex);
    memset(&listing, 0xA5, sizeof listing);
    memset(&flow, 0xA5, sizeof flow);
    mallopt(M_PERTURB, 0x5A);
    listing_init(&listing);
    flow_init(&flow, &hex, &listing, "image");
    flow.steps_max = 20000;
}

void tearDown(void)
{
    flow_free(&flow);
    listing_free(&listing);
}

static void put(uint16_t address, const uint8_t *code, size_t count)
{
    memcpy(&hex.code[address], code, count);
    memset(&hex.used[address], true, count);
}
#define PUT(address, ...)                                                                          \
    put(address, (const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))

/* mov sp,#0x2f; lcall 0x0100; sjmp . */
static void put_start(void)
{
    PUT(0, 0x02, 0x00, 0x40);
    PUT(0x40, 0x75, 0x81, 0x2F, 0x12, 0x01, 0x00, 0x80, 0xFE);
}

/* The instruction at ADDRESS comes from source line LINE, which may bound a loop. */
static void comes_from(uint16_t address, int line, long rounds)
{
    char place[32];

    snprintf(place, sizeof place, "x.c:%d", line);
    listing.places[address] = strdup(place);
    listing.rounds[address] = rounds;
}

/* The function at ADDRESS. */
static void is_named(uint16_t address, const char *name)
{
    listing.names[address] = strdup(name);
}

/* What is written to stderr from listen on, until compare. */
static FILE *kept;
static char *said;
static size_t said_bytes;

static void listen(void)
{
    kept = stderr;
    stderr = open_memstream(&said, &said_bytes);
    TEST_ASSERT_NOT_NULL(stderr);
}

/* One message "image: error: EXPECTED" was written; nothing if EXPECTED is NULL. */
static void compare(const char *expected, const char *name)
{
    char whole[1000] = "";

    fclose(stderr);
    stderr = kept;
    if (expected != NULL) {
        snprintf(whole, sizeof whole, "image: error: %s\n", expected);
    }
    TEST_ASSERT_EQUAL_STRING_MESSAGE(whole, said, name);
    free(said);
}

static void refuses_to_follow(const char *expected, const char *name)
{
    bool is_good;

    listen();
    is_good = flow_follow(&flow);
    compare(expected, name);
    TEST_ASSERT_FALSE_MESSAGE(is_good, name);
}

static void refuses_to_count(uint16_t entry, bool is_round, const char *expected, const char *name)
{
    bool is_good;
    long cycles;

    listen();
    is_good = flow_cycles(&flow, entry, is_round, &cycles);
    compare(expected, name);
    TEST_ASSERT_FALSE_MESSAGE(is_good, name);
}

static long cycles_of(uint16_t entry)
{
    long cycles = -1;

    TEST_ASSERT_TRUE(flow_cycles(&flow, entry, false, &cycles));
    return cycles;
}

static void test_the_stack_of_calls_and_pushes(void)
{
    put_start();
    PUT(0x100, 0xC0, 0xE0, 0x12, 0x02, 0x00, 0xD0, 0xE0,
        0x22); /* push acc; lcall 0x200; pop acc; ret */
    PUT(0x200, 0xC0, 0xE0, 0xC0, 0xF0, 0xD0, 0xF0, 0xD0, 0xE0, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(0x2F, flow.stack_base);
    TEST_ASSERT_EQUAL_INT(2 + 2, flow_stack(&flow, 0x200));
    TEST_ASSERT_EQUAL_INT(2 + 1 + 4, flow_stack(&flow, 0x100));
    TEST_ASSERT_EQUAL_INT(0x200, flow_deepest(&flow, 0x100));
    TEST_ASSERT_EQUAL_INT(2 + 7, flow_stack(&flow, 0)); /* the reset is counted as a call */
}

static void test_the_deeper_of_two_branches_counts(void)
{
    put_start();
    PUT(0x100, 0x60, 0x04, 0x12, 0x02, 0x00, 0x22, 0x12, 0x03, 0x00,
        0x22); /* jz; lcall 0x200; ret; lcall 0x300 */
    PUT(0x200, 0x22);
    PUT(0x300, 0xC0, 0xE0, 0xD0, 0xE0, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(2 + 3, flow_stack(&flow, 0x100));
}

static void test_interrupts_and_their_levels(void)
{
    uint16_t entry;

    put_start();
    PUT(0x100, 0xD2, 0xBB, 0x22); /* setb pt1; ret */
    PUT(0x0B, 0x32);              /* reti: not used */
    PUT(0x1B, 0x02, 0x02, 0x00);
    PUT(0x23, 0x02, 0x03, 0x00);
    PUT(0x200, 0xC0, 0xE0, 0xD0, 0xE0, 0x32);
    PUT(0x300, 0x32);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_FALSE(flow_interrupt(&flow, 0, &entry));
    TEST_ASSERT_FALSE(flow_interrupt(&flow, 1, &entry));
    TEST_ASSERT_TRUE(flow_interrupt(&flow, 3, &entry));
    TEST_ASSERT_EQUAL_HEX16(0x200, entry);
    TEST_ASSERT_TRUE(flow_interrupt(&flow, 4, &entry));
    TEST_ASSERT_EQUAL_HEX16(0x300, entry);
    TEST_ASSERT_EQUAL_HEX8(1 << 3, flow.high);
    TEST_ASSERT_EQUAL_INT(2 + 1, flow_stack(&flow, 0x200));
}

/* Code that merely lies where an unused vector would be is not taken for one. */
static void test_code_in_the_place_of_a_vector(void)
{
    uint16_t entry;

    PUT(0, 0x02, 0x00, 0x1B);
    PUT(0x1B, 0x02, 0x00, 0x40);
    put_start();
    PUT(0, 0x02, 0x00, 0x1B);
    PUT(0x100, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_FALSE(flow_interrupt(&flow, 3, &entry));
}

#define BYTES_LEFT                                                                                 \
    "returns with bytes left on the stack, or calls through a function pointer; call the "         \
    "function "                                                                                    \
    "by its name"

static void test_what_cannot_be_followed_is_refused(void)
{
    static const struct {
        const char *name;
        uint8_t code[8];
        size_t count;
        const char *message;
    } cases[] = {
        {"recursion",
         {0x12, 0x01, 0x00, 0x22},
         4,
         "x.c:6: work calls itself: work > work; the stack of a recursion has no bound; make a "
         "loop of it"},
        {"a pointer",
         {0x73},
         1,
         "at 0x0100 (x.c:6): calls through a function pointer; call the function by its name"},
        {"stack pointer moved", {0x05, 0x81, 0x22}, 3, "at 0x0102 (work): " BYTES_LEFT},
        {"stack pointer set again",
         {0x75, 0x81, 0x40, 0x22},
         4,
         "at 0x0100 (x.c:6): the stack pointer is set a second time; let only the start-up code "
         "set it"},
        {"stack pointer from a",
         {0xF5, 0x81, 0x22},
         3,
         "at 0x0100 (x.c:6): the stack pointer is set to what is not known here; do without "
         "longjmp and without variables of changing size"},
        {"a pop too many",
         {0xD0, 0xE0, 0xC0, 0xE0, 0x22},
         5,
         "at 0x0100 (x.c:6): takes more from the stack than it has put there"},
        {"a push too many", {0xC0, 0xE0, 0x22}, 3, "at 0x0102 (work): " BYTES_LEFT},
        {"two depths at one place",
         {0x60, 0x02, 0xC0, 0xE0, 0x22},
         5,
         "at 0x0104 (work): is reached with different stacks"},
        {"no instruction", {0xA5, 0x22}, 2, "at 0x0100 (x.c:6): 0xA5 is no instruction"},
        {"the end of the code", {0x00}, 1, "at 0x0101 (work): runs out of the code"},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tearDown();
        setUp();
        put_start();
        is_named(0x100, "work");
        put(0x100, cases[i].code, cases[i].count);
        comes_from(0x100, 6, LISTING_NO_BOUND);
        refuses_to_follow(cases[i].message, cases[i].name);
    }
}

/* So many push acc, then as many pop acc; ret. */
static void test_the_most_that_a_function_may_push(void)
{
    for (uint16_t most = VALUES_DEPTH_MAX; most <= VALUES_DEPTH_MAX + 1; most++) {
        uint16_t at = 0x100;

        tearDown();
        setUp();
        put_start();
        is_named(0x100, "work");
        for (uint16_t i = 0; i < 2 * most; i++, at = (uint16_t)(at + 2)) {
            PUT(at, i < most ? 0xC0 : 0xD0, 0xE0);
        }
        PUT(at, 0x22);
        if (most == VALUES_DEPTH_MAX) {
            TEST_ASSERT_TRUE(flow_follow(&flow));
            TEST_ASSERT_EQUAL_INT(2 + VALUES_DEPTH_MAX, flow_stack(&flow, 0x100));
        } else {
            refuses_to_follow("at 0x01FC (work): this function has too much on the stack", "deep");
        }
    }
}

/* mov dptr,#table; jmp @a+dptr; table: ljmp 0x200; ljmp 0x300 */
static void test_a_switch_goes_everywhere_that_its_table_says(void)
{
    put_start();
    PUT(0x100, 0x90, 0x01, 0x04, 0x73, 0x02, 0x02, 0x00, 0x02, 0x03, 0x00);
    PUT(0x200, 0x22);
    PUT(0x300, 0xA4, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(2 + 2 + 2 + 4 + 2, cycles_of(0x100));
}

/* mov dptr,#low; movc; push; mov dptr,#high; movc; push; ret: the tables hold 0x200 and 0x301 */
static void test_a_switch_goes_to_the_addresses_in_its_tables(void)
{
    put_start();
    PUT(0x100, 0xEF, 0x90, 0x01, 0x0F, 0x93, 0xC0, 0xE0, 0xEF, 0x90, 0x01, 0x11, 0x93, 0xC0, 0xE0,
        0x22, 0x00, 0x01, 0x02, 0x03);
    PUT(0x200, 0x22);
    PUT(0x301, 0xA4, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(2 * (1 + 2 + 2 + 2) + 2 + 4 + 2, cycles_of(0x100));
    TEST_ASSERT_EQUAL_INT(2 + 2, flow_stack(&flow, 0x100));
}

/* mov a,sp; add a,#4; mov sp,a; then four times dec sp */
static void test_a_frame_on_the_stack(void)
{
    put_start();
    PUT(0x100, 0xE5, 0x81, 0x24, 0x04, 0xF5, 0x81, 0x15, 0x81, 0x15, 0x81, 0x15, 0x81, 0x15, 0x81,
        0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(2 + 4, flow_stack(&flow, 0x100));
}

/* push 8; mov 8,sp; inc sp; lcall 0x200; mov sp,8; pop 8; ret, and the callee writes through R0 */
static void test_a_frame_pointer_outlives_a_call(void)
{
    put_start();
    PUT(0x100, 0xC0, 0x08, 0x85, 0x81, 0x08, 0x05, 0x81, 0x12, 0x02, 0x00, 0x85, 0x08, 0x81, 0xD0,
        0x08, 0x22);
    PUT(0x200, 0xF6, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(2 + 2 + 2, flow_stack(&flow, 0x100));
}

static void test_a_call_takes_what_its_callee_takes(void)
{
    put_start();
    PUT(0x100, 0x12, 0x02, 0x00, 0x00, 0x22);
    PUT(0x200, 0x84, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(4 + 2, cycles_of(0x200));
    TEST_ASSERT_EQUAL_INT(2 + 6 + 1 + 2, cycles_of(0x100));
}

/* mov r7,#5; loop: nop; djnz r7,loop; ret */
static void test_a_loop_that_counts_with_constants_needs_no_bound(void)
{
    put_start();
    PUT(0x100, 0x7F, 0x05, 0x00, 0xDF, 0xFD, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(1 + 5 * 3 + 2, cycles_of(0x100));
}

/* jz over a trap; the way that returns counts */
static void test_a_trap_does_not_hide_the_return(void)
{
    put_start();
    PUT(0x100, 0x60, 0x02, 0x80, 0xFE, 0xA4, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(2 + 4 + 2, cycles_of(0x100));
}

/* jz return; mul; ljmp 0; return: ret. A jump to 0 starts the program again, and its way counts. */
static void test_a_jump_to_the_start_is_no_recursion(void)
{
    put_start();
    PUT(0x100, 0x60, 0x04, 0xA4, 0x02, 0x00, 0x00, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(2 + 4 + 2, cycles_of(0x100));
}

/* Between its vectors SDCC 4.5 has routines, in which 0x02 is no jump. */
static void test_the_atomic_routines_are_no_vectors(void)
{
    uint16_t entry;

    put_start();
    PUT(0x100, 0x22);
    PUT(0x08, 0x00, 0x00, 0xE2, 0xFB, 0xEA, 0xF2, 0x80, 0x2C, 0x00, 0x00, 0xE0, 0xFB, 0xEA, 0xF0,
        0x80, 0x24, 0xE6, 0xB5, 0x02, 0x02, 0xEB, 0xF6, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_FALSE(flow_interrupt(&flow, 3, &entry));
}

/* --- cycles ---------------------------------------------------------------------------------- */

/* A program at 0x100, named work; its lines of source and what they bound. */
struct timed {
    const char *name;
    uint8_t code[32];
    size_t count;
    struct {
        uint16_t address;
        int line;
        long rounds;
    } lines[5];
    long expected; /* cycles; 0: MESSAGE comes */
    const char *message;
};

static void start_timed(const struct timed *timed)
{
    tearDown();
    setUp();
    put_start();
    is_named(0x40, "begin");
    is_named(0x100, "work");
    put(0x100, timed->code, timed->count);
    for (size_t i = 0; i < 5 && timed->lines[i].address != 0; i++) {
        comes_from(timed->lines[i].address, timed->lines[i].line, timed->lines[i].rounds);
    }
    TEST_ASSERT_TRUE_MESSAGE(flow_follow(&flow), timed->name);
}

static void check_timed(const struct timed *timed, bool is_round)
{
    long cycles = -1;

    if (timed->expected == 0) {
        refuses_to_count(0x100, is_round, timed->message, timed->name);
        return;
    }
    TEST_ASSERT_TRUE_MESSAGE(flow_cycles(&flow, 0x100, is_round, &cycles), timed->name);
    TEST_ASSERT_EQUAL_INT_MESSAGE(timed->expected, cycles, timed->name);
}

#define NO_BOUND                                                                                   \
    "a loop without a bound; write /* rounds: N */ on the line of its condition, or give "         \
    "--loop=work:N"

static void test_the_longest_way_counts(void)
{
    static const struct timed cases[] = {
        /* jz over the mul; ret */
        {"a step aside", {0x60, 0x01, 0xA4, 0x22}, 4, {{0}}, 2 + 4 + 2, NULL},
        /* jz b; a: mul; sjmp c; b: nop; c: mul; ret */
        {"the longer way is straight on",
         {0x60, 0x03, 0xA4, 0x80, 0x01, 0x00, 0xA4, 0x22},
         8,
         {{0}},
         2 + (4 + 2) + 4 + 2,
         NULL},
        /* jz b; a: nop; sjmp c; b: div; c: mul; ret */
        {"the longer way is the jump",
         {0x60, 0x03, 0x00, 0x80, 0x01, 0x84, 0xA4, 0x22},
         8,
         {{0}},
         2 + 4 + 4 + 2,
         NULL},
        /* mov r7,#5; loop: nop; djnz r7,loop; ret: all turns, and the way out through one more,
         * which is one turn more than a do-while makes */
        {"a bounded loop",
         {0x7F, 0x05, 0x00, 0xDF, 0xFD, 0x22},
         6,
         {{0x103, 7, 5}},
         1 + 5 * 3 + 3 + 2,
         NULL},
        {"a loop at the entry", {0x00, 0xDF, 0xFD, 0x22}, 4, {{0x101, 7, 4}}, 4 * 3 + 3 + 2, NULL},
        /* loop: jz out; mul; sjmp loop; out: ret */
        {"a loop that asks first",
         {0x60, 0x03, 0xA4, 0x80, 0xFB, 0x22},
         6,
         {{0x100, 7, 4}},
         4 * 8 + 2 + 2,
         NULL},
        {"a loop that asks first, with its bound where it jumps back",
         {0x60, 0x03, 0xA4, 0x80, 0xFB, 0x22},
         6,
         {{0x103, 7, 4}},
         4 * 8 + 2 + 2,
         NULL},
        {"the same line at its begin and its end",
         {0x60, 0x03, 0xA4, 0x80, 0xFB, 0x22},
         6,
         {{0x100, 7, 4}, {0x102, 8, -1}, {0x103, 7, 4}},
         4 * 8 + 2 + 2,
         NULL},
        /* loop: jz out; jc loop; mul; sjmp loop; out: ret */
        {"two ways back to the line of the condition",
         {0x60, 0x05, 0x40, 0xFC, 0xA4, 0x80, 0xF9, 0x22},
         8,
         {{0x100, 7, 4}, {0x102, 8, -1}, {0x104, 9, -1}, {0x105, 9, -1}},
         4 * 10 + 2 + 2,
         NULL},
        /* loop: nop; jz loop; jc loop; ret */
        {"two ways back from one line",
         {0x00, 0x60, 0xFD, 0x40, 0xFB, 0x22},
         6,
         {{0x100, 6, -1}, {0x101, 7, 4}, {0x103, 7, 4}},
         4 * 5 + 5 + 2,
         NULL},
        /* loop: mul; jz out; nop; sjmp loop; out: ret */
        {"the bound of a loop without end stands where it begins",
         {0xA4, 0x60, 0x03, 0x00, 0x80, 0xFA, 0x22},
         7,
         {{0x100, 7, 4}, {0x101, 8, -1}, {0x103, 9, -1}, {0x104, 9, -1}},
         4 * 9 + 6 + 2,
         NULL},
        /* djnz r7,itself; mul; nop; ret */
        {"a loop of one instruction, and what follows",
         {0xDF, 0xFE, 0xA4, 0x00, 0x22},
         5,
         {{0x100, 7, 3}},
         3 * 2 + 2 + 4 + 1 + 2,
         NULL},
        /* outer: mov r7,#3; inner: djnz r7,inner; djnz r6,outer; ret */
        {"a loop of one instruction in a loop",
         {0x7F, 0x03, 0xDF, 0xFE, 0xDE, 0xFA, 0x22},
         7,
         {{0x102, 7, 3}, {0x104, 8, 10}},
         10 * (1 + 8 + 2) + (1 + 8 + 2) + 2,
         NULL},
        /* outer: nop; inner: jz out; mul; sjmp inner; out: nop; djnz r6,outer; ret */
        {"a loop that asks first in a loop",
         {0x00, 0x60, 0x03, 0xA4, 0x80, 0xFB, 0x00, 0xDE, 0xF7, 0x22},
         10,
         {{0x101, 7, 5}, {0x107, 8, 3}},
         3 * (1 + (5 * 8 + 2) + 1 + 2) + (1 + (5 * 8 + 2) + 1 + 2) + 2,
         NULL},
        /* a: nop; b: nop; c: djnz r5,c; djnz r6,b; djnz r7,a; ret */
        {"three loops in each other",
         {0x00, 0x00, 0xDD, 0xFE, 0xDE, 0xFB, 0xDF, 0xF8, 0x22},
         9,
         {{0x102, 7, 2}, {0x104, 8, 3}, {0x106, 9, 4}},
         5 * (1 + 4 * (1 + 3 * 2 + 2) + 2) + 2,
         NULL},
        /* outer: mul; a: djnz r5,a; b: djnz r6,b; djnz r7,outer; ret */
        {"two loops after each other in a loop",
         {0xA4, 0xDD, 0xFE, 0xDE, 0xFE, 0xDF, 0xF9, 0x22},
         8,
         {{0x101, 7, 2}, {0x103, 8, 3}, {0x105, 9, 4}},
         5 * (4 + 3 * 2 + 4 * 2 + 2) + 2,
         NULL},
        /* loop: nop; jz out; mul; djnz r6,loop; out: ret */
        {"a loop with two ways out",
         {0x00, 0x60, 0x03, 0xA4, 0xDE, 0xFA, 0x22},
         7,
         {{0x104, 8, 3}},
         3 * 9 + 9 + 2,
         NULL},
        /* loop: nop; jz out; djnz r6,loop; ret; out: mul; mul; mul; ret */
        {"the early way out is the longer one",
         {0x00, 0x60, 0x03, 0xDE, 0xFB, 0x22, 0xA4, 0xA4, 0xA4, 0x22},
         10,
         {{0x103, 8, 3}},
         3 * 5 + 3 + 12 + 2,
         NULL},
        /* loop: nop; jc b; mul; sjmp loop; b: djnz r7,loop; ret */
        {"the longer of two ways back is straight on",
         {0x00, 0x40, 0x03, 0xA4, 0x80, 0xFA, 0xDF, 0xF8, 0x22},
         9,
         {{0x104, 8, 3}, {0x106, 8, 3}},
         3 * (1 + 2 + 4 + 2) + 1 + 2 + 2 + 2,
         NULL},
        /* loop: nop; jc b; sjmp loop; b: mul; djnz r7,loop; ret */
        {"the longer of two ways back is the jump",
         {0x00, 0x40, 0x02, 0x80, 0xFB, 0xA4, 0xDF, 0xF8, 0x22},
         9,
         {{0x103, 8, 3}, {0x106, 8, 3}},
         4 * (1 + 2 + 4 + 2) + 2,
         NULL},
        /* jz c; jc c; mul; sjmp d; c: nop; d: ret */
        {"two ways to a step aside are no loop",
         {0x60, 0x05, 0x40, 0x03, 0xA4, 0x80, 0x01, 0x00, 0x22},
         9,
         {{0}},
         2 + 2 + (4 + 2) + 2,
         NULL},
        /* mov r7,#1; djnz r7,itself; ret */
        {"a loop that turns never", {0x7F, 0x01, 0xDF, 0xFE, 0x22}, 5, {{0}}, 1 + 2 + 2, NULL},
        /* jz trap; mul; ret; trap: sjmp trap */
        {"a trap does not hide the return",
         {0x60, 0x02, 0xA4, 0x22, 0x80, 0xFE},
         6,
         {{0}},
         2 + 4 + 2,
         NULL},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        start_timed(&cases[i]);
        check_timed(&cases[i], false);
        check_timed(&cases[i], false); /* it is known now */
    }
}

static void test_loops_that_cannot_be_bounded_are_refused(void)
{
    static const struct timed cases[] = {
        {"no bound", {0xDF, 0xFE, 0x22}, 3, {{0x100, 6, -1}}, 0, "at 0x0100 (x.c:6): " NO_BOUND},
        /* loop: nop; mul; djnz r6,loop; ret */
        {"a bound in the middle",
         {0x00, 0xA4, 0xDE, 0xFC, 0x22},
         5,
         {{0x100, 6, -1}, {0x101, 7, 2}, {0x102, 8, -1}},
         0,
         "at 0x0100 (x.c:6): " NO_BOUND},
        /* loop: jz out; mul; sjmp loop; out: ret */
        {"a bound in the middle, before the jump back",
         {0x60, 0x03, 0xA4, 0x80, 0xFB, 0x22},
         6,
         {{0x100, 6, -1}, {0x102, 7, 2}, {0x103, 8, -1}},
         0,
         "at 0x0100 (x.c:6): " NO_BOUND},
        /* mov r7,a; djnz r7,itself; ret */
        {"a bound before the loop",
         {0xFF, 0xDF, 0xFE, 0x22},
         4,
         {{0x100, 6, 5}, {0x101, 7, -1}},
         0,
         "at 0x0101 (x.c:7): " NO_BOUND},
        /* outer: loop: jz out; mul; sjmp loop; out: djnz r6,outer; ret */
        {"the outer loop begins with the inner one's condition",
         {0x60, 0x03, 0xA4, 0x80, 0xFB, 0xDE, 0xF9, 0x22},
         8,
         {{0x100, 6, 5}, {0x102, 7, -1}, {0x103, 7, -1}, {0x105, 8, -1}},
         0,
         "at 0x0103 (x.c:7): " NO_BOUND},
        /* jc out; outer: loop: jz on; mul; sjmp loop; on: djnz r6,outer; out: jz end; end: ret */
        {"the line leads away before and after such a loop, not out of it",
         {0x40, 0x07, 0x60, 0x03, 0xA4, 0x80, 0xFB, 0xDE, 0xF9, 0x60, 0x00, 0x22},
         12,
         {{0x100, 6, 5}, {0x102, 6, 5}, {0x105, 7, -1}, {0x107, 8, -1}, {0x109, 6, 5}},
         0,
         "at 0x0105 (x.c:7): " NO_BOUND},
        /* outer: nop; inner: mul; djnz r5,inner; djnz r6,outer; ret */
        {"the inner loop has no bound, the outer one has",
         {0x00, 0xA4, 0xDD, 0xFD, 0xDE, 0xFA, 0x22},
         7,
         {{0x100, 6, -1}, {0x101, 6, -1}, {0x102, 7, -1}, {0x104, 8, 5}},
         0,
         "at 0x0101 (x.c:6): " NO_BOUND},
        /* loop: djnz r5,itself; djnz r6,loop; ret */
        {"the inner loop has no bound",
         {0xDD, 0xFE, 0xDE, 0xFC, 0x22},
         5,
         {{0x100, 6, -1}, {0x102, 7, 5}},
         0,
         "at 0x0100 (x.c:6): " NO_BOUND},
        /* The outer loop has no bound of its own, and does not borrow the inner one's. */
        {"a bound is one loop's",
         {0x7F, 0x03, 0xDF, 0xFE, 0xDE, 0xFA, 0x22},
         7,
         {{0x100, 7, 3}, {0x102, 7, 3}, {0x104, 8, -1}},
         0,
         "at 0x0100 (x.c:7): " NO_BOUND},
        /* djnz r7,itself; djnz r6,itself; ret, on one line */
        {"two loops on a line",
         {0xDF, 0xFE, 0xDE, 0xFE, 0x22},
         5,
         {{0x100, 7, 3}, {0x102, 7, 3}},
         0,
         "at 0x0102 (x.c:7): " NO_BOUND},
        {"two bounds",
         {0x60, 0x03, 0xA4, 0x80, 0xFB, 0x22},
         6,
         {{0x100, 7, 4}, {0x103, 8, 5}},
         0,
         "at 0x0100 (x.c:7): two lines with `rounds:` for one loop; keep one"},
        /* jz into the middle of: loop: nop; nop; djnz r7,loop; ret */
        {"two entries",
         {0x60, 0x01, 0x00, 0x00, 0xDF, 0xFC, 0x22},
         7,
         {{0x102, 7, -1}, {0x103, 7, -1}, {0x104, 7, 5}},
         0,
         "at 0x0102 (x.c:7): a loop with two entries; take the jump into it away"},
        {"no return", {0x80, 0xFE}, 2, {{0x100, 7, -1}}, 0, "at 0x0100 (x.c:7): never returns"},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        start_timed(&cases[i]);
        check_timed(&cases[i], false);
    }
}

static void test_a_round_of_an_endless_loop(void)
{
    static const struct timed cases[] = {
        /* nop; loop: mul; jz skip; nop; skip: sjmp loop */
        {"alone", {0x00, 0xA4, 0x60, 0x01, 0x00, 0x80, 0xFA}, 7, {{0}}, 4 + 2 + 1 + 2, NULL},
        /* loop: nop; djnz r7,itself; sjmp loop */
        {"with a bounded loop in it",
         {0x00, 0xDF, 0xFE, 0x80, 0xFB},
         5,
         {{0x101, 7, 5}},
         1 + 6 * 2 + 2,
         NULL},
        /* djnz r7,itself; loop: nop; sjmp loop */
        {"after a longer bounded loop",
         {0xDF, 0xFE, 0x00, 0x80, 0xFD},
         5,
         {{0x100, 7, 100}},
         1 + 2,
         NULL},
        /* jz b; a: mul; nop; sjmp a; b: nop; sjmp b */
        {"the longer of two comes first",
         {0x60, 0x04, 0xA4, 0x00, 0x80, 0xFC, 0x00, 0x80, 0xFD},
         9,
         {{0}},
         4 + 1 + 2,
         NULL},
        /* jz b; a: nop; sjmp a; b: mul; nop; sjmp b */
        {"the longer of two comes last",
         {0x60, 0x03, 0x00, 0x80, 0xFD, 0xA4, 0x00, 0x80, 0xFC},
         9,
         {{0}},
         4 + 1 + 2,
         NULL},
        {"there is none",
         {0xA4, 0xDF, 0xFE, 0x22},
         4,
         {{0x100, 5, -1}, {0x101, 7, 5}},
         0,
         "at 0x0100 (x.c:5): has no endless loop to take a round of"},
        {"an unbounded loop comes before",
         {0xDF, 0xFE, 0x80, 0xFE},
         4,
         {{0x100, 6, -1}},
         0,
         "at 0x0100 (x.c:6): " NO_BOUND},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        start_timed(&cases[i]);
        check_timed(&cases[i], true);
    }
}

/* jz out; loop: mul; sjmp loop; out: ret */
static void test_a_function_may_return_or_turn_for_ever(void)
{
    static const struct timed timed = {
        "both", {0x60, 0x03, 0xA4, 0x80, 0xFD, 0x22}, 6, {{0}}, 2 + 2, NULL};
    long cycles;

    start_timed(&timed);
    check_timed(&timed, false);
    TEST_ASSERT_TRUE(flow_cycles(&flow, 0x100, true, &cycles));
    TEST_ASSERT_EQUAL_INT(4 + 2, cycles);
    check_timed(&timed, false);
}

/* loop: nop; djnz r7,loop; ret */
static void test_a_bound_may_be_given_for_a_function(void)
{
    static const struct timed timed = {
        "given", {0x00, 0xDF, 0xFD, 0x22}, 4, {{0x100, 6, -1}}, 4 * 3 + 3 + 2, NULL};

    start_timed(&timed);
    flow.rounds[0x100] = 4;
    check_timed(&timed, false);
}

/* mov r7,#5; loop: lcall 0x200; djnz r7,loop; ret */
static void test_what_a_callee_changes_is_not_counted(void)
{
    static const struct {
        uint8_t code; /* of the callee */
        bool is_counted;
    } cases[] = {{0x0E, true}, {0x1F, false}}; /* inc r6; dec r7 */

    for (size_t i = 0; i < 2; i++) {
        tearDown();
        setUp();
        put_start();
        is_named(0x100, "work");
        PUT(0x100, 0x7F, 0x05, 0x12, 0x02, 0x00, 0xDF, 0xFB, 0x22);
        PUT(0x200, cases[i].code, 0x22);
        comes_from(0x102, 6, LISTING_NO_BOUND);
        TEST_ASSERT_TRUE(flow_follow(&flow));
        if (cases[i].is_counted) {
            TEST_ASSERT_EQUAL_INT(1 + 5 * (2 + 3 + 2) + 2, cycles_of(0x100));
        } else {
            refuses_to_count(0x100, false, "at 0x0102 (x.c:6): " NO_BOUND, "changed");
        }
    }
}

/* mov COUNTER,#5; mov r7,COUNTER; loop: djnz r7,loop; ret, while an interrupt may set COUNTER */
static void test_a_counter_that_an_interrupt_changes_bounds_nothing(void)
{
    static const uint8_t counters[] = {0x00, 0x30, 0x7F};

    for (size_t i = 0; i < 2 * sizeof counters; i++) {
        uint8_t counter = counters[i / 2], changed = (uint8_t)(counter + i % 2);

        tearDown();
        setUp();
        put_start();
        is_named(0x100, "work");
        PUT(0x100, 0x75, counter, 0x05, 0xAF, counter, 0xDF, 0xFE, 0x22);
        comes_from(0x105, 6, LISTING_NO_BOUND);
        PUT(0x0B, 0x02, 0x02, 0x00);
        PUT(0x200, 0x75, changed, 0x09, 0x32);
        TEST_ASSERT_TRUE(flow_follow(&flow));
        if (changed == counter) {
            refuses_to_count(0x100, false, "at 0x0105 (x.c:6): " NO_BOUND, "shared");
        } else {
            TEST_ASSERT_EQUAL_INT(2 + 2 + 5 * 2 + 2, cycles_of(0x100));
        }
    }
}

/* The table of what is known of a function grows with it. */
static void test_a_long_function(void)
{
    put_start();
    for (uint16_t i = 0; i < 600; i += 3) {
        PUT((uint16_t)(0x100 + i), 0x60, 0x01, 0xA4); /* jz over the mul */
    }
    PUT(0x100 + 600, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(200 * 6 + 2, cycles_of(0x100));
}

/* --- messages about code without source lines ------------------------------------------------- */

#define LIBRARY_LOOP                                                                               \
    "a loop without a bound; avoid the call, or give --loop=strlen:N, the most rounds of each of " \
    "its loops"

/* Line 7 of work calls 0x200; strlen stands at 0x300 and has a loop without a bound. */
static void put_library(void)
{
    put_start();
    is_named(0x40, "begin");
    is_named(0x100, "work");
    is_named(0x200, "wrap");
    is_named(0x300, "strlen");
    PUT(0x100, 0x00, 0x12, 0x02, 0x00, 0x22);
    PUT(0x300, 0xDF, 0xFE, 0x22);
    comes_from(0x100, 6, LISTING_NO_BOUND);
    comes_from(0x101, 7, LISTING_NO_BOUND);
}

static void test_a_loop_of_the_library_names_the_line_that_leads_there(void)
{
    static const struct {
        const char *name;
        uint8_t code[6]; /* at 0x200 */
        uint16_t line_8; /* what is on line 8 */
        const char *message;
    } cases[] = {
        {"a call", {0x12, 0x03, 0x00, 0x22}, 0, "strlen, called at x.c:7: " LIBRARY_LOOP},
        {"a call with a line",
         {0x12, 0x03, 0x00, 0x22},
         0x200,
         "strlen, called at x.c:8: " LIBRARY_LOOP},
        {"a jump", {0x02, 0x03, 0x00}, 0, "strlen, called at x.c:7: " LIBRARY_LOOP},
        {"a jump with a line", {0x02, 0x03, 0x00}, 0x200, "strlen, called at x.c:8: " LIBRARY_LOOP},
        {"a later jump with a line",
         {0x00, 0x02, 0x03, 0x00},
         0x201,
         "strlen, called at x.c:8: " LIBRARY_LOOP},
        {"another line than the jump's",
         {0x00, 0x02, 0x03, 0x00},
         0x200,
         "strlen, called at x.c:7: " LIBRARY_LOOP},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tearDown();
        setUp();
        put_library();
        put(0x200, cases[i].code, sizeof cases[i].code);
        if (cases[i].line_8 != 0) {
            comes_from(cases[i].line_8, 8, LISTING_NO_BOUND);
        }
        TEST_ASSERT_TRUE(flow_follow(&flow));
        refuses_to_count(0x100, false, cases[i].message, cases[i].name);
    }
}

/* Line 7 calls what returns; line 8 jumps to strlen. */
static void test_a_call_that_has_returned_leads_nowhere(void)
{
    put_library();
    PUT(0x104, 0x02, 0x03, 0x00);
    PUT(0x200, 0x22);
    comes_from(0x104, 8, LISTING_NO_BOUND);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    refuses_to_count(0x100, false, "strlen, called at x.c:8: " LIBRARY_LOOP, "jump");
}

/* Line 7 calls strlen, and line 8 wrap, which calls strlen, too. */
static void test_the_line_that_leads_to_the_caller_is_named(void)
{
    put_library();
    PUT(0x101, 0x12, 0x03, 0x00, 0x12, 0x02, 0x00, 0x22);
    comes_from(0x104, 8, LISTING_NO_BOUND);
    PUT(0x200, 0x12, 0x03, 0x00, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    refuses_to_count(0x200, false, "strlen, called at x.c:8: " LIBRARY_LOOP, "wrap");
}

/* Two functions call wrap, which calls strlen: the one whose cycles are counted is named. */
static void test_the_last_caller_is_named(void)
{
    put_library();
    PUT(0x200, 0x12, 0x03, 0x00, 0x22);
    PUT(0x400, 0x12, 0x02, 0x00, 0x22);
    comes_from(0x400, 9, LISTING_NO_BOUND);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_TRUE(flow_follow_function(&flow, 0x400));
    refuses_to_count(0x100, false, "strlen, called at x.c:7: " LIBRARY_LOOP, "work");
    refuses_to_count(0x400, false, "strlen, called at x.c:9: " LIBRARY_LOOP, "other");
}

/* An interrupt changes the byte that a jump goes by: it has other targets when the loop's rounds
 * are counted.
 * mov 0x30,#0; mov a,0x30; mov dptr,#0x109; jmp @a+dptr; two ljmp 0x10F; djnz r7,itself; ret */
static void test_what_is_followed_once_more_may_be_refused(void)
{
    put_start();
    is_named(0x100, "work");
    PUT(0x100, 0x75, 0x30, 0x00, 0xE5, 0x30, 0x90, 0x01, 0x09, 0x73, 0x02, 0x01, 0x0F, 0x02, 0x01,
        0x0F, 0xDF, 0xFE, 0x22);
    PUT(0x0B, 0x02, 0x02, 0x00);
    PUT(0x200, 0x75, 0x30, 0x03, 0x32);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    refuses_to_count(0x100, false,
                     "at 0x0108 (work): calls through a function pointer; call the function by its "
                     "name",
                     "shared");
}

/* Each function calls the next one twice: what a call takes is found once. */
static void test_the_cycles_of_a_function_are_found_once(void)
{
    long expected = 2;

    put_start();
    for (uint8_t i = 1; i < 24; i++) {
        PUT((uint16_t)(0x100 * i), 0x12, (uint8_t)(i + 1), 0x00, 0x12, (uint8_t)(i + 1), 0x00,
            0x22);
        expected = 2 * (2 + expected) + 2;
    }
    PUT(0x1800, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(expected, cycles_of(0x100));
}

/* The loop's own jump back to the function's begin does not lead there. */
static void test_a_function_does_not_lead_to_itself(void)
{
    put_library();
    PUT(0x200, 0x00, 0xDF, 0xFD, 0x22);
    comes_from(0x201, 8, LISTING_NO_BOUND);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    refuses_to_count(0x100, false,
                     "wrap, called at x.c:7: a loop without a bound; avoid the call, or give "
                     "--loop=wrap:N, the most rounds of each of its loops",
                     "itself");
}

static void test_no_line_leads_to_what_nothing_calls(void)
{
    put_library();
    PUT(0x200, 0x22);
    comes_from(0xFFFF, 9, LISTING_NO_BOUND);
    comes_from(0, 0, LISTING_NO_BOUND);
    free(listing.places[0]);
    listing.places[0] = NULL;
    TEST_ASSERT_TRUE(flow_follow(&flow));
    refuses_to_count(0x300, false, "strlen: " LIBRARY_LOOP, "not called");
    PUT(0x400, 0xA5);
    is_named(0x400, "odd");
    refuses_to_count(0x400, false, "at 0x0400 (odd): 0xA5 is no instruction", "not called");
    refuses_to_count(0x400, false, "at 0x0400 (odd): 0xA5 is no instruction", "once more");
}

static void test_code_of_the_library_that_cannot_be_followed(void)
{
    put_library();
    PUT(0x200, 0x12, 0x03, 0x00, 0x22);
    PUT(0x300, 0x00, 0x73);
    refuses_to_follow("at 0x0301 (strlen, called at x.c:7): calls through a function pointer; call "
                      "the function by its name",
                      "pointer");
}

/* lcall 0x200; ret; 0x200: djnz r7,itself; ret */
static void test_the_rounds_of_a_library_function_are_known(void)
{
    static const struct {
        const char *name;
        bool has_line;
        long given; /* rounds; 0: none */
        long expected;
        const char *message;
    } cases[] = {
        {"_divulong", false, 0, 2 + 32 * 2 + 2 + 2 + 2, NULL},
        {"_divulong", false, 8, 2 + 8 * 2 + 2 + 2 + 2, NULL},
        {"_mine", false, 1, 2 + 1 * 2 + 2 + 2 + 2, NULL},
        {"_mine", false, 8, 2 + 8 * 2 + 2 + 2 + 2, NULL},
        {"_divulong", true, 0, 0,
         "at 0x0200 (x.c:9): a loop without a bound; write /* rounds: N */ on the line of its "
         "condition, or give --loop=_divulong:N"},
        {"_mine", false, 0, 0,
         "_mine: a loop without a bound; avoid the call, or give --loop=_mine:N, the most rounds "
         "of each of its loops"},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tearDown();
        setUp();
        put_start();
        PUT(0x100, 0x12, 0x02, 0x00, 0x22);
        PUT(0x200, 0xDF, 0xFE, 0x22);
        is_named(0x100, "work");
        is_named(0x200, cases[i].name);
        flow.rounds[0x200] = cases[i].given;
        if (cases[i].has_line) {
            comes_from(0x200, 9, LISTING_NO_BOUND);
        }
        TEST_ASSERT_TRUE(flow_follow(&flow));
        if (cases[i].message == NULL) {
            TEST_ASSERT_EQUAL_INT(cases[i].expected, cycles_of(0x100));
        } else {
            refuses_to_count(0x100, false, cases[i].message, cases[i].name);
        }
    }
}

/* f0 calls f1, which calls f2, ..., f9, which calls f1 on line 9. */
static void test_a_recursion_is_told_with_its_whole_path(void)
{
    char name[] = "f0";

    for (int has_line = 0; has_line < 2; has_line++) {
        tearDown();
        setUp();
        put_start();
        for (uint8_t i = 0; i < 10; i++) {
            name[1] = (char)('0' + i);
            is_named((uint16_t)(0x100 * (i + 1)), name);
            PUT((uint16_t)(0x100 * (i + 1)), 0x12, (uint8_t)(i < 9 ? i + 2 : 2), 0x00, 0x22);
        }
        if (has_line) {
            comes_from(0xA00, 9, LISTING_NO_BOUND);
        }
        refuses_to_follow(has_line
                              ? "x.c:9: f1 calls itself: f1 > f2 > f3 > f4 > f5 > f6 > f7 > f8 > "
                                "f9 > f1; the stack of a recursion has no bound; make a loop of it"
                              : "f1 calls itself: f1 > f2 > f3 > f4 > f5 > f6 > f7 > f8 > "
                                "f9 > f1; the stack of a recursion has no bound; make a loop of it",
                          "path");
    }
}

/* --- the start, and interrupts -------------------------------------------------------------- */

static void test_the_start_sets_the_stack_pointer(void)
{
    TEST_ASSERT_EQUAL_INT(-1, flow.stack_base);
    refuses_to_follow(
        "no code at address 0, where an 8051 begins; give an image that starts by itself", "empty");
    PUT(0, 0x80, 0xFE); /* sjmp . */
    is_named(0, "start");
    refuses_to_follow("at 0x0000 (start): no start-up sets the stack pointer", "no start-up");

    tearDown();
    setUp();
    PUT(0, 0x75, 0x81, 0x00, 0x80, 0xFE); /* mov sp,#0; sjmp . */
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(0, flow.stack_base);
}

/* setb of a bit of IP makes the interrupt of this bit one of the high level. */
static void test_the_bits_of_the_priority_register(void)
{
    for (int bit = 0xB7; bit <= 0xBE; bit++) {
        tearDown();
        setUp();
        put_start();
        PUT(0x100, 0xD2, (uint8_t)bit, 0x22);
        TEST_ASSERT_TRUE(flow_follow(&flow));
        TEST_ASSERT_EQUAL_HEX8(bit >= 0xB8 && bit <= 0xBD ? 1 << (bit - 0xB8) : 0, flow.high);
        tearDown();
        setUp();
        put_start();
        PUT(0x100, 0xC2, (uint8_t)bit, 0x22); /* clr */
        TEST_ASSERT_TRUE(flow_follow(&flow));
        TEST_ASSERT_EQUAL_HEX8(0, flow.high);
    }
}

/* At 0x33, behind the last vector, is code like any other. */
static void test_what_an_interrupt_does_is_followed(void)
{
    put_start();
    PUT(0x100, 0x22);
    PUT(0x33, 0x02, 0x02, 0x00);
    PUT(0x200, 0xA5);
    is_named(0x200, "late");
    TEST_ASSERT_TRUE(flow_follow(&flow));
    tearDown();
    setUp();
    put_start();
    PUT(0x100, 0x22);
    PUT(0x2B, 0x02, 0x02, 0x00);
    PUT(0x200, 0xA5);
    is_named(0x200, "late");
    refuses_to_follow("at 0x0200 (late): 0xA5 is no instruction", "interrupt");
}

static void test_each_vector_is_one(void)
{
    for (int n = 0; n < FLOW_INTERRUPTS; n++) {
        uint16_t entry;

        tearDown();
        setUp();
        put_start();
        PUT(0x100, 0x22);
        PUT((uint16_t)(8 * n + 3), 0x02, 0x02, 0x00);
        PUT(0x200, 0x32);
        TEST_ASSERT_TRUE(flow_follow(&flow));
        for (int k = 0; k < FLOW_INTERRUPTS; k++) {
            TEST_ASSERT_EQUAL_INT(k == n, flow_interrupt(&flow, k, &entry));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_stack_of_calls_and_pushes);
    RUN_TEST(test_the_deeper_of_two_branches_counts);
    RUN_TEST(test_interrupts_and_their_levels);
    RUN_TEST(test_code_in_the_place_of_a_vector);
    RUN_TEST(test_what_cannot_be_followed_is_refused);
    RUN_TEST(test_the_most_that_a_function_may_push);
    RUN_TEST(test_a_switch_goes_everywhere_that_its_table_says);
    RUN_TEST(test_a_switch_goes_to_the_addresses_in_its_tables);
    RUN_TEST(test_a_frame_on_the_stack);
    RUN_TEST(test_a_frame_pointer_outlives_a_call);
    RUN_TEST(test_a_call_takes_what_its_callee_takes);
    RUN_TEST(test_a_loop_that_counts_with_constants_needs_no_bound);
    RUN_TEST(test_a_trap_does_not_hide_the_return);
    RUN_TEST(test_a_jump_to_the_start_is_no_recursion);
    RUN_TEST(test_the_atomic_routines_are_no_vectors);
    RUN_TEST(test_the_longest_way_counts);
    RUN_TEST(test_loops_that_cannot_be_bounded_are_refused);
    RUN_TEST(test_a_round_of_an_endless_loop);
    RUN_TEST(test_a_function_may_return_or_turn_for_ever);
    RUN_TEST(test_a_bound_may_be_given_for_a_function);
    RUN_TEST(test_what_a_callee_changes_is_not_counted);
    RUN_TEST(test_a_counter_that_an_interrupt_changes_bounds_nothing);
    RUN_TEST(test_a_long_function);
    RUN_TEST(test_a_loop_of_the_library_names_the_line_that_leads_there);
    RUN_TEST(test_a_call_that_has_returned_leads_nowhere);
    RUN_TEST(test_the_line_that_leads_to_the_caller_is_named);
    RUN_TEST(test_the_last_caller_is_named);
    RUN_TEST(test_what_is_followed_once_more_may_be_refused);
    RUN_TEST(test_the_cycles_of_a_function_are_found_once);
    RUN_TEST(test_a_function_does_not_lead_to_itself);
    RUN_TEST(test_no_line_leads_to_what_nothing_calls);
    RUN_TEST(test_code_of_the_library_that_cannot_be_followed);
    RUN_TEST(test_the_rounds_of_a_library_function_are_known);
    RUN_TEST(test_a_recursion_is_told_with_its_whole_path);
    RUN_TEST(test_the_start_sets_the_stack_pointer);
    RUN_TEST(test_the_bits_of_the_priority_register);
    RUN_TEST(test_what_an_interrupt_does_is_followed);
    RUN_TEST(test_each_vector_is_one);
    return UNITY_END();
}
