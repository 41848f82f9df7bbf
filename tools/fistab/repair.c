/* SPDX-License-Identifier: MIT */
/* Nearest monotone table, by cuts.
 *
 * Raising a cell from level k to k+1 changes its squared distance to the surface value x by
 * 2 * (k + 1/2 - x). So the cells above level k in the nearest table are, of all sets that the law
 * allows (with a cell, every cell that must not be lower), the one with the largest sum of
 * x - (k + 1/2): a largest closed set, which is a minimum cut. The sets of growing k are nested, so
 * all levels are found by halving: a first cut splits the cells at the middle level, and each part
 * goes on alone with its own half of the levels; parts never exchange flow, and 7 passes of one
 * flow over the whole table do for 101 levels.
 *
 * The flow is push-relabel (Goldberg, Tarjan), first phase only, in integers: no tolerance. */
#include "repair.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

struct cell {
    int64_t excess;                     /* x - (k + 1/2) where positive: what the source sends */
    int64_t room;                       /* the same where negative: what the sink still takes */
    int64_t flow[REPAIR_INPUTS_MAX];    /* to the upper neighbour along each input */
    size_t height;                      /* lower bound of the steps to the sink */
    int low, high;                      /* the levels that this cell can still get */
    unsigned char has_upper, has_lower; /* bit k: the neighbour along input k is in the same part */
};

struct cut {
    struct cell *cells;
    size_t count;
    int inputs;
    ptrdiff_t step[REPAIR_INPUTS_MAX]; /* to the neighbour that must not be lower; 0 if free */
    size_t *queue;                     /* ring of count entries; each cell is in it at most once */
    size_t queue_head, queue_length;
    unsigned char *queued;
};

static void enqueue(struct cut *cut, size_t i)
{
    if (cut->queued[i]) {
        return;
    }
    cut->queued[i] = 1;
    cut->queue[(cut->queue_head + cut->queue_length++) % cut->count] = i;
}

static size_t dequeue(struct cut *cut)
{
    size_t i = cut->queue[cut->queue_head];

    cut->queue_head = (cut->queue_head + 1) % cut->count;
    cut->queue_length--;
    cut->queued[i] = 0;
    return i;
}

static size_t upper(const struct cut *cut, size_t i, int k)
{
    return i + (size_t)cut->step[k];
}

static size_t lower(const struct cut *cut, size_t i, int k)
{
    return i - (size_t)cut->step[k];
}

/* Neighbours take part in one cut if they share their levels; else the law holds between them. */
static void find_neighbours(struct cut *cut, const size_t *dims)
{
    size_t stride = cut->count;

    for (size_t i = 0; i < cut->count; i++) {
        cut->cells[i].has_upper = cut->cells[i].has_lower = 0;
    }
    for (int k = 0; k < cut->inputs; k++) {
        stride /= dims[k];
        if (cut->step[k] == 0) {
            continue;
        }
        for (size_t i = 0; i < cut->count; i++) {
            size_t place = i / stride % dims[k];
            struct cell *cell = &cut->cells[i], *above;

            if (place == (cut->step[k] > 0 ? dims[k] - 1 : 0)) {
                continue;
            }
            above = &cut->cells[upper(cut, i, k)];
            if (cell->low == cell->high || above->low != cell->low || above->high != cell->high) {
                continue;
            }
            cell->has_upper |= (unsigned char)(1U << k);
            above->has_lower |= (unsigned char)(1U << k);
        }
    }
}

/* Exact heights, by breadth first from the sink; a cell that cannot reach it gets count + 1. Uses
 * the queue, and leaves in it the cells that can still send something. */
static void relabel_all(struct cut *cut)
{
    while (cut->queue_length > 0) {
        dequeue(cut);
    }
    for (size_t i = 0; i < cut->count; i++) {
        cut->cells[i].height = cut->count + 1;
        if (cut->cells[i].room > 0) {
            cut->cells[i].height = 1;
            enqueue(cut, i);
        }
    }
    while (cut->queue_length > 0) {
        size_t i = dequeue(cut);
        const struct cell *cell = &cut->cells[i];

        for (int k = 0; k < cut->inputs; k++) {
            size_t below = lower(cut, i, k), above = upper(cut, i, k);

            if ((cell->has_lower >> k & 1) && cut->cells[below].height > cut->count) {
                cut->cells[below].height = cell->height + 1;
                enqueue(cut, below);
            }
            if ((cell->has_upper >> k & 1) && cell->flow[k] > 0 &&
                cut->cells[above].height > cut->count) {
                cut->cells[above].height = cell->height + 1;
                enqueue(cut, above);
            }
        }
    }
    for (size_t i = 0; i < cut->count; i++) {
        if (cut->cells[i].excess > 0 && cut->cells[i].height <= cut->count) {
            enqueue(cut, i);
        }
    }
}

/* Sends what cell i has on to lower heights, lifting it as needed, until it has nothing left or
 * cannot reach the sink. Returns how often it was lifted. */
static size_t discharge(struct cut *cut, size_t i)
{
    struct cell *cell = &cut->cells[i];
    size_t lifts = 0;

    while (cell->excess > 0 && cell->height <= cut->count) {
        size_t lowest = cut->count;

        if (cell->room > 0) {
            int64_t amount = cell->excess < cell->room ? cell->excess : cell->room;
            cell->room -= amount;
            cell->excess -= amount;
        }
        for (int k = 0; k < cut->inputs && cell->excess > 0; k++) {
            if (cell->has_upper >> k & 1) {
                struct cell *above = &cut->cells[upper(cut, i, k)];

                if (above->height + 1 == cell->height) {
                    cell->flow[k] += cell->excess;
                    above->excess += cell->excess;
                    cell->excess = 0;
                    enqueue(cut, upper(cut, i, k));
                } else if (above->height < lowest) {
                    lowest = above->height;
                }
            }
            if (cell->has_lower >> k & 1) {
                struct cell *below = &cut->cells[lower(cut, i, k)];
                int64_t amount = below->flow[k] < cell->excess ? below->flow[k] : cell->excess;

                if (amount > 0 && below->height + 1 == cell->height) {
                    below->flow[k] -= amount;
                    cell->excess -= amount;
                    below->excess += amount;
                    enqueue(cut, lower(cut, i, k));
                }
                if (below->flow[k] > 0 && below->height < lowest) {
                    lowest = below->height;
                }
            }
        }
        if (cell->excess > 0) {
            cell->height = lowest + 1;
            lifts++;
        }
    }
    return lifts;
}

/* One cut of all parts at once. Afterwards a cell with height > count is above its middle level. */
static void find_cut(struct cut *cut, const int64_t *scaled, int64_t half)
{
    size_t lifts = 0;

    for (size_t i = 0; i < cut->count; i++) {
        struct cell *cell = &cut->cells[i];
        int64_t over = scaled[i] - half * (2 * ((cell->low + cell->high) / 2) + 1);

        cell->excess = over > 0 ? over : 0;
        cell->room = over < 0 ? -over : 0;
        for (int k = 0; k < cut->inputs; k++) {
            cell->flow[k] = 0;
        }
    }
    relabel_all(cut);
    while (cut->queue_length > 0) {
        lifts += discharge(cut, dequeue(cut));
        if (lifts > cut->count) {
            relabel_all(cut);
            lifts = 0;
        }
    }
    relabel_all(cut);
}

/* The largest power of two for which no sum over the table overflows. */
static int64_t scale_for(size_t count, int levels_max, double largest)
{
    double range = fmax(largest, levels_max) + levels_max + 1;

    return (int64_t)1 << (int)floor(61 - log2(range) - log2((double)count));
}

int repair_monotone(const double *surface, const size_t *dims, int inputs, const int *direction,
                    int levels_max, int *cells)
{
    struct cut cut = {.inputs = inputs, .count = 1};
    int64_t *scaled, scale;
    double largest = 0;
    size_t stride;
    int status = -1;

    for (int k = 0; k < inputs; k++) {
        cut.count *= dims[k];
    }
    stride = cut.count;
    for (int k = 0; k < inputs; k++) {
        stride /= dims[k];
        cut.step[k] = direction[k] * (ptrdiff_t)stride;
    }
    cut.cells = calloc(cut.count, sizeof *cut.cells);
    cut.queue = calloc(cut.count, sizeof *cut.queue);
    cut.queued = calloc(cut.count, 1);
    scaled = calloc(cut.count, sizeof *scaled);
    if (cut.cells == NULL || cut.queue == NULL || cut.queued == NULL || scaled == NULL) {
        goto done;
    }

    for (size_t i = 0; i < cut.count; i++) {
        largest = fmax(largest, fabs(surface[i]));
    }
    scale = scale_for(cut.count, levels_max, largest);
    for (size_t i = 0; i < cut.count; i++) {
        scaled[i] = llround(surface[i] * (double)scale);
        cut.cells[i].high = levels_max;
    }
    for (int span = levels_max; span > 0; span /= 2) {
        find_neighbours(&cut, dims);
        find_cut(&cut, scaled, scale / 2);
        for (size_t i = 0; i < cut.count; i++) {
            struct cell *cell = &cut.cells[i];
            int middle = (cell->low + cell->high) / 2;

            if (cell->low == cell->high) {
                continue;
            }
            if (cell->height > cut.count) {
                cell->low = middle + 1;
            } else {
                cell->high = middle;
            }
        }
    }
    for (size_t i = 0; i < cut.count; i++) {
        cells[i] = cut.cells[i].low;
    }
    status = 0;
done:
    free(cut.cells);
    free(cut.queue);
    free(cut.queued);
    free(scaled);
    return status;
}

size_t repair_violations(const int *cells, const size_t *dims, int inputs, const int *direction,
                         size_t *first)
{
    size_t count = 1, stride, violations = 0;

    for (int k = 0; k < inputs; k++) {
        count *= dims[k];
    }
    for (size_t i = 0; i < count; i++) {
        stride = count;
        for (int k = 0; k < inputs; k++) {
            stride /= dims[k];
            if (i / stride % dims[k] + 1 == dims[k]) {
                continue;
            }
            if ((cells[i + stride] - cells[i]) * direction[k] >= 0) {
                continue;
            }
            if (violations++ == 0 && first != NULL) {
                *first = i;
            }
        }
    }
    return violations;
}

static double sum_of_squares(const struct table *table, size_t output)
{
    double sum = 0;

    for (size_t i = 0; i < table->cells; i++) {
        double distance = table->cell[output][i] - table->surface[output][i];
        sum += distance * distance;
    }
    return sum;
}

int repair_output(struct table *table, size_t output, const struct law *law,
                  struct repair_report *report)
{
    int inputs = (int)table->inputs, *cell = table->cell[output], status;
    const double *surface = table->surface[output];
    /* Halves go up as they do in rounding, so that no cell changes but for the law. */
    double *nudged = malloc(table->cells * sizeof *nudged);

    if (nudged == NULL) {
        return -1;
    }
    for (size_t i = 0; i < table->cells; i++) {
        nudged[i] = surface[i] + TABLE_HALF_WITHIN;
    }
    *report = (struct repair_report){
        .broken_before = repair_violations(cell, table->dims, inputs, law->direction, NULL),
        .squares_before = sum_of_squares(table, output),
    };
    status =
        repair_monotone(nudged, table->dims, inputs, law->direction, table->options.levels, cell);
    free(nudged);
    if (status != 0) {
        return -1;
    }
    report->broken_after = repair_violations(cell, table->dims, inputs, law->direction, NULL);
    report->squares_after = sum_of_squares(table, output);
    for (size_t i = 0; i < table->cells; i++) {
        int change = abs(cell[i] - table_round(surface[i]));

        report->changed += change > 0;
        if (change > report->largest) {
            report->largest = change;
        }
    }
    return 0;
}
