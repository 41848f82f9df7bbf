/* SPDX-License-Identifier: MIT */
/* Under test: tools/bound/opcode.c, every opcode against what the exact simulator does with it, and
 * against every listing that SDCC has written here. */
#include "bound/opcode.h"
#include "sim/mcs52.h"

#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

enum {
    P0 = 0x80,
    SP = 0x81,
    DPL = 0x82,
    DPH = 0x83,
    PSW = 0xD0,
    ACC = 0xE0,
    SP_BEFORE = 0x30,
    CODE_BYTES = 0x10000,
    TABLE = 0x1234, /* what DPTR holds */
    STATES = 12
};

static struct mcs52 *chip;
static uint8_t code[CODE_BYTES];

void setUp(void)
{
    memset(code, 0, sizeof code);
    chip = mcs52_create(MCS52_INTEL, NULL);
    TEST_ASSERT_NOT_NULL(chip);
}

void tearDown(void)
{
    mcs52_destroy(chip);
}

/* What one opcode has done so far. */
struct seen {
    bool jumped, went_on;
};

static const char *name_of(const uint8_t *bytes, uint16_t address)
{
    static char text[40];

    snprintf(text, sizeof text, "%02X %02X %02X at %04X", bytes[0], bytes[1], bytes[2], address);
    return text;
}

/* The chip before the instruction: RAM full of one value, with odd and even accumulator, carry and
 * pins. Some values make operands equal. */
static uint8_t prepare(int state, const uint8_t *bytes)
{
    const uint8_t fills[STATES / 2] = {0x00, 0x01, 0x55, 0xFF, bytes[1], bytes[2]};
    uint8_t fill = fills[state / 2];

    memset(mcs52_ram(chip), fill, MCS52_RAM_BYTES);
    mcs52_poke(chip, SP, SP_BEFORE);
    mcs52_poke(chip, DPL, TABLE & 0xFF);
    mcs52_poke(chip, DPH, TABLE >> 8);
    mcs52_poke(chip, PSW, state % 2 ? 0x80 : 0);
    mcs52_poke(chip, P0, fill);
    mcs52_poke(chip, ACC, state % 2 ? (uint8_t)~fill : fill);
    return fill;
}

/* The instruction goes where its course says. */
static void check_course(const struct instruction *it, uint16_t address, uint8_t fill, uint8_t a,
                         struct seen *seen, const char *name)
{
    uint16_t next = (uint16_t)(address + it->bytes), pc = mcs52_pc(chip);
    const uint8_t *pushed = &mcs52_ram(chip)[SP_BEFORE + 1];

    switch (it->course) {
    case COURSE_ON:
        TEST_ASSERT_EQUAL_HEX16_MESSAGE(next, pc, name);
        break;
    case COURSE_CALL:
        TEST_ASSERT_EQUAL_HEX16_MESSAGE(next, pushed[1] << 8 | pushed[0], name);
        TEST_ASSERT_EQUAL_HEX16_MESSAGE(it->target, pc, name);
        break;
    case COURSE_JUMP:
        TEST_ASSERT_EQUAL_HEX16_MESSAGE(it->target, pc, name);
        break;
    case COURSE_BRANCH:
        seen->jumped |= pc == it->target;
        seen->went_on |= pc == next;
        TEST_ASSERT_TRUE_MESSAGE(pc == it->target || pc == next, name);
        break;
    case COURSE_RETURN:
        TEST_ASSERT_EQUAL_HEX16_MESSAGE(fill << 8 | fill, pc, name);
        break;
    case COURSE_SWITCH:
        TEST_ASSERT_EQUAL_HEX16_MESSAGE(TABLE + a, pc, name);
        break;
    case COURSE_NONE:
        TEST_FAIL_MESSAGE(name);
        break;
    }
}

/* Runs the instruction BYTES at ADDRESS once in each state of the chip. */
static void check_at(uint16_t address, const uint8_t *bytes, struct seen *seen)
{
    const char *name = name_of(bytes, address);
    struct instruction it;
    int by_course;
    bool sets_sp = false;

    for (int i = 0; i < 3; i++) {
        code[(uint16_t)(address + i)] = bytes[i];
        mcs52_load(chip, (uint16_t)(address + i), &bytes[i], 1);
    }
    it = opcode_decode(code, address);
    by_course = it.course == COURSE_CALL ? 2 : it.course == COURSE_RETURN ? -2 : 0;
    for (int state = 0; state < STATES; state++) {
        uint8_t fill = prepare(state, bytes), a = mcs52_sfr(chip, ACC);
        uint64_t began = mcs52_cycles(chip);

        mcs52_jump(chip, address);
        mcs52_step(chip);
        TEST_ASSERT_EQUAL_INT_MESSAGE(it.cycles, mcs52_cycles(chip) - began, name);
        check_course(&it, address, fill, a, seen, name);
        sets_sp |= mcs52_sfr(chip, SP) != SP_BEFORE + it.push + by_course;
    }
    TEST_ASSERT_EQUAL_MESSAGE(it.writes_sp, sets_sp, name);
    for (int i = 0; i < 3; i++) {
        code[(uint16_t)(address + i)] = 0;
        mcs52_load(chip, (uint16_t)(address + i), &code[(uint16_t)(address + i)], 1);
    }
}

static void test_every_opcode_does_what_the_simulator_does(void)
{
    static const uint16_t addresses[] = {0x1234, 0x07FD, 0x07FE, 0x07FF, 0xFFFD, 0xFFFF};
    static const uint8_t operands[][2] = {{SP, 0x05},   {0x45, SP},   {0x28, 0x7F},
                                          {0x01, 0x80}, {0x55, 0xFB}, {0xFF, 0x10}};

    for (int opcode = 0; opcode < 256; opcode++) {
        struct seen seen = {0};
        bool is_branch;

        code[0] = (uint8_t)opcode;
        is_branch = opcode_decode(code, 0).course == COURSE_BRANCH;
        code[0] = 0;
        for (size_t i = 0; i < 6 * 6 && opcode != 0xA5; i++) {
            const uint8_t bytes[] = {(uint8_t)opcode, operands[i / 6][0], operands[i / 6][1]};

            check_at(addresses[i % 6], bytes, &seen);
        }
        TEST_ASSERT_EQUAL(is_branch, seen.jumped && seen.went_on);
    }
}

/* The length of what does not go on to the next instruction, and of what is no instruction. */
static void test_the_length_of_jumps_and_returns(void)
{
    for (int opcode = 0; opcode < 256; opcode++) {
        struct instruction it;

        code[0] = (uint8_t)opcode;
        it = opcode_decode(code, 0);
        TEST_ASSERT_EQUAL(opcode == 0xA5, it.course == COURSE_NONE);
        TEST_ASSERT_EQUAL(opcode == 0x73, it.course == COURSE_SWITCH);
        if (it.course == COURSE_JUMP) {
            TEST_ASSERT_EQUAL_INT(opcode == 0x02 ? 3 : 2, it.bytes);
        } else if (it.course >= COURSE_RETURN) {
            TEST_ASSERT_EQUAL_INT(1, it.bytes);
        }
    }
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
    RUN_TEST(test_every_opcode_does_what_the_simulator_does);
    RUN_TEST(test_the_length_of_jumps_and_returns);
    RUN_TEST(test_the_instruction_table_against_the_assemblers_own);
    return UNITY_END();
}
