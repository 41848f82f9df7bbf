/* SPDX-License-Identifier: MIT */
/* Under test: tools/fistab/pack.c. Whatever packs comes back cell by cell; what does not says why.
 */
#include "fistab/pack.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "common/diag.h"
#include "fistab/repair.h"
#include "fistab/table.h"

enum { SIDE_MAX = 256 };

static int cells[SIDE_MAX * SIDE_MAX];
static struct pack pack;
static char why[PACK_WHY_BYTES];
static uint32_t seed;

void setUp(void)
{
    seed = 1;
}

void tearDown(void)
{
    pack_free(&pack);
}

static uint32_t random_below(uint32_t limit)
{
    seed = seed * 1664525U + 1013904223U;
    return (seed >> 8) % limit;
}

/* What pack_table() said was STATUS. */
static void assert_packed(int status, size_t rows, size_t cols)
{
    TEST_ASSERT_EQUAL_MESSAGE(0, status, why);
    TEST_ASSERT_TRUE(pack.count < rows * cols);
    for (size_t row = 0; row < rows; row++) {
        for (size_t col = 0; col < cols; col++) {
            TEST_ASSERT_EQUAL_INT(cells[row * cols + col], pack_at(&pack, row, col));
        }
    }
}

static void assert_packs(size_t rows, size_t cols)
{
    assert_packed(pack_table(&pack, cells, rows, cols, why), rows, cols);
}

static void assert_does_not_pack(size_t rows, size_t cols, const char *reason)
{
    TEST_ASSERT_EQUAL(-1, pack_table(&pack, cells, rows, cols, why));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(why, reason), why);
}

/* Packs, or says that it would not be smaller. */
static void assert_packs_if_smaller(size_t rows, size_t cols)
{
    int status;

    why[0] = '\0';
    status = pack_table(&pack, cells, rows, cols, why);
    if (status == 0 || strstr(why, "it would take") == NULL) {
        assert_packed(status, rows, cols);
    }
}

/* --- the brake's table ------------------------------------------------------------------------ */

static void pack_brake(const char *repair)
{
    const struct table_options options = {.infer = {.samples = INFER_SAMPLES}, .levels = 100};
    struct repair_report report;
    struct laws laws = {0};
    struct table table;
    struct fis fis;

    TEST_ASSERT_EQUAL(EXIT_FINE, fis_read("tables/brake.fis", &fis));
    TEST_ASSERT_EQUAL(EXIT_FINE, table_make(&fis, &options, &table));
    if (repair != NULL) {
        TEST_ASSERT_TRUE(laws_add(&laws, repair));
        repair_output(&table, 0, laws_of(&laws, 0), &report);
    }
    memcpy(cells, table.cell[0], table.cells * sizeof *cells);
    table_free(&table);
    fis_free(&fis);
    assert_packs(100, 100);
}

static void test_that_the_brakes_table_takes_less_than_2000_bytes(void)
{
    pack_brake(NULL);
    TEST_ASSERT_TRUE(pack.count <= 1895);
}

static void test_that_the_brakes_repaired_table_takes_less_than_1600_bytes(void)
{
    pack_brake("-1,+2");
    TEST_ASSERT_TRUE(pack.count <= 1532);
}

/* --- other tables ----------------------------------------------------------------------------- */

static void test_that_a_constant_table_is_a_few_bytes(void)
{
    for (size_t i = 0; i < SIDE_MAX * SIDE_MAX; i++) {
        cells[i] = 255;
    }
    assert_packs(SIDE_MAX, SIDE_MAX);
    /* one strip of one block: two bytes for it, its page, a run of two, 256 cells of shape */
    TEST_ASSERT_TRUE(pack.count <= 261);
}

static void test_that_planes_pack_in_every_shape(void)
{
    static const size_t side[] = {2, 7, 8, 9, 16, 17, 100, 255, 256};
    enum { SIDES = sizeof side / sizeof side[0] };

    for (size_t r = 0; r < SIDES; r++) {
        for (size_t c = 0; c < SIDES; c++) {
            for (size_t i = 0; i < side[r] * side[c]; i++) {
                cells[i] = (int)((i / side[c] * 3 + i % side[c] * 2) / 9);
            }
            assert_packs_if_smaller(side[r], side[c]);
            pack_free(&pack);
        }
    }
}

static void test_that_single_rows_and_columns_come_back(void)
{
    for (size_t length = 1; length <= SIDE_MAX; length += length < 40 ? 1 : 54) {
        for (size_t i = 0; i < length; i++) {
            cells[i] = (int)(i / 16);
        }
        assert_packs_if_smaller(1, length);
        pack_free(&pack);
        assert_packs_if_smaller(length, 1);
        pack_free(&pack);
    }
}

static void test_that_walks_of_many_pages_come_back(void)
{
    /* Every row differs, so that a strip of 256 rows fills its page to the last run. */
    for (size_t i = 0; i < SIDE_MAX * SIDE_MAX; i++) {
        cells[i] = (int)((i / SIDE_MAX + i % SIDE_MAX / 64) & 255);
    }
    assert_packs(SIDE_MAX, SIDE_MAX);
}

static void test_that_random_terraces_come_back(void)
{
    for (int round = 0; round < 40; round++) {
        size_t rows = 1 + random_below(60), cols = 1 + random_below(60);
        uint32_t down = 1 + random_below(20), across = 1 + random_below(20);

        for (size_t row = 0; row < rows; row++) {
            for (size_t col = 0; col < cols; col++) {
                int *cell = &cells[row * cols + col];

                *cell = row > 0 ? cell[-(ptrdiff_t)cols] : (int)random_below(256);
                if (col > 0 && random_below(across) != 0) {
                    *cell = cell[-1];
                }
                if (random_below(down) == 0) {
                    *cell = (*cell + (int)random_below(3)) & 255;
                }
            }
        }
        assert_packs_if_smaller(rows, cols);
        pack_free(&pack);
    }
}

static void test_that_leading_rows_alike_are_left_out(void)
{
    for (size_t i = 0; i < 64 * 64; i++) {
        cells[i] = i / 64 < 30 ? 7 : (int)(i / 64);
    }
    assert_packs(64, 64);
    TEST_ASSERT_EQUAL(24, pack.first_row);
    TEST_ASSERT_EQUAL(5, pack.blocks);
}

static void test_that_noise_is_refused_with_both_sizes(void)
{
    for (size_t i = 0; i < 100 * 100; i++) {
        cells[i] = (int)random_below(256);
    }
    assert_does_not_pack(100, 100, "it would take");
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(why, "the plain table 10000"), why);
}

static void test_that_more_than_a_byte_can_index_is_refused(void)
{
    assert_does_not_pack(257, 1, "257 by 1 cells");
    assert_does_not_pack(1, 300, "1 by 300 cells");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_the_brakes_table_takes_less_than_2000_bytes);
    RUN_TEST(test_that_the_brakes_repaired_table_takes_less_than_1600_bytes);
    RUN_TEST(test_that_a_constant_table_is_a_few_bytes);
    RUN_TEST(test_that_planes_pack_in_every_shape);
    RUN_TEST(test_that_single_rows_and_columns_come_back);
    RUN_TEST(test_that_walks_of_many_pages_come_back);
    RUN_TEST(test_that_random_terraces_come_back);
    RUN_TEST(test_that_leading_rows_alike_are_left_out);
    RUN_TEST(test_that_noise_is_refused_with_both_sizes);
    RUN_TEST(test_that_more_than_a_byte_can_index_is_refused);
    return UNITY_END();
}
