/* SPDX-License-Identifier: MIT */
/* The processor's registers and what instructions are made of. Only mcs52_cpu.c includes this. */
#ifndef FUZZY51_MCS52_CORE_H
#define FUZZY51_MCS52_CORE_H

#include "mcs52_inside.h"

#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define INLINE static inline __attribute__((always_inline))
#else
#define INLINE static inline
#endif

/* What the processor holds while it runs; the rest stays in the chip. */
struct core {
    struct mcs52 *chip;
    uint8_t *r; /* R0..R7 */
    uint64_t now, end, instructions;
    unsigned pc; /* the lower 16 bits */
    uint8_t a, psw;
};

INLINE void take(struct core *x, struct mcs52 *chip)
{
    x->chip = chip;
    x->now = chip->now;
    x->instructions = chip->instructions;
    x->pc = chip->pc;
    x->a = chip->a;
    x->psw = chip->psw;
    x->r = mcs52_bank(chip);
}

INLINE void give(const struct core *x)
{
    struct mcs52 *chip = x->chip;

    chip->now = x->now;
    chip->instructions = x->instructions;
    chip->pc = (uint16_t)x->pc;
    chip->a = x->a;
    chip->psw = x->psw;
}

/* --- operands ----------------------------------------------------------------------------- */

INLINE uint8_t get_special(struct core *x, uint8_t address, uint64_t cycle)
{
    if (address == ACC) {
        return x->a;
    }
    if (address == PSW) {
        return (uint8_t)(x->psw | __builtin_parity(x->a));
    }
    return mcs52_read(x->chip, address, cycle);
}

/* A direct address, in the first cycle; of a port, the pins. */
INLINE uint8_t get(struct core *x, uint8_t address)
{
    if (address < 0x80) {
        return x->chip->ram[address];
    }
    /* cppcheck-suppress arrayIndexOutOfBoundsCond ; a uint8_t is never 256 */
    return mcs52_special[address] & READ_SPECIAL ? get_special(x, address, x->now)
                                                 : x->chip->sfr[address];
}

/* A direct address that will be written back, in the last cycle, so that no flag is lost that the
 * hardware sets meanwhile; of a port, the latch ([I], read-modify-write). */
INLINE uint8_t get_latch(struct core *x, uint8_t address)
{
    if (address < 0x80) {
        return x->chip->ram[address];
    }
    /* cppcheck-suppress arrayIndexOutOfBoundsCond ; a uint8_t is never 256 */
    return (mcs52_special[address] & (WRITE_SPECIAL | IS_PORT)) == WRITE_SPECIAL
               ? get_special(x, address, x->end - 1)
               : x->chip->sfr[address];
}

INLINE void put_special(struct core *x, uint8_t address, uint8_t value)
{
    if (address == ACC) {
        x->a = value;
    } else if (address == PSW) {
        x->psw = value & (uint8_t)~PSW_P;
        x->r = x->chip->ram + (value & PSW_BANK);
    } else {
        mcs52_write(x->chip, address, value, x->end);
    }
}

INLINE void put(struct core *x, uint8_t address, uint8_t value)
{
    if (address < 0x80) {
        x->chip->ram[address] = value;
        /* cppcheck-suppress arrayIndexOutOfBoundsCond ; a uint8_t is never 256 */
    } else if (mcs52_special[address] & WRITE_SPECIAL) {
        put_special(x, address, value);
    } else {
        x->chip->sfr[address] = value;
    }
}

INLINE uint8_t byte_of_bit(uint8_t bit)
{
    return bit < 0x80 ? (uint8_t)(0x20 + (bit >> 3)) : bit & 0xF8;
}

INLINE uint8_t mask_of_bit(uint8_t bit)
{
    return (uint8_t)(1u << (bit & 7));
}

INLINE bool get_bit(struct core *x, uint8_t bit)
{
    return (get(x, byte_of_bit(bit)) & mask_of_bit(bit)) != 0;
}

INLINE void put_bit(struct core *x, uint8_t bit, bool value)
{
    uint8_t byte = byte_of_bit(bit), mask = mask_of_bit(bit), old = get_latch(x, byte);

    put(x, byte, (uint8_t)(value ? old | mask : old & ~mask));
}

INLINE bool carry(const struct core *x)
{
    return (x->psw & PSW_CY) != 0;
}

INLINE void set_carry(struct core *x, bool value)
{
    x->psw = (uint8_t)((x->psw & ~PSW_CY) | (value ? PSW_CY : 0));
}

INLINE unsigned dptr(const struct core *x)
{
    return (unsigned)(x->chip->sfr[DPH] << 8 | x->chip->sfr[DPL]);
}

INLINE void push(struct core *x, uint8_t value)
{
    x->chip->ram[++x->chip->sfr[SP]] = value;
}

INLINE uint8_t pop(struct core *x)
{
    return x->chip->ram[x->chip->sfr[SP]--];
}

INLINE void jump(struct core *x, unsigned target)
{
    x->pc = target;
}

INLINE void call(struct core *x, unsigned target)
{
    push(x, (uint8_t)x->pc);
    push(x, (uint8_t)(x->pc >> 8));
    jump(x, target);
}

INLINE void ret(struct core *x)
{
    unsigned high = pop(x);

    x->pc = high << 8 | pop(x);
}

INLINE void branch(struct core *x, bool taken, uint8_t offset)
{
    x->pc += taken ? (unsigned)(int8_t)offset : 0;
}

INLINE void put_xdata(struct core *x, unsigned address, uint8_t value)
{
    struct mcs52 *chip = x->chip;

    chip->xdata[address] = value;
    if (address == chip->xdata_watch && chip->outside.xdata != NULL) {
        chip->outside.xdata(chip->outside.user, x->end, value);
    }
}

INLINE unsigned paged(const struct core *x, uint8_t low)
{
    return (unsigned)(x->chip->sfr[P2] << 8 | low);
}

/* --- arithmetic --------------------------------------------------------------------------- */

/* CARRIES has at bit N the carry or borrow into bit N. */
INLINE void set_flags(struct core *x, unsigned carries)
{
    unsigned others = x->psw & ~(unsigned)(PSW_CY | PSW_AC | PSW_OV);

    x->psw = (uint8_t)(others | (carries >> 1 & PSW_CY) | (carries << 2 & PSW_AC) |
                       ((carries >> 6 ^ carries >> 5) & PSW_OV));
}

INLINE void add(struct core *x, uint8_t value, unsigned carry_in)
{
    unsigned sum = x->a + value + carry_in;

    set_flags(x, x->a ^ value ^ sum);
    x->a = (uint8_t)sum;
}

INLINE void subtract(struct core *x, uint8_t value)
{
    unsigned difference = (unsigned)x->a - value - carry(x);

    set_flags(x, x->a ^ value ^ difference);
    x->a = (uint8_t)difference;
}

INLINE void multiply(struct core *x)
{
    unsigned product = (unsigned)x->a * x->chip->sfr[B];

    x->a = (uint8_t)product;
    x->chip->sfr[B] = (uint8_t)(product >> 8);
    x->psw = (uint8_t)((x->psw & ~(PSW_CY | PSW_OV)) | (product > 255 ? PSW_OV : 0));
}

/* By 0: [I] leaves A and B undefined; they stay as they are. */
INLINE void divide(struct core *x)
{
    uint8_t divisor = x->chip->sfr[B];

    x->psw = (uint8_t)((x->psw & ~(PSW_CY | PSW_OV)) | (divisor == 0 ? PSW_OV : 0));
    if (divisor != 0) {
        x->chip->sfr[B] = x->a % divisor;
        x->a = x->a / divisor;
    }
}

INLINE void decimal_adjust(struct core *x)
{
    unsigned sum = x->a;

    sum += (sum & 15) > 9 || (x->psw & PSW_AC) != 0 ? 6u : 0u;
    set_carry(x, carry(x) || sum > 0xFF);
    sum += carry(x) || (sum & 0xF0) > 0x90 ? 0x60u : 0u;
    set_carry(x, carry(x) || sum > 0xFF);
    x->a = (uint8_t)sum;
}

INLINE void compare(struct core *x, uint8_t left, uint8_t right, uint8_t offset)
{
    x->pc += 3;
    set_carry(x, left < right);
    branch(x, left != right, offset);
}

INLINE void exchange(uint8_t *a, uint8_t *b)
{
    uint8_t kept = *a;

    *a = *b;
    *b = kept;
}

#endif
