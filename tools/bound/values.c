/* SPDX-License-Identifier: MIT */
#include "values.h"

#include <string.h>

enum { SP = 0x81, DPL = 0x82, DPH = 0x83, PSW = 0xD0, ACC = 0xE0, B = 0xF0 };
enum {
    REGISTERS = 0x20, /* of all banks */
    RAM = 0x80,       /* that has direct addresses */
    BELOW = 0xC0      /* an offset of the stack pointer from here on is negative */
};

static const struct value any = {.kind = VALUE_ANY};

static struct value constant(unsigned number)
{
    return (struct value){.kind = VALUE_CONST, .number = number & 0xFF};
}

static bool is_same(struct value a, struct value b)
{
    return a.kind == b.kind && a.place == b.place && a.number == b.number;
}

static bool is_const(struct value a)
{
    return a.kind == VALUE_CONST;
}

static bool is_followed(const struct values_world *world, int byte)
{
    switch (byte) {
    case SP:
    case DPL:
    case DPH:
    case PSW:
    case ACC:
    case B:
        return !world->is_shared[byte];
    default: /* the other special function registers belong to the hardware */
        return !world->is_shared[byte] && byte < RAM;
    }
}

void values_world_init(struct values_world *world, const uint8_t *code)
{
    memset(world, 0, sizeof *world);
    world->code = code;
    world->frame_pointer = -1;
    for (int i = 0; i + 5 < 0x10000; i++) {
        const uint8_t *next = &code[i + 2];
        bool is_moved = next[0] == 0x85 && next[1] == SP && next[2] == code[i + 1];
        bool is_moved_by_a =
            next[0] == 0xE5 && next[1] == SP && next[2] == 0xF5 && next[3] == code[i + 1];

        if (code[i] == 0xC0 && code[i + 1] < RAM && (is_moved || is_moved_by_a)) {
            world->frame_pointer = code[i + 1];
        }
    }
}

void values_enter(struct values *values, const struct values_world *world)
{
    for (int i = 0; i < VALUES_BYTES; i++) {
        values->byte[i] =
            is_followed(world, i) ? (struct value){.kind = VALUE_ENTRY, .place = (uint8_t)i} : any;
    }
    for (int i = 0; i < VALUES_SLOTS; i++) {
        values->slot[i] = any;
    }
    values->carry = any;
}

static bool merge(struct value *value, struct value other)
{
    if (other.kind == VALUE_NONE || value->kind == VALUE_ANY || is_same(*value, other)) {
        return false;
    }
    *value = value->kind == VALUE_NONE ? other : any;
    return true;
}

bool values_equal(const struct values *a, const struct values *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

bool values_merge(struct values *values, const struct values *other)
{
    bool is_less = merge(&values->carry, other->carry);

    for (int i = 0; i < VALUES_BYTES; i++) {
        is_less |= merge(&values->byte[i], other->byte[i]);
    }
    for (int i = 0; i < VALUES_SLOTS; i++) {
        is_less |= merge(&values->slot[i], other->slot[i]);
    }
    return is_less;
}

int values_depth(const struct values *values)
{
    struct value sp = values->byte[SP];

    if (sp.place != SP) {
        return VALUES_LOST;
    }
    return sp.number < BELOW ? sp.number : sp.number - 0x100;
}

/* --- reading and writing --------------------------------------------------------------- */

/* The first byte of the bank of registers in use. A function begins with the bank that it was
 * compiled for; SDCC's names ARn then mean bank 0. Returns -1 if it is not known. */
static int bank_of(const struct values *values)
{
    struct value psw = values->byte[PSW];

    if (psw.kind == VALUE_ENTRY) {
        return 0;
    }
    return is_const(psw) ? psw.number : -1;
}

/* A direct byte. Of the PSW only the bank is followed, not the flags. */
static struct value get_byte(const struct values *values, int byte)
{
    return byte == PSW ? any : values->byte[byte];
}

static struct value get_register(const struct values *values, int n)
{
    int bank = bank_of(values);

    return bank < 0 ? any : values->byte[bank + n];
}

/* Of what is written to the PSW only the bank stays known; and of the PSW's value on the stack no
 * other byte learns anything. */
static void set_byte(struct values *values, const struct values_world *world, int byte,
                     struct value value)
{
    if (byte == PSW) {
        values->carry = any;
        if (is_const(value)) {
            value = (struct value){VALUE_CONST, PSW, value.number & 0x18};
        }
    }
    if ((byte == PSW) != (value.place == PSW)) {
        value = any;
    }
    values->byte[byte] = is_followed(world, byte) ? value : any;
}

static void set_register(struct values *values, const struct values_world *world, int n,
                         struct value value)
{
    int bank = bank_of(values);

    if (bank >= 0) {
        set_byte(values, world, bank + n, value);
        return;
    }
    for (int i = n; i < REGISTERS; i += 8) { /* of any of the banks */
        values->byte[i] = any;
    }
}

/* A write through R0 or R1. */
static void set_indirect(struct values *values, const struct values_world *world, int n,
                         struct value value)
{
    struct value pointer = get_register(values, n);
    int bank = bank_of(values);

    if (is_const(pointer)) {
        if (pointer.number < RAM) {
            set_byte(values, world, pointer.number, value);
        }
    } else if (pointer.place == SP) {
        if (pointer.number < VALUES_SLOTS) {
            values->slot[pointer.number] = any;
        }
    } else {
        for (int i = 8; i < RAM; i++) { /* an unknown bank is taken for the first one */
            if (i != world->frame_pointer && (i < bank || i >= bank + 8)) {
                values->byte[i] = any;
            }
        }
    }
}

static struct value get_indirect(const struct values *values, int n)
{
    struct value pointer = get_register(values, n);

    return is_const(pointer) && pointer.number < RAM ? values->byte[pointer.number] : any;
}

/* --- arithmetic ----------------------------------------------------------------------------- */

static struct value plus(struct value value, int number)
{
    if (value.kind != VALUE_CONST && value.kind != VALUE_ENTRY) {
        return any;
    }
    value.number = (uint16_t)(value.number + number) & 0xFF;
    return value;
}

static void add(struct values *values, struct value other, struct value carry)
{
    struct value a = values->byte[ACC];

    values->carry = any;
    if (!is_const(carry) || (!is_const(a) && !is_const(other))) {
        values->byte[ACC] = any;
    } else if (is_const(a) && is_const(other)) {
        unsigned sum = (unsigned)a.number + other.number + carry.number;

        values->byte[ACC] = constant(sum);
        values->carry = constant(sum >> 8);
    } else if (is_const(other)) {
        values->byte[ACC] = plus(a, other.number + carry.number);
    } else {
        values->byte[ACC] = plus(other, a.number + carry.number);
    }
}

static void subtract(struct values *values, struct value other)
{
    struct value a = values->byte[ACC], carry = values->carry;

    values->carry = any;
    if (!is_const(carry) || !is_const(other)) {
        values->byte[ACC] = any;
    } else if (is_const(a)) {
        int difference = a.number - other.number - carry.number;

        values->byte[ACC] = constant((unsigned)difference);
        values->carry = constant(difference < 0);
    } else {
        values->byte[ACC] = plus(a, -other.number - carry.number);
    }
}

/* orl, anl, xrl by the high half of the opcode: 4, 5, 6. */
static struct value combine(int operation, struct value a, struct value b)
{
    if (operation == 5 && ((is_const(a) && a.number == 0) || (is_const(b) && b.number == 0))) {
        return constant(0);
    }
    if (!is_const(a) || !is_const(b)) {
        return any;
    }
    return constant(operation == 4   ? (unsigned)(a.number | b.number)
                    : operation == 5 ? (unsigned)(a.number & b.number)
                                     : (unsigned)(a.number ^ b.number));
}

/* Compares as cjne does: the carry is set if A is less than B. */
static void compare(struct values *values, struct value a, struct value b)
{
    values->carry = is_const(a) && is_const(b) ? constant(a.number < b.number) : any;
}

/* rr, rrc, rl, rlc. */
static void rotate(struct values *values, bool is_left, bool is_through)
{
    struct value a = values->byte[ACC], carry = values->carry;
    unsigned out, in;

    if (!is_const(a) || (is_through && !is_const(carry))) {
        values->byte[ACC] = any;
        values->carry = is_through ? any : carry;
        return;
    }
    out = is_left ? a.number >> 7 : a.number & 1U;
    in = is_through ? carry.number : out;
    values->byte[ACC] =
        constant(is_left ? (unsigned)a.number << 1 | in : (unsigned)a.number >> 1 | in << 7);
    if (is_through) {
        values->carry = constant(out);
    }
}

/* --- bits ----------------------------------------------------------------------------------- */

static int byte_of_bit(uint8_t bit)
{
    return bit < RAM ? 0x20 + bit / 8 : bit & 0xF8;
}

static struct value get_bit(const struct values *values, uint8_t bit)
{
    struct value byte = values->byte[byte_of_bit(bit)];

    if (byte_of_bit(bit) == PSW) {
        return bit == PSW + 7 ? values->carry : any;
    }
    return is_const(byte) ? constant((unsigned)byte.number >> (bit & 7) & 1U) : any;
}

static void set_bit(struct values *values, const struct values_world *world, uint8_t bit,
                    struct value value)
{
    int at = byte_of_bit(bit);
    struct value byte = values->byte[at];

    if (at == PSW) {
        if (bit == PSW + 7) {
            values->carry = value;
        } else if (bit == PSW + 3 || bit == PSW + 4) { /* the bank */
            values->byte[PSW] = any;
        }
        return;
    }
    if (is_const(byte) && is_const(value)) {
        set_byte(
            values, world, at,
            constant((byte.number & ~(1U << (bit & 7))) | (unsigned)value.number << (bit & 7)));
    } else {
        set_byte(values, world, at, any);
    }
}

static struct value invert(struct value bit)
{
    return is_const(bit) ? constant(!bit.number) : any;
}

/* --- instructions --------------------------------------------------------------------------- */

/* The operand of an arithmetic instruction, by the low half of its opcode. */
static struct value operand(const struct values *values, const uint8_t *code)
{
    int form = code[0] & 15;

    return form == 4   ? constant(code[1])
           : form == 5 ? get_byte(values, code[1])
           : form < 8  ? get_indirect(values, form - 6)
                       : get_register(values, form - 8);
}

static void set_operand(struct values *values, const struct values_world *world,
                        const uint8_t *code, struct value value)
{
    int form = code[0] & 15;

    if (form == 4) {
        values->byte[ACC] = value;
    } else if (form == 5) {
        set_byte(values, world, code[1], value);
    } else if (form < 8) {
        set_indirect(values, world, form - 6, value);
    } else {
        set_register(values, world, form - 8, value);
    }
}

/* A constant of two bytes. */
static struct value wide(unsigned number)
{
    return (struct value){.kind = VALUE_CONST, .number = (uint16_t)number};
}

static struct value low_half(struct value wide)
{
    return is_const(wide) ? constant(wide.number) : any;
}

static struct value high_half(struct value wide)
{
    return is_const(wide) ? constant((unsigned)wide.number >> 8) : any;
}

/* The data pointer. */
static struct value pair(const struct values *values)
{
    struct value low = values->byte[DPL], high = values->byte[DPH];

    return is_const(low) && is_const(high) ? wide((unsigned)high.number << 8 | low.number) : any;
}

/* An unknown byte of the table at BASE. */
static struct value table_at(unsigned base)
{
    return (struct value){.kind = VALUE_TABLE, .number = (uint16_t)base};
}

/* OPCODE, if it is one of those of the accumulator alone, with B and the carry. */
static void step_accumulator(struct values *values, uint8_t opcode)
{
    struct value a = values->byte[ACC], b = values->byte[B], product = any;

    switch (opcode) {
    case 0x03: /* rr, rl; rrc, rlc */
    case 0x23:
    case 0x13:
    case 0x33:
        rotate(values, (opcode & 0x20) != 0, (opcode & 0x10) != 0);
        break;
    case 0xE0: /* movx */
    case 0xE2:
    case 0xE3:
        values->byte[ACC] = any;
        break;
    case 0x84: /* div */
        values->byte[ACC] = values->byte[B] = any;
        values->carry = constant(0);
        break;
    case 0xA4: /* mul */
        if (is_const(a) && is_const(b)) {
            product = wide((unsigned)a.number * b.number);
        }
        values->byte[ACC] = low_half(product);
        values->byte[B] = high_half(product);
        values->carry = constant(0);
        break;
    case 0xC4: /* swap */
        values->byte[ACC] =
            is_const(a) ? constant((unsigned)a.number << 4 | (unsigned)a.number >> 4) : any;
        break;
    case 0xD4: /* da */
        values->byte[ACC] = values->carry = any;
        break;
    case 0xE4: /* clr */
        values->byte[ACC] = constant(0);
        break;
    case 0xF4: /* cpl */
        values->byte[ACC] = is_const(a) ? constant(~(unsigned)a.number) : any;
        break;
    }
}

/* The instruction, if it is one of bits. */
static void step_bit(struct values *values, const struct values_world *world, const uint8_t *code)
{
    switch (code[0]) {
    case 0x10: /* jbc: afterwards the bit is 0 either way */
    case 0xC2:
        set_bit(values, world, code[1], constant(0));
        break;
    case 0xD2:
        set_bit(values, world, code[1], constant(1));
        break;
    case 0xB2:
        set_bit(values, world, code[1], invert(get_bit(values, code[1])));
        break;
    case 0x92:
        set_bit(values, world, code[1], values->carry);
        break;
    case 0xA2:
        values->carry = get_bit(values, code[1]);
        break;
    case 0xB3:
        values->carry = invert(values->carry);
        break;
    case 0xC3:
        values->carry = constant(0);
        break;
    case 0xD3:
        values->carry = constant(1);
        break;
    case 0x72: /* orl c, anl c */
    case 0x82:
    case 0xA0:
    case 0xB0:
        values->carry = any;
        break;
    }
}

/* The instruction, if it is one of the stack, of the data pointer or of tables in code. */
static void step_address(struct values *values, const struct values_world *world, uint16_t address)
{
    const uint8_t *code = &world->code[address];
    struct value pointer = pair(values);
    int depth = values_depth(values);

    switch (code[0]) {
    case 0xC0: /* push: of the stack pointer itself, what it is afterwards */
        values->byte[SP].number++;
        values->slot[depth + 1] = values->byte[code[1]];
        break;
    case 0xD0:
        values->byte[SP] = plus(values->byte[SP], -1);
        set_byte(values, world, code[1], values->slot[depth]);
        break;
    case 0x22: /* ret, reti: of a switch, a jump to an address that it has pushed */
    case 0x32:
        if (depth >= 2) {
            values->byte[SP].number -= 2;
        }
        break;
    case 0x83: /* movc a,@a+pc; before it `add a,#(table - next)` */
        values->byte[ACC] =
            address >= 2 && code[-2] == 0x24 ? table_at(address + 1U + code[-1]) : any;
        break;
    case 0x93: /* movc a,@a+dptr */
        values->byte[ACC] = is_const(pointer) ? table_at(pointer.number) : any;
        break;
    case 0x90:
        values->byte[DPH] = constant(code[1]);
        values->byte[DPL] = constant(code[2]);
        break;
    case 0xA3:
        pointer.number++;
        values->byte[DPL] = low_half(pointer);
        values->byte[DPH] = high_half(pointer);
        break;
    }
}

/* An instruction with an operand. */
static void step_operand(struct values *values, const struct values_world *world,
                         const uint8_t *code)
{
    struct value a = values->byte[ACC], other = operand(values, code);
    int operation = code[0] >> 4, form = code[0] & 15;

    switch (operation) {
    case 0x0: /* inc, dec */
    case 0x1:
        set_operand(values, world, code, plus(form == 4 ? a : other, operation == 0 ? 1 : -1));
        break;
    case 0x2:
        add(values, other, constant(0));
        break;
    case 0x3:
        add(values, other, values->carry);
        break;
    case 0x4: /* orl, anl, xrl */
    case 0x5:
    case 0x6:
        values->byte[ACC] = combine(operation, a, other);
        break;
    case 0x7: /* mov x,#data */
        set_operand(values, world, code, constant(code[form == 5 ? 2 : 1]));
        break;
    case 0x8: /* mov direct,x */
        set_byte(values, world, code[form == 5 ? 2 : 1], other);
        break;
    case 0x9:
        subtract(values, other);
        break;
    case 0xA: /* mov x,direct */
        set_operand(values, world, code, get_byte(values, code[1]));
        break;
    case 0xB: /* cjne a with #data or direct; cjne others with #data */
        if (form <= 5) {
            compare(values, a, other);
        } else {
            compare(values, other, constant(code[1]));
        }
        break;
    case 0xC: /* xch */
        set_operand(values, world, code, a);
        values->byte[ACC] = other;
        break;
    case 0xD: /* djnz, xchd */
        if (form == 6 || form == 7) {
            values->byte[ACC] = other = any;
        }
        set_operand(values, world, code, plus(other, -1));
        break;
    case 0xE: /* mov a,x */
        values->byte[ACC] = other;
        break;
    default: /* mov x,a */
        set_operand(values, world, code, a);
        break;
    }
}

void values_step(struct values *values, const struct values_world *world, uint16_t address)
{
    const uint8_t *code = &world->code[address];
    int operation = code[0] >> 4, form = code[0] & 15, before = values_depth(values);
    bool is_logic = operation >= 4 && operation <= 6; /* orl, anl, xrl */
    bool is_accumulators = form == 4 && (operation == 8 || operation == 0xA || operation >= 0xC);

    step_accumulator(values, code[0]);
    step_bit(values, world, code);
    step_address(values, world, address);
    if ((form == 2 || form == 3) && is_logic) {
        struct value other = form == 2 ? values->byte[ACC] : constant(code[2]);

        set_byte(values, world, code[1], combine(operation, get_byte(values, code[1]), other));
    } else if (form > 3 && !is_accumulators) {
        step_operand(values, world, code);
    }
    /* What is beyond the stack pointer, interrupts and callees overwrite. */
    for (int i = before; i > 0 && i > values_depth(values); i--) {
        values->slot[i] = any;
    }
}

void values_return(struct values *values, const bool is_changed[VALUES_BYTES])
{
    for (int i = 0; i < VALUES_BYTES; i++) {
        if (is_changed[i]) {
            values->byte[i] = any;
        }
    }
    values->carry = any;
}

void values_changed(const struct values *values, bool is_changed[VALUES_BYTES])
{
    for (int i = 0; i < VALUES_BYTES; i++) {
        struct value value = values->byte[i];
        bool is_kept = value.kind == VALUE_ENTRY && value.place == i && value.number == 0;

        is_changed[i] |= !is_kept && i != SP;
    }
}

/* The value that a branch asks for, which the branch leaves as it is. */
static struct value asked(const struct values *values, const uint8_t *code)
{
    struct value first, second;

    switch (code[0]) {
    case 0x40:
    case 0x50:
        return values->carry;
    case 0x60:
    case 0x70:
        return values->byte[ACC];
    case 0x20:
    case 0x30:
        return get_bit(values, code[1]);
    case 0x10:
        return any;
    case 0xB4:
    case 0xB5:
        first = values->byte[ACC];
        second = operand(values, code);
        break;
    case 0xD5:
        return get_byte(values, code[1]);
    default:
        first = operand(values, code);
        second = constant(code[1]);
        if (code[0] >= 0xD8) {
            return first;
        }
        break;
    }
    return is_const(first) && is_const(second) ? constant(first.number != second.number) : any;
}

void values_branch(const struct values *values, const struct values_world *world, uint16_t address,
                   bool *may_go_on, bool *may_jump)
{
    const uint8_t *code = &world->code[address];
    struct value value = asked(values, code);
    bool jumps_at_zero = code[0] == 0x30 || code[0] == 0x50 || code[0] == 0x60; /* jnb, jnc, jz */

    *may_go_on = !is_const(value) || (value.number == 0) != jumps_at_zero;
    *may_jump = !is_const(value) || (value.number == 0) == jumps_at_zero;
}

/* A table of ljmp or ajmp begins at TABLE. */
static int jumps_at(const uint8_t *code, uint16_t table, uint16_t *targets)
{
    int count = 0, bytes = code[table] == 0x02 ? 3 : 2;

    while (count < VALUES_REPEATS / bytes &&
           (bytes == 3 ? code[table] == 0x02 : (code[table] & 0x1F) == 0x01)) {
        targets[count++] = table;
        table = (uint16_t)(table + bytes);
    }
    return count;
}

/* LOW and HIGH are the halves of an address: a constant, or a byte each of two tables, the second
 * of which begins where the first one ends. */
static int halves(const uint8_t *code, struct value low, struct value high, uint16_t *targets)
{
    int count = high.number - low.number;

    if (is_const(low) && is_const(high)) {
        targets[0] = (uint16_t)(high.number << 8 | low.number);
        return 1;
    }
    if (low.kind != VALUE_TABLE || high.kind != VALUE_TABLE || count < 1 ||
        count > VALUES_REPEATS) {
        return 0;
    }
    for (int i = 0; i < count; i++) {
        targets[i] =
            (uint16_t)(code[(uint16_t)(high.number + i)] << 8 | code[(uint16_t)(low.number + i)]);
    }
    return count;
}

int values_targets(const struct values *values, const struct values_world *world, bool is_return,
                   uint16_t *targets)
{
    struct value a = values->byte[ACC], pointer = pair(values);
    int depth = values_depth(values), count;

    if (is_return) {
        return depth < 2
                   ? 0
                   : halves(world->code, values->slot[depth - 1], values->slot[depth], targets);
    }
    if (!is_const(a)) {
        return is_const(pointer) ? jumps_at(world->code, pointer.number, targets) : 0;
    }
    count = halves(world->code, values->byte[DPL], values->byte[DPH], targets);
    for (int i = 0; i < count; i++) {
        targets[i] = (uint16_t)(targets[i] + a.number);
    }
    return count;
}
