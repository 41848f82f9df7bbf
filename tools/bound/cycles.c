/* SPDX-License-Identifier: MIT */
/* The longest time through a function: the longest path, loops taken as often as they can turn. */
#include "flow.h"

#include "diag.h"
#include "graph.h"
#include "memory.h"
#include "rounds.h"

#include <stdlib.h>
#include <string.h>

/* The search for the longest path through part of a function. */
struct search {
    struct flow *flow;
    uint16_t entry;
    struct function *function;
    int *part; /* of each node: the header of the innermost loop that holds it, as far as the search
                  has come; 0, the node that is no instruction: none */
    bool *is_claimed; /* its source line's `rounds:` is another loop's */
    long endless;     /* cycles of one turn of the longest endless loop; 0: there is none */
};

/* Of a node: the number of its visit, 0 before it, and the least one of its component that is known
 * yet. */
struct mark {
    int order, low;
    bool is_sorted;
};

/* Strongly connected components of the part with this header, by Tarjan's algorithm. */
struct components {
    const struct search *search;
    int header; /* edges back to it do not count */
    struct mark *marks;
    int *stack, *sorted; /* sorted: nodes, the components one after another, last ones first */
    int *begins;         /* of each component: its place in sorted */
    int visited, depth, count, sorted_count;
};

static bool is_edge(const struct components *found, int to)
{
    return to != found->header && found->search->part[to] == found->header;
}

static void visit(struct components *found, int at)
{
    const struct function *function = found->search->function;
    const struct node *node = &function->nodes[at];
    struct mark *marks = found->marks;

    marks[at].order = marks[at].low = ++found->visited;
    found->stack[found->depth++] = at;
    for (int i = node->first; i < node->first + node->count; i++) {
        int to = function->successors[i];

        if (!is_edge(found, to)) {
            continue;
        }
        if (marks[to].order == 0) {
            visit(found, to);
        }
        if (!marks[to].is_sorted && marks[to].low < marks[at].low) {
            marks[at].low = marks[to].low;
        }
    }
    if (marks[at].low < marks[at].order) {
        return;
    }
    found->begins[found->count++] = found->sorted_count;
    do {
        int member = found->stack[--found->depth];

        marks[member].is_sorted = true;
        found->sorted[found->sorted_count++] = member;
    } while (found->stack[found->depth] != at);
}

static bool longest(struct search *search, int header, long *dist);

static bool goes_to(const struct function *function, int from, int to)
{
    const struct node *node = &function->nodes[from];

    for (int i = node->first; i < node->first + node->count; i++) {
        if (function->successors[i] == to) {
            return true;
        }
    }
    return false;
}

static bool is_loop(const struct components *found, const int *members, int count)
{
    int first = *members;

    return count > 1 || (first != found->header && goes_to(found->search->function, first, first));
}

/* Returns whether a round of a loop begins or ends with the instruction AT: AT is the loop's
 * header, or a jump back to the header. */
static bool is_turning(const struct search *search, int at, int header)
{
    return at == header || goes_to(search->function, at, header);
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

static bool is_on(const struct search *search, int at, const char *place)
{
    const char *own = search->flow->listing->places[search->function->nodes[at].address];

    return own != NULL && strcmp(own, place) == 0;
}

/* Returns whether the loop of these nodes is left from the source line PLACE. */
static bool is_left_from(const struct search *search, const int *members, int count,
                         const char *place)
{
    for (int i = 0; i < count; i++) {
        const struct node *node = &search->function->nodes[members[i]];

        for (int k = node->first; is_on(search, members[i], place) && k < node->first + node->count;
             k++) {
            bool is_inside = false;

            for (int m = 0; m < count; m++) {
                is_inside = is_inside || members[m] == search->function->successors[k];
            }
            if (!is_inside) {
                return true;
            }
        }
    }
    return false;
}

/* Finds the source line whose `rounds:` bounds the loop of these nodes: that of an instruction with
 * which a round begins or ends. *PLACE stays NULL if there is none. */
static bool find_line(const struct search *search, const int *members, int count, int header,
                      const char **place, long *rounds)
{
    const struct listing *listing = search->flow->listing;

    for (int i = 0; i < count; i++) {
        uint16_t address = search->function->nodes[members[i]].address;

        if (search->is_claimed[members[i]] || listing->rounds[address] == LISTING_NO_BOUND ||
            !is_turning(search, members[i], header)) {
            continue;
        }
        if (*place != NULL && !is_on(search, members[i], *place)) {
            return graph_complain(search->flow, address,
                                  "two lines with `rounds:` for one loop; keep one");
        }
        *place = listing->places[address];
        *rounds = listing->rounds[address];
    }
    return true;
}

/* Returns a jump back to the HEADER that the line PLACE with its `rounds:` does not bound; NONE: it
 * bounds the loop. Two loops may begin with one instruction: so where several jumps lead back, the
 * line must be that of each of them, or that by which the loop is entered and left. */
static int find_unbounded(const struct search *search, const int *members, int count, int header,
                          const char *place)
{
    int jumps = 0, unbounded = NONE;

    for (int i = 0; i < count; i++) {
        if (goes_to(search->function, members[i], header)) {
            jumps++;
            unbounded = is_on(search, members[i], place) ? unbounded : members[i];
        }
    }
    return jumps == 1 ||
                   (is_on(search, header, place) && is_left_from(search, members, count, place))
               ? NONE
               : unbounded;
}

/* Finds how many rounds the loop of these nodes has at most: what the `rounds:` comment on the
 * source line of its condition says, or what the program counts itself, with constants. A comment
 * is valid for one loop, the innermost one on its line. */
static bool find_rounds(struct search *search, const int *members, int count, int header,
                        long *rounds)
{
    const struct function *function = search->function;
    const char *place = NULL;
    int unbounded;

    if (!find_line(search, members, count, header, &place, rounds)) {
        return false;
    }
    if (place == NULL) {
        if (!graph_settle(search->flow, search->function)) {
            return false;
        }
        *rounds = rounds_count(search->flow, function, members, count, header);
        return *rounds >= 0 || find_given(search, function->nodes[header].address, rounds);
    }
    unbounded = find_unbounded(search, members, count, header, place);
    if (unbounded != NONE) {
        return complain_of_loop(search, function->nodes[unbounded].address);
    }
    for (int i = 0; i < function->node_count; i++) {
        search->is_claimed[i] |= is_on(search, i, place);
    }
    return true;
}

static bool is_endless(const struct search *search, const int *members, int count, int header)
{
    for (int i = 0; i < count; i++) {
        const struct node *node = &search->function->nodes[members[i]];

        for (int k = node->first; k < node->first + node->count; k++) {
            if (search->part[search->function->successors[k]] != header) {
                return false;
            }
        }
    }
    return true;
}

/* The most cycles of a round of the loop with this HEADER; DIST as longest has found it. */
static long longest_round(const struct function *function, int header, const long *dist)
{
    long round = 0;

    for (int i = 0; i < function->node_count; i++) {
        if (dist[i] > round && goes_to(function, i, header)) {
            round = dist[i];
        }
    }
    return round;
}

/* The longest paths through the loop of these nodes. dist is known at the loop's header. The
 * longest round is taken as often as the source says, then the way out of the loop. */
static bool pass_loop(struct search *search, const int *members, int count, int header, long *dist)
{
    const struct function *function = search->function;
    long *inner_dist = memory_get((size_t)function->node_count, sizeof *inner_dist);
    long rounds = 1, round, before = dist[header];
    bool is_good, never_ends;

    for (int i = 0; i < count; i++) {
        search->part[members[i]] = header;
    }
    never_ends = is_endless(search, members, count, header);
    is_good = longest(search, header, inner_dist) &&
              (never_ends || find_rounds(search, members, count, header, &rounds));
    round = longest_round(function, header, inner_dist);
    if (never_ends && round > search->endless) {
        search->endless = round;
    }
    for (int i = 0; i < count; i++) {
        dist[members[i]] = before + rounds * round + inner_dist[members[i]];
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

/* Extends the path that ends in AT to the successors of AT; those in a loop that has been passed
 * are in another part now. */
static void relax(const struct components *found, int at, long *dist)
{
    const struct function *function = found->search->function;
    const struct node *node = &function->nodes[at];

    for (int i = node->first; i < node->first + node->count; i++) {
        int to = function->successors[i];

        if (is_edge(found, to) && dist[at] > dist[to]) {
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

/* Passes the components of FOUND in their order: DIST of the header is set. */
static bool pass_components(struct search *search, const struct components *found, long *dist)
{
    int end = found->sorted_count;

    for (int i = found->count; i-- > 0;) {
        int begin = found->begins[i];

        if (!pass_component(search, found, &found->sorted[begin], end - begin, dist)) {
            return false;
        }
        for (int k = begin; k < end; k++) {
            relax(found, found->sorted[k], dist);
        }
        end = begin;
    }
    return true;
}

/* Finds for each node of the part with this HEADER dist, the most cycles from the start of HEADER
 * to the end of the node; of other nodes NONE. */
static bool longest(struct search *search, int header, long *dist)
{
    size_t nodes = (size_t)search->function->node_count;
    struct components found = {.search = search, .header = header};
    bool is_good;

    found.marks = memory_get(nodes, sizeof *found.marks);
    found.stack = memory_get(nodes, sizeof *found.stack);
    found.sorted = memory_get(nodes, sizeof *found.sorted);
    found.begins = memory_get(nodes, sizeof *found.begins);
    for (size_t i = 0; i < nodes; i++) {
        dist[i] = NONE;
    }
    visit(&found, header);
    dist[header] = 0;
    is_good = pass_components(search, &found, dist);
    free(found.marks);
    free(found.stack);
    free(found.sorted);
    free(found.begins);
    return is_good;
}

/* CYCLES become those of the longest way to a return, and are kept for the next caller. */
static bool take_way_out(const struct search *search, const long *dist, long *cycles)
{
    struct function *function = search->function;

    *cycles = 0;
    for (int i = 0; i < function->node_count; i++) {
        if (function->nodes[i].returns && dist[i] > *cycles) {
            *cycles = dist[i];
        }
    }
    if (*cycles == 0) {
        return graph_complain(search->flow, search->entry, "never returns");
    }
    function->cycles = *cycles;
    return true;
}

static bool take_round(const struct search *search, long *cycles)
{
    *cycles = search->endless;
    return *cycles != 0 ||
           graph_complain(search->flow, search->entry, "has no endless loop to take a round of");
}

bool flow_cycles(struct flow *flow, uint16_t entry, bool is_round, long *cycles)
{
    struct function *function;
    struct search search = {.flow = flow, .entry = entry};
    uint16_t caller = flow->entry;
    long *dist;
    bool is_good;

    if (!flow_follow_function(flow, entry)) { /* nothing but a jump may have led to it */
        return false;
    }
    search.function = function = flow->functions[entry];
    if (function->cycles != 0 && !is_round) {
        *cycles = function->cycles;
        return true;
    }
    flow->entry = entry;
    dist = memory_get((size_t)function->node_count, sizeof *dist);
    search.part = memory_get((size_t)function->node_count, sizeof *search.part);
    search.is_claimed = memory_get((size_t)function->node_count, sizeof *search.is_claimed);
    is_good = longest(&search, 0, dist) &&
              (is_round ? take_round(&search, cycles) : take_way_out(&search, dist, cycles));
    flow->entry = caller;
    free(dist);
    free(search.part);
    free(search.is_claimed);
    return is_good;
}
