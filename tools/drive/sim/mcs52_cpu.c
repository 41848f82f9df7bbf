/* SPDX-License-Identifier: MIT */
/* The processor: all instructions, by [I]'s instruction set. */
#include "mcs52_core.h"

/* Machine cycles of each instruction, from [I]'s summary of the instruction set. */
#define ROW(c0, c1, c2, c3, c4, c5, c67, c8_f)                                                     \
    c0, c1, c2, c3, c4, c5, c67, c67, c8_f, c8_f, c8_f, c8_f, c8_f, c8_f, c8_f, c8_f
const uint8_t mcs52_op_cycles[256] = {
    ROW(1, 2, 2, 1, 1, 1, 1, 1), /* 0x */
    ROW(2, 2, 2, 1, 1, 1, 1, 1), /* 1x */
    ROW(2, 2, 2, 1, 1, 1, 1, 1), /* 2x */
    ROW(2, 2, 2, 1, 1, 1, 1, 1), /* 3x */
    ROW(2, 2, 1, 2, 1, 1, 1, 1), /* 4x */
    ROW(2, 2, 1, 2, 1, 1, 1, 1), /* 5x */
    ROW(2, 2, 1, 2, 1, 1, 1, 1), /* 6x */
    ROW(2, 2, 2, 2, 1, 2, 1, 1), /* 7x */
    ROW(2, 2, 2, 2, 4, 2, 2, 2), /* 8x */
    ROW(2, 2, 2, 2, 1, 1, 1, 1), /* 9x */
    ROW(2, 2, 1, 2, 4, 1, 2, 2), /* Ax */
    ROW(2, 2, 1, 1, 2, 2, 2, 2), /* Bx */
    ROW(2, 2, 1, 1, 1, 1, 1, 1), /* Cx */
    ROW(2, 2, 1, 1, 1, 2, 1, 2), /* Dx */
    ROW(2, 2, 2, 2, 1, 1, 1, 1), /* Ex */
    ROW(2, 2, 2, 2, 1, 1, 1, 1), /* Fx */
};

/* Cases of the codes HIGH+4..HIGH+F: VALUE is the immediate, direct, indirect or register operand.
 */
#define WITH_OPERAND(high, action)                                                                 \
    case (high) + 4:                                                                               \
        value = p[1], x->pc += 2;                                                                  \
        action;                                                                                    \
        break;                                                                                     \
    case (high) + 5:                                                                               \
        value = get(x, p[1]), x->pc += 2;                                                          \
        action;                                                                                    \
        break;                                                                                     \
    case (high) + 6 ...(high) + 7:                                                                 \
        value = ram[x->r[op & 1]], x->pc += 1;                                                     \
        action;                                                                                    \
        break;                                                                                     \
    case (high) + 8 ...(high) + 15:                                                                \
        value = x->r[op & 7], x->pc += 1;                                                          \
        action;                                                                                    \
        break

/* Cases of the codes HIGH+2 and HIGH+3: a direct operand, changed by A or an immediate. */
#define ON_DIRECT(high, operator)                                                                  \
    case (high) + 2:                                                                               \
        x->pc += 2;                                                                                \
        put(x, p[1], get_latch(x, p[1]) operator x->a);                                            \
        break;                                                                                     \
    case (high) + 3:                                                                               \
        x->pc += 3;                                                                                \
        put(x, p[1], get_latch(x, p[1]) operator p[2]);                                            \
        break

/* Cases of the codes HIGH+4..HIGH+F: A, a direct, indirect or register operand becomes one more. */
#define STEP_BY(high, difference)                                                                  \
    case (high) + 4:                                                                               \
        x->pc += 1, x->a = (uint8_t)(x->a + (difference));                                         \
        break;                                                                                     \
    case (high) + 5:                                                                               \
        x->pc += 2;                                                                                \
        put(x, p[1], (uint8_t)(get_latch(x, p[1]) + (difference)));                                \
        break;                                                                                     \
    case (high) + 6 ...(high) + 7:                                                                 \
        x->pc += 1;                                                                                \
        ram[x->r[op & 1]] = (uint8_t)(ram[x->r[op & 1]] + (difference));                           \
        break;                                                                                     \
    case (high) + 8 ...(high) + 15:                                                                \
        x->pc += 1;                                                                                \
        x->r[op & 7] = (uint8_t)(x->r[op & 7] + (difference));                                     \
        break

/* The eight codes that differ in their upper three bits, which belong to an address in the page of
 * the next instruction. */
#define ALL_PAGES(low, jump)                                                                       \
    case (low):                                                                                    \
    case (low) + 0x20:                                                                             \
    case (low) + 0x40:                                                                             \
    case (low) + 0x60:                                                                             \
    case (low) + 0x80:                                                                             \
    case (low) + 0xA0:                                                                             \
    case (low) + 0xC0:                                                                             \
    case (low) + 0xE0:                                                                             \
        x->pc += 2;                                                                                \
        jump(x, (x->pc & 0xF800) | (op & 0xE0u) << 3 | p[1]);                                      \
        break

#define JUMP_IF(code, condition)                                                                   \
    case (code):                                                                                   \
        x->pc += 2;                                                                                \
        branch(x, (condition), p[1]);                                                              \
        break

INLINE void instruction(struct core *x)
{
    uint8_t *const ram = x->chip->ram, *const sfr = x->chip->sfr;
    const uint8_t *p = x->chip->code + (uint16_t)x->pc;
    const uint8_t op = p[0];
    uint8_t value;

    x->end = x->now + mcs52_op_cycles[op];
    switch (op) {
    case 0x00: /* NOP */
    case 0xA5: /* reserved */
        x->pc += 1;
        break;
        ALL_PAGES(0x01, jump); /* AJMP */
        ALL_PAGES(0x11, call); /* ACALL */
    case 0x02:                 /* LJMP */
        jump(x, (unsigned)p[1] << 8 | p[2]);
        break;
    case 0x12: /* LCALL */
        x->pc += 3;
        call(x, (unsigned)p[1] << 8 | p[2]);
        break;
    case 0x22: /* RET */
        ret(x);
        break;
    case 0x32: /* RETI */
        ret(x);
        mcs52_return(x->chip, x->end);
        break;
    case 0x73: /* JMP @A+DPTR */
        jump(x, dptr(x) + x->a);
        break;
    case 0x80: /* SJMP */
        x->pc += 2 + (unsigned)(int8_t)p[1];
        break;
        JUMP_IF(0x40, carry(x));  /* JC */
        JUMP_IF(0x50, !carry(x)); /* JNC */
        JUMP_IF(0x60, x->a == 0); /* JZ */
        JUMP_IF(0x70, x->a != 0); /* JNZ */
    case 0x10:                    /* JBC */
        x->pc += 3;
        value = get_latch(x, byte_of_bit(p[1]));
        if (value & mask_of_bit(p[1])) {
            put(x, byte_of_bit(p[1]), (uint8_t)(value & ~mask_of_bit(p[1])));
            branch(x, true, p[2]);
        }
        break;
    case 0x20: /* JB */
        x->pc += 3;
        branch(x, get_bit(x, p[1]), p[2]);
        break;
    case 0x30: /* JNB */
        x->pc += 3;
        branch(x, !get_bit(x, p[1]), p[2]);
        break;
    case 0xB4: /* CJNE A, #data */
        compare(x, x->a, p[1], p[2]);
        break;
    case 0xB5: /* CJNE A, direct */
        compare(x, x->a, get(x, p[1]), p[2]);
        break;
    case 0xB6 ... 0xB7: /* CJNE @Ri, #data */
        compare(x, ram[x->r[op & 1]], p[1], p[2]);
        break;
    case 0xB8 ... 0xBF: /* CJNE Rn, #data */
        compare(x, x->r[op & 7], p[1], p[2]);
        break;
    case 0xD5: /* DJNZ direct */
        x->pc += 3;
        value = (uint8_t)(get_latch(x, p[1]) - 1);
        put(x, p[1], value);
        branch(x, value != 0, p[2]);
        break;
    case 0xD8 ... 0xDF: /* DJNZ Rn */
        x->pc += 2;
        branch(x, --x->r[op & 7] != 0, p[1]);
        break;

    case 0x03: /* RR */
        x->pc += 1, x->a = (uint8_t)(x->a >> 1 | x->a << 7);
        break;
    case 0x13: /* RRC */
        x->pc += 1, value = (uint8_t)(x->a >> 1 | carry(x) << 7);
        set_carry(x, x->a & 1);
        x->a = value;
        break;
    case 0x23: /* RL */
        x->pc += 1, x->a = (uint8_t)(x->a << 1 | x->a >> 7);
        break;
    case 0x33: /* RLC */
        x->pc += 1, value = (uint8_t)(x->a << 1 | carry(x));
        set_carry(x, x->a >> 7);
        x->a = value;
        break;
        STEP_BY(0x00, 1);                            /* INC */
        STEP_BY(0x10, -1);                           /* DEC */
        WITH_OPERAND(0x20, add(x, value, 0));        /* ADD */
        WITH_OPERAND(0x30, add(x, value, carry(x))); /* ADDC */
        WITH_OPERAND(0x40, x->a |= value);           /* ORL */
        WITH_OPERAND(0x50, x->a &= value);           /* ANL */
        WITH_OPERAND(0x60, x->a ^= value);           /* XRL */
        WITH_OPERAND(0x90, subtract(x, value));      /* SUBB */
        ON_DIRECT(0x40, |);
        ON_DIRECT(0x50, &);
        ON_DIRECT(0x60, ^);
    case 0x84: /* DIV */
        x->pc += 1;
        divide(x);
        break;
    case 0xA4: /* MUL */
        x->pc += 1;
        multiply(x);
        break;
    case 0xA3: /* INC DPTR */
        x->pc += 1;
        sfr[DPH] = (uint8_t)(sfr[DPH] + (++sfr[DPL] == 0));
        break;
    case 0xC4: /* SWAP */
        x->pc += 1, x->a = (uint8_t)(x->a << 4 | x->a >> 4);
        break;
    case 0xD4: /* DA */
        x->pc += 1;
        decimal_adjust(x);
        break;
    case 0xE4: /* CLR A */
        x->pc += 1, x->a = 0;
        break;
    case 0xF4: /* CPL A */
        x->pc += 1, x->a = (uint8_t)~x->a;
        break;

    case 0x72: /* ORL C, bit */
        x->pc += 2;
        set_carry(x, get_bit(x, p[1]) | carry(x));
        break;
    case 0x82: /* ANL C, bit */
        x->pc += 2;
        set_carry(x, get_bit(x, p[1]) & carry(x));
        break;
    case 0xA0: /* ORL C, /bit */
        x->pc += 2;
        set_carry(x, (!get_bit(x, p[1])) | carry(x));
        break;
    case 0xB0: /* ANL C, /bit */
        x->pc += 2;
        set_carry(x, (!get_bit(x, p[1])) & carry(x));
        break;
    case 0xA2: /* MOV C, bit */
        x->pc += 2;
        set_carry(x, get_bit(x, p[1]));
        break;
    case 0x92: /* MOV bit, C */
        x->pc += 2;
        put_bit(x, p[1], carry(x));
        break;
    case 0xB2: /* CPL bit */
        x->pc += 2;
        put(x, byte_of_bit(p[1]), get_latch(x, byte_of_bit(p[1])) ^ mask_of_bit(p[1]));
        break;
    case 0xC2: /* CLR bit */
        x->pc += 2;
        put_bit(x, p[1], false);
        break;
    case 0xD2: /* SETB bit */
        x->pc += 2;
        put_bit(x, p[1], true);
        break;
    case 0xB3: /* CPL C */
        x->pc += 1, x->psw ^= PSW_CY;
        break;
    case 0xC3: /* CLR C */
        x->pc += 1;
        set_carry(x, false);
        break;
    case 0xD3: /* SETB C */
        x->pc += 1;
        set_carry(x, true);
        break;

    case 0x74: /* MOV A, #data */
        x->pc += 2, x->a = p[1];
        break;
    case 0x75: /* MOV direct, #data */
        x->pc += 3;
        put(x, p[1], p[2]);
        break;
    case 0x76 ... 0x77: /* MOV @Ri, #data */
        x->pc += 2, ram[x->r[op & 1]] = p[1];
        break;
    case 0x78 ... 0x7F: /* MOV Rn, #data */
        x->pc += 2, x->r[op & 7] = p[1];
        break;
    case 0x85: /* MOV direct, direct: the source comes first */
        x->pc += 3;
        put(x, p[2], get(x, p[1]));
        break;
    case 0x86 ... 0x87: /* MOV direct, @Ri */
        x->pc += 2;
        put(x, p[1], ram[x->r[op & 1]]);
        break;
    case 0x88 ... 0x8F: /* MOV direct, Rn */
        x->pc += 2;
        put(x, p[1], x->r[op & 7]);
        break;
    case 0x90: /* MOV DPTR, #data16 */
        x->pc += 3, sfr[DPH] = p[1], sfr[DPL] = p[2];
        break;
    case 0xA6 ... 0xA7: /* MOV @Ri, direct */
        x->pc += 2, ram[x->r[op & 1]] = get(x, p[1]);
        break;
    case 0xA8 ... 0xAF: /* MOV Rn, direct */
        x->pc += 2, x->r[op & 7] = get(x, p[1]);
        break;
    case 0xE5: /* MOV A, direct */
        x->pc += 2, x->a = get(x, p[1]);
        break;
    case 0xE6 ... 0xE7: /* MOV A, @Ri */
        x->pc += 1, x->a = ram[x->r[op & 1]];
        break;
    case 0xE8 ... 0xEF: /* MOV A, Rn */
        x->pc += 1, x->a = x->r[op & 7];
        break;
    case 0xF5: /* MOV direct, A */
        x->pc += 2;
        put(x, p[1], x->a);
        break;
    case 0xF6 ... 0xF7: /* MOV @Ri, A */
        x->pc += 1, ram[x->r[op & 1]] = x->a;
        break;
    case 0xF8 ... 0xFF: /* MOV Rn, A */
        x->pc += 1, x->r[op & 7] = x->a;
        break;
    case 0x83: /* MOVC A, @A+PC */
        x->pc += 1, x->a = x->chip->code[(uint16_t)(x->pc + x->a)];
        break;
    case 0x93: /* MOVC A, @A+DPTR */
        x->pc += 1, x->a = x->chip->code[(uint16_t)(dptr(x) + x->a)];
        break;
    case 0xE0: /* MOVX A, @DPTR */
        x->pc += 1, x->a = x->chip->xdata[dptr(x)];
        break;
    case 0xE2 ... 0xE3: /* MOVX A, @Ri: P2's latch is the page */
        x->pc += 1, x->a = x->chip->xdata[paged(x, x->r[op & 1])];
        break;
    case 0xF0: /* MOVX @DPTR, A */
        x->pc += 1;
        put_xdata(x, dptr(x), x->a);
        break;
    case 0xF2 ... 0xF3: /* MOVX @Ri, A */
        x->pc += 1;
        put_xdata(x, paged(x, x->r[op & 1]), x->a);
        break;
    case 0xC0: /* PUSH */
        x->pc += 2;
        sfr[SP]++;
        ram[sfr[SP]] = get(x, p[1]);
        break;
    case 0xD0: /* POP */
        x->pc += 2, value = pop(x);
        put(x, p[1], value);
        break;
    case 0xC5: /* XCH A, direct */
        x->pc += 2, value = get(x, p[1]);
        put(x, p[1], x->a);
        x->a = value;
        break;
    case 0xC6 ... 0xC7: /* XCH A, @Ri */
        x->pc += 1;
        exchange(&x->a, &ram[x->r[op & 1]]);
        break;
    case 0xC8 ... 0xCF: /* XCH A, Rn */
        x->pc += 1;
        exchange(&x->a, &x->r[op & 7]);
        break;
    case 0xD6 ... 0xD7: /* XCHD A, @Ri */
        x->pc += 1, value = ram[x->r[op & 1]];
        ram[x->r[op & 1]] = (uint8_t)((value & 0xF0) | (x->a & 0x0F));
        x->a = (uint8_t)((x->a & 0xF0) | (value & 0x0F));
        break;
    }
    x->instructions++;
    x->now = x->end;
}

INLINE void execute(struct mcs52 *chip, bool probed, bool one)
{
    struct core x;

    take(&x, chip);
    do {
        if (x.now >= chip->next) {
            give(&x);
            if (!mcs52_boundary(chip)) {
                return;
            }
            take(&x, chip);
        }
        if (probed && x.now >= chip->probe_from) {
            give(&x);
            mcs52_faults_strike(chip);
            take(&x, chip);
        }
        if (probed && chip->covered != NULL) {
            chip->covered[x.pc >> 3] |= (uint8_t)(1u << (x.pc & 7));
        }
        instruction(&x);
    } while (!one);
    give(&x);
}

void mcs52_execute(struct mcs52 *chip)
{
    execute(chip, false, false);
}

void mcs52_execute_probed(struct mcs52 *chip, bool one)
{
    execute(chip, true, one);
}
