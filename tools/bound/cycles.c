/* SPDX-License-Identifier: MIT */
/* The longest time through a function: the longest path, loops taken as often as they can turn. */
#include "flow.h"

#include "diag.h"
#include "graph.h"
#include "rounds.h"

#include <stdlib.h>
#include <string.h>

/* The search for the longest path through part of a function. */
struct search {
    struct flow *flow;
    uint16_t entry;
    struct function *function;
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

/* The loop at ADDRESS has no bound. A function of SDCC's library has no source line: the message
 * names the function, and the line of ours that leads to it. */
static bool complain_of_loop(const struct search *search, uint16_t address)
{
    const struct flow *flow = search->flow;
    uint16_t owner = graph_owner(flow, address);
    const char *line = flow->listing->places[address], *name = listing_name(flow->listing, owner);

    if (line != NULL) {
        diag_error(flow->path, 0,
                   "at 0x%04X (%s): a loop without a bound; write /* rounds: N */ on the line of "
                   "its condition, or give --loop=%s:N",
                   address, line, name);
        return false;
    }
    line = graph_leading_line(flow, owner);
    diag_error(
        flow->path, 0,
        "%s%s%s: a loop without a bound; avoid the call, or give --loop=%s:N, the most rounds of "
        "each of its loops",
        name, line != NULL ? ", called at " : "", line != NULL ? line : "", name);
    return false;
}

/* The program counts the rounds itself, with constants. */
static bool find_counted(struct search *search, const int *members, int count, int header,
                         long *rounds)
{
    if (search->function->before == NULL && !graph_settle(search->flow, search->function)) {
        return false;
    }
    *rounds = rounds_count(search->flow, search->function, members, count, header);
    return *rounds >= 0;
}

/* --loop, or what is known of SDCC's library, bounds the loop at ADDRESS. */
static bool find_given(const struct search *search, uint16_t address, long *rounds)
{
    const struct flow *flow = search->flow;
    uint16_t owner = graph_owner(flow, address);

    *rounds = flow->rounds[owner];
    if (*rounds == 0 && flow->listing->places[address] == NULL) {
        *rounds = rounds_of_library(listing_name(flow->listing, owner));
    }
    return *rounds > 0 || complain_of_loop(search, address);
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
            return graph_complain(search->flow, address,
                                  "two different `rounds:` for one loop; keep one");
        }
        *rounds = listing->rounds[address];
        turn = listing->places[address];
    }
    if (turn == NULL) {
        return find_counted(search, members, count, header, rounds) ||
               find_given(search, nodes[header].address, rounds);
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

        if (node->returns) {
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
    if (is_good && never_ends && turn > search->endless) {
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
            return graph_complain(search->flow, search->function->nodes[members[i]].address,
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
    uint16_t caller = flow->entry;
    long *dist, turn;
    bool is_good;

    if (!flow_follow_function(flow, entry)) { /* nothing but a jump may have led to it */
        return false;
    }
    search.function = function = flow->functions[entry];
    if (function->cycles != NONE && !is_round) {
        *cycles = function->cycles;
        return true;
    }
    flow->entry = entry;
    dist = malloc((size_t)function->node_count * sizeof *dist);
    search.part = calloc((size_t)function->node_count, sizeof *search.part);
    search.is_claimed = calloc((size_t)function->node_count, sizeof *search.is_claimed);
    if (dist == NULL || search.part == NULL || search.is_claimed == NULL) {
        abort();
    }
    is_good = longest(&search, 0, 0, dist, &turn);
    *cycles = 0;
    for (int i = 0; i < function->node_count && is_good; i++) {
        if (function->nodes[i].returns && dist[i] > *cycles) {
            *cycles = dist[i];
        }
    }
    if (is_good && is_round) {
        *cycles = search.endless;
        is_good = search.endless != NONE ||
                  graph_complain(flow, entry, "has no endless loop to take a round of");
    } else if (is_good && *cycles == 0) {
        is_good = graph_complain(flow, entry, "never returns");
    } else if (is_good) {
        function->cycles = *cycles;
    }
    flow->entry = caller;
    graph_forget(function);
    free(dist);
    free(search.part);
    free(search.is_claimed);
    return is_good;
}
