/* SPDX-License-Identifier: MIT */
/* Under test: tools/bound/values.c, what is known before and after each instruction, against the
 * simulator: with all operands known the result is known, too, and is the simulator's; whatever is
 * known along a program of chance holds in the simulator; and, by hand, what is left of operands of
 * which a part is known. */
#include "unity.h"

#include "bound/opcode.h"
#include "bound/values.h"
#include "sim/mcs52.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { P0 = 0x80, SP = 0x81, DPL = 0x82, DPH = 0x83, P1 = 0x90, UNUSED = 0xC0, PSW = 0xD0 };
enum { ACC = 0xE0, B = 0xF0, RAM = 0x80 };
enum {
    AT = 0x1000, /* the first instruction of a test */
    SHARED = 0x35,
    FRAME_POINTER = 0x0A,
    STACK = 0x80, /* the stack pointer at the entry: no direct address reaches the stack */
    WALKS = 1500,
    WALK_LENGTH = 50,
    DRAWS = 30 /* of each opcode */
};

static struct mcs52 *chip;
static struct values_world world;
static struct values values;
static uint8_t code[0x10000];
static uint8_t entry[VALUES_BYTES]; /* the bytes at the function's entry, where there is a chip */
static uint32_t seed;

static const struct value any = {.kind = VALUE_ANY};

static struct value number(unsigned value)
{
    return (struct value){.kind = VALUE_CONST, .number = (uint16_t)value};
}

/* What PLACE was at the entry, plus VALUE. */
static struct value at_entry(unsigned place, unsigned value)
{
    return (struct value){.kind = VALUE_ENTRY, .place = (uint8_t)place, .number = (uint16_t)value};
}

static struct value table(unsigned base)
{
    return (struct value){.kind = VALUE_TABLE, .number = (uint16_t)base};
}

/* A PSW of which the bank is known. */
static struct value bank(unsigned first)
{
    return (struct value){.kind = VALUE_CONST, .place = PSW, .number = (uint16_t)first};
}

static unsigned chance(unsigned below)
{
    seed = seed * 1664525 + 1013904223;
    return (unsigned)((uint64_t)seed * below >> 32);
}

void setUp(void)
{
    for (int i = 0; i < 0x10000; i++) {
        code[i] = (uint8_t)(i >> 8); /* so that a byte of a table tells which table */
    }
    memset(&world, 0xFF, sizeof world);
    values_world_init(&world, code);
    values_enter(&values, &world);
    seed = 1;
}

void tearDown(void)
{
    mcs52_destroy(chip);
    chip = NULL;
}

/* --- beside the simulator ------------------------------------------------------------------- */

static uint8_t byte_of_chip(int byte)
{
    return byte < RAM ? mcs52_ram(chip)[byte] : mcs52_sfr(chip, (uint8_t)byte);
}

static bool is_in_table(unsigned base, uint8_t byte)
{
    for (unsigned i = 0; i < 0x100; i++) {
        if (code[(uint16_t)(base + i)] == byte) {
            return true;
        }
    }
    return false;
}

static bool holds(struct value value, uint8_t byte)
{
    uint8_t mask = value.place == PSW ? 0x18 : 0xFF; /* of the PSW only the bank is known */

    switch (value.kind) {
    case VALUE_CONST:
        return (byte & mask) == value.number;
    case VALUE_ENTRY:
        return ((byte ^ (entry[value.place] + value.number)) & mask) == 0;
    case VALUE_TABLE:
        return value.number >> 8 == AT >> 8 || is_in_table(value.number, byte);
    default:
        return value.kind == VALUE_ANY;
    }
}

static void check_value(struct value value, uint8_t byte, const char *what, int which)
{
    if (!holds(value, byte)) {
        char text[120];

        snprintf(text, sizeof text, "%s 0x%02X is 0x%02X, not kind %u place 0x%02X number 0x%X",
                 what, which, byte, value.kind, value.place, value.number);
        TEST_FAIL_MESSAGE(text);
    }
}

/* All that is known holds. */
static void check_all(void)
{
    int depth = values_depth(&values);

    for (int i = 0; i < VALUES_BYTES; i++) {
        if (values.byte[i].kind != VALUE_ANY) {
            check_value(values.byte[i], byte_of_chip(i), "byte", i);
        }
    }
    for (int i = 0; i <= depth && i < VALUES_SLOTS; i++) {
        check_value(values.slot[i], mcs52_ram(chip)[(STACK + i) & 0xFF], "slot", i);
    }
    for (int i = depth + 1; depth >= 0 && i < VALUES_SLOTS; i++) {
        TEST_ASSERT_EQUAL_UINT8(VALUE_ANY, values.slot[i].kind);
    }
    check_value(values.carry, byte_of_chip(PSW) >> 7, "carry", 0);
}

/* A chip and a function's entry, of chance. */
static void begin(void)
{
    if (chip == NULL) {
        chip = mcs52_create(MCS52_INTEL, NULL);
        TEST_ASSERT_NOT_NULL(chip);
        mcs52_load(chip, 0, code, sizeof code);
    }
    for (int i = 0; i < MCS52_RAM_BYTES; i++) {
        mcs52_ram(chip)[i] = (uint8_t)chance(0x100);
    }
    for (int i = 0; i < 4; i++) {
        static const uint8_t followed[] = {DPL, DPH, ACC, B};

        mcs52_poke(chip, followed[i], (uint8_t)chance(0x100));
    }
    mcs52_poke(chip, PSW, (uint8_t)chance(0x100) & 0xE7);
    mcs52_poke(chip, SP, STACK);
    for (int i = 0; i < VALUES_BYTES; i++) {
        entry[i] = byte_of_chip(i);
    }
    values_enter(&values, &world);
}

/* Takes the instruction at ADDRESS in both. Of a branch, the way that the chip goes must be one of
 * those that it may go. Returns how many it may go. */
static int step_both(uint16_t address)
{
    struct instruction it = opcode_decode(code, address);
    uint16_t next = (uint16_t)(address + it.bytes);
    bool may_go_on = false, may_jump = false;

    mcs52_load(chip, address, &code[address], it.bytes);
    mcs52_jump(chip, address);
    mcs52_step(chip);
    values_step(&values, &world, address);
    if (it.course == COURSE_BRANCH) {
        values_branch(&values, &world, address, &may_go_on, &may_jump);
        TEST_ASSERT_TRUE(mcs52_pc(chip) == next ? may_go_on : may_jump);
    }
    return may_go_on + may_jump;
}

static uint8_t pick(const uint8_t *from, size_t count)
{
    return from[chance((unsigned)count)];
}
#define PICK(...) pick((const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))

/* Instructions that are no jump, call or return, nor 0xA5. */
static bool is_tried(uint8_t opcode)
{
    return (opcode & 15) != 1 && opcode != 0x02 && opcode != 0x12 && opcode != 0x22 &&
           opcode != 0x32 && opcode != 0x73 && opcode != 0xA5;
}

static bool writes_indirect(uint8_t opcode)
{
    uint8_t row = opcode >> 4;

    return (opcode & 14) == 6 &&
           (row <= 1 || row == 7 || row == 0xA || row == 0xC || row == 0xD || row == 0xF);
}

static bool has_bit(uint8_t opcode)
{
    switch (opcode) {
    case 0x10:
    case 0x20:
    case 0x30:
    case 0x72:
    case 0x82:
    case 0x92:
    case 0xA0:
    case 0xA2:
    case 0xB0:
    case 0xB2:
    case 0xC2:
    case 0xD2:
        return true;
    default:
        return false;
    }
}

static bool has_direct(uint8_t opcode)
{
    switch (opcode) {
    case 0x42:
    case 0x43:
    case 0x52:
    case 0x53:
    case 0x62:
    case 0x63:
    case 0xC0:
    case 0xD0:
        return true;
    default: /* the rows of operands; mov direct,x and mov x,direct */
        return (opcode & 15) == 5 ||
               ((opcode >> 4 == 8 || opcode >> 4 == 0xA) && (opcode & 15) > 5);
    }
}

/* Puts OPCODE with operands to ADDRESS; direct ones by draw_direct, bits in those bytes. */
static void put_drawn(uint16_t address, uint8_t opcode, uint8_t (*draw_direct)(void))
{
    uint8_t bytes[3];

    for (int i = 0; i < 2; i++) {
        bytes[i] = chance(2) ? (uint8_t)chance(0x100) : PICK(0, 1, 8, 0x10, 0x30, 0x7F, 0x80, 0xFF);
    }
    if (has_direct(opcode)) {
        bytes[0] = draw_direct();
    }
    if (opcode == 0x85) {
        bytes[1] = draw_direct();
    }
    if (has_bit(opcode)) {
        uint8_t byte = PICK(0x20, 0x21, 0x2F, ACC, B, P1, PSW);

        bytes[0] = (uint8_t)((byte < RAM ? (byte - 0x20) * 8 : byte) + (int)chance(8));
    }
    code[address] = opcode;
    code[address + 1] = bytes[0];
    code[address + 2] = bytes[1];
    code[address + opcode_decode(code, address).bytes - 1] |=
        opcode_decode(code, address).course == COURSE_BRANCH; /* it jumps to elsewhere */
}

/* Makes all that is followed known; R0 and R1 point to RAM, beside the registers. */
static void know_all(void)
{
    uint8_t first = (uint8_t)(chance(4) * 8);

    mcs52_poke(chip, PSW, (uint8_t)((byte_of_chip(PSW) & 0xE7) | first));
    mcs52_ram(chip)[first] = (uint8_t)(0x20 + chance(0x60));
    mcs52_ram(chip)[first + 1] = (uint8_t)(0x20 + chance(0x60));
    mcs52_poke(chip, SP, STACK + 3);
    for (int i = 0; i < VALUES_BYTES; i++) {
        if (values.byte[i].kind == VALUE_ENTRY) {
            values.byte[i] = number(byte_of_chip(i));
        }
    }
    values.byte[PSW] = bank(first);
    values.byte[SP] = at_entry(SP, 3);
    values.carry = number(byte_of_chip(PSW) >> 7);
    for (int i = 1; i <= 3; i++) {
        values.slot[i] = number(mcs52_ram(chip)[STACK + i]);
    }
}

static uint8_t draw_known(void)
{
    return PICK(0x00, 0x01, 0x07, 0x09, 0x1F, 0x20, 0x30, 0x7F, ACC, B, DPL, DPH);
}

/* The bits of a port belong to the hardware; of the PSW only carry and bank are followed. */
static bool is_bit_unknown(uint8_t bit)
{
    return (bit & 0xF8) == P1 || ((bit & 0xF8) == PSW && bit != PSW + 7);
}

/* What an instruction leaves unknown of known operands: the result of a division, of da and of
 * xchd, what comes from external RAM or code, and the bank when one of its bits is written. */
static bool leaves_unknown(const uint8_t *bytes, int byte)
{
    switch (bytes[0]) {
    case 0x84:
        return byte == ACC || byte == B;
    case 0x83:
    case 0x93:
    case 0xD4:
    case 0xE0:
    case 0xE2:
    case 0xE3:
        return byte == ACC;
    case 0xD6:
    case 0xD7:
        return byte == ACC || byte == mcs52_ram(chip)[(byte_of_chip(PSW) & 0x18) + (bytes[0] & 1)];
    case 0x10:
    case 0x92:
    case 0xB2:
    case 0xC2:
    case 0xD2:
        return byte == PSW && (bytes[1] == PSW + 3 || bytes[1] == PSW + 4);
    default:
        return false;
    }
}

static bool leaves_carry_unknown(const uint8_t *bytes)
{
    switch (bytes[0]) {
    case 0x72: /* orl c, anl c */
    case 0x82:
    case 0xA0:
    case 0xB0:
    case 0xD4:
        return true;
    default:
        return bytes[0] == 0xA2 && is_bit_unknown(bytes[1]);
    }
}

static bool is_followed(int byte)
{
    return byte < RAM || byte == DPL || byte == DPH || byte == PSW || byte == ACC || byte == B;
}

/* One instruction with all operands known. */
static void check_known(uint8_t opcode)
{
    const uint8_t *bytes = &code[AT];
    int ways;

    begin();
    know_all();
    code[AT - 2] = 0;
    put_drawn(AT, opcode, draw_known);
    ways = step_both(AT);
    check_all();
    for (int i = 0; i < VALUES_BYTES; i++) {
        int kind = is_followed(i) && !leaves_unknown(bytes, i) ? VALUE_CONST : VALUE_ANY;

        if (i != SP && !(i == ACC && (opcode == 0x83 || opcode == 0x93))) {
            TEST_ASSERT_EQUAL_INT_MESSAGE(kind, values.byte[i].kind, "what is known of a byte");
        }
    }
    for (int i = 1; i <= values_depth(&values); i++) {
        TEST_ASSERT_EQUAL_INT(VALUE_CONST, values.slot[i].kind);
    }
    TEST_ASSERT_EQUAL_INT(opcode == 0xC0 ? 4 : opcode == 0xD0 ? 2 : 3, values_depth(&values));
    TEST_ASSERT_EQUAL_INT(leaves_carry_unknown(bytes) ? VALUE_ANY : VALUE_CONST, values.carry.kind);
    if (opcode_decode(code, AT).course == COURSE_BRANCH) {
        bool is_unknown = opcode == 0x10 || (has_bit(opcode) && is_bit_unknown(bytes[1]));

        TEST_ASSERT_EQUAL_INT_MESSAGE(is_unknown ? 2 : 1, ways, "ways of a branch");
    }
}

static void test_known_operands_give_the_results_of_the_simulator(void)
{
    for (int opcode = 0; opcode < 0x100; opcode++) {
        for (int draw = 0; draw < DRAWS && is_tried((uint8_t)opcode); draw++) {
            check_known((uint8_t)opcode);
        }
    }
}

/* --- programs of chance --------------------------------------------------------------------- */

static uint8_t draw_any(void)
{
    return PICK(0x00, 0x01, 0x02, 0x07, 0x08, 0x09, 0x10, 0x1F, 0x20, 0x30, SHARED, 0x7F, ACC, ACC,
                B, DPL, DPH, PSW, SP, P0, UNUSED, FRAME_POINTER);
}

/* Whether the instruction writes to where no pointer of C does: to the registers, to what has been
 * pushed, to the frame pointer, or from the stack into direct RAM. */
static bool is_wild(uint8_t opcode)
{
    int first = byte_of_chip(PSW) & 0x18, n = first + (opcode & 1);
    uint8_t to = mcs52_ram(chip)[n], sp = byte_of_chip(SP);
    struct value pointer = values.byte[PSW].kind == VALUE_ANY ? any : values.byte[n];
    bool is_of_stack = pointer.kind == VALUE_ENTRY && pointer.place == SP;

    if (!writes_indirect(opcode)) {
        return false;
    }
    if (is_of_stack) {
        return to < RAM;
    }
    return (to > STACK && to <= sp) ||
           (pointer.kind != VALUE_CONST &&
            (to < 8 || (to >= first && to < first + 8) || to == FRAME_POINTER));
}

/* The next instruction at ADDRESS: often one that makes something known. */
static void draw_instruction(uint16_t address)
{
    uint8_t opcode;

    do {
        opcode = chance(3) ? (uint8_t)chance(0x100)
                           : PICK(0x74, 0x75, 0x78, 0x79, 0x7F, 0xC3, 0xD3, 0x90, 0xE4, 0xC0, 0xD0,
                                  0xA8, 0xE5, 0x15);
    } while (!is_tried(opcode) || is_wild(opcode) ||
             (opcode == 0x83 && code[address - 2] == 0x24)); /* see the tables below */
    put_drawn(address, opcode, draw_any);
}

/* What others do at any time: interrupts write to the byte that they share, and beyond the stack
 * pointer. */
static void disturb(void)
{
    mcs52_ram(chip)[SHARED] = (uint8_t)chance(0x100);
    for (int i = byte_of_chip(SP) + 1; i < MCS52_RAM_BYTES; i++) {
        mcs52_ram(chip)[i] = (uint8_t)chance(0x100);
    }
}

/* Returns how many instructions it has. */
static int walk(void)
{
    uint16_t address = AT;
    int length = 0;

    begin();
    while (length < WALK_LENGTH && values_depth(&values) >= 0 &&
           values_depth(&values) <= VALUES_DEPTH_MAX) {
        disturb();
        draw_instruction(address);
        step_both(address);
        check_all();
        address = (uint16_t)(address + opcode_decode(code, address).bytes);
        length++;
    }
    return length;
}

static void test_what_is_known_along_a_program_of_chance_holds(void)
{
    int taken = 0;

    world.is_shared[SHARED] = true;
    world.frame_pointer = FRAME_POINTER;
    for (int i = 0; i < WALKS; i++) {
        taken += walk();
    }
    TEST_ASSERT_GREATER_THAN_INT(10 * WALKS, taken);
}

/* --- by hand: part of the operands is known ------------------------------------------------- */

static void put(uint16_t address, const uint8_t *bytes, size_t count)
{
    memcpy(&code[address], bytes, count);
}
#define PUT(address, ...)                                                                          \
    put(address, (const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))

/* Takes one instruction of these bytes. */
#define STEP(...) (PUT(AT, __VA_ARGS__), values_step(&values, &world, AT))

static void expect(struct value expected, struct value value, int line)
{
    UNITY_TEST_ASSERT_EQUAL_UINT(expected.kind, value.kind, (UNITY_LINE_TYPE)line, "kind");
    UNITY_TEST_ASSERT_EQUAL_HEX16(expected.place, value.place, (UNITY_LINE_TYPE)line, "place");
    UNITY_TEST_ASSERT_EQUAL_HEX16(expected.number, value.number, (UNITY_LINE_TYPE)line, "number");
}
#define EXPECT(expected, value) expect(expected, value, __LINE__)

/* A function's entry, with what is known of the accumulator and of the carry. */
static void enter(struct value a, struct value carry)
{
    values_enter(&values, &world);
    values.byte[ACC] = a;
    values.carry = carry;
}

#define EXPECT_A(of_a, of_carry) (EXPECT(of_a, values.byte[ACC]), EXPECT(of_carry, values.carry))

static void test_the_entry_of_a_function(void)
{
    world.is_shared[SHARED] = world.is_shared[B] = true;
    memset(&values, 0, sizeof values);
    values_enter(&values, &world);
    for (int i = 0; i < VALUES_BYTES; i++) {
        bool is_known = (is_followed(i) || i == SP) && i != SHARED && i != B;

        EXPECT(is_known ? at_entry((unsigned)i, 0) : any, values.byte[i]);
    }
    for (int i = 0; i < VALUES_SLOTS; i++) {
        EXPECT(any, values.slot[i]);
    }
    EXPECT(any, values.carry);
    TEST_ASSERT_EQUAL_INT(0, values_depth(&values));
}

static void test_a_constant_is_added_to_what_was_at_the_entry(void)
{
    enter(at_entry(7, 2), number(1));
    STEP(0x24, 0xFF); /* add a,#255 */
    EXPECT_A(at_entry(7, 1), any);
    enter(at_entry(7, 2), number(1));
    STEP(0x34, 5); /* addc a,#5 */
    EXPECT_A(at_entry(7, 8), any);
    enter(number(3), number(1));
    STEP(0x2F); /* add a,r7 */
    EXPECT_A(at_entry(7, 3), any);
    enter(number(3), number(1));
    STEP(0x3F); /* addc a,r7 */
    EXPECT_A(at_entry(7, 4), any);
    enter(at_entry(7, 0), number(0));
    STEP(0x2E); /* add a,r6 */
    EXPECT_A(any, any);
    enter(any, number(0));
    STEP(0x24, 5);
    EXPECT_A(any, any);
    enter(number(5), any);
    STEP(0x34, 5);
    EXPECT_A(any, any);
    enter(number(5), any);
    STEP(0x24, 5); /* add does not ask for the carry */
    EXPECT_A(number(10), number(0));
}

static void test_a_constant_is_subtracted_from_what_was_at_the_entry(void)
{
    enter(at_entry(7, 2), number(0));
    STEP(0x94, 5); /* subb a,#5 */
    EXPECT_A(at_entry(7, 0xFD), any);
    enter(at_entry(7, 2), number(1));
    STEP(0x94, 5);
    EXPECT_A(at_entry(7, 0xFC), any);
    enter(number(9), number(0));
    STEP(0x9F); /* subb a,r7 */
    EXPECT_A(any, any);
    enter(number(9), any);
    STEP(0x94, 5);
    EXPECT_A(any, any);
    enter(number(5), number(0));
    STEP(0x94, 5);
    EXPECT_A(number(0), number(0));
    enter(number(5), number(1));
    STEP(0x94, 5);
    EXPECT_A(number(0xFF), number(1));
}

static void test_what_was_at_the_entry_is_counted_up_and_down(void)
{
    enter(at_entry(7, 0xFF), number(1));
    STEP(0x04); /* inc a */
    EXPECT_A(at_entry(7, 0), number(1));
    STEP(0x14); /* dec a */
    EXPECT_A(at_entry(7, 0xFF), number(1));
    STEP(0x0F); /* inc r7 */
    EXPECT(at_entry(7, 1), values.byte[7]);
    STEP(0x15, 0x30); /* dec 0x30 */
    EXPECT(at_entry(0x30, 0xFF), values.byte[0x30]);
    STEP(0xDF, 0); /* djnz r7 */
    EXPECT(at_entry(7, 0), values.byte[7]);
    STEP(0xD5, 0x30, 0); /* djnz 0x30 */
    EXPECT(at_entry(0x30, 0xFE), values.byte[0x30]);
    STEP(0xCF); /* xch a,r7 */
    EXPECT_A(at_entry(7, 0), number(1));
    EXPECT(at_entry(7, 0xFF), values.byte[7]);
    enter(table(0x200), any);
    STEP(0x04);
    EXPECT_A(any, any);
}

static void test_what_is_unknown_makes_the_result_unknown(void)
{
    static const uint8_t of_a[] = {0x03, 0x13, 0x23, 0x33, 0xC4, 0xF4};

    for (size_t i = 0; i < sizeof of_a; i++) {
        bool is_through = of_a[i] == 0x13 || of_a[i] == 0x33; /* rrc, rlc */

        enter(at_entry(ACC, 0), number(1));
        STEP(of_a[i]);
        EXPECT_A(any, is_through ? any : number(1));
        enter(number(0x81), any);
        STEP(of_a[i]);
        EXPECT(any, values.carry);
        TEST_ASSERT_EQUAL_INT(is_through ? VALUE_ANY : VALUE_CONST, values.byte[ACC].kind);
    }
    for (int known = 0; known < 2; known++) {
        enter(known ? number(5) : any, number(1));
        values.byte[B] = known ? any : number(5);
        STEP(0xA4); /* mul */
        EXPECT_A(any, number(0));
        EXPECT(any, values.byte[B]);
    }
    for (uint8_t row = 4; row <= 6; row++) {
        enter(at_entry(ACC, 0), any);
        STEP((uint8_t)(row << 4 | 4), 5); /* orl, anl, xrl a,#5 */
        EXPECT_A(any, any);
        enter(number(5), any);
        STEP((uint8_t)(row << 4 | 15)); /* a,r7 */
        EXPECT_A(any, any);
        enter(any, any);
        STEP((uint8_t)(row << 4 | 4), 0);
        EXPECT_A(row == 5 ? number(0) : any, any);
        enter(number(0), any);
        STEP((uint8_t)(row << 4 | 15));
        EXPECT_A(row == 5 ? number(0) : any, any);
    }
}

static void test_a_comparison_with_the_unknown_tells_nothing(void)
{
    bool may_go_on, may_jump;

    for (int known = 0; known < 3; known++) {
        enter(known ? number(5) : any, number(1));
        values.byte[0x30] = known == 1 ? any : number(5);
        STEP(0xB5, 0x30, 1); /* cjne a,0x30 */
        EXPECT(known == 2 ? number(0) : any, values.carry);
        values_branch(&values, &world, AT, &may_go_on, &may_jump);
        TEST_ASSERT_TRUE(may_go_on);
        TEST_ASSERT_EQUAL_INT(known != 2, may_jump);
    }
    enter(any, number(1));
    STEP(0xBF, 5, 1); /* cjne r7,#5 */
    EXPECT(any, values.carry);
}

static void test_branches_on_the_unknown_go_both_ways(void)
{
    static const uint8_t branches[][3] = {{0x10, 0x07}, {0x20, 0x07}, {0x30, 0x07}, {0x40},
                                          {0x50},       {0x60},       {0x70},       {0xD5, 0x30},
                                          {0xDF},       {0xB4, 5},    {0xB5, 0x30}, {0xBF, 5},
                                          {0xB6, 5},    {0xB7, 5},    {0xD5, PSW}};

    for (size_t i = 0; i < sizeof branches / sizeof branches[0]; i++) {
        bool may_go_on = false, may_jump = false;

        enter(any, any);
        put(AT, branches[i], 3);
        values_step(&values, &world, AT);
        values_branch(&values, &world, AT, &may_go_on, &may_jump);
        TEST_ASSERT_TRUE(may_go_on);
        TEST_ASSERT_TRUE(may_jump);
    }
}

static void test_unknown_bits(void)
{
    enter(any, number(1));
    STEP(0xD2, 0x09); /* setb 0x21.1 */
    EXPECT(any, values.byte[0x21]);
    values.byte[0x21] = number(0xFF);
    STEP(0xC2, 0x09);
    EXPECT(number(0xFD), values.byte[0x21]);
    values.carry = any;
    STEP(0x92, 0x0A); /* mov 0x21.2,c */
    EXPECT(any, values.byte[0x21]);
    STEP(0xC3);
    STEP(0xA2, 0x0A); /* mov c,0x21.2 */
    EXPECT(any, values.carry);
    STEP(0xB3); /* cpl c */
    EXPECT(any, values.carry);
    STEP(0xB2, 0x0A); /* cpl 0x21.2 */
    EXPECT(any, values.byte[0x21]);
    values.byte[0x2F] = number(0);
    STEP(0xD2, 0x7F); /* the last bit of RAM, and the first one of a port */
    EXPECT(number(0x80), values.byte[0x2F]);
    STEP(0xD2, 0x80);
    EXPECT(any, values.byte[P0]);
    EXPECT(at_entry(0x30, 0), values.byte[0x30]);
}

/* --- by hand: banks of registers ------------------------------------------------------------ */

static void test_the_bits_of_the_bank_are_followed(void)
{
    for (uint8_t bit = PSW; bit < PSW + 8; bit++) {
        bool is_of_bank = bit == PSW + 3 || bit == PSW + 4;

        enter(any, number(0));
        STEP(0xD2, bit); /* setb */
        EXPECT(is_of_bank ? any : at_entry(PSW, 0), values.byte[PSW]);
        EXPECT(number(bit == PSW + 7), values.carry);
        STEP(0xA2, bit); /* mov c,psw.n */
        EXPECT(bit == PSW + 7 ? number(1) : any, values.carry);
    }
    enter(any, number(0));
    STEP(0x75, PSW, 0xF7); /* mov psw,#0xF7 */
    EXPECT(bank(0x10), values.byte[PSW]);
    EXPECT(any, values.carry);
    STEP(0x7A, 5); /* mov r2,#5 */
    EXPECT(number(5), values.byte[0x12]);
    EXPECT(at_entry(2, 0), values.byte[2]);
    STEP(0xEA); /* mov a,r2 */
    EXPECT(number(5), values.byte[ACC]);
    STEP(0x43, PSW, 8); /* orl psw,#8 */
    EXPECT(any, values.byte[PSW]);
}

static void test_in_an_unknown_bank_each_register_may_be_written(void)
{
    for (unsigned n = 0; n < 8; n++) {
        enter(any, any);
        STEP(0xF5, PSW); /* mov psw,a */
        STEP((uint8_t)(0x78 + n), 5);
        for (unsigned i = 0; i < 0x30; i++) {
            EXPECT(i < 0x20 && i % 8 == n ? any : at_entry(i, 0), values.byte[i]);
        }
        STEP((uint8_t)(0xE8 + n)); /* mov a,rn */
        EXPECT(any, values.byte[ACC]);
    }
    enter(at_entry(7, 0), any);
    STEP(0xF5, PSW); /* what r7 was is no bank either */
    EXPECT(any, values.byte[PSW]);
}

/* push psw; mov psw,#8; pop psw, and pop acc */
static void test_the_psw_comes_back_from_the_stack_with_its_bank_alone(void)
{
    enter(any, number(1));
    STEP(0xC0, PSW);
    STEP(0x75, PSW, 8);
    STEP(0xC0, PSW);
    EXPECT(at_entry(PSW, 0), values.slot[1]);
    EXPECT(bank(8), values.slot[2]);
    STEP(0xD0, PSW);
    EXPECT(bank(8), values.byte[PSW]);
    STEP(0xD0, PSW);
    EXPECT(at_entry(PSW, 0), values.byte[PSW]);
    EXPECT(any, values.carry);
    STEP(0xC0, PSW);
    STEP(0xD0, ACC);
    EXPECT(any, values.byte[ACC]);
    STEP(0x74, 0xFF);
    STEP(0xC0, ACC);
    STEP(0xD0, PSW);
    EXPECT(bank(0x18), values.byte[PSW]);
}

/* --- by hand: pointers ---------------------------------------------------------------------- */

static void test_an_unknown_pointer_spares_registers_and_the_frame_pointer(void)
{
    static const int first_of[] = {0, 8, 0x10, 0x18, -1};

    world.frame_pointer = FRAME_POINTER;
    for (int i = 0; i < 5; i++) {
        int first = first_of[i];

        enter(number(1), any);
        values.byte[PSW] = first < 0 ? any : bank((unsigned)first);
        values.slot[1] = number(4);
        values.slot[127] = number(5);
        STEP(0xF7); /* mov @r1,a */
        for (int at = 0; at < VALUES_BYTES; at++) {
            bool is_spared =
                at < 8 || at == FRAME_POINTER || (first >= 0 && at >= first && at < first + 8);

            if (at < RAM) {
                EXPECT(is_spared ? at_entry((unsigned)at, 0) : any, values.byte[at]);
            }
        }
        EXPECT(number(1), values.byte[ACC]);
        EXPECT(at_entry(SP, 0), values.byte[SP]);
        EXPECT(at_entry(DPL, 0), values.byte[DPL]);
    }
}

static void test_a_known_pointer_writes_one_byte(void)
{
    static const uint8_t pointers[] = {0, 0x30, 0x7F, 0x80, 0xFF};

    for (size_t i = 0; i < sizeof pointers; i++) {
        struct values before;
        uint8_t to = pointers[i];

        enter(number(0x55), any);
        values.byte[0] = number(to);
        before = values;
        STEP(0xF6); /* mov @r0,a */
        if (to < RAM) {
            before.byte[to] = number(0x55);
        }
        TEST_ASSERT_TRUE(values_equal(&before, &values));
        values.byte[ACC] = any;
        STEP(0xE6); /* mov a,@r0 */
        EXPECT(to >= RAM ? any : to == 0 ? at_entry(0x55, 0) : number(0x55), values.byte[ACC]);
    }
}

/* mov r0,sp; inc r0: a pointer to the function's own bytes on the stack */
static void test_a_pointer_to_the_stack_writes_one_byte_of_it(void)
{
    static const uint16_t offsets[] = {0, 1, 2, 127, 128, 255};

    for (size_t i = 0; i < sizeof offsets / sizeof offsets[0]; i++) {
        struct values before;

        enter(number(1), number(0));
        values.byte[SP] = at_entry(SP, 100);
        values.byte[0] = at_entry(SP, offsets[i]);
        for (int slot = 1; slot < VALUES_SLOTS; slot++) {
            values.slot[slot] = number(9);
        }
        before = values;
        STEP(0xF6);
        if (offsets[i] < VALUES_SLOTS) {
            before.slot[offsets[i]] = any;
        }
        TEST_ASSERT_TRUE(values_equal(&before, &values));
        STEP(0xE6);
        EXPECT(any, values.byte[ACC]);
    }
    enter(number(1), any);
    values.byte[0] = at_entry(7, 1); /* which is no address of the stack */
    STEP(0xF6);
    EXPECT(any, values.byte[0x7F]);
}

/* --- by hand: the stack --------------------------------------------------------------------- */

static void test_the_depth_of_the_stack(void)
{
    enter(any, any);
    values.byte[SP] = at_entry(SP, 0xBF);
    TEST_ASSERT_EQUAL_INT(0xBF, values_depth(&values));
    values.byte[SP] = at_entry(SP, 0xC0);
    TEST_ASSERT_EQUAL_INT(-0x40, values_depth(&values));
    values.byte[SP] = at_entry(7, 0);
    TEST_ASSERT_EQUAL_INT(VALUES_LOST, values_depth(&values));
    values.byte[SP] = number(0x30);
    TEST_ASSERT_EQUAL_INT(VALUES_LOST, values_depth(&values));
    enter(any, any);
    STEP(0xD0, ACC); /* pop what is not there */
    TEST_ASSERT_EQUAL_INT(-1, values_depth(&values));
    EXPECT(any, values.byte[ACC]);
}

static void test_bytes_beyond_the_stack_pointer_are_forgotten(void)
{
    for (int kind = 0; kind < 4; kind++) {
        static const uint8_t back[][3] = {
            {0x15, SP}, {0xD0, B}, {0x75, SP, 0x40}, {0x22}}; /* dec sp; pop; mov sp; ret */
        int left[] = {1, 1, 0, 0};

        enter(number(7), any);
        STEP(0xC0, ACC);
        STEP(0xC0, ACC);
        EXPECT(number(7), values.slot[1]);
        EXPECT(number(7), values.slot[2]);
        put(AT, back[kind], 3);
        values_step(&values, &world, AT);
        EXPECT(left[kind] == 1 ? number(7) : any, values.slot[1]);
        EXPECT(any, values.slot[2]);
        TEST_ASSERT_EQUAL_INT(kind == 2 ? VALUES_LOST : left[kind], values_depth(&values));
    }
}

static void test_the_deepest_push(void)
{
    enter(number(7), any);
    values.byte[SP] = at_entry(SP, VALUES_DEPTH_MAX);
    STEP(0xC0, ACC);
    EXPECT(number(7), values.slot[VALUES_DEPTH_MAX + 1]);
    TEST_ASSERT_EQUAL_INT(VALUES_DEPTH_MAX + 1, values_depth(&values));
}

static void test_a_return_takes_an_address_of_the_functions_own(void)
{
    static const uint8_t returns[] = {0x22, 0x32};
    static const int left[] = {0, 1, 0, 1}; /* of so many bytes */

    for (int i = 0; i < 8; i++) {
        enter(number(7), any);
        values.byte[SP] = at_entry(SP, (unsigned)i % 4);
        STEP(returns[i / 4]);
        TEST_ASSERT_EQUAL_INT(left[i % 4], values_depth(&values));
        EXPECT(number(7), values.byte[ACC]);
    }
}

/* --- by hand: tables in code, the data pointer ---------------------------------------------- */

static void test_a_byte_of_a_table(void)
{
    static uint8_t from_0[20] = {0x24, 0x24, 0x83, 0x83, 0x83}; /* the code begins at the third */

    enter(any, any);
    PUT(AT - 2, 0x24, 0x10); /* add a,#0x10; movc a,@a+pc */
    STEP(0x83);
    EXPECT(table(AT + 0x11), values.byte[ACC]);
    PUT(AT - 2, 0x25, 0x10);
    STEP(0x83);
    EXPECT(any, values.byte[ACC]);
    PUT(AT - 1, 0x24);
    PUT(AT - 3, 0x24);
    STEP(0x83);
    EXPECT(any, values.byte[ACC]);
    STEP(0x93); /* movc a,@a+dptr */
    EXPECT(any, values.byte[ACC]);
    STEP(0x90, 0x12, 0x34);
    STEP(0x93);
    EXPECT(table(0x1234), values.byte[ACC]);
    world.code = &from_0[2];
    for (uint16_t address = 0; address < 2; address++) {
        values_step(&values, &world, address);
        EXPECT(any, values.byte[ACC]);
    }
    world.code = from_0;
    values_step(&values, &world, 2);
    EXPECT(table(3 + 0x24), values.byte[ACC]);
}

static void test_the_data_pointer_counts_in_two_bytes(void)
{
    enter(any, any);
    STEP(0x90, 0x12, 0xFF);
    STEP(0xA3); /* inc dptr */
    EXPECT(number(0x13), values.byte[DPH]);
    EXPECT(number(0x00), values.byte[DPL]);
    STEP(0x90, 0xFF, 0xFF);
    STEP(0xA3);
    EXPECT(number(0), values.byte[DPH]);
    EXPECT(number(0), values.byte[DPL]);
    for (int half = 0; half < 2; half++) {
        values.byte[DPH] = half ? any : number(1);
        values.byte[DPL] = half ? number(1) : any;
        STEP(0xA3);
        EXPECT(any, values.byte[DPH]);
        EXPECT(any, values.byte[DPL]);
    }
}

/* --- where paths meet, calls ---------------------------------------------------------------- */

/* The values of VALUES, one after another. */
static struct value *value_of(struct values *of, int i)
{
    return i < VALUES_BYTES                  ? &of->byte[i]
           : i < VALUES_BYTES + VALUES_SLOTS ? &of->slot[i - VALUES_BYTES]
                                             : &of->carry;
}

static void test_where_paths_meet_only_what_both_know_is_left(void)
{
    static const struct {
        struct value one, other, both;
        bool is_less;
    } cases[] = {
        {{VALUE_NONE, 0, 0}, {VALUE_CONST, 0, 5}, {VALUE_CONST, 0, 5}, true},
        {{VALUE_NONE, 0, 0}, {VALUE_NONE, 0, 0}, {VALUE_NONE, 0, 0}, false},
        {{VALUE_CONST, 0, 5}, {VALUE_NONE, 0, 0}, {VALUE_CONST, 0, 5}, false},
        {{VALUE_CONST, 0, 5}, {VALUE_CONST, 0, 5}, {VALUE_CONST, 0, 5}, false},
        {{VALUE_CONST, 0, 5}, {VALUE_CONST, 0, 6}, {VALUE_ANY, 0, 0}, true},
        {{VALUE_CONST, 0, 8}, {VALUE_CONST, PSW, 8}, {VALUE_ANY, 0, 0}, true},
        {{VALUE_CONST, 0, 5}, {VALUE_ENTRY, 0, 5}, {VALUE_ANY, 0, 0}, true},
        {{VALUE_ENTRY, 7, 5}, {VALUE_ENTRY, 6, 5}, {VALUE_ANY, 0, 0}, true},
        {{VALUE_ENTRY, 7, 5}, {VALUE_ENTRY, 7, 5}, {VALUE_ENTRY, 7, 5}, false},
        {{VALUE_CONST, 0, 5}, {VALUE_ANY, 0, 0}, {VALUE_ANY, 0, 0}, true},
        {{VALUE_ANY, 0, 0}, {VALUE_CONST, 0, 5}, {VALUE_ANY, 0, 0}, false},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int at = 0; at <= VALUES_BYTES + VALUES_SLOTS; at++) {
            struct values other;

            values_enter(&values, &world);
            other = values;
            *value_of(&values, at) = cases[i].one;
            *value_of(&other, at) = cases[i].other;
            TEST_ASSERT_EQUAL_INT(cases[i].both.kind == cases[i].other.kind &&
                                      !(cases[i].both.kind == VALUE_ANY && cases[i].is_less) &&
                                      memcmp(&cases[i].one, &cases[i].other, 4) == 0,
                                  values_equal(&values, &other));
            TEST_ASSERT_EQUAL_INT(cases[i].is_less, values_merge(&values, &other));
            EXPECT(cases[i].both, *value_of(&values, at));
        }
    }
}

static void test_a_call_leaves_what_its_callee_does_not_change(void)
{
    static bool is_changed[VALUES_BYTES + 1];
    struct values before;

    for (int i = 0; i < VALUES_BYTES; i++) {
        enter(number(1), number(0));
        before = values;
        is_changed[i] = true;
        values_return(&values, is_changed);
        is_changed[i] = false;
        before.byte[i] = before.carry = any;
        TEST_ASSERT_TRUE(values_equal(&before, &values));
    }
}

static void test_what_a_function_changes(void)
{
    static const struct value changed[] = {
        {VALUE_ENTRY, 7, 1}, {VALUE_ENTRY, 6, 0}, {VALUE_CONST, 7, 0}, {VALUE_ANY, 7, 0}};

    for (int i = 0; i < VALUES_BYTES; i++) {
        bool is_changed[VALUES_BYTES + 1] = {[3] = true};

        for (int at = 0; at < VALUES_BYTES; at++) {
            values.byte[at] = at_entry((unsigned)at, 0);
        }
        if (i > 0) {
            values.byte[i] = at_entry((unsigned)i, 1);
        }
        values_changed(&values, is_changed);
        for (int at = 0; at < VALUES_BYTES; at++) {
            bool is_expected = at == 3 || (at == i && i != 0 && i != SP);

            TEST_ASSERT_EQUAL_INT(is_expected, is_changed[at]);
        }
        TEST_ASSERT_FALSE(is_changed[VALUES_BYTES]); /* which is beyond its bytes */
    }
    for (int i = 0; i < 4; i++) {
        bool is_changed[VALUES_BYTES] = {false};

        values_enter(&values, &world);
        values.byte[7] = changed[i];
        values_changed(&values, is_changed);
        TEST_ASSERT_TRUE(is_changed[7]);
    }
}

/* --- jumps to what is known ----------------------------------------------------------------- */

static uint16_t room[VALUES_REPEATS + 2], *targets = &room[1];

/* The number of targets, which are all that is written. */
static int find_targets(bool is_return)
{
    int count;

    memset(room, 0xA5, sizeof room);
    count = values_targets(&values, &world, is_return, targets);
    TEST_ASSERT_EQUAL_HEX16(0xA5A5, targets[-1]);
    TEST_ASSERT_EQUAL_HEX16(0xA5A5, targets[count]);
    return count;
}

static void test_a_table_of_jumps(void)
{
    enter(any, any);
    STEP(0x90, 0x20, 0x00);
    PUT(0x2000, 0x02, 0x12, 0x34, 0x02, 0x00, 0x00, 0x01); /* ljmp; ljmp; ajmp */
    TEST_ASSERT_EQUAL_INT(2, find_targets(false));
    TEST_ASSERT_EQUAL_HEX16(0x2000, targets[0]);
    TEST_ASSERT_EQUAL_HEX16(0x2003, targets[1]);
    PUT(0x2000, 0xE1, 0x34, 0x01, 0x00, 0x02); /* ajmp; ajmp; ljmp */
    TEST_ASSERT_EQUAL_INT(2, find_targets(false));
    TEST_ASSERT_EQUAL_HEX16(0x2000, targets[0]);
    TEST_ASSERT_EQUAL_HEX16(0x2002, targets[1]);
    PUT(0x2000, 0x11, 0x34); /* acall */
    TEST_ASSERT_EQUAL_INT(0, find_targets(false));
    memset(&code[0x2000], 0x01, 0x200);
    TEST_ASSERT_EQUAL_INT(128, find_targets(false));
    memset(&code[0x2000], 0x02, 0x300);
    TEST_ASSERT_EQUAL_INT(85, find_targets(false));
    values.byte[DPH] = any;
    TEST_ASSERT_EQUAL_INT(0, find_targets(false));
}

static void test_a_jump_to_a_known_address(void)
{
    enter(number(3), any);
    STEP(0x90, 0x20, 0xFF);
    TEST_ASSERT_EQUAL_INT(1, find_targets(false));
    TEST_ASSERT_EQUAL_HEX16(0x2102, targets[0]);
    for (int half = 0; half < 2; half++) {
        values.byte[DPH] = half ? any : number(1);
        values.byte[DPL] = half ? number(1) : any;
        TEST_ASSERT_EQUAL_INT(0, find_targets(false));
    }
}

/* The low bytes of three addresses, then the high ones. */
static void test_a_jump_to_the_addresses_in_two_tables(void)
{
    PUT(0x2000, 0x34, 0x56, 0x78, 0x12, 0x13, 0x14, 0x15);
    enter(number(1), any);
    values.byte[DPL] = table(0x2000);
    values.byte[DPH] = table(0x2003);
    TEST_ASSERT_EQUAL_INT(3, find_targets(false));
    TEST_ASSERT_EQUAL_HEX16(0x1235, targets[0]);
    TEST_ASSERT_EQUAL_HEX16(0x1357, targets[1]);
    TEST_ASSERT_EQUAL_HEX16(0x1479, targets[2]);
    for (int is_return = 0; is_return < 2; is_return++) {
        static const struct {
            unsigned low, high;
            int count;
        } cases[] = {{0x2000, 0x2000, 0},
                     {0x2000, 0x2001, 1},
                     {0x2001, 0x2000, 0},
                     {0x2000, 0x2100, 256},
                     {0x2000, 0x2101, 0}};

        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
            enter(number(0), any);
            values.byte[SP] = at_entry(SP, 2);
            values.slot[1] = values.byte[DPL] = table(cases[i].low);
            values.slot[2] = values.byte[DPH] = table(cases[i].high);
            TEST_ASSERT_EQUAL_INT(cases[i].count, find_targets(is_return != 0));
        }
    }
    values.slot[1] = number(0x00);
    values.slot[2] = table(0x10);
    TEST_ASSERT_EQUAL_INT(0, find_targets(true));
    values.slot[1] = table(0x2000);
    values.slot[2] = (struct value){.kind = VALUE_ANY, .number = 0x2001};
    TEST_ASSERT_EQUAL_INT(0, find_targets(true));
}

static void test_a_return_to_a_pushed_address(void)
{
    enter(any, any);
    values.slot[0] = values.slot[1] = number(0x34);
    values.slot[2] = values.slot[3] = number(0x12);
    for (unsigned depth = 0; depth < 4; depth++) {
        values.byte[SP] = at_entry(SP, depth);
        TEST_ASSERT_EQUAL_INT(depth < 2 ? 0 : 1, find_targets(true));
        TEST_ASSERT_TRUE(depth < 2 || targets[0] == (depth == 2 ? 0x1234 : 0x1212));
    }
    values.byte[SP] = at_entry(SP, 2);
    values.slot[1] = any;
    TEST_ASSERT_EQUAL_INT(0, find_targets(true));
    values.slot[1] = number(0);
    values.slot[2] = any;
    TEST_ASSERT_EQUAL_INT(0, find_targets(true));
}

/* --- the frame pointer ---------------------------------------------------------------------- */

static void test_the_frame_pointer_is_what_begins_functions(void)
{
    static const struct {
        uint8_t bytes[6];
        int found;
    } cases[] = {
        {{0xC0, 0x09, 0x85, SP, 0x09}, 0x09},       /* push 9; mov 9,sp */
        {{0xC0, 0x7F, 0x85, SP, 0x7F}, 0x7F},       /* and the same of the last byte of RAM */
        {{0xC0, 0x0B, 0xE5, SP, 0xF5, 0x0B}, 0x0B}, /* push 11; mov a,sp; mov 11,a */
        {{0xC0, 0x80, 0x85, SP, 0x80}, -1},         /* a register of the hardware */
        {{0xC1, 0x09, 0x85, SP, 0x09}, -1},         /* and one byte of it otherwise */
        {{0xC0, 0x08, 0x85, SP, 0x09}, -1},         {{0xC0, 0x09, 0x86, SP, 0x09}, -1},
        {{0xC0, 0x09, 0x85, SP + 1, 0x09}, -1},     {{0xC0, 0x09, 0x85, SP, 0x08}, -1},
        {{0xC0, 0x09, 0xE6, SP, 0xF5, 0x09}, -1},   {{0xC0, 0x09, 0xE5, SP + 1, 0xF5, 0x09}, -1},
        {{0xC0, 0x09, 0xE5, SP, 0xF6, 0x09}, -1},   {{0xC0, 0x09, 0xE5, SP, 0xF5, 0x08}, -1},
    };
    static uint8_t more[0x10000 + 6]; /* what lies beside the code is none of it */
    static const int places[] = {-1, 0, 0x1234, 0xFFFA, 0xFFFB};

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int k = 0; k < 5; k++) {
            bool is_beside = places[k] < 0 || places[k] > 0xFFFA;

            memset(more, 0, sizeof more);
            memcpy(&more[1 + places[k]], cases[i].bytes, 6);
            memset(&world, 0xFF, sizeof world);
            values_world_init(&world, &more[1]);
            TEST_ASSERT_EQUAL_INT(is_beside ? -1 : cases[i].found, world.frame_pointer);
            TEST_ASSERT_FALSE(world.is_shared[0] || world.is_shared[VALUES_BYTES - 1]);
            TEST_ASSERT_EQUAL_PTR(&more[1], world.code);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_known_operands_give_the_results_of_the_simulator);
    RUN_TEST(test_what_is_known_along_a_program_of_chance_holds);
    RUN_TEST(test_the_entry_of_a_function);
    RUN_TEST(test_a_constant_is_added_to_what_was_at_the_entry);
    RUN_TEST(test_a_constant_is_subtracted_from_what_was_at_the_entry);
    RUN_TEST(test_what_was_at_the_entry_is_counted_up_and_down);
    RUN_TEST(test_what_is_unknown_makes_the_result_unknown);
    RUN_TEST(test_a_comparison_with_the_unknown_tells_nothing);
    RUN_TEST(test_branches_on_the_unknown_go_both_ways);
    RUN_TEST(test_unknown_bits);
    RUN_TEST(test_the_bits_of_the_bank_are_followed);
    RUN_TEST(test_in_an_unknown_bank_each_register_may_be_written);
    RUN_TEST(test_the_psw_comes_back_from_the_stack_with_its_bank_alone);
    RUN_TEST(test_an_unknown_pointer_spares_registers_and_the_frame_pointer);
    RUN_TEST(test_a_known_pointer_writes_one_byte);
    RUN_TEST(test_a_pointer_to_the_stack_writes_one_byte_of_it);
    RUN_TEST(test_the_depth_of_the_stack);
    RUN_TEST(test_bytes_beyond_the_stack_pointer_are_forgotten);
    RUN_TEST(test_the_deepest_push);
    RUN_TEST(test_a_return_takes_an_address_of_the_functions_own);
    RUN_TEST(test_a_byte_of_a_table);
    RUN_TEST(test_the_data_pointer_counts_in_two_bytes);
    RUN_TEST(test_where_paths_meet_only_what_both_know_is_left);
    RUN_TEST(test_a_call_leaves_what_its_callee_does_not_change);
    RUN_TEST(test_what_a_function_changes);
    RUN_TEST(test_a_table_of_jumps);
    RUN_TEST(test_a_jump_to_a_known_address);
    RUN_TEST(test_a_jump_to_the_addresses_in_two_tables);
    RUN_TEST(test_a_return_to_a_pushed_address);
    RUN_TEST(test_the_frame_pointer_is_what_begins_functions);
    return UNITY_END();
}
