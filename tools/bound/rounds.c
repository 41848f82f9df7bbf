/* SPDX-License-Identifier: MIT */
#include "rounds.h"

#include "memory.h"

#include <stdlib.h>
#include <string.h>

/* A node of the loop. */
struct place {
    bool is_member, is_queued;
    long round;           /* in which a way has led here last; from 1 on */
    struct values before; /* it in that round; of the header: in the next one */
};

/* One loop that is taken round by round. */
struct turning {
    const struct flow *flow;
    const struct function *function;
    int header;
    struct place *places; /* of all nodes of the function */
    int *queue;
    int queued;
    long round, steps;
};

/* Tells the node AT what is known on one of the ways to it. */
static void tell(struct turning *turning, int at, const struct values *values)
{
    struct place *place = &turning->places[at];

    if (place->round != turning->round) {
        place->before = *values;
        place->round = turning->round;
    } else if (!values_merge(&place->before, values)) {
        return;
    }
    if (at != turning->header && !place->is_queued) {
        place->is_queued = true;
        turning->queue[turning->queued++] = at;
    }
}

/* Takes the instruction AT with VALUES before it. Returns false if the steps are used up, or
 * where the stack is lost. */
static bool step(struct turning *turning, int at, struct values values)
{
    const struct function *function = turning->function;
    const struct node *node = &function->nodes[at];
    bool may_go[2] = {true, true}; /* of a branch, which has two successors */

    graph_step(turning->flow, node, &values);
    if (++turning->steps > turning->flow->steps_max || values_depth(&values) == VALUES_LOST) {
        return false;
    }
    if (node->it.course == COURSE_BRANCH) {
        values_branch(&values, &turning->flow->world, node->address, &may_go[0], &may_go[1]);
    }
    for (int i = 0; i < node->count; i++) {
        int to = function->successors[node->first + i];

        if (turning->places[to].is_member && (i > 1 || may_go[i])) {
            tell(turning, to, &values);
        }
    }
    return true;
}

/* One round, from the header back to it. */
static bool turn(struct turning *turning)
{
    struct values values = turning->places[turning->header].before;

    if (!step(turning, turning->header, values)) {
        return false;
    }
    while (turning->queued > 0) {
        int at = turning->queue[--turning->queued];

        turning->places[at].is_queued = false;
        if (!step(turning, at, turning->places[at].before)) {
            return false;
        }
    }
    return true;
}

/* What is known when the loop is entered from outside. */
static void enter(struct turning *turning)
{
    const struct function *function = turning->function;
    struct values *values = &turning->places[turning->header].before;

    if (turning->header == 1) { /* the function's entry */
        values_enter(values, &turning->flow->world);
    }
    for (int i = 1; i < function->node_count; i++) {
        const struct node *node = &function->nodes[i];

        for (int k = node->first; k < node->first + node->count; k++) {
            struct values after = *node->before;

            if (function->successors[k] == turning->header && !turning->places[i].is_member) {
                graph_step(turning->flow, node, &after);
                values_merge(values, &after);
            }
        }
    }
}

/* Goes round until there is no way back to the header. */
static long count_rounds(struct turning *turning)
{
    struct place *header = &turning->places[turning->header];

    for (turning->round = 1;; turning->round++) {
        struct values before = header->before;

        if (!turn(turning)) {
            return NONE;
        }
        if (header->round != turning->round) {
            return turning->round - 1;
        }
        if (values_equal(&before, &header->before)) { /* it turns for ever */
            return NONE;
        }
    }
}

long rounds_count(const struct flow *flow, const struct function *function, const int *members,
                  int count, int header)
{
    struct turning turning = {.flow = flow, .function = function, .header = header};
    long rounds;

    turning.places = memory_get((size_t)function->node_count, sizeof *turning.places);
    turning.queue = memory_get((size_t)function->node_count, sizeof *turning.queue);
    for (int i = 0; i < count; i++) {
        turning.places[members[i]].is_member = true;
    }
    enter(&turning);
    rounds = count_rounds(&turning);
    free(turning.places);
    free(turning.queue);
    return rounds;
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
