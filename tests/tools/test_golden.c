/* SPDX-License-Identifier: MIT */
/* Under test: inference, against data of programs that are not ours (tests/golden, which says how
 * it was made). */
#include "fistab/infer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "common/diag.h"

enum { FIELDS_MAX = 128 };

/* One line of a CSV file, cut at its commas. */
struct row {
    char *field[FIELDS_MAX];
    int fields;
    double number[FIELDS_MAX]; /* of the fields that are numbers */
};

static struct fis fis;

void setUp(void)
{
}

void tearDown(void)
{
}

static void cut(char *line, struct row *row)
{
    char *rest = line;

    line[strcspn(line, "\r\n")] = '\0';
    for (row->fields = 0; row->fields < FIELDS_MAX; row->fields++) {
        char *field = strsep(&rest, ",");
        if (field == NULL) {
            return;
        }
        row->field[row->fields] = field;
        row->number[row->fields] = strtod(field, NULL);
    }
}

/* Calls VISIT for each line of PATH but those that begin with #. Returns how many there were. */
static int each_row(const char *path, void (*visit)(const struct row *row))
{
    static char line[4096];
    FILE *file = fopen(path, "r");
    struct row row;
    int rows = 0;

    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    TEST_ASSERT_NOT_NULL(fgets(line, sizeof line, file));
    TEST_ASSERT_EQUAL_STRING_LEN_MESSAGE("# made by ", line, 10,
                                         "the first line says how it was made");
    while (fgets(line, sizeof line, file) != NULL) {
        if (line[0] == '#') {
            continue;
        }
        cut(line, &row);
        visit(&row);
        rows++;
    }
    fclose(file);
    return rows;
}

static void open_fis(const char *path)
{
    TEST_ASSERT_EQUAL(EXIT_FINE, fis_read(path, &fis));
}

static void eval(const double *x, double *y, bool exact)
{
    struct infer_options options = {.samples = INFER_SAMPLES, .exact = exact};
    struct engine *engine = engine_create(&fis, &options);

    TEST_ASSERT_NOT_NULL(engine);
    TEST_ASSERT_EQUAL(0, engine_eval(engine, x, y));
    engine_free(engine);
}

static int norm(const struct norm_name *names, const char *text)
{
    int i = 1;
    while (names[i].fis != NULL && strcmp(names[i].fis, text) != 0) {
        i++;
    }
    TEST_ASSERT_NOT_NULL_MESSAGE(names[i].fis, text);
    return i;
}

static int word(const char *const *words, const char *text)
{
    int i = 1;
    while (words[i] != NULL && strcmp(words[i], text) != 0) {
        i++;
    }
    TEST_ASSERT_NOT_NULL_MESSAGE(words[i], text);
    return i;
}

static void close_to(double expected, double got, double tolerance, const struct row *row)
{
    char message[200];

    snprintf(message, sizeof message, "at %s,%s,%s,%s,%s: expected %.12g, got %.12g", row->field[0],
             row->field[1], row->field[2], row->fields > 3 ? row->field[3] : "",
             row->fields > 4 ? row->field[4] : "", expected, got);
    TEST_ASSERT_TRUE_MESSAGE(fabs(expected - got) <= tolerance, message);
}

/* --- membership functions -------------------------------------------------------------------- */

static double degree_of(const struct row *row)
{
    double parameter[FIELDS_MAX];
    size_t count = 0;
    char *rest = row->field[1];
    enum mf_kind kind = mf_kind_by_name(row->field[0]);

    TEST_ASSERT_NOT_EQUAL(MF_UNKNOWN, kind);
    for (char *end = rest; *rest != '\0'; rest = end) {
        parameter[count] = strtod(rest, &end);
        if (end == rest) {
            break;
        }
        count++;
    }
    TEST_ASSERT_NULL(mf_fault(kind, parameter, count));
    return mf_degree(kind, parameter, count, row->number[2]);
}

static void membership(const struct row *row)
{
    close_to(row->number[3], degree_of(row), 1e-12, row);
}

static void membership_as_share(const struct row *row)
{
    double degree = degree_of(row);
    close_to(row->number[3], degree / (degree + 1), 1e-11, row); /* 12 decimals are printed */
}

static void test_membership_functions_equal_those_of_octave(void)
{
    TEST_ASSERT_EQUAL(22 * 34, each_row("tests/golden/mf_octave.csv", membership));
}

static void test_membership_functions_equal_those_of_fuzzylite(void)
{
    TEST_ASSERT_EQUAL(6 * 34, each_row("tests/golden/mf_fuzzylite.csv", membership_as_share));
}

/* --- Mamdani --------------------------------------------------------------------------------- */

/* and,or,imp,agg,output,x1,x2,centroid,bisector,mom,som,lom */
static void mamdani(const struct row *row)
{
    static const enum fis_defuzz method[] = {DEFUZZ_CENTROID, DEFUZZ_BISECTOR, DEFUZZ_MOM,
                                             DEFUZZ_SOM, DEFUZZ_LOM};
    int output = atoi(row->field[4]) - 1;
    struct variable *variable = &fis.output[output];

    fis.block[0].and_method = (enum tnorm)norm(tnorm_name, row->field[0]);
    fis.block[0].or_method = (enum snorm)norm(snorm_name, row->field[1]);
    fis.block[0].imp_method = (enum tnorm)norm(tnorm_name, row->field[2]);
    variable->agg_method = (enum snorm)norm(snorm_name, row->field[3]);
    for (int i = 0; i < 5; i++) {
        double y[FIS_VARIABLES_MAX];
        variable->defuzz_method = method[i];
        eval(&row->number[5], y, false);
        close_to(row->number[7 + i], y[output], 1e-9 * (variable->max - variable->min), row);
    }
}

static void test_asymmetric_surfaces_of_all_methods_equal_those_of_octave(void)
{
    open_fis("tests/golden/asym.fis");
    TEST_ASSERT_EQUAL(24 * 30 * 2, each_row("tests/golden/surface_octave.csv", mamdani));
    fis_free(&fis);
}

static void test_brake_surfaces_equal_those_of_octave(void)
{
    open_fis("tables/brake.fis");
    TEST_ASSERT_EQUAL(2 * 17 * 15, each_row("tests/golden/brake_octave.csv", mamdani));
    fis_free(&fis);
}

/* --- Sugeno ---------------------------------------------------------------------------------- */

/* and,or,defuzz,x1,x2,y1,y2 */
static void sugeno(const struct row *row, double tolerance)
{
    double y[FIS_VARIABLES_MAX];

    fis.block[0].and_method = (enum tnorm)norm(tnorm_name, row->field[0]);
    fis.block[0].or_method = (enum snorm)norm(snorm_name, row->field[1]);
    for (size_t o = 0; o < fis.outputs; o++) {
        fis.output[o].defuzz_method = (enum fis_defuzz)word(fis_defuzz_words, row->field[2]);
    }
    eval(&row->number[3], y, false);
    close_to(row->number[5], y[0], tolerance, row);
    close_to(row->number[6], y[1], tolerance, row);
}

static void sugeno_octave(const struct row *row)
{
    sugeno(row, 1e-11);
}

static void sugeno_fuzzylite(const struct row *row)
{
    sugeno(row, 5e-12); /* 12 decimals are printed */
}

static void test_sugeno_equals_octave(void)
{
    open_fis("tests/golden/sugeno.fis");
    TEST_ASSERT_EQUAL(2 * 8 * 7, each_row("tests/golden/sugeno_octave.csv", sugeno_octave));
    fis_free(&fis);
}

static void test_sugeno_equals_fuzzylite(void)
{
    open_fis("tests/golden/sugeno.fis");
    TEST_ASSERT_EQUAL(2 * 8 * 6, each_row("tests/golden/sugeno_fuzzylite.csv", sugeno_fuzzylite));
    fis_free(&fis);
}

/* --- exact ----------------------------------------------------------------------------------- */

static int exact_row;

static void exact_cells(const struct row *row)
{
    TEST_ASSERT_EQUAL(100, row->fields);
    for (int c = 0; c < 100; c++) {
        double x[2] = {1.02 + 0.04 * exact_row, 0.175 + 0.35 * c};
        double y;
        eval(x, &y, true);
        close_to(row->number[c], y, 1e-11, row);
    }
    exact_row++;
}

static void exact_anchor(const struct row *row)
{
    double y;

    eval(&row->number[2], &y, true);
    close_to(row->number[4] / row->number[5], y, 1e-12, row);
}

static void test_exact_equals_the_rational_surface(void)
{
    open_fis("tables/brake.fis");
    exact_row = 0;
    TEST_ASSERT_EQUAL(100, each_row("tests/golden/exact_centre_100x100.csv", exact_cells));
    fis_free(&fis);
}

static void test_exact_equals_the_rational_anchors(void)
{
    open_fis("tables/brake.fis");
    TEST_ASSERT_EQUAL(13, each_row("tests/golden/exact_rational_anchors.csv", exact_anchor));
    fis_free(&fis);
}

/* fuzzylite sums over midpoints of h = range / 100,000. Where the set is straight or smooth, that
 * is right to the second order in h, about h^2/24 of its curvature; a kink inside a stripe costs at
 * most h^2/8 times the change of slope. Both the brake's and the other system's slopes are below 60
 * / range, and there are fewer than 40 kinks, so the area is off by less than 40 * 60/8 * 1e-10 =
 * 3e-8 of the range, the moment about the middle by half of that; the area is above 0.1 of the
 * range: together below 4.5e-7 of the range. */
#define MIDPOINT_ERROR 4.5e-7

static void exact_fuzzylite(const struct row *row)
{
    double y[FIS_VARIABLES_MAX];

    eval(row->number, y, true);
    for (size_t o = 0; o < fis.outputs; o++) {
        close_to(row->number[2 + o], y[o], MIDPOINT_ERROR * (fis.output[o].max - fis.output[o].min),
                 row);
    }
}

static void test_exact_brake_is_what_fuzzylite_tends_to(void)
{
    open_fis("tables/brake.fis");
    TEST_ASSERT_EQUAL(17 * 15, each_row("tests/golden/brake_fuzzylite.csv", exact_fuzzylite));
    fis_free(&fis);
}

static void test_exact_curved_sets_are_what_fuzzylite_tends_to(void)
{
    open_fis("tests/golden/asym.fis");
    for (size_t r = 0; r < fis.rules;
         r++) { /* the data are for the system without `not` in its outcomes */
        for (size_t o = 0; o < fis.outputs; o++) {
            fis.rule[r].term[fis.inputs + o] = abs(fis.rule[r].term[fis.inputs + o]);
        }
    }
    TEST_ASSERT_EQUAL(6 * 5, each_row("tests/golden/surface_fuzzylite.csv", exact_fuzzylite));
    fis_free(&fis);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_membership_functions_equal_those_of_octave);
    RUN_TEST(test_membership_functions_equal_those_of_fuzzylite);
    RUN_TEST(test_asymmetric_surfaces_of_all_methods_equal_those_of_octave);
    RUN_TEST(test_brake_surfaces_equal_those_of_octave);
    RUN_TEST(test_sugeno_equals_octave);
    RUN_TEST(test_sugeno_equals_fuzzylite);
    RUN_TEST(test_exact_equals_the_rational_surface);
    RUN_TEST(test_exact_equals_the_rational_anchors);
    RUN_TEST(test_exact_brake_is_what_fuzzylite_tends_to);
    RUN_TEST(test_exact_curved_sets_are_what_fuzzylite_tends_to);
    return UNITY_END();
}
