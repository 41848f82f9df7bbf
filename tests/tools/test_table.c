/* SPDX-License-Identifier: MIT */
/* Under test: table.c and header.c: which cell is where, what it holds, and how the chip finds it.
 */
#include "fistab/table.h"

#include <math.h>
#include <stdlib.h>

#include "fis_text.h"
#include "fistab/crc.h"
#include "fistab/header.h"

static struct table table;

void setUp(void)
{
}

void tearDown(void)
{
    table_free(&table);
    fis_free(&fis);
}

static void make(const struct table_options *options)
{
    TEST_ASSERT_EQUAL(EXIT_FINE, table_make(&fis, options, &table));
}

#define OPTIONS(levels_, ...)                                                                      \
    (&(const struct table_options){                                                                \
        .infer = {.samples = INFER_SAMPLES}, .levels = levels_, __VA_ARGS__})

/* Sugeno planes: a cell tells where it was sampled. Input 1 counts tens, input 2 ones. */
static void given_plane(void)
{
    given("[System]\nType='sugeno'\nDefuzzMethod='wtaver'\n[Input1]\nName='row'\nRange=[0 "
          "4]\n[Input2]\nName='column'\n"
          "Range=[10 13]\n[Output1]\nName='y'\nRange=[0 100]\nMF1='plane':'linear',[10 1 "
          "-10]\n[Rules]\n0 0, 1 (1) : 1\n");
}

static void test_rows_are_the_first_input_and_cells_their_centres(void)
{
    given_plane();
    make(OPTIONS(100, .dims = {4, 3}));

    TEST_ASSERT_EQUAL(12, table.cells);
    for (size_t r = 0; r < 4; r++) {
        for (size_t c = 0; c < 3; c++) {
            double expected = 10 * ((double)r + 0.5) + ((double)c + 0.5);
            TEST_ASSERT_TRUE(fabs(expected - table.surface[0][3 * r + c]) < 1e-12);
            TEST_ASSERT_EQUAL((int)floor(expected + 0.5), table.cell[0][3 * r + c]);
        }
    }
    TEST_ASSERT_TRUE(fabs(table_axis_value(&table, 1, 2) - 12.5) < 1e-15);
}

static void test_nodes_go_from_end_to_end(void)
{
    given_plane();
    make(OPTIONS(100, .dims = {3, 4}, .nodes = true));

    TEST_ASSERT_EQUAL(0, table.cell[0][0]);
    TEST_ASSERT_EQUAL(1, table.cell[0][1]);
    TEST_ASSERT_EQUAL(20, table.cell[0][4]);
    TEST_ASSERT_EQUAL(43, table.cell[0][11]);
    TEST_ASSERT_TRUE(table_axis_value(&table, 0, 2) == 4);
    TEST_ASSERT_TRUE(table_axis_value(&table, 1, 3) == 13);
}

static void test_the_asymmetric_system_is_not_transposed(void)
{
    struct infer_options infer = {.samples = INFER_SAMPLES};
    struct engine *engine;

    TEST_ASSERT_EQUAL(EXIT_FINE, fis_read("tests/golden/asym.fis", &fis));
    make(OPTIONS(100, .dims = {7, 5}));
    engine = engine_create(&fis, &infer);
    for (size_t r = 0; r < 7; r++) {
        for (size_t c = 0; c < 5; c++) {
            double x[2] = {-2 + (double)r + 0.5, 10 + 16 * ((double)c + 0.5)};
            double y[2];
            engine_eval(engine, x, y);
            TEST_ASSERT_TRUE(fabs((y[0] + 3) / 14 * 100 - table.surface[0][5 * r + c]) < 1e-9);
            TEST_ASSERT_TRUE(fabs(y[1] * 100 - table.surface[1][5 * r + c]) < 1e-9);
        }
    }
    engine_free(engine);
}

static void test_four_inputs_and_the_last_one_fastest(void)
{
    size_t at[4];

    given("[System]\nType='sugeno'\nDefuzzMethod='wtaver'\n[Input1]\nName='a'\nRange=[0 "
          "2]\n[Input2]\nName='b'\nRange=[0 3]\n"
          "[Input3]\nName='c'\nRange=[0 4]\n[Input4]\nName='d'\nRange=[0 "
          "5]\n[Output1]\nName='y'\nRange=[0 255]\n"
          "MF1='p':'linear',[100 20 5 1 -63]\n[Rules]\n0 0 0 0, 1 (1) : 1\n");
    make(OPTIONS(255, .dims = {2, 3, 4, 5}));

    TEST_ASSERT_EQUAL(120, table.cells);
    TEST_ASSERT_EQUAL(0, table.cell[0][0]);
    TEST_ASSERT_EQUAL(1, table.cell[0][1]);
    TEST_ASSERT_EQUAL(5, table.cell[0][5]);
    TEST_ASSERT_EQUAL(20, table.cell[0][20]);
    TEST_ASSERT_EQUAL(100, table.cell[0][60]);
    table_coordinates(&table, 60 + 2 * 20 + 3 * 5 + 4, at);
    for (size_t i = 0; i < 4; i++) {
        TEST_ASSERT_EQUAL(i + 1, at[i]);
    }
}

static void test_levels_stretch_the_range_of_the_output(void)
{
    given("[System]\nType='sugeno'\nDefuzzMethod='wtaver'\n[Input1]\nName='x'\nRange=[-8 "
          "8]\n[Output1]\nName='y'\n"
          "Range=[-8 8]\nMF1='same':'linear',[1 0]\n[Rules]\n0, 1 (1) : 1\n");
    make(OPTIONS(200, .dims = {5}, .nodes = true));

    TEST_ASSERT_EQUAL(0, table.cell[0][0]);
    TEST_ASSERT_EQUAL(50, table.cell[0][1]);
    TEST_ASSERT_EQUAL(100, table.cell[0][2]);
    TEST_ASSERT_EQUAL(200, table.cell[0][4]);
}

static void test_that_a_half_rounds_up(void)
{
    TEST_ASSERT_EQUAL(3, table_round(2.5));
    TEST_ASSERT_EQUAL(3, table_round(2.5 - 1e-10)); /* a half, apart from rounding errors */
    TEST_ASSERT_EQUAL(2, table_round(2.5 - 1e-8));
    TEST_ASSERT_EQUAL(0, table_round(0.49));
    TEST_ASSERT_EQUAL(100, table_round(100));
}

static void test_cells_of_the_brake_run_from_13_to_86(void)
{
    int low = 100, high = 0;

    TEST_ASSERT_EQUAL(EXIT_FINE, fis_read("tables/brake.fis", &fis));
    make(OPTIONS(100, .nodes = false));

    TEST_ASSERT_EQUAL(10000, table.cells);
    for (size_t i = 0; i < table.cells; i++) {
        low = table.cell[0][i] < low ? table.cell[0][i] : low;
        high = table.cell[0][i] > high ? table.cell[0][i] : high;
    }
    TEST_ASSERT_EQUAL(13, low);
    TEST_ASSERT_EQUAL(86, high);
}

/* The exact integral differs from the 101-point sum in 2,264 rounded cells: which rule made a table
 * matters. */
static void test_where_exact_and_sampled_brakes_differ(void)
{
    struct table exact;
    size_t differ = 0;

    TEST_ASSERT_EQUAL(EXIT_FINE, fis_read("tables/brake.fis", &fis));
    make(OPTIONS(100, .nodes = false));
    TEST_ASSERT_EQUAL(EXIT_FINE,
                      table_make(&fis,
                                 &(const struct table_options){
                                     .infer = {.samples = 101, .exact = true}, .levels = 100},
                                 &exact));
    for (size_t i = 0; i < table.cells; i++) {
        differ += table.cell[0][i] != exact.cell[0][i];
    }
    table_free(&exact);
    TEST_ASSERT_EQUAL(2264, differ);
}

static void test_that_a_hole_makes_no_table(void)
{
    given("[System]\n[Input1]\nName='x'\nRange=[0 10]\nMF1='low':'trimf',[0 0 "
          "4]\n[Output1]\nName='y'\nRange=[0 10]\n"
          "MF1='low':'trimf',[0 0 10]\n[Rules]\n1, 1 (1) : 1\n");
    TEST_ASSERT_EQUAL(EXIT_INPUT, table_make(&fis, OPTIONS(100, .nodes = false), &table));
}

/* --- reciprocals ----------------------------------------------------------------------------- */

static void check_reciprocal(unsigned long span, unsigned long cells)
{
    unsigned mul, shift;
    char message[80];

    if (!header_reciprocal(span, cells, &mul, &shift)) {
        return;
    }
    TEST_ASSERT_TRUE(mul <= 0xFFFF);
    for (unsigned long x = 0; x <= span; x++) {
        uint32_t product = (uint32_t)x * mul; /* as the chip has it */
        snprintf(message, sizeof message, "span %lu, %lu cells, at %lu", span, cells, x);
        TEST_ASSERT_EQUAL_MESSAGE(x * cells / span, product >> (16 + shift), message);
    }
}

static void test_reciprocals_are_exact(void)
{
    unsigned mul, shift;

    TEST_ASSERT_TRUE(header_reciprocal(4000, 100, &mul, &shift));
    TEST_ASSERT_TRUE(header_reciprocal(35000, 100, &mul, &shift));
    TEST_ASSERT_TRUE(header_reciprocal(65535, 255, &mul, &shift));
    for (unsigned long span = 1; span < 65536; span += span / 7 + 1) {
        for (unsigned long cells = 1; cells < 300; cells += cells / 3 + 1) {
            check_reciprocal(span, cells);
        }
    }
}

static void test_there_is_no_reciprocal_of_what_does_not_fit(void)
{
    unsigned mul, shift;

    TEST_ASSERT_FALSE(header_reciprocal(65536, 100, &mul, &shift)); /* x has 16 bits */
    TEST_ASSERT_FALSE(
        header_reciprocal(50, 100, &mul, &shift)); /* more cells than steps: mul has not 16 */
    TEST_ASSERT_FALSE(header_reciprocal(0, 100, &mul, &shift));
}

/* --- check sums ------------------------------------------------------------------------------ */

static void test_check_sums_have_their_published_values(void)
{
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926, crc32_update(0, "123456789", 9));
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926, crc32_update(crc32_update(0, "1234", 4), "56789", 5));
    TEST_ASSERT_EQUAL_HEX16(0x29B1, crc16_update(0xFFFF, "123456789", 9));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rows_are_the_first_input_and_cells_their_centres);
    RUN_TEST(test_nodes_go_from_end_to_end);
    RUN_TEST(test_the_asymmetric_system_is_not_transposed);
    RUN_TEST(test_four_inputs_and_the_last_one_fastest);
    RUN_TEST(test_levels_stretch_the_range_of_the_output);
    RUN_TEST(test_that_a_half_rounds_up);
    RUN_TEST(test_cells_of_the_brake_run_from_13_to_86);
    RUN_TEST(test_where_exact_and_sampled_brakes_differ);
    RUN_TEST(test_that_a_hole_makes_no_table);
    RUN_TEST(test_reciprocals_are_exact);
    RUN_TEST(test_there_is_no_reciprocal_of_what_does_not_fit);
    RUN_TEST(test_check_sums_have_their_published_values);
    return UNITY_END();
}
