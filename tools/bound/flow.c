/* SPDX-License-Identifier: MIT */
#include "flow.h"

#include "diag.h"
#include "graph.h"
#include "memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ARRAY with room for one more than its COUNT elements. */
static void *grow(void *array, int count, int *room, size_t size)
{
    if (count < *room) {
        return array;
    }
    *room = *room == 0 ? 64 : 2 * *room;
    return memory_resize(array, (size_t)*room, size);
}

/* --- messages ------------------------------------------------------------------------------- */

uint16_t graph_owner(const struct flow *flow, uint16_t address)
{
    while (flow->listing->names[address] == NULL && address != 0) {
        address--;
    }
    return address;
}

const char *graph_leading_line(const struct flow *flow, uint16_t owner)
{
    const struct function *function = flow->functions[flow->entry];
    uint16_t caller = flow->callers[flow->entry];

    for (int i = 1; owner != flow->entry && i < function->node_count; i++) {
        const struct node *node = &function->nodes[i];

        if (node->it.target == owner && flow->listing->places[node->address] != NULL) {
            return flow->listing->places[node->address];
        }
    }
    while (caller != 0 && flow->listing->places[caller] == NULL) {
        caller = flow->callers[flow->owners[caller]];
    }
    return flow->listing->places[caller];
}

/* Code of SDCC's library has no source line: then the message names its function and the line that
 * leads there. */
bool graph_complain(const struct flow *flow, uint16_t address, const char *what)
{
    const char *line = flow->listing->places[address];
    uint16_t owner = graph_owner(flow, address);

    if (line != NULL) {
        diag_error(flow->path, 0, "at 0x%04X (%s): %s", address, line, what);
        return false;
    }
    line = graph_leading_line(flow, owner);
    diag_error(flow->path, 0, "at 0x%04X (%s%s%s): %s", address, listing_name(flow->listing, owner),
               line != NULL ? ", called at " : "", line != NULL ? line : "", what);
    return false;
}

/* Writes how ENTRY came to AT: "entry > a > at". */
static void write_path(FILE *stream, const struct flow *flow, uint16_t entry, uint16_t at)
{
    if (at != entry) {
        write_path(stream, flow, entry, flow->owners[flow->callers[at]]);
        fputs(" > ", stream);
    }
    fputs(listing_name(flow->listing, at), stream);
}

/* ENTRY is called while it is followed. */
static bool complain_of_recursion(const struct flow *flow, uint16_t entry, uint16_t call)
{
    const char *line = flow->listing->places[call], *name = listing_name(flow->listing, entry);
    char *path;
    size_t length;
    FILE *stream = memory_open(&path, &length);

    write_path(stream, flow, entry, flow->entry);
    fclose(stream);
    diag_error(
        flow->path, 0,
        "%s%s%s calls itself: %s > %s; the stack of a recursion has no bound; make a loop of it",
        line != NULL ? line : "", line != NULL ? ": " : "", name, path, name);
    free(path);
    return false;
}

/* --- graph ---------------------------------------------------------------------------------- */

/* The nodes of a function by their addresses; 0: there is none yet. */
struct index {
    int node[HEX_CODE_SIZE];
};

/* What graph_settle works with. */
struct settling {
    struct flow *flow;
    struct function *function;
    struct index *index;
    int *queue; /* nodes before which less is known than when they were looked at */
    int queued, room;
};

static int add_node(struct settling *work, uint16_t address)
{
    struct function *function = work->function;

    if (work->index->node[address] != 0) {
        return work->index->node[address];
    }
    function->nodes =
        grow(function->nodes, function->node_count, &function->node_room, sizeof *function->nodes);
    function->nodes[function->node_count] = (struct node){.address = address, .depth = NONE};
    work->index->node[address] = function->node_count;
    return function->node_count++;
}

static void add_successor(struct function *function, int node)
{
    function->successors = grow(function->successors, function->successor_count,
                                &function->successor_room, sizeof(int));
    function->successors[function->successor_count++] = node;
}

/* Tells the node AT what is known on one of the ways to it. */
static void tell(struct settling *work, int at, const struct values *values)
{
    struct node *node = &work->function->nodes[at];

    if (node->before == NULL) {
        node->before = memory_get(1, sizeof *node->before);
    }
    if (values_merge(node->before, values) && !node->is_queued) {
        node->is_queued = true;
        work->queue = grow(work->queue, work->queued, &work->room, sizeof *work->queue);
        work->queue[work->queued++] = at;
    }
}

static bool follow_function(struct flow *flow, uint16_t entry, uint16_t call);

static bool follow_call(struct flow *flow, struct function *function, const struct node *node)
{
    const struct function *callee;

    if (!follow_function(flow, node->it.target, node->address)) {
        return false;
    }
    callee = flow->functions[node->it.target];
    if (node->depth + callee->stack > function->stack) {
        function->stack = node->depth + callee->stack;
        function->deepest = node->it.target;
    }
    return true;
}

void graph_step(const struct flow *flow, const struct node *node, struct values *values)
{
    const uint8_t *code = &flow->hex->code[node->address];

    if (node->it.writes_sp && code[0] == 0x75) { /* the start-up sets the stack pointer */
        return;
    }
    values_step(values, &flow->world, node->address);
    if (node->it.course == COURSE_CALL) {
        values_return(values, flow->functions[node->it.target]->is_changed);
    }
}

/* Notes that the start-up code sets the stack pointer. */
static bool note_stack_base(struct flow *flow, const struct node *node)
{
    int base = flow->hex->code[(uint16_t)(node->address + 2)];

    if ((flow->stack_base >= 0 && flow->stack_base != base) || node->depth != 0) {
        return graph_complain(flow, node->address,
                              "the stack pointer is set a second time; let "
                              "only the start-up code set it");
    }
    flow->stack_base = base;
    return true;
}

/* Notes what NODE does to the stack and to the priority of interrupts. Afterwards VALUES are those
 * behind it. */
static bool note_effects(struct flow *flow, struct function *function, const struct node *node,
                         struct values *values)
{
    const uint8_t *code = &flow->hex->code[node->address];
    int after;

    if (node->it.writes_sp && code[0] == 0x75 && !note_stack_base(flow, node)) {
        return false;
    }
    if (code[0] == 0xD2 && code[1] >= 0xB8 && code[1] <= 0xBD) { /* setb IP.n */
        flow->high |= (uint8_t)(1 << (code[1] - 0xB8));
    }
    if (node->it.course == COURSE_CALL && !follow_call(flow, function, node)) {
        return false;
    }
    graph_step(flow, node, values);
    after = values_depth(values);
    if (after < 0 || after > VALUES_DEPTH_MAX) {
        return graph_complain(
            flow, node->address,
            after == VALUES_LOST ? "the stack pointer is set to what is not known here; do without "
                                   "longjmp and without variables of changing size"
            : after < 0          ? "takes more from the stack than it has put there"
                                 : "this function has too much on the stack");
    }
    if (after > function->stack) {
        function->stack = after;
    }
    return true;
}

/* Returns whether the function ends with NODE. A jump to 0 starts the program again, which is taken
 * for a return; a `ret` with bytes left on the stack ends a switch. */
static bool is_end(const struct node *node)
{
    return (node->it.course == COURSE_RETURN && node->depth == 0) ||
           (node->it.course == COURSE_JUMP && node->it.target == 0);
}

/* Finds the addresses that may follow NODE, with the VALUES before it, and returns their number; 0:
 * they are not known. A `ret` that ends a switch takes its target from the stack. */
static int targets_of(const struct flow *flow, const struct node *node, const struct values *values,
                      uint16_t targets[VALUES_REPEATS])
{
    uint16_t next = (uint16_t)(node->address + node->it.bytes);

    switch (node->it.course) {
    case COURSE_ON:
    case COURSE_CALL:
        targets[0] = next;
        return 1;
    case COURSE_BRANCH:
        targets[0] = next;
        targets[1] = node->it.target;
        return 2;
    case COURSE_JUMP:
        targets[0] = node->it.target;
        return 1;
    case COURSE_RETURN:
        return values_targets(values, &flow->world, true, targets);
    case COURSE_SWITCH:
        return values_targets(values, &flow->world, false, targets);
    case COURSE_NONE:
        break;
    }
    return 0;
}

static bool complain_of_pointer(const struct flow *flow, const struct node *node)
{
    return graph_complain(
        flow, node->address,
        node->it.course == COURSE_NONE ? "0xA5 is no instruction"
        : node->it.course == COURSE_RETURN
            ? "returns with bytes left on the stack, or calls through a function pointer; call the "
              "function by its name"
            : "calls through a function pointer; call the function by its name");
}

/* Looks at the node AT with what is known before it, and tells its successors. */
static bool visit(struct settling *work, int at)
{
    struct flow *flow = work->flow;
    struct function *function = work->function;
    struct node node = function->nodes[at];
    struct values values = *node.before;
    uint16_t targets[VALUES_REPEATS];
    int count, depth = values_depth(&values);

    if (!flow->hex->used[node.address]) {
        return graph_complain(flow, node.address, "runs out of the code");
    }
    if (depth == VALUES_LOST) {
        return graph_complain(flow, node.address, "is reached with different stacks");
    }
    node.depth = depth;
    node.it = opcode_decode(flow->hex->code, node.address);
    node.returns = is_end(&node);
    count = node.returns ? 0 : targets_of(flow, &node, &values, targets);
    if (node.is_known ? count != node.count : count == 0 && !node.returns) {
        return complain_of_pointer(flow, &node);
    }
    if (!note_effects(flow, function, &node, &values)) {
        return false;
    }
    memset(&flow->is_code[node.address], true, node.it.bytes);
    if (!node.is_known) {
        node.first = function->successor_count;
        node.count = count;
        node.is_known = true;
        for (int i = 0; i < count; i++) {
            add_successor(function, add_node(work, targets[i]));
        }
    }
    function->nodes[at] = node;
    for (int i = 0; i < count; i++) {
        tell(work, function->successors[node.first + i], &values);
    }
    return true;
}

bool graph_settle(struct flow *flow, struct function *function)
{
    struct settling work = {.flow = flow, .function = function};
    struct values values;
    bool is_good = true;

    if (function->nodes[1].before != NULL) {
        return true;
    }
    work.index = memory_get(1, sizeof *work.index);
    work.index->node[function->nodes[1].address] = 1;
    values_enter(&values, &flow->world);
    tell(&work, 1, &values);
    while (work.queued > 0) {
        int at = work.queue[--work.queued];

        function->nodes[at].is_queued = false;
        is_good = is_good && visit(&work, at);
    }
    free(work.index);
    free(work.queue);
    return is_good;
}

void graph_forget(struct function *function)
{
    for (int i = 0; i < function->node_count; i++) {
        free(function->nodes[i].before);
        function->nodes[i].before = NULL;
    }
}

/* A function of which only the entry is known. */
static struct function *new_function(uint16_t entry)
{
    struct function *function = memory_get(1, sizeof *function);

    function->deepest = NONE;
    function->nodes = grow(NULL, 0, &function->node_room, sizeof *function->nodes);
    function->nodes[0] = (struct node){.address = entry, .count = 1};
    function->nodes[1] = (struct node){.address = entry, .depth = NONE};
    function->node_count = 2;
    add_successor(function, 1);
    return function;
}

static void free_function(struct function *function)
{
    graph_forget(function);
    free(function->nodes);
    free(function->successors);
    free(function);
}

/* CALL is where ENTRY is called from; 0: from nowhere. */
static bool follow_function(struct flow *flow, uint16_t entry, uint16_t call)
{
    struct function *function = flow->functions[entry];
    uint16_t caller = flow->entry;

    if (function != NULL) {
        return function->is_done || complain_of_recursion(flow, entry, call);
    }
    flow->callers[entry] = call;
    flow->owners[call] = caller;
    flow->entry = entry;
    flow->functions[entry] = function = new_function(entry);
    function->is_done = graph_settle(flow, function);
    flow->entry = caller;
    if (!function->is_done) {
        flow->functions[entry] = NULL;
        free_function(function);
        return false;
    }
    for (int i = 1; i < function->node_count; i++) {
        if (function->nodes[i].returns) {
            values_changed(function->nodes[i].before, function->is_changed);
        }
    }
    graph_forget(function);
    function->stack += FLOW_RETURN_ADDRESS;
    return true;
}

bool flow_interrupt(const struct flow *flow, int n, uint16_t *entry)
{
    const uint8_t *code = &flow->hex->code[8 * n + 3];

    *entry = (uint16_t)(code[1] << 8 | code[2]);
    return flow->vectors >> n & 1;
}

/* Returns whether the bytes at VECTOR are of the routines that SDCC 4.5 puts between the vectors,
 * for C11's atomic flags: they begin with these instructions, in a program without interrupts at
 * 8, and are 65 bytes long, so that they reach beyond the last vector. */
static bool is_atomic_routine(const struct hexfile *hex, uint16_t vector)
{
    static const uint8_t begin[] = {0x00, 0x00, 0xE2, 0xFB, 0xEA, 0xF2, 0x80, 0x2C,
                                    0x00, 0x00, 0xE0, 0xFB, 0xEA, 0xF0, 0x80, 0x24};

    for (int i = 3; i <= vector; i++) {
        if (memcmp(&hex->code[i], begin, sizeof begin) == 0) {
            return true;
        }
    }
    return false;
}

bool flow_follow(struct flow *flow)
{
    values_world_init(&flow->world, flow->hex->code);
    if (!flow->hex->used[0]) {
        diag_error(
            flow->path, 0,
            "no code at address 0, where an 8051 begins; give an image that starts by itself");
        return false;
    }
    if (!follow_function(flow, 0, 0)) {
        return false;
    }
    if (flow->stack_base < 0) {
        return graph_complain(flow, 0, "no start-up sets the stack pointer");
    }
    /* Where a vector is not used, a reti may stand, or nothing, or what the reset has led to. */
    for (int n = 0; n < FLOW_INTERRUPTS; n++) {
        uint16_t vector = (uint16_t)(8 * n + 3), entry;

        if (flow->is_code[vector] || flow->hex->code[vector] != 0x02 ||
            is_atomic_routine(flow->hex, vector)) {
            continue;
        }
        flow->vectors |= (uint8_t)(1 << n);
        flow_interrupt(flow, n, &entry);
        if (!follow_function(flow, entry, 0)) {
            return false;
        }
        for (int i = 0; i < VALUES_BYTES; i++) {
            flow->world.is_shared[i] |= flow->functions[entry]->is_changed[i];
        }
    }
    return true;
}

bool flow_follow_function(struct flow *flow, uint16_t entry)
{
    return follow_function(flow, entry, 0);
}

int flow_stack(const struct flow *flow, uint16_t entry)
{
    return flow->functions[entry]->stack;
}

long flow_deepest(const struct flow *flow, uint16_t entry)
{
    return flow->functions[entry]->deepest;
}

void flow_init(struct flow *flow, const struct hexfile *hex, const struct listing *listing,
               const char *path)
{
    memset(flow, 0, sizeof *flow);
    flow->hex = hex;
    flow->listing = listing;
    flow->path = path;
    flow->stack_base = -1;
    flow->steps_max = 2000000;
}

void flow_free(struct flow *flow)
{
    for (int i = 0; i < HEX_CODE_SIZE; i++) {
        if (flow->functions[i] != NULL) {
            free_function(flow->functions[i]);
        }
    }
}
