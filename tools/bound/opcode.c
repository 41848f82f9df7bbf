/* SPDX-License-Identifier: MIT */
#include "opcode.h"

/* A character for each opcode 0x00..0xFF, 16 in a row; from Intel's manual. */
static const char bytes_of[16][17] = {
    "1231121111111111", "3231121111111111", "3211221111111111", "3211221111111111",
    "2223221111111111", "2223221111111111", "2223221111111111", "2221232222222222",
    "2221132222222222", "3221221111111111", "2221112222222222", "2221333333333333",
    "2221121111111111", "2221131122222222", "1211121111111111", "1211121111111111",
};
static const char cycles_of[16][17] = {
    "1221111111111111", "2221111111111111", "2221111111111111", "2221111111111111",
    "2212111111111111", "2212111111111111", "2212111111111111", "2222121111111111",
    "2222422222222222", "2222111111111111", "2212412222222222", "2211222222222222",
    "2211111111111111", "2211121122222222", "2222111111111111", "2222111111111111",
};

enum { SP = 0x81 };

static bool is_relative(uint8_t opcode)
{
    switch (opcode) {
    case 0x10: /* jbc */
    case 0x20: /* jb */
    case 0x30: /* jnb */
    case 0x40: /* jc */
    case 0x50: /* jnc */
    case 0x60: /* jz */
    case 0x70: /* jnz */
    case 0xD5: /* djnz direct */
        return true;
    default: /* cjne, djnz rN */
        return (opcode >= 0xB4 && opcode <= 0xBF) || (opcode >= 0xD8 && opcode <= 0xDF);
    }
}

/* Returns whether OPCODE, with these operands, writes the byte at the address DIRECT. */
static bool writes(const uint8_t *operands, uint8_t opcode, uint8_t direct)
{
    switch (opcode) {
    case 0x05: /* inc */
    case 0x15: /* dec */
    case 0x42: /* orl direct,a */
    case 0x43:
    case 0x52: /* anl */
    case 0x53:
    case 0x62: /* xrl */
    case 0x63:
    case 0x75: /* mov direct,#data */
    case 0xC5: /* xch */
    case 0xD0: /* pop */
    case 0xD5: /* djnz */
    case 0xF5: /* mov direct,a */
        return operands[0] == direct;
    case 0x85: /* mov direct,direct: the source comes first */
        return operands[1] == direct;
    default: /* mov direct,@rN; mov direct,rN */
        return opcode >= 0x86 && opcode <= 0x8F && operands[0] == direct;
    }
}

struct instruction opcode_decode(const uint8_t *code, uint16_t address)
{
    uint8_t opcode = code[address], first = code[(uint16_t)(address + 1)];
    uint8_t operands[2] = {first, code[(uint16_t)(address + 2)]};
    struct instruction it = {
        .bytes = (uint8_t)(bytes_of[opcode >> 4][opcode & 15] - '0'),
        .cycles = (uint8_t)(cycles_of[opcode >> 4][opcode & 15] - '0'),
        .writes_sp = writes(operands, opcode, SP),
    };
    uint16_t next = (uint16_t)(address + it.bytes);
    uint16_t absolute = (uint16_t)(first << 8 | operands[1]);

    if (is_relative(opcode) || opcode == 0x80) {
        it.course = opcode == 0x80 ? COURSE_JUMP : COURSE_BRANCH;
        it.target = (uint16_t)(next + (int8_t)code[(uint16_t)(next - 1)]);
    } else if ((opcode & 15) == 1) { /* ajmp and acall: 11 bits, within the next one's 2 KB */
        it.course = opcode & 0x10 ? COURSE_CALL : COURSE_JUMP;
        it.target = (uint16_t)((next & 0xF800) | (opcode & 0xE0) << 3 | first);
    } else if (opcode == 0x02 || opcode == 0x12) {
        it.course = opcode == 0x12 ? COURSE_CALL : COURSE_JUMP;
        it.target = absolute;
    } else if (opcode == 0x22 || opcode == 0x32) {
        it.course = COURSE_RETURN;
    } else if (opcode == 0x73) {
        it.course = COURSE_SWITCH;
    } else if (opcode == 0xA5) {
        it.course = COURSE_NONE;
    } else if (opcode == 0xC0) {
        it.push = 1;
    } else if (opcode == 0xD0) {
        it.push = -1;
    }
    return it;
}
