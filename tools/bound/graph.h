/* SPDX-License-Identifier: MIT */
/* What flow.c finds of a function, for cycles.c and rounds.c. */
#ifndef FUZZY51_GRAPH_H
#define FUZZY51_GRAPH_H

#include "flow.h"
#include "opcode.h"
#include "values.h"

enum { NONE = -1 };

/* One instruction of a function. */
struct node {
    uint16_t address;
    struct instruction it;
    bool is_known;         /* it, first and count are set */
    bool returns;          /* to the caller; a `ret` that ends a switch does not */
    bool is_queued;        /* to be looked at again */
    int depth;             /* bytes on the stack before it, of this function's own */
    int first, count;      /* its successors; of a branch the next instruction, then its target */
    struct values *before; /* while they are needed; else NULL */
};

/* A function: all instructions that can be reached from its entry without a call. Code that several
 * functions jump to is part of each of them. */
struct function {
    struct node
        *nodes; /* the first one is no instruction: it leads to the entry, and nothing to it */
    int node_count, node_room;
    int *successors;
    int successor_count, successor_room;
    int stack; /* with the return address */
    long deepest;
    bool is_changed[VALUES_BYTES]; /* its caller finds these bytes changed */
    bool is_done;
    long cycles; /* 0: not known yet */
};

/* Finds what is known before each instruction of FUNCTION, unless that is done: sets before. */
bool graph_settle(struct flow *flow, struct function *function);
void graph_forget(struct function *function);

/* VALUES becomes what is known after the instruction NODE, with what it calls. */
void graph_step(const struct flow *flow, const struct node *node, struct values *values);

/* Says what stops bound at ADDRESS; returns false. */
bool graph_complain(const struct flow *flow, uint16_t address, const char *what);

/* The name that the code at ADDRESS is part of: the last one before it. It is not always that of
 * the function that was called, because a function may end with a jump to another one. */
uint16_t graph_owner(const struct flow *flow, uint16_t address);

/* The source line that leads to the function OWNER, which has none and whose code the function
 * flow->entry came to: that of the jump in it, or else that of the last call with a source line.
 * NULL: none is known. */
const char *graph_leading_line(const struct flow *flow, uint16_t owner);

#endif
