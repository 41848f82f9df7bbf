/* SPDX-License-Identifier: MIT */
#include "flow.h"

#include "diag.h"
#include "opcode.h"

#include <stdlib.h>
#include <string.h>

enum { SUCCESSORS = 64, NONE = -1 };

/* One instruction of a function. */
struct node {
    uint16_t address;
    struct instruction it;
    int depth;        /* bytes on the stack before it, of this function's own */
    int first, count; /* its successors */
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
    bool is_done;
    long cycles; /* NONE: not known yet */
};

static void *grow(void *array, int count, int *room, size_t size)
{
    if (count < *room) {
        return array;
    }
    *room = *room == 0 ? 64 : 2 * *room;
    array = realloc(array, (size_t)*room * size);
    if (array == NULL) {
        abort();
    }
    return array;
}

static const char *place(const struct flow *flow, uint16_t address)
{
    return flow->listing->places[address] != NULL ? flow->listing->places[address]
                                                  : listing_name(flow->listing, address);
}

static bool complain(const struct flow *flow, uint16_t address, const char *what)
{
    diag_error(flow->path, 0, "at 0x%04X (%s): %s", address, place(flow, address), what);
    return false;
}

/* --- graph ----------------------------------------------------------------------------------- */

static int add_node(struct function *function, int16_t *index, uint16_t address, int depth)
{
    if (index[address] != NONE) {
        return index[address];
    }
    function->nodes =
        grow(function->nodes, function->node_count, &function->node_room, sizeof *function->nodes);
    function->nodes[function->node_count] = (struct node){.address = address, .depth = depth};
    index[address] = (int16_t)function->node_count;
    return function->node_count++;
}

static void add_successor(struct function *function, int node)
{
    function->successors = grow(function->successors, function->successor_count,
                                &function->successor_room, sizeof(int));
    function->successors[function->successor_count++] = node;
}

/* The targets of `jmp @a+dptr`. SDCC uses it for switch: dptr points to a table of ljmp behind it.
 */
static int switch_targets(const struct flow *flow, uint16_t address, uint16_t targets[SUCCESSORS])
{
    const uint8_t *code = flow->hex->code;
    uint16_t table = (uint16_t)(address + 1);
    int count = 0;

    if (code[(uint16_t)(address - 3)] != 0x90 || /* mov dptr,#table */
        (code[(uint16_t)(address - 2)] << 8 | code[(uint16_t)(address - 1)]) != table) {
        return 0;
    }
    while (count < SUCCESSORS && code[table] == 0x02) {
        targets[count++] = table;
        table = (uint16_t)(table + 3);
    }
    return count;
}

static bool follow_function(struct flow *flow, uint16_t entry);

static bool follow_call(struct flow *flow, struct function *function, const struct node *node)
{
    const struct function *callee;

    if (!follow_function(flow, node->it.target)) {
        return false;
    }
    callee = flow->functions[node->it.target];
    if (node->depth + callee->stack > function->stack) {
        function->stack = node->depth + callee->stack;
        function->deepest = node->it.target;
    }
    return true;
}

/* Notes what NODE does to the stack pointer and to the priority of interrupts. */
static bool note_effects(struct flow *flow, struct function *function, const struct node *node)
{
    const uint8_t *code = &flow->hex->code[node->address];

    if (node->it.writes_sp) {
        if (code[0] != 0x75 || (flow->stack_base >= 0 && flow->stack_base != code[2]) ||
            node->depth != 0) {
            return complain(
                flow, node->address,
                "the stack pointer is moved; use no variable arguments and no --stack-auto");
        }
        flow->stack_base = code[2];
    }
    if (code[0] == 0xD2 && code[1] >= 0xB8 && code[1] <= 0xBD) { /* setb IP.n */
        flow->high |= (uint8_t)(1 << (code[1] - 0xB8));
    }
    if (node->depth + node->it.push > function->stack) {
        function->stack = node->depth + node->it.push;
    }
    if (node->depth + node->it.push < 0) {
        return complain(flow, node->address, "pops what it has not pushed");
    }
    if (node->it.course == COURSE_RETURN && node->depth != 0) {
        return complain(flow, node->address, "returns with bytes left on the stack");
    }
    return node->it.course != COURSE_CALL || follow_call(flow, function, node);
}

/* Finds the instructions that may follow NODE. */
static int targets_of(const struct flow *flow, const struct node *node,
                      uint16_t targets[SUCCESSORS])
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
        return 0;
    case COURSE_UNKNOWN:
        break;
    }
    return switch_targets(flow, node->address, targets);
}

static bool follow_node(struct flow *flow, struct function *function, int16_t *index, int at)
{
    uint16_t targets[SUCCESSORS];
    struct node node = function->nodes[at];
    int count;

    if (!flow->hex->used[node.address]) {
        return complain(flow, node.address, "runs out of the code");
    }
    node.it = opcode_decode(flow->hex->code, node.address);
    if (!note_effects(flow, function, &node)) {
        return false;
    }
    count = targets_of(flow, &node, targets);
    if (node.it.course == COURSE_UNKNOWN && count == 0) {
        return complain(flow, node.address,
                        "jumps or calls through a pointer; call the function by its name");
    }
    memset(&flow->is_code[node.address], true, node.it.bytes);
    node.first = function->successor_count;
    node.count = count;
    function->nodes[at] = node;
    for (int i = 0; i < count; i++) {
        int next = add_node(function, index, targets[i], node.depth + node.it.push);

        if (function->nodes[next].depth != node.depth + node.it.push) {
            return complain(flow, targets[i], "is reached with different stacks");
        }
        add_successor(function, next);
    }
    return true;
}

static bool follow_function(struct flow *flow, uint16_t entry)
{
    struct function *function = flow->functions[entry];
    int16_t *index;
    bool is_good = true;

    if (function != NULL) {
        return function->is_done ||
               complain(flow, entry, "calls itself; a function on this chip has one set of locals");
    }
    function = calloc(1, sizeof *function);
    index = malloc(HEX_CODE_SIZE * sizeof *index);
    if (function == NULL || index == NULL) {
        abort();
    }
    memset(index, 0xFF, HEX_CODE_SIZE * sizeof *index); /* NONE */
    flow->functions[entry] = function;
    function->deepest = NONE;
    function->cycles = NONE;
    add_node(function, index, entry, 0);
    index[entry] = NONE;
    function->nodes[0].count = 1;
    add_successor(function, add_node(function, index, entry, 0));
    for (int i = 1; i < function->node_count && is_good; i++) {
        is_good = follow_node(flow, function, index, i);
    }
    free(index);
    function->stack += FLOW_RETURN_ADDRESS;
    function->is_done = is_good;
    return is_good;
}

bool flow_interrupt(const struct flow *flow, int n, uint16_t *entry)
{
    const uint8_t *code = &flow->hex->code[8 * n + 3];

    *entry = (uint16_t)(code[1] << 8 | code[2]);
    return flow->vectors >> n & 1;
}

bool flow_follow(struct flow *flow)
{
    if (!follow_function(flow, 0)) {
        return false;
    }
    if (flow->stack_base < 0) {
        return complain(flow, 0, "no start-up sets the stack pointer");
    }
    /* Where a vector is not used, a reti may stand, or nothing, or what the reset has led to. */
    for (int n = 0; n < FLOW_INTERRUPTS; n++) {
        uint16_t vector = (uint16_t)(8 * n + 3), entry;

        if (!flow->hex->used[vector] || flow->is_code[vector] || flow->hex->code[vector] != 0x02) {
            continue;
        }
        flow->vectors |= (uint8_t)(1 << n);
        flow_interrupt(flow, n, &entry);
        if (!follow_function(flow, entry)) {
            return false;
        }
    }
    return true;
}

int flow_stack(const struct flow *flow, uint16_t entry)
{
    return flow->functions[entry]->stack;
}

long flow_deepest(const struct flow *flow, uint16_t entry)
{
    return flow->functions[entry]->deepest;
}

/* --- cycles ---------------------------------------------------------------------------------- */

/* The search for the longest path through part of a function. */
struct search {
    struct flow *flow;
    uint16_t entry;
    const struct function *function;
    int *part; /* of each node: the innermost loop under way that holds it; 0: the function */
    int parts;
    bool *is_claimed; /* its source line's `rounds:` is another loop's */
    long endless;     /* cycles of one turn of the endless loop; NONE: no such loop */
};

/* Strongly connected components of one part, by Tarjan's algorithm. */
struct components {
    const struct search *search;
    int part, header; /* edges back to the header do not count */
    int *order, *low, *component;
    int *stack, *sorted; /* sorted: nodes, the components one after another, last ones first */
    int visited, depth, count, sorted_count;
};

static bool is_edge(const struct components *found, int to)
{
    return to != found->header && found->search->part[to] == found->part;
}

static void visit(struct components *found, int at)
{
    const struct function *function = found->search->function;
    const struct node *node = &function->nodes[at];

    found->order[at] = found->low[at] = ++found->visited;
    found->stack[found->depth++] = at;
    for (int i = node->first; i < node->first + node->count; i++) {
        int to = function->successors[i];

        if (!is_edge(found, to)) {
            continue;
        }
        if (found->order[to] == 0) {
            visit(found, to);
        }
        if (found->component[to] == NONE && found->low[to] < found->low[at]) {
            found->low[at] = found->low[to];
        }
    }
    if (found->low[at] < found->order[at]) {
        return;
    }
    do {
        int member = found->stack[--found->depth];

        found->component[member] = found->count;
        found->sorted[found->sorted_count++] = member;
    } while (found->stack[found->depth] != at);
    found->count++;
}

static bool longest(struct search *search, int part, int header, long *dist, long *turn);

static bool is_loop(const struct components *found, const int *members, int count)
{
    const struct function *function = found->search->function;
    const struct node *node = &function->nodes[members[0]];

    if (count > 1) {
        return true;
    }
    for (int i = node->first; i < node->first + node->count; i++) {
        if (function->successors[i] == members[0] && members[0] != found->header) {
            return true;
        }
    }
    return false;
}

/* Returns whether a round of a loop begins or ends with the instruction AT: AT is the loop's
 * header, or a jump back to the header. */
static bool is_turning(const struct search *search, int at, int header)
{
    const struct node *node = &search->function->nodes[at];

    for (int i = node->first; i < node->first + node->count; i++) {
        if (search->function->successors[i] == header) {
            return true;
        }
    }
    return at == header;
}

/* The function that the code at ADDRESS is part of: the last name before it. It is not always the
 * function that was called, because a function may end with a jump to another one. */
static uint16_t owner_of(const struct flow *flow, uint16_t address)
{
    while (flow->listing->names[address] == NULL && address != 0) {
        address--;
    }
    return address;
}

/* The source line that leads to the function OWNER, whose code the search came to: that of the jump
 * in the function itself, or else that of the last call with a source line. NULL: none is known. */
static const char *leading_line(const struct search *search, uint16_t owner)
{
    const struct flow *flow = search->flow;
    uint16_t caller = flow->callers[search->entry];

    for (int i = 1; i < search->function->node_count && owner != search->entry; i++) {
        const struct node *node = &search->function->nodes[i];

        if (node->it.target == owner && flow->listing->places[node->address] != NULL) {
            return flow->listing->places[node->address];
        }
    }
    while (caller != 0 && flow->listing->places[caller] == NULL) {
        caller = flow->callers[flow->owners[caller]];
    }
    return flow->listing->places[caller];
}

/* The loop at ADDRESS has no bound. A function of SDCC's library has no source line: the message
 * names the function, and the line of ours that leads to it. */
static bool complain_of_loop(const struct search *search, uint16_t address)
{
    const struct flow *flow = search->flow;
    uint16_t owner = owner_of(flow, address);
    const char *line = flow->listing->places[address], *name = listing_name(flow->listing, owner);

    if (line != NULL) {
        diag_error(flow->path, 0,
                   "at 0x%04X (%s): a loop without a bound; write /* rounds: N */ on the line of "
                   "its condition, or give --loop=%s:N",
                   address, line, name);
        return false;
    }
    line = leading_line(search, owner);
    diag_error(
        flow->path, 0,
        "%s%s%s: a loop without a bound; do without this call, or give --loop=%s:N, the most "
        "rounds of each of its loops",
        name, line != NULL ? ", called at " : "", line != NULL ? line : "", name);
    return false;
}

/* Finds how many rounds the loop of these nodes has at most: the `rounds:` comment on the source
 * line of its condition. A comment is valid for one loop, the innermost one on its line. */
static bool find_rounds(struct search *search, const int *members, int count, int header,
                        long *rounds)
{
    const struct listing *listing = search->flow->listing;
    const struct node *nodes = search->function->nodes;
    const char *turn = NULL;

    *rounds = LISTING_NO_BOUND;
    for (int i = 0; i < count; i++) {
        uint16_t address = nodes[members[i]].address;

        if (search->is_claimed[members[i]] || listing->rounds[address] == LISTING_NO_BOUND ||
            !is_turning(search, members[i], header)) {
            continue;
        }
        if (*rounds != LISTING_NO_BOUND && *rounds != listing->rounds[address]) {
            return complain(search->flow, address,
                            "two different `rounds:` for one loop; keep one");
        }
        *rounds = listing->rounds[address];
        turn = listing->places[address];
    }
    if (turn == NULL) {
        uint16_t address = nodes[header].address;

        *rounds = search->flow->rounds[owner_of(search->flow, address)];
        return *rounds > 0 || complain_of_loop(search, address);
    }
    for (int i = 0; i < search->function->node_count; i++) {
        const char *other = listing->places[nodes[i].address];

        if (other != NULL && strcmp(other, turn) == 0) {
            search->is_claimed[i] = true;
        }
    }
    return true;
}

static bool is_endless(const struct search *search, const int *members, int count, int inner)
{
    for (int i = 0; i < count; i++) {
        const struct node *node = &search->function->nodes[members[i]];

        if (node->it.course == COURSE_RETURN) {
            return false;
        }
        for (int k = node->first; k < node->first + node->count; k++) {
            if (search->part[search->function->successors[k]] != inner) {
                return false;
            }
        }
    }
    return true;
}

/* The longest paths through the loop of these nodes. dist is known at the loop's header. The
 * longest round is taken as often as the source says, then the way out of the loop. */
static bool pass_loop(struct search *search, const int *members, int count, int header, long *dist)
{
    int outer = search->part[header], inner = ++search->parts;
    long *inner_dist = malloc((size_t)search->function->node_count * sizeof *inner_dist);
    long rounds = 1, turn, before = dist[header];
    bool is_good, never_ends;

    if (inner_dist == NULL) {
        abort();
    }
    for (int i = 0; i < count; i++) {
        search->part[members[i]] = inner;
    }
    never_ends = is_endless(search, members, count, inner);
    is_good = longest(search, inner, header, inner_dist, &turn) &&
              (never_ends || find_rounds(search, members, count, header, &rounds));
    if (is_good && never_ends) {
        search->endless = turn;
    }
    for (int i = 0; i < count && is_good; i++) {
        dist[members[i]] = before + rounds * turn + inner_dist[members[i]];
    }
    for (int i = 0; i < count; i++) {
        search->part[members[i]] = outer;
    }
    free(inner_dist);
    return is_good;
}

/* Cycles of one instruction, with those of the function that it calls. */
static bool cost(struct search *search, int at, long *cycles)
{
    const struct node *node = &search->function->nodes[at];
    long callee = 0;

    if (node->it.course == COURSE_CALL) {
        search->flow->callers[node->it.target] = node->address;
        search->flow->owners[node->address] = search->entry;
        if (!flow_cycles(search->flow, node->it.target, false, &callee)) {
            return false;
        }
    }
    *cycles = node->it.cycles + callee;
    return true;
}

/* Extends the path that ends in AT to the successors of AT outside its component. */
static void relax(const struct components *found, int at, long *dist)
{
    const struct function *function = found->search->function;
    const struct node *node = &function->nodes[at];

    for (int i = node->first; i < node->first + node->count; i++) {
        int to = function->successors[i];

        if (is_edge(found, to) && found->component[to] != found->component[at] &&
            dist[at] > dist[to]) {
            dist[to] = dist[at];
        }
    }
}

/* One component: before, dist is the longest time up to each of its nodes; afterwards, the longest
 * time to the end of each. */
static bool pass_component(struct search *search, const struct components *found,
                           const int *members, int count, long *dist)
{
    long cycles;
    int header = NONE;

    if (!is_loop(found, members, count)) {
        if (!cost(search, members[0], &cycles)) {
            return false;
        }
        dist[members[0]] += cycles;
        return true;
    }
    for (int i = 0; i < count; i++) {
        if (dist[members[i]] < 0) {
            continue;
        }
        if (header != NONE) {
            return complain(search->flow, search->function->nodes[members[i]].address,
                            "a loop with two entries; take the jump into it away");
        }
        header = members[i];
    }
    return pass_loop(search, members, count, header, dist);
}

/* Finds for each node of the PART dist, the most cycles from the start of HEADER to the end of the
 * node; and turn, the most cycles from HEADER back to HEADER, 0 if there is no way back. */
static bool longest(struct search *search, int part, int header, long *dist, long *turn)
{
    int nodes = search->function->node_count;
    struct components found = {.search = search, .part = part, .header = header};
    int *room = calloc((size_t)nodes * 5, sizeof *room);
    bool is_good = true;

    if (room == NULL) {
        abort();
    }
    found.order = room;
    found.low = room + nodes;
    found.component = room + 2 * nodes;
    found.stack = room + 3 * nodes;
    found.sorted = room + 4 * nodes;
    for (int i = 0; i < nodes; i++) {
        found.component[i] = NONE;
        dist[i] = NONE;
    }
    visit(&found, header);
    dist[header] = 0;
    for (int end = found.sorted_count; end > 0 && is_good;) {
        int begin = end - 1;

        while (begin > 0 &&
               found.component[found.sorted[begin - 1]] == found.component[found.sorted[begin]]) {
            begin--;
        }
        is_good = pass_component(search, &found, &found.sorted[begin], end - begin, dist);
        for (int i = begin; i < end && is_good; i++) {
            relax(&found, found.sorted[i], dist);
        }
        end = begin;
    }
    *turn = 0;
    for (int i = 0; i < nodes && is_good; i++) {
        const struct node *node = &search->function->nodes[i];

        for (int k = node->first; k < node->first + node->count; k++) {
            if (search->function->successors[k] == header && search->part[i] == part &&
                dist[i] > *turn) {
                *turn = dist[i];
            }
        }
    }
    free(room);
    return is_good;
}

bool flow_cycles(struct flow *flow, uint16_t entry, bool is_round, long *cycles)
{
    struct function *function;
    struct search search = {.flow = flow, .entry = entry, .endless = NONE};
    long *dist, turn;
    bool is_good;

    if (!follow_function(flow, entry)) { /* nothing but a jump may have led to it */
        return false;
    }
    search.function = function = flow->functions[entry];
    if (function->cycles != NONE && !is_round) {
        *cycles = function->cycles;
        return true;
    }
    dist = malloc((size_t)function->node_count * sizeof *dist);
    search.part = calloc((size_t)function->node_count, sizeof *search.part);
    search.is_claimed = calloc((size_t)function->node_count, sizeof *search.is_claimed);
    if (dist == NULL || search.part == NULL || search.is_claimed == NULL) {
        abort();
    }
    is_good = longest(&search, 0, 0, dist, &turn);
    *cycles = 0;
    for (int i = 0; i < function->node_count && is_good; i++) {
        if (function->nodes[i].it.course == COURSE_RETURN && dist[i] > *cycles) {
            *cycles = dist[i];
        }
    }
    if (is_good && is_round) {
        *cycles = search.endless;
        is_good = search.endless != NONE ||
                  complain(flow, entry, "has no endless loop to take a round of");
    } else if (is_good && search.endless != NONE) {
        is_good = complain(flow, entry, "never returns");
    } else if (is_good) {
        function->cycles = *cycles;
    }
    free(dist);
    free(search.part);
    free(search.is_claimed);
    return is_good;
}

void flow_init(struct flow *flow, const struct hexfile *hex, const struct listing *listing,
               const char *path)
{
    memset(flow, 0, sizeof *flow);
    flow->hex = hex;
    flow->listing = listing;
    flow->path = path;
    flow->stack_base = -1;
}

void flow_free(struct flow *flow)
{
    for (int i = 0; i < HEX_CODE_SIZE; i++) {
        if (flow->functions[i] == NULL) {
            continue;
        }
        free(flow->functions[i]->nodes);
        free(flow->functions[i]->successors);
        free(flow->functions[i]);
    }
}
