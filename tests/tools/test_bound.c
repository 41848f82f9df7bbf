/* SPDX-License-Identifier: MIT */
/* Under test: tools/bound, on small programs written as bytes, whose stack and cycles are counted
 * by hand from the data sheet, and its instruction table against every listing that SDCC has
 * written here. */
#include "unity.h"

#include "bound/flow.h"
#include "bound/listing.h"
#include "bound/opcode.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct hexfile hex;
static struct listing listing;
static struct flow flow;

void setUp(void)
{
    memset(&hex, 0, sizeof hex);
    listing_init(&listing);
    flow_init(&flow, &hex, &listing, "image");
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

/* Messages to stderr are not checked here. */
static bool follow_quietly(void)
{
    int kept = dup(STDERR_FILENO);
    bool is_good;

    TEST_ASSERT_NOT_NULL(freopen("/dev/null", "w", stderr));
    is_good = flow_follow(&flow);
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
    return is_good;
}

static bool count_quietly(uint16_t entry, bool is_round, long *cycles)
{
    int kept = dup(STDERR_FILENO);
    bool is_good;

    TEST_ASSERT_NOT_NULL(freopen("/dev/null", "w", stderr));
    is_good = flow_cycles(&flow, entry, is_round, cycles);
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
    return is_good;
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

static void test_what_cannot_be_followed_is_refused(void)
{
    static const struct {
        const char *name;
        uint8_t code[8];
        size_t count;
    } cases[] = {
        {"recursion", {0x12, 0x01, 0x00, 0x22}, 4},
        {"a pointer", {0x73}, 1},
        {"stack pointer moved", {0x05, 0x81, 0x22}, 3},
        {"stack pointer set again", {0x75, 0x81, 0x40, 0x22}, 4},
        {"stack pointer from a", {0xF5, 0x81, 0x22}, 3},
        {"a pop too many", {0xD0, 0xE0, 0xC0, 0xE0, 0x22}, 5},
        {"a push too many", {0xC0, 0xE0, 0x22}, 3},
        {"two depths at one place", {0x60, 0x02, 0xC0, 0xE0, 0x22}, 5},
        {"no instruction", {0xA5, 0x22}, 2},
        {"the end of the code", {0x00}, 1},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tearDown();
        setUp();
        put_start();
        put(0x100, cases[i].code, cases[i].count);
        TEST_ASSERT_FALSE_MESSAGE(follow_quietly(), cases[i].name);
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

static void test_the_longer_of_two_branches_counts(void)
{
    put_start();
    PUT(0x100, 0x60, 0x01, 0xA4, 0x22); /* jz over the mul */
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(2 + 4 + 2, cycles_of(0x100));
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
static void test_a_loop_turns_as_often_as_its_source_line_says(void)
{
    put_start();
    PUT(0x100, 0x7F, 0x05, 0x00, 0xDF, 0xFD, 0x22);
    comes_from(0x103, 7, 5);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    /* Five turns and the way out through the last of them: one turn more than a do-while makes. */
    TEST_ASSERT_EQUAL_INT(1 + 5 * 3 + 3 + 2, cycles_of(0x100));
}

static void test_a_loop_at_the_entry_counts_too(void)
{
    put_start();
    PUT(0x100, 0x00, 0xDF, 0xFD, 0x22);
    comes_from(0x101, 7, 4);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(4 * 3 + 3 + 2, cycles_of(0x100));
}

/* outer: mov r7,#3; inner: djnz r7,inner; djnz r6,outer; ret */
static void test_loops_in_loops(void)
{
    put_start();
    PUT(0x100, 0x7F, 0x03, 0xDF, 0xFE, 0xDE, 0xFA, 0x22);
    comes_from(0x102, 7, 3);
    comes_from(0x104, 8, 10);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    /* A turn of the outer one: 1, the inner one 3 * 2 + 2, 2. */
    TEST_ASSERT_EQUAL_INT(10 * 11 + 11 + 2, cycles_of(0x100));
}

/* The outer loop has no bound of its own, and must not borrow the inner one's. */
static void test_a_bound_speaks_for_one_loop(void)
{
    long cycles;

    put_start();
    PUT(0x100, 0x7F, 0x03, 0xDF, 0xFE, 0xDE, 0xFA, 0x22);
    comes_from(0x100, 7, 3);
    comes_from(0x102, 7, 3);
    comes_from(0x104, 8, LISTING_NO_BOUND);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_FALSE(count_quietly(0x100, false, &cycles));
}

/* mov r7,#5; loop: nop; djnz r7,loop; ret */
static void test_a_loop_that_counts_with_constants_needs_no_bound(void)
{
    put_start();
    PUT(0x100, 0x7F, 0x05, 0x00, 0xDF, 0xFD, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_EQUAL_INT(1 + 5 * 3 + 2, cycles_of(0x100));
}

/* mov 0x30,#5; loop: djnz 0x30,loop; ret, while an interrupt may set 0x30 */
static void test_a_counter_that_an_interrupt_changes_bounds_nothing(void)
{
    long cycles;

    for (int is_shared = 0; is_shared < 2; is_shared++) {
        tearDown();
        setUp();
        put_start();
        PUT(0x100, 0x75, 0x30, 0x05, 0xD5, 0x30, 0xFD, 0x22);
        PUT(0x0B, 0x02, 0x02, 0x00);
        PUT(0x200, 0x75, (uint8_t)(is_shared ? 0x30 : 0x31), 0x09, 0x32);
        TEST_ASSERT_TRUE(flow_follow(&flow));
        TEST_ASSERT_EQUAL_INT(!is_shared, count_quietly(0x100, false, &cycles));
    }
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

static void test_loops_that_cannot_be_bounded_are_refused(void)
{
    long cycles;

    put_start(); /* no bound */
    PUT(0x100, 0xDF, 0xFE, 0x22);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_FALSE(count_quietly(0x100, false, &cycles));

    tearDown();
    setUp();
    put_start(); /* jz into the middle of: loop: nop; nop; djnz */
    PUT(0x100, 0x60, 0x01, 0x00, 0x00, 0xDF, 0xFC, 0x22);
    comes_from(0x104, 7, 5);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_FALSE(count_quietly(0x100, false, &cycles));
}

/* A round of: loop: mul; jz skip; nop; skip: sjmp loop. */
static void test_a_round_of_an_endless_loop(void)
{
    long cycles;

    put_start();
    PUT(0x100, 0x00, 0xA4, 0x60, 0x01, 0x00, 0x80, 0xFA);
    TEST_ASSERT_TRUE(flow_follow(&flow));
    TEST_ASSERT_TRUE(flow_cycles(&flow, 0x100, true, &cycles));
    TEST_ASSERT_EQUAL_INT(4 + 2 + 1 + 2, cycles);
    TEST_ASSERT_FALSE(count_quietly(0x100, false, &cycles)); /* it never returns */
}

static void test_names_and_bounds_come_from_a_listing(void)
{
    const char *path = "build/tests/bound.rst";
    FILE *stream = fopen(path, "w");

    TEST_ASSERT_NOT_NULL(stream);
    fputs("                                     61 \t.area DSEG    (DATA)\n"
          "      000100                         62 _not_code::\n"
          "                                    180 \t.area CSEG    (CODE)\n"
          "      000100                        236 _work:\n"
          "                                    237 ;\tfirmware/x.c:52: } while (--n != 0); /* "
          "rounds: 12 */\n"
          "      000100 DF FE            [24]  238 \tdjnz\tr7,00101$\n"
          "                                    239 ;\tfirmware/x.c:54: }\n"
          "      000102 22               [24]  240 \tret\n",
          stream);
    fclose(stream);
    PUT(0x100, 0xDF, 0xFE, 0x22);
    TEST_ASSERT_EQUAL_INT(0, listing_read(&listing, &hex, path));
    TEST_ASSERT_EQUAL_INT(0x100, listing_find(&listing, "work"));
    TEST_ASSERT_EQUAL_INT(-1, listing_find(&listing, "not_code"));
    TEST_ASSERT_EQUAL_STRING("firmware/x.c:52", listing.places[0x100]);
    TEST_ASSERT_EQUAL_INT(12, listing.rounds[0x100]);
    TEST_ASSERT_EQUAL_INT(LISTING_NO_BOUND, listing.rounds[0x102]);
    remove(path);
}

/* SDCC's listings give each instruction's clocks in brackets. */
static int compare_line(const char *line)
{
    unsigned address, bytes[3], clocks;
    const char *bracket = strchr(line, '[');
    int count =
        bracket == NULL
            ? 0
            : sscanf(line, " %6x %2x %2x %2x", &address, &bytes[0], &bytes[1], &bytes[2]) - 1;
    static uint8_t code[HEX_CODE_SIZE];
    struct instruction it;

    if (count < 1 || sscanf(bracket, "[%u]", &clocks) != 1) {
        return 0;
    }
    for (int i = 0; i < 3; i++) {
        code[i] = i < count ? (uint8_t)bytes[i] : 0;
    }
    it = opcode_decode(code, 0);
    TEST_ASSERT_EQUAL_INT_MESSAGE(count, it.bytes, line);
    TEST_ASSERT_EQUAL_INT_MESSAGE(clocks, 12 * it.cycles, line);
    return 1;
}

static void test_the_instruction_table_against_the_assemblers_own(void)
{
    glob_t files;
    int compared = 0;

    TEST_ASSERT_EQUAL_INT(0, glob("build/stc89c516rd/*/*/*.rst", 0, NULL, &files));
    for (size_t i = 0; i < files.gl_pathc; i++) {
        FILE *stream = fopen(files.gl_pathv[i], "r");
        char line[1024];

        TEST_ASSERT_NOT_NULL(stream);
        while (fgets(line, sizeof line, stream) != NULL) {
            if (strncmp(line, "      0", 7) == 0) {
                compared += compare_line(line);
            }
        }
        fclose(stream);
    }
    globfree(&files);
    TEST_ASSERT_GREATER_THAN_INT(10000, compared);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_stack_of_calls_and_pushes);
    RUN_TEST(test_the_deeper_of_two_branches_counts);
    RUN_TEST(test_interrupts_and_their_levels);
    RUN_TEST(test_code_in_the_place_of_a_vector);
    RUN_TEST(test_what_cannot_be_followed_is_refused);
    RUN_TEST(test_a_switch_goes_everywhere_that_its_table_says);
    RUN_TEST(test_a_switch_goes_to_the_addresses_in_its_tables);
    RUN_TEST(test_a_frame_on_the_stack);
    RUN_TEST(test_a_frame_pointer_outlives_a_call);
    RUN_TEST(test_the_longer_of_two_branches_counts);
    RUN_TEST(test_a_call_takes_what_its_callee_takes);
    RUN_TEST(test_a_loop_turns_as_often_as_its_source_line_says);
    RUN_TEST(test_a_loop_at_the_entry_counts_too);
    RUN_TEST(test_loops_in_loops);
    RUN_TEST(test_a_bound_speaks_for_one_loop);
    RUN_TEST(test_a_loop_that_counts_with_constants_needs_no_bound);
    RUN_TEST(test_a_counter_that_an_interrupt_changes_bounds_nothing);
    RUN_TEST(test_a_trap_does_not_hide_the_return);
    RUN_TEST(test_a_jump_to_the_start_is_no_recursion);
    RUN_TEST(test_the_atomic_routines_are_no_vectors);
    RUN_TEST(test_loops_that_cannot_be_bounded_are_refused);
    RUN_TEST(test_a_round_of_an_endless_loop);
    RUN_TEST(test_names_and_bounds_come_from_a_listing);
    RUN_TEST(test_the_instruction_table_against_the_assemblers_own);
    return UNITY_END();
}
