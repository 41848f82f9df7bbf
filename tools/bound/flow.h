/* SPDX-License-Identifier: MIT */
/* Every path through an image: how deep its stack can get, how long its functions can take. Nothing
 * is run: what is found holds for whatever the inputs are. A path that the data rule out counts all
 * the same, so figures are upper bounds. */
#ifndef FUZZY51_FLOW_H
#define FUZZY51_FLOW_H

#include "hexfile.h"
#include "listing.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    FLOW_INTERRUPTS = 6,
    FLOW_RETURN_ADDRESS = 2 /* bytes that a call or an interrupt pushes */
};

struct function;

struct flow {
    const struct hexfile *hex;
    const struct listing *listing;
    const char *path; /* of the image, for messages */
    struct function *functions[HEX_CODE_SIZE];
    bool is_code[HEX_CODE_SIZE + 2]; /* followed so far */
    uint8_t vectors;                 /* in use: bit n is the one at 8 n + 3 */
    int stack_base;                  /* SP as the start-up sets it; -1: not found yet */
    uint8_t high; /* interrupts that begin at a higher level: bits as in vectors */
};

/* All functions from here on return false after a message: the image does what cannot be followed
 * (a jump or a call through a pointer, recursion, a stack pointer of its own). */

void flow_init(struct flow *flow, const struct hexfile *hex, const struct listing *listing,
               const char *path);
void flow_free(struct flow *flow);

/* Follows all code from reset and from the vectors in use. */
bool flow_follow(struct flow *flow);

/* Whether vector N, 0..FLOW_INTERRUPTS-1, is in use, and its routine's address. */
bool flow_interrupt(const struct flow *flow, int n, uint16_t *entry);

/* The most bytes of stack below a call of ENTRY, its return address and those of all calls below
 * included. */
int flow_stack(const struct flow *flow, uint16_t entry);

/* Where that is: the callee on the deepest path, or -1: in ENTRY itself. */
long flow_deepest(const struct flow *flow, uint16_t entry);

/* The most machine cycles from the call of ENTRY to its return, the call itself not counted; with
 * is_round from one turn of its endless loop to the next. Interrupts come on top. */
bool flow_cycles(struct flow *flow, uint16_t entry, bool is_round, long *cycles);

#endif
