/* SPDX-License-Identifier: MIT */
/* Under test: tools/fistab/repair.c and law.c. Optimality is shown, not believed: small tables
 * against every monotone table there is, the brake's table by a certificate that a second, simple
 * flow makes. */
#include "fistab/repair.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "common/diag.h"

enum { CELLS_MAX = 10000 };

static uint32_t seed;

/* The brake's system and table, if the case made them; freed when it failed, too. */
static struct fis fis;
static struct table table;

void setUp(void)
{
    seed = 1;
}

void tearDown(void)
{
    table_free(&table);
    fis_free(&fis);
}

static uint32_t random_below(uint32_t limit)
{
    seed = seed * 1664525U + 1013904223U;
    return (seed >> 8) % limit;
}

/* --- small tables, against all of them -------------------------------------------------------- */

static double squares(const double *surface, const int *cells, size_t count)
{
    double sum = 0;

    for (size_t i = 0; i < count; i++) {
        sum += (cells[i] - surface[i]) * (cells[i] - surface[i]);
    }
    return sum;
}

/* The best of all (levels + 1) ^ count tables; of equally good ones the largest. */
static void best_by_trying(const double *surface, const size_t *dims, int inputs,
                           const int *direction, int levels, size_t count, int *best)
{
    int cells[16] = {0};
    double least = INFINITY;

    for (;;) {
        size_t i = 0;
        double sum = squares(surface, cells, count);

        /* The sum first: it is the cheaper one to look at. */
        if (sum <= least && repair_violations(cells, dims, inputs, direction, NULL) == 0) {
            /* All sums are exact, as surface values are in quarters; later tables are not smaller
             * everywhere, so the largest of equals is taken cell by cell. */
            if (sum < least) {
                memcpy(best, cells, count * sizeof *cells);
            }
            for (size_t k = 0; sum == least && k < count; k++) {
                best[k] = best[k] > cells[k] ? best[k] : cells[k];
            }
            least = fmin(least, sum);
        }
        while (i < count && cells[i] == levels) {
            cells[i++] = 0;
        }
        if (i == count) {
            return;
        }
        cells[i]++;
    }
}

static void try_small(const size_t *dims, int inputs, int levels, int rounds)
{
    size_t count = 1;

    for (int k = 0; k < inputs; k++) {
        count *= dims[k];
    }
    for (int round = 0; round < rounds; round++) {
        double surface[16];
        int direction[REPAIR_INPUTS_MAX], expected[16], cells[16];

        for (size_t i = 0; i < count; i++) {
            surface[i] = random_below((uint32_t)(4 * levels + 1)) / 4.0;
        }
        for (int k = 0; k < inputs; k++) {
            direction[k] = (int)random_below(3) - 1;
        }

        best_by_trying(surface, dims, inputs, direction, levels, count, expected);
        TEST_ASSERT_EQUAL(0, repair_monotone(surface, dims, inputs, direction, levels, cells));

        TEST_ASSERT_EQUAL_INT_ARRAY(expected, cells, count);
    }
}

static void test_that_a_row_is_the_best_of_all_rows(void)
{
    try_small((const size_t[]){6}, 1, 4, 300);
}

static void test_that_a_square_is_the_best_of_all_squares(void)
{
    try_small((const size_t[]){3, 3}, 2, 2, 200);
    try_small((const size_t[]){2, 3}, 2, 4, 200);
    try_small((const size_t[]){4, 2}, 2, 3, 100);
}

static void test_that_a_cube_is_the_best_of_all_cubes(void)
{
    try_small((const size_t[]){2, 2, 2}, 3, 3, 100);
    try_small((const size_t[]){2, 1, 2, 2}, 4, 3, 100);
}

/* --- the brake's table ------------------------------------------------------------------------ */

static const size_t brake_dims[] = {100, 100};
static const int brake_direction[] = {-1, 1};

static void make_brake(int levels)
{
    const struct table_options options = {.infer = {.samples = INFER_SAMPLES}, .levels = levels};

    TEST_ASSERT_EQUAL(EXIT_FINE, fis_read("tables/brake.fis", &fis));
    TEST_ASSERT_EQUAL(EXIT_FINE, table_make(&fis, &options, &table));
    TEST_ASSERT_EQUAL(CELLS_MAX, table.cells);
}

/* A flow from cells with supply to cells with room, along the law: a cell sends to the neighbours
 * that must not be lower, and takes back what it sent. Breadth-first, one path at a time. */
struct flow {
    const int *cells;
    int64_t supply[CELLS_MAX], room[CELLS_MAX];
    int64_t sent[2][CELLS_MAX]; /* to the upper neighbour along each input */
    size_t from[CELLS_MAX];     /* the path, backwards; CELLS_MAX: not reached */
};

static size_t next_cell(size_t cell, int way)
{
    size_t row = cell / 100, col = cell % 100;

    switch (way) {
    case 0: /* nearer: upper along distance */
        return row > 0 ? cell - 100 : CELLS_MAX;
    case 1: /* faster: upper along speed */
        return col < 99 ? cell + 1 : CELLS_MAX;
    case 2:
        return row < 99 ? cell + 100 : CELLS_MAX;
    default:
        return col > 0 ? cell - 1 : CELLS_MAX;
    }
}

/* What can go from cell to its neighbour `next`: upwards all, downwards what came from there. */
static int64_t capacity(const struct flow *flow, size_t next, int way)
{
    return way < 2 ? INT64_MAX : flow->sent[way - 2][next];
}

static size_t find_path(struct flow *flow, size_t start)
{
    static size_t queue[CELLS_MAX];
    size_t head = 0, tail = 0;

    for (size_t i = 0; i < CELLS_MAX; i++) {
        flow->from[i] = CELLS_MAX;
    }
    flow->from[start] = start;
    queue[tail++] = start;
    while (head < tail) {
        size_t cell = queue[head++];

        if (flow->room[cell] > 0) {
            return cell;
        }
        for (int way = 0; way < 4; way++) {
            size_t next = next_cell(cell, way);

            if (next == CELLS_MAX || flow->from[next] != CELLS_MAX ||
                flow->cells[next] != flow->cells[cell] || capacity(flow, next, way) == 0) {
                continue;
            }
            flow->from[next] = cell;
            queue[tail++] = next;
        }
    }
    return CELLS_MAX;
}

static int way_between(size_t cell, size_t next)
{
    for (int way = 0; way < 4; way++) {
        if (next_cell(cell, way) == next) {
            return way;
        }
    }
    return -1;
}

static void send_along(struct flow *flow, size_t start, size_t end)
{
    int64_t amount = flow->supply[start] < flow->room[end] ? flow->supply[start] : flow->room[end];

    for (size_t cell = end; cell != start; cell = flow->from[cell]) {
        int64_t most = capacity(flow, cell, way_between(flow->from[cell], cell));
        amount = amount < most ? amount : most;
    }
    for (size_t cell = end; cell != start; cell = flow->from[cell]) {
        int way = way_between(flow->from[cell], cell);

        if (way < 2) {
            flow->sent[way][flow->from[cell]] += amount;
        } else {
            flow->sent[way - 2][cell] -= amount;
        }
    }
    flow->supply[start] -= amount;
    flow->room[end] -= amount;
}

/* Can every cell with a supply get rid of it among the cells of its own value? */
static void assert_all_sent(struct flow *flow)
{
    memset(flow->sent, 0, sizeof flow->sent);
    for (size_t i = 0; i < CELLS_MAX; i++) {
        while (flow->supply[i] > 0) {
            size_t end = find_path(flow, i);

            TEST_ASSERT_TRUE_MESSAGE(end != CELLS_MAX, "a better table exists");
            send_along(flow, i, end);
        }
    }
}

/* The table is the nearest one if, for each value v, no set of its cells that the law allows to
 * move alone gains by moving: up to v + 1 it would gain the sum of x - (v + 1/2), down to v - 1 the
 * sum of (v - 1/2) - x. A flow proves that no such sum is positive: all that speaks for moving is
 * carried, along the law, to cells that must move too and lose as much. Both steps are enough, as
 * the squares are convex and the sets above growing levels are nested. */
static void assert_nearest(const double *surface, const int *cells, int levels)
{
    static struct flow flow;
    const int64_t unit = (int64_t)1 << 40; /* exact in the same steps as repair.c takes */

    flow.cells = cells;
    for (size_t i = 0; i < CELLS_MAX; i++) {
        int64_t gain = llround(surface[i] * (double)unit) - cells[i] * unit - unit / 2;

        flow.supply[i] = gain > 0 ? gain : 0;
        flow.room[i] = cells[i] == levels ? INT64_MAX : gain < 0 ? -gain : 0;
    }
    assert_all_sent(&flow);

    /* Downwards: what is short at a cell comes from cells below it, so the roles change. */
    for (size_t i = 0; i < CELLS_MAX; i++) {
        int64_t over = llround(surface[i] * (double)unit) - cells[i] * unit + unit / 2;

        flow.supply[i] = over > 0 ? over : 0;
        flow.room[i] = over < 0 && cells[i] > 0 ? -over : 0;
    }
    memset(flow.sent, 0, sizeof flow.sent);
    for (size_t i = 0; i < CELLS_MAX; i++) {
        size_t end;

        while (flow.supply[i] > 0 && (end = find_path(&flow, i)) != CELLS_MAX) {
            send_along(&flow, i, end);
        }
    }
    for (size_t i = 0; i < CELLS_MAX; i++) {
        TEST_ASSERT_TRUE_MESSAGE(flow.room[i] == 0, "a better table exists, with lower cells");
    }
}

static void test_that_the_brakes_table_is_the_nearest_one(void)
{
    make_brake(100);
    TEST_ASSERT_EQUAL(
        0, repair_monotone(table.surface[0], brake_dims, 2, brake_direction, 100, table.cell[0]));
    TEST_ASSERT_EQUAL(0, repair_violations(table.cell[0], brake_dims, 2, brake_direction, NULL));
    assert_nearest(table.surface[0], table.cell[0], 100);
}

static void test_that_the_brakes_table_of_255_levels_is_the_nearest_one(void)
{
    make_brake(255);
    for (size_t i = 0; i < table.cells; i++) { /* whole steps of 2^-40, whatever the scale */
        table.surface[0][i] = ldexp(round(ldexp(table.surface[0][i], 30)), -30);
    }
    TEST_ASSERT_EQUAL(
        0, repair_monotone(table.surface[0], brake_dims, 2, brake_direction, 255, table.cell[0]));
    TEST_ASSERT_EQUAL(0, repair_violations(table.cell[0], brake_dims, 2, brake_direction, NULL));
    assert_nearest(table.surface[0], table.cell[0], 255);
}

/* The study's figures (an independent model) for the table of 101 samples: 337 pairs along distance
 * and 313 along speed, about 3,500 cells changed by at most 3, sum of squares about 4,147. */
static void test_that_the_brakes_repair_is_as_small_as_the_study_says(void)
{
    struct repair_report report;
    static struct laws laws;
    const struct law *law;

    make_brake(100);
    TEST_ASSERT_TRUE(laws_add(&laws, "1:-1"));
    TEST_ASSERT_TRUE(laws_add(&laws, "2:+2"));
    TEST_ASSERT_TRUE(laws_add(&laws, "-1,+2"));
    law = laws_of(&laws, 0);
    TEST_ASSERT_EQUAL(337, repair_violations(table.cell[0], brake_dims, 2, law->direction, NULL));
    law = laws_of(&laws, 1);
    TEST_ASSERT_EQUAL(313, repair_violations(table.cell[0], brake_dims, 2, law->direction, NULL));
    law = laws_of(&laws, 2);

    TEST_ASSERT_EQUAL(0, repair_output(&table, 0, law, &report));

    TEST_ASSERT_EQUAL(650, report.broken_before);
    TEST_ASSERT_EQUAL(0, report.broken_after);
    TEST_ASSERT_EQUAL(3, report.largest);
    TEST_ASSERT_TRUE(report.changed <= 3531);
    TEST_ASSERT_TRUE(report.squares_after < 4147.4);
}

static void test_that_a_table_that_obeys_is_only_rounded(void)
{
    double surface[CELLS_MAX];
    int cells[CELLS_MAX];

    for (size_t i = 0; i < CELLS_MAX; i++) {
        surface[i] = (double)(99 - i / 100) * 0.51 + (double)(i % 100) * 0.37;
    }
    TEST_ASSERT_EQUAL(0, repair_monotone(surface, brake_dims, 2, brake_direction, 100, cells));
    for (size_t i = 0; i < CELLS_MAX; i++) {
        TEST_ASSERT_EQUAL_INT(table_round(surface[i]), cells[i]);
    }
}

/* Halves as floating point makes them, a little more or less: they stay as rounding has them. */
static void test_that_halves_change_no_cell(void)
{
    struct repair_report report;
    struct laws laws = {0};

    make_brake(100);
    for (size_t i = 0; i < table.cells; i++) {
        table.surface[0][i] = (double)(i % 100) / 2 + (i % 3 == 0 ? -1e-12 : 1e-12);
        table.cell[0][i] = table_round(table.surface[0][i]);
    }
    TEST_ASSERT_TRUE(laws_add(&laws, "-1,+2"));
    TEST_ASSERT_EQUAL(0, repair_output(&table, 0, laws_of(&laws, 0), &report));
    TEST_ASSERT_EQUAL(0, report.broken_before);
    TEST_ASSERT_EQUAL(0, report.changed);
}

static void test_that_free_inputs_are_only_rounded(void)
{
    double surface[CELLS_MAX];
    int cells[CELLS_MAX];

    for (size_t i = 0; i < CELLS_MAX; i++) {
        surface[i] = random_below(100001) / 1000.0;
    }
    TEST_ASSERT_EQUAL(0, repair_monotone(surface, brake_dims, 2, (const int[]){0, 0}, 100, cells));
    for (size_t i = 0; i < CELLS_MAX; i++) {
        TEST_ASSERT_EQUAL_INT((int)floor(surface[i] + 0.5), cells[i]);
    }
}

static void test_that_noise_becomes_monotone(void)
{
    double surface[CELLS_MAX];
    int cells[CELLS_MAX];

    for (size_t i = 0; i < CELLS_MAX; i++) {
        surface[i] = ldexp(random_below(1 << 20), -14);
    }
    TEST_ASSERT_EQUAL(0, repair_monotone(surface, brake_dims, 2, brake_direction, 64, cells));
    TEST_ASSERT_EQUAL(0, repair_violations(cells, brake_dims, 2, brake_direction, NULL));
    assert_nearest(surface, cells, 64);
}

static void test_that_a_broken_pair_is_found_and_named(void)
{
    const size_t dims[] = {2, 3};
    const int cells[] = {1, 2, 3,  /* 2 falls to 1 below it, */
                         2, 1, 4}; /* and 2 to 1 beside it */
    size_t first = 99;

    TEST_ASSERT_EQUAL(2, repair_violations(cells, dims, 2, (const int[]){1, 1}, &first));
    TEST_ASSERT_EQUAL(1, first);
    TEST_ASSERT_EQUAL(1, repair_violations(cells, dims, 2, (const int[]){0, 1}, &first));
    TEST_ASSERT_EQUAL(3, first);
}

/* --- the law's own words ---------------------------------------------------------------------- */

static void test_that_laws_are_read(void)
{
    struct laws laws = {0};

    TEST_ASSERT_NULL(laws_of(&laws, 0)->text);
    TEST_ASSERT_TRUE(laws_add(&laws, "-1,+2"));
    TEST_ASSERT_EQUAL_INT(-1, laws_of(&laws, 0)->direction[0]);
    TEST_ASSERT_EQUAL_INT(1, laws_of(&laws, 0)->direction[1]);
    TEST_ASSERT_EQUAL_INT(0, laws_of(&laws, 0)->direction[2]);
    TEST_ASSERT_TRUE(laws_add(&laws, "2:+64"));
    TEST_ASSERT_EQUAL_INT(1, laws_of(&laws, 1)->direction[63]);
    TEST_ASSERT_EQUAL_INT(-1, laws_of(&laws, 2)->direction[0]);
    TEST_ASSERT_EQUAL_STRING("-1,+2 2:+64", laws.text);
    TEST_ASSERT_FALSE_MESSAGE(laws_add(&laws, "+1"), "a second law for all outputs");
    TEST_ASSERT_FALSE_MESSAGE(laws_add(&laws, "2:+1"), "a second law for output 2");
}

static void test_that_other_texts_are_no_laws(void)
{
    static const char *const text[] = {"",    "1",      "+",    "-0",    "+65",
                                       "+1,", ",+1",    "+1+2", "+1,+1", "+1,-1",
                                       "+ 1", "+1, +2", "--1",  "+1x",   "+18446744073709551617"};

    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        struct laws laws = {0};

        TEST_ASSERT_FALSE_MESSAGE(laws_add(&laws, text[i]), text[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_row_is_the_best_of_all_rows);
    RUN_TEST(test_that_a_square_is_the_best_of_all_squares);
    RUN_TEST(test_that_a_cube_is_the_best_of_all_cubes);
    RUN_TEST(test_that_the_brakes_table_is_the_nearest_one);
    RUN_TEST(test_that_the_brakes_table_of_255_levels_is_the_nearest_one);
    RUN_TEST(test_that_the_brakes_repair_is_as_small_as_the_study_says);
    RUN_TEST(test_that_a_table_that_obeys_is_only_rounded);
    RUN_TEST(test_that_halves_change_no_cell);
    RUN_TEST(test_that_free_inputs_are_only_rounded);
    RUN_TEST(test_that_noise_becomes_monotone);
    RUN_TEST(test_that_a_broken_pair_is_found_and_named);
    RUN_TEST(test_that_laws_are_read);
    RUN_TEST(test_that_other_texts_are_no_laws);
    return UNITY_END();
}
