/* SPDX-License-Identifier: MIT */
/* What is known of the registers, the internal RAM and the stack before an instruction, for all
 * inputs: for each byte either a constant, or what it was at the function's entry plus a constant,
 * or nothing. From this flow.c learns where the stack pointer is and where a switch leads, and
 * rounds.c how often a counted loop turns.
 *
 * Assumed of the program, as C and SDCC grant it: a pointer writes neither to the registers nor to
 * what the compiler pushed, and a register means the same byte as its name ARn. */
#ifndef FUZZY51_VALUES_H
#define FUZZY51_VALUES_H

#include <stdbool.h>
#include <stdint.h>

enum {
    VALUES_BYTES = 256, /* the direct addresses */
    VALUES_SLOTS = 128,
    VALUES_DEPTH_MAX = VALUES_SLOTS - 2, /* bytes of stack of one function; a push has room */
    VALUES_LOST = -256,
    VALUES_REPEATS = 256
};

enum {
    VALUE_NONE,  /* no path has come here yet */
    VALUE_CONST, /* number, 0..255 */
    VALUE_ENTRY, /* what the byte PLACE was at the function's entry, plus number, modulo 256 */
    VALUE_TABLE, /* an unknown byte of the table in code at number */
    VALUE_ANY
};

struct value {
    uint8_t kind;
    uint8_t place; /* of the PSW, 0xD0, only the bank is known, bits 3 and 4; a constant, too, has
                      this place there; else 0 */
    uint16_t number;
};

struct values {
    struct value byte[VALUES_BYTES]; /* by direct address; the bank's registers are 0..7 of them */
    struct value slot[VALUES_SLOTS]; /* of the stack, by distance from its pointer at the entry; 0
                                        is unused */
    struct value carry;
};

/* What is not of one function. */
struct values_world {
    const uint8_t *code;
    int frame_pointer;            /* the byte that holds SDCC's frame pointer (_bp); -1: none */
    bool is_shared[VALUES_BYTES]; /* an interrupt may change the byte at any time */
};

/* Finds the frame pointer: all code with frames begins a function with `push _bp; mov _bp,sp`, or
 * the same by way of the accumulator. */
void values_world_init(struct values_world *world, const uint8_t *code);

/* The entry of a function: each byte is what it is. */
void values_enter(struct values *values, const struct values_world *world);

/* Adds what another path knows. Returns whether this takes from what was known. */
bool values_merge(struct values *values, const struct values *other);

bool values_equal(const struct values *a, const struct values *b);

/* The bytes on the stack, of the function's own: -64..191; VALUES_LOST: not known. */
int values_depth(const struct values *values);

/* What the instruction at ADDRESS makes of VALUES, whose depth is 0..VALUES_DEPTH_MAX. A call
 * pushes nothing: values_return says what it leaves. */
void values_step(struct values *values, const struct values_world *world, uint16_t address);

/* What a call leaves of VALUES, whose callee changes the bytes IS_CHANGED. */
void values_return(struct values *values, const bool is_changed[VALUES_BYTES]);

/* Notes in IS_CHANGED the bytes that are not any more what they were at the entry. */
void values_changed(const struct values *values, bool is_changed[VALUES_BYTES]);

/* Which way the branch IT at ADDRESS can go, with the VALUES after it. */
void values_branch(const struct values *values, const struct values_world *world, uint16_t address,
                   bool *may_go_on, bool *may_jump);

/* The addresses that `jmp @a+dptr` or, with is_return, a `ret` that ends a switch may go to, with
 * the VALUES before it. Returns their number, or 0 if they are not known; TARGETS has room for
 * VALUES_REPEATS. */
int values_targets(const struct values *values, const struct values_world *world, bool is_return,
                   uint16_t *targets);

#endif
