/* SPDX-License-Identifier: MIT */
/* Follows every path through an image and finds the deepest stack and the longest time. Nothing is
 * run, so the result holds for all inputs. A path that the data never allow counts, too; so each
 * figure is an upper bound. */
#ifndef FUZZY51_FLOW_H
#define FUZZY51_FLOW_H

#include "hexfile.h"
#include "listing.h"
#include "values.h"

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
    bool is_code[HEX_CODE_SIZE + 2]; /* the bytes of all instructions found so far */
    uint8_t vectors;                 /* interrupts in use: bit n is the vector at 8 n + 3 */
    int stack_base; /* the value that the start-up code gives SP; -1: not found yet */
    uint16_t
        callers[HEX_CODE_SIZE]; /* of a function: the call that the search for cycles took last */
    uint16_t owners[HEX_CODE_SIZE]; /* of such a call: the function that it is in */
    long rounds[HEX_CODE_SIZE];     /* of each loop of the function at this address; 0: not given */
    uint16_t entry;                 /* of the function that is looked at */
    long
        steps_max; /* instructions that a loop is followed for, to count its rounds; some seconds */
    struct values_world world;
    uint8_t high; /* interrupts of the high priority level: bits as in vectors */
};

/* Each function from here on that returns bool returns false after a message on stderr: the image
 * has something that cannot be followed, such as a call through a pointer or recursion. */

void flow_init(struct flow *flow, const struct hexfile *hex, const struct listing *listing,
               const char *path);
void flow_free(struct flow *flow);

/* Follows all code from the reset vector and from the interrupt vectors in use. */
bool flow_follow(struct flow *flow);

/* Returns whether the vector N, 0..FLOW_INTERRUPTS-1, is in use, and sets *ENTRY to the address of
 * its routine. */
bool flow_interrupt(const struct flow *flow, int n, uint16_t *entry);

/* Follows the function at ENTRY, too, which nothing may have called. */
bool flow_follow_function(struct flow *flow, uint16_t entry);

/* The most bytes of stack that a call of ENTRY takes, with its own return address and all that the
 * functions which it calls take. */
int flow_stack(const struct flow *flow, uint16_t entry);

/* The function that ENTRY calls on its deepest path, or -1 if ENTRY itself is the deepest. */
long flow_deepest(const struct flow *flow, uint16_t entry);

/* The most machine cycles of ENTRY, from its first instruction to its return; with is_round, those
 * of one round of its endless loop. The time of interrupts is not included. */
bool flow_cycles(struct flow *flow, uint16_t entry, bool is_round, long *cycles);

#endif
