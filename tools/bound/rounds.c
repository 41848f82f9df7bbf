/* SPDX-License-Identifier: MIT */
#include "rounds.h"

#include <stdlib.h>
#include <string.h>

#ifndef BOUND_STEPS_MAX
#define BOUND_STEPS_MAX 2000000 /* instructions of all rounds: some seconds */
#endif

enum { STEPS_MAX = BOUND_STEPS_MAX };

/* One loop that is taken round by round. */
struct turning {
    const struct flow *flow;
    const struct function *function;
    int header;
    bool *is_member;
    int *ways;             /* edges to each node */
    struct values *before; /* of the nodes with several ways to them, in this round */
    bool *is_reached;
    bool *is_queued;
    int *queue;
    int queued;
    struct values back; /* what is known when the header is reached again */
    bool goes_back;
    long steps;
};

static void tell(struct turning *turning, int at, const struct values *values)
{
    if (at == turning->header) {
        if (!turning->goes_back) {
            turning->back = *values;
            turning->goes_back = true;
        } else {
            values_merge(&turning->back, values);
        }
        return;
    }
    if (!turning->is_reached[at]) {
        turning->before[at] = *values;
        turning->is_reached[at] = true;
    } else if (!values_merge(&turning->before[at], values)) {
        return;
    }
    if (!turning->is_queued[at]) {
        turning->is_queued[at] = true;
        turning->queue[turning->queued++] = at;
    }
}

/* Follows the instructions from AT on, while there is one way to go that no other way meets. */
static bool run(struct turning *turning, int at, struct values *values)
{
    const struct function *function = turning->function;

    for (;;) {
        const struct node *node = &function->nodes[at];
        bool may_go[2] = {true, true};
        int next = NONE, ways = 0;

        if (turning->steps++ > STEPS_MAX || !node->is_known) {
            return false;
        }
        if (!graph_step(turning->flow, node, values)) {
            return false;
        }
        if (node->it.course == COURSE_BRANCH) {
            values_branch(values, &turning->flow->world, node->address, &may_go[0], &may_go[1]);
        } else if (node->it.course == COURSE_RETURN && node->count > 0) {
            values_drop(values, FLOW_RETURN_ADDRESS);
        }
        for (int i = 0; i < node->count; i++) {
            int to = function->successors[node->first + i];

            if ((node->it.course != COURSE_BRANCH || may_go[i]) && turning->is_member[to]) {
                next = to;
                ways++;
            }
        }
        if (ways == 1 && next != turning->header && turning->ways[next] == 1) {
            at = next;
            continue;
        }
        for (int i = 0; i < node->count; i++) {
            int to = function->successors[node->first + i];

            if ((node->it.course != COURSE_BRANCH || may_go[i]) && turning->is_member[to]) {
                tell(turning, to, values);
            }
        }
        return true;
    }
}

/* One round, from the header on, with VALUES before it. */
static bool turn(struct turning *turning, struct values *values)
{
    bool is_good;

    memset(turning->is_reached, false, (size_t)turning->function->node_count);
    turning->goes_back = false;
    is_good = run(turning, turning->header, values);
    while (is_good && turning->queued > 0) {
        int at = turning->queue[--turning->queued];
        struct values before = turning->before[at];

        turning->is_queued[at] = false;
        is_good = run(turning, at, &before);
    }
    return is_good;
}

/* What is known when the loop is entered from outside. */
static void enter(const struct turning *turning, struct values *values)
{
    const struct function *function = turning->function;

    memset(values, 0, sizeof *values);
    for (int i = 0; i < function->node_count; i++) {
        const struct node *node = &function->nodes[i];

        for (int k = node->first; k < node->first + node->count; k++) {
            struct values after;

            if (function->successors[k] != turning->header || turning->is_member[i]) {
                continue;
            }
            if (i == 0) {
                values_enter(&after, &turning->flow->world);
            } else {
                after = function->before[i];
                graph_step(turning->flow, node, &after);
            }
            values_merge(values, &after);
        }
    }
}

static void *allocate(int count, size_t size)
{
    void *room = calloc((size_t)count, size);

    if (room == NULL) {
        abort();
    }
    return room;
}

long rounds_count(const struct flow *flow, const struct function *function, const int *members,
                  int count, int header)
{
    int nodes = function->node_count;
    struct turning turning = {.flow = flow, .function = function, .header = header};
    struct values values;
    long rounds = 0;
    bool is_good = true;

    turning.is_member = allocate(nodes, sizeof *turning.is_member);
    turning.ways = allocate(nodes, sizeof *turning.ways);
    turning.before = allocate(nodes, sizeof *turning.before);
    turning.is_reached = allocate(nodes, sizeof *turning.is_reached);
    turning.is_queued = allocate(nodes, sizeof *turning.is_queued);
    turning.queue = allocate(nodes, sizeof *turning.queue);
    for (int i = 0; i < count; i++) {
        turning.is_member[members[i]] = true;
    }
    for (int i = 0; i < function->successor_count; i++) {
        turning.ways[function->successors[i]]++;
    }
    enter(&turning, &values);
    do {
        struct values before = values;

        is_good = turn(&turning, &values);
        if (is_good && turning.goes_back) {
            rounds++;
            is_good = !values_equal(&before, &turning.back); /* else it turns for ever */
            values = turning.back;
        }
    } while (is_good && turning.goes_back);
    free(turning.is_member);
    free(turning.ways);
    free(turning.before);
    free(turning.is_reached);
    free(turning.is_queued);
    free(turning.queue);
    return is_good ? rounds : NONE;
}

long rounds_of_library(const char *name)
{
    static const struct {
        const char *name;
        long rounds;
    } known[] = {
        {"_divlong", 32}, /* "long" and "int": with --stack-auto */
        {"_divulong", 32},  {"_modint", 16},
        {"_moduint", 16},   {"_modlong", 32},
        {"_modulong", 32},  {"__uitoa", 16},
        {"__ultoa", 32},    {"fs_lshift_a", 8},
        {"fs_rshift_a", 7}, {"_fs_cordic_rshift_r765_unsigned", 7},
    };

    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(name, known[i].name) == 0) {
            return known[i].rounds;
        }
    }
    return NONE;
}
