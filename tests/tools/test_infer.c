/* SPDX-License-Identifier: MIT */
/* Under test: tools/fistab/infer.c and defuzz.c, sampled inference against cases worked out by
 * hand. */
#include "fis_text.h"

#include <math.h>

#include "fistab/defuzz.h"

void setUp(void)
{
}

void tearDown(void)
{
    fis_free(&fis);
}

/* Asserts |EXPECTED - GOT| <= 1e-12; Unity's own would compare as float. */
#define NEAR(expected, got) near_(expected, got, __LINE__)
static void near_(double expected, double got, int line)
{
    char message[100];

    snprintf(message, sizeof message, "expected %.15g, got %.15g", expected, got);
    if (!(fabs(expected - got) <= 1e-12)) {
        UNITY_TEST_FAIL((UNITY_LINE_TYPE)line, message);
    }
}

/* One input 0..10 with a falling and a rising set; one output 0..10 likewise, and a middle one. */
#define ONE_INPUT                                                                                  \
    "[Input1]\nName='x'\nRange=[0 10]\nMF1='falls':'trimf',[0 0 10]\nMF2='rises':'trimf',[0 10 "   \
    "10]\n"
#define ONE_OUTPUT                                                                                 \
    "[Output1]\nName='y'\nRange=[0 10]\nMF1='low':'trimf',[0 0 10]\nMF2='high':'trimf',[0 10 "     \
    "10]\n"                                                                                        \
    "MF3='middle':'trimf',[0 5 10]\n"

/* --- the brake ------------------------------------------------------------------------------- */

static void test_spot_values_of_the_brake(void)
{
    static const double spot[][3] = {{3, 10, 86.28104575},
                                     {1.5, 5, 83.71717172},
                                     {2.5, 0, 68.85185185},
                                     {5, 0, 9.666666667},
                                     {4, 0, 30}};

    TEST_ASSERT_EQUAL(EXIT_FINE, fis_read("tables/brake.fis", &fis));
    for (size_t i = 0; i < sizeof spot / sizeof spot[0]; i++) {
        TEST_ASSERT_TRUE(fabs(spot[i][2] - output(101, spot[i][0], spot[i][1])) <
                         6e-9); /* ten digits are given */
    }
}

/* --- three samples at 0, 5 and 10 ------------------------------------------------------------ */

/* x = 6: falls 0.4, so low (1, 0.5, 0) becomes 0.4, 0.4, 0. */
static void test_min_cuts_a_set(void)
{
    given("[System]\n" METHODS("min", "max", "min", "max", "%s") ONE_INPUT ONE_OUTPUT
          "[Rules]\n1, 1 (1) : 1\n",
          "centroid");
    NEAR(2.5, output(3, 6, 0));
}

/* 0.4, 0.2, 0. */
static void test_prod_scales_a_set(void)
{
    given("[System]\n" METHODS("min", "max", "prod", "max", "centroid") ONE_INPUT ONE_OUTPUT
          "[Rules]\n1, 1 (1) : 1\n");
    NEAR(5 * 0.2 / 0.6, output(3, 6, 0));
}

/* low: 0.4, 0.4, 0; high, at rises = 0.6: 0, 0.5, 0.6. */
static void test_aggregation(void)
{
    const char *text = "[System]\n" METHODS("min", "max", "min", "%s", "centroid")
        ONE_INPUT ONE_OUTPUT "[Rules]\n1, 1 (1) : 1\n2, 2 (1) : 1\n";

    given(text, "max"); /* 0.4, 0.5, 0.6 */
    NEAR((5 * 0.5 + 10 * 0.6) / 1.5, output(3, 6, 0));
    given(text, "sum"); /* 0.4, 0.9, 0.6 */
    NEAR((5 * 0.9 + 10 * 0.6) / 1.9, output(3, 6, 0));
    given(text, "probor"); /* 0.4, 0.4 + 0.5 - 0.2, 0.6 */
    NEAR((5 * 0.7 + 10 * 0.6) / 1.7, output(3, 6, 0));
}

/* With sum and probor, two rules with one outcome count twice; with max once. */
static void test_two_rules_with_one_outcome(void)
{
    const char *text = "[System]\n" METHODS("min", "max", "min", "%s", "centroid")
        ONE_INPUT ONE_OUTPUT "[Rules]\n1, 1 (1) : 1\n2, 1 (1) : 1\n2, 2 (1) : 1\n";

    given(text, "max"); /* low at 0.6: 0.6, 0.5, 0; high: 0, 0.5, 0.6 */
    NEAR((5 * 0.5 + 10 * 0.6) / 1.7, output(3, 6, 0));
    given(text, "sum"); /* 0.4 + 0.6, 0.4 + 0.5 + 0.5, 0.6 */
    NEAR((5 * 1.4 + 10 * 0.6) / 3, output(3, 6, 0));
    given(text, "probor"); /* 0.4 + 0.6 - 0.24; (0.4 + 0.5 - 0.2) + 0.5 - 0.35; 0.6 */
    NEAR((5 * 0.85 + 10 * 0.6) / (0.76 + 0.85 + 0.6), output(3, 6, 0));
}

static void test_methods_of_defuzzification(void)
{
    const char *text = "[System]\n" METHODS("min", "max", "min", "max", "%s") ONE_INPUT ONE_OUTPUT
        "[Rules]\n1, 1 (1) : 1\n";

    given(text, "bisector"); /* 0.4, 0.4, 0: half of 0.8 is reached at once */
    NEAR(0, output(3, 6, 0));
    given(text, "mom");
    NEAR(2.5, output(3, 6, 0));
    given(text, "som");
    NEAR(0, output(3, 6, 0));
    given(text, "lom");
    NEAR(5, output(3, 6, 0));
}

/* near is (5 - 3.32) / 2 = 0.84 here, and hold is 0.84 at the samples -0.16 and 0.16: the ends of
 * its plateau, which rounding takes to be a little above or below. */
static void test_a_plateau_that_ends_on_samples_keeps_its_ends(void)
{
    given("[System]\n" METHODS(
        "min", "max", "min", "max",
        "mom") "[Input1]\nName='gap'\nRange=[0 10]\nMF1='near':'trimf',[1 3 5]\n"
               "[Output1]\nName='command'\nRange=[-2 2]\nMF1='hold':'trimf',[-1 0 1]\n"
               "[Rules]\n1, 1 (1) : 1\n");
    NEAR(0, output(101, 3.32, 0));
}

/* --- MathWorks' own example of defuzz: the answers stand in its documentation ---------------- */

static void test_the_example_of_matlabs_documentation(void)
{
    static const double trapezoid[3][4] = {{-10, -8, -2, 2}, {-5, -3, 2, 4}, {2, 3, 8, 9}};
    static const double height[3] = {0.9, 0.5, 0.1};
    enum { N = 201 };
    double x[N], mu[N], y;

    for (int k = 0; k < N; k++) {
        x[k] = -10 + 0.1 * k;
        mu[k] = 0;
        for (int i = 0; i < 3; i++) {
            mu[k] = fmax(mu[k], height[i] * mf_degree(MF_TRAPMF, trapezoid[i], 4, x[k]));
        }
    }
    TEST_ASSERT_TRUE(defuzz(&(struct variable){.defuzz_method = DEFUZZ_MOM}, x, mu, N, &y));
    NEAR(-5, y);
    TEST_ASSERT_TRUE(defuzz(&(struct variable){.defuzz_method = DEFUZZ_SOM}, x, mu, N, &y));
    NEAR(-2, y);
    TEST_ASSERT_TRUE(defuzz(&(struct variable){.defuzz_method = DEFUZZ_LOM}, x, mu, N, &y));
    NEAR(-8, y);
}

static void test_of_two_alike_in_size_the_left_one_counts(void)
{
    static const double x[] = {-2, -1, 0, 1, 2};
    static const double mu[] = {1, 0.5, 0, 0.5, 1};
    double y;

    TEST_ASSERT_TRUE(defuzz(&(struct variable){.defuzz_method = DEFUZZ_SOM}, x, mu, 5, &y));
    NEAR(-2, y);
    TEST_ASSERT_TRUE(defuzz(&(struct variable){.defuzz_method = DEFUZZ_LOM}, x, mu, 5, &y));
    NEAR(-2, y);
    TEST_ASSERT_TRUE(defuzz(&(struct variable){.defuzz_method = DEFUZZ_MOM}, x, mu, 5, &y));
    NEAR(0, y);
}

static void test_that_an_empty_set_has_no_centre(void)
{
    static const double x[] = {0, 1};
    static const double mu[] = {0, 0};
    double y = 7;

    for (enum fis_defuzz method = DEFUZZ_CENTROID; method <= DEFUZZ_SOM; method++) {
        TEST_ASSERT_FALSE(defuzz(&(struct variable){.defuzz_method = method}, x, mu, 2, &y));
    }
    NEAR(7, y);
}

/* --- rules: a Sugeno system gives the strengths away ----------------------------------------- */

/* One rule says 1, one says 0 with strength 1: the answer is s / (s + 1). */
#define STRENGTH                                                                                   \
    "[Input1]\nName='a'\nRange=[0 10]\nMF1='set':'trimf',[0 0 10]\n[Input2]\nName='b'\nRange=[0 "  \
    "10]\n"                                                                                        \
    "MF1='set':'trimf',[0 0 10]\n[Output1]\nName='y'\nRange=[0 1]\nMF1='one':'constant',[1]\n"     \
    "MF2='none':'constant',[0]\n[Rules]\n0 0, 2 (1) : 1\n"

static double strength(const char *and_method, const char *or_method, const char *rule)
{
    double y;

    given("[System]\nType='sugeno'\nAndMethod='%s'\nOrMethod='%s'\nDefuzzMethod='wtaver'\n" STRENGTH
          "%s\n",
          and_method, or_method, rule);
    y = output(101, 3, 6); /* degrees 0.7 and 0.4 */
    return y / (1 - y);
}

static void test_strengths_of_rules(void)
{
    NEAR(0.4, strength("min", "max", "1 1, 1 (1) : 1"));
    NEAR(0.28, strength("prod", "max", "1 1, 1 (1) : 1"));
    NEAR(0.7, strength("min", "max", "1 1, 1 (1) : 2"));
    NEAR(0.82, strength("min", "probor", "1 1, 1 (1) : 2"));
    NEAR(0.3, strength("min", "max", "-1 1, 1 (1) : 1"));
    NEAR(0.6, strength("min", "max", "-1 -1, 1 (1) : 2"));
    NEAR(0.2, strength("min", "max", "1 1, 1 (0.5) : 1"));
    NEAR(0.7, strength("min", "max", "1 0, 1 (1) : 1"));
    NEAR(0.4, strength("min", "max", "0 1, 1 (1) : 2"));
    NEAR(1, strength("min", "max", "0 0, 1 (1) : 1"));
    NEAR(0, strength("min", "max", "0 0, 1 (1) : 2"));
    NEAR(0, strength("min", "max", "1 1, 1 (0) : 1"));
}

/* --- Sugeno ---------------------------------------------------------------------------------- */

static void test_sugeno_weighs_planes(void)
{
    const char *text = "[System]\nType='sugeno'\nDefuzzMethod='%s'\n" ONE_INPUT
                       "[Output1]\nName='y'\nRange=[0 10]\n"
                       "MF1='flat':'constant',[4]\nMF2='plane':'linear',[2 -1]\n[Rules]\n1, 1 (1) "
                       ": 1\n2, 2 (0.5) : 1\n";

    given(text, "wtaver"); /* x = 6: 0.4 of 4, 0.3 of 11 */
    NEAR((0.4 * 4 + 0.3 * 11) / 0.7, output(101, 6, 0));
    given(text, "wtsum");
    NEAR(0.4 * 4 + 0.3 * 11, output(101, 6, 0));
}

static void test_a_rule_that_leaves_an_output_out_does_not_count_for_it(void)
{
    double x[1] = {6}, y[2];

    given(
        "[System]\nType='sugeno'\nDefuzzMethod='wtaver'\n" ONE_INPUT
        "[Output1]\nName='y'\nRange=[0 10]\n"
        "MF1='flat':'constant',[4]\n[Output2]\nName='z'\nRange=[0 10]\nMF1='flat':'constant',[9]\n"
        "[Rules]\n1, 1 0 (1) : 1\n2, 0 1 (1) : 1\n");
    TEST_ASSERT_EQUAL(0, eval(101, x, y));
    NEAR(4, y[0]);
    NEAR(9, y[1]);
}

/* --- nothing fires --------------------------------------------------------------------------- */

static void test_without_a_rule_the_answer_is_the_middle_of_the_range(void)
{
    double x[1] = {10}, y[2] = {0, 0};
    struct infer_options options = {.samples = 101};
    struct engine *engine;

    given("[System]\n" ONE_INPUT
          "[Output1]\nName='y'\nRange=[-2 10]\nMF1='low':'trimf',[-2 -2 10]\n"
          "[Output2]\nName='z'\nRange=[0 8]\nMF1='low':'trimf',[0 4 8]\n[Rules]\n1, 1 0 (1) : "
          "1\n2, 0 1 (1) : 1\n");
    engine = engine_create(&fis, &options);
    TEST_ASSERT_EQUAL(1, engine_eval(engine, x, y));
    TEST_ASSERT_FALSE(engine_fired(engine, 0));
    TEST_ASSERT_TRUE(engine_fired(engine, 1));
    NEAR(4, y[0]);
    NEAR(4, y[1]);
    engine_free(engine);
}

static void test_a_set_that_no_sample_meets_is_like_no_rule(void)
{
    double x[1] = {0}, y[1];

    given("[System]\n" ONE_INPUT "[Output1]\nName='y'\nRange=[0 10]\nMF1='thin':'trimf',[4 4.2 "
          "4.4]\n[Rules]\n1, 1 (1) : 1\n");
    TEST_ASSERT_EQUAL(1, eval(3, x, y)); /* samples at 0, 5, 10 */
    NEAR(5, y[0]);
    TEST_ASSERT_EQUAL(0, eval(51, x, y)); /* 4.2 is one */
    NEAR(4.2, y[0]);
    TEST_ASSERT_EQUAL(0, eval(0, x, y));
    NEAR(4.2, y[0]);
}

static void test_points_do_not_depend_on_the_points_before(void)
{
    struct infer_options options = {.samples = 101};
    struct engine *engine;
    double first[2] = {3, 10}, second[2] = {3, 20}, third[2] = {2, 10};
    double y, again;

    TEST_ASSERT_EQUAL(EXIT_FINE, fis_read("tables/brake.fis", &fis));
    engine = engine_create(&fis, &options);
    engine_eval(engine, first, &y);
    engine_eval(engine, second, &again);
    engine_eval(engine, third, &again);
    engine_eval(engine, first, &again);
    TEST_ASSERT_TRUE(y == again);
    engine_free(engine);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_spot_values_of_the_brake);
    RUN_TEST(test_min_cuts_a_set);
    RUN_TEST(test_prod_scales_a_set);
    RUN_TEST(test_aggregation);
    RUN_TEST(test_two_rules_with_one_outcome);
    RUN_TEST(test_methods_of_defuzzification);
    RUN_TEST(test_a_plateau_that_ends_on_samples_keeps_its_ends);
    RUN_TEST(test_the_example_of_matlabs_documentation);
    RUN_TEST(test_of_two_alike_in_size_the_left_one_counts);
    RUN_TEST(test_that_an_empty_set_has_no_centre);
    RUN_TEST(test_strengths_of_rules);
    RUN_TEST(test_sugeno_weighs_planes);
    RUN_TEST(test_a_rule_that_leaves_an_output_out_does_not_count_for_it);
    RUN_TEST(test_without_a_rule_the_answer_is_the_middle_of_the_range);
    RUN_TEST(test_a_set_that_no_sample_meets_is_like_no_rule);
    RUN_TEST(test_points_do_not_depend_on_the_points_before);
    return UNITY_END();
}
