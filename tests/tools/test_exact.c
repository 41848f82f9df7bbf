/* SPDX-License-Identifier: MIT */
/* Under test: exact.c, shape.c and quad.c: --exact against integrals worked out by hand. */
#include "fis_text.h"

#include <math.h>

void setUp(void)
{
}

void tearDown(void)
{
    fis_free(&fis);
}

/* Asserts |EXPECTED - GOT| <= 1e-9 of the range of the output. */
#define NEAR(expected, got)  near_(expected, got, 1e-9, __LINE__)
#define EQUAL(expected, got) near_(expected, got, 1e-14, __LINE__)
static void near_(double expected, double got, double share, int line)
{
    double range = fis.output[0].max - fis.output[0].min;
    char message[120];

    snprintf(message, sizeof message, "expected %.15g, got %.15g, off by %.2g of the range",
             expected, got, fabs(expected - got) / range);
    if (!(fabs(expected - got) <= share * range)) {
        UNITY_TEST_FAIL((UNITY_LINE_TYPE)line, message);
    }
}

/* The input a is the strength of the first rule, b of the second. */
static void system_of(const char *imp, const char *agg, const char *defuzz, double min, double max,
                      const char *sets, const char *rules)
{
    given("[System]\nImpMethod='%s'\nAggMethod='%s'\nDefuzzMethod='%s'\n[Input1]\nName='a'\nRange=["
          "0 1]\n"
          "MF1='a':'linsmf',[0 1]\n[Input2]\nName='b'\nRange=[0 1]\nMF1='b':'linsmf',[0 1]\n"
          "[Output1]\nName='y'\nRange=[%.17g %.17g]\n%s\n[Rules]\n%s\n",
          imp, agg, defuzz, min, max, sets, rules);
}

#define ONE_RULE  "1 0, 1 (1) : 1"
#define TWO_RULES "1 0, 1 (1) : 1\n0 1, 2 (1) : 1"

/* --- straight sets: to the last digits ------------------------------------------------------- */

/* trimf [0 0 10] cut at 0.5: a box of 5 and a triangle. Area 3.75, moment 6.25 + 25/3. */
static void test_a_cut_triangle(void)
{
    static const char sets[] = "MF1='low':'trimf',[0 0 10]";

    system_of("min", "max", "centroid", 0, 10, sets, ONE_RULE);
    EQUAL(35.0 / 9, output(0, 0.5, 0));
    system_of("min", "max", "bisector", 0, 10, sets, ONE_RULE);
    EQUAL(3.75, output(0, 0.5, 0));
    system_of("min", "max", "mom", 0, 10, sets, ONE_RULE);
    EQUAL(2.5, output(0, 0.5, 0));
    system_of("min", "max", "som", 0, 10, sets, ONE_RULE);
    EQUAL(0, output(0, 0.5, 0));
    system_of("min", "max", "lom", 0, 10, sets, ONE_RULE);
    EQUAL(5, output(0, 0.5, 0));
}

static void test_a_scaled_triangle_keeps_its_centre(void)
{
    static const char sets[] = "MF1='low':'trimf',[0 0 10]";

    system_of("prod", "max", "centroid", 0, 10, sets, ONE_RULE);
    EQUAL(10.0 / 3, output(0, 0.01, 0));
    system_of("prod", "max", "bisector", 0, 10, sets, ONE_RULE);
    EQUAL(10 - sqrt(50), output(0, 0.01, 0));
    system_of("prod", "max", "mom", 0, 10, sets, ONE_RULE);
    EQUAL(0, output(0, 0.01, 0));
}

/* Two triangles, falling and rising, both whole: they cross at 5, 0.5. max: a V. */
static void test_aggregation_meets_at_the_crossing(void)
{
    static const char sets[] = "MF1='low':'trimf',[0 0 10]\nMF2='high':'trimf',[0 10 10]";

    /* heights 1 and 0.6: cross where 1 - x/10 = 0.6 x/10, x = 6.25 */
    system_of("prod", "max", "centroid", 0, 10, sets, TWO_RULES);
    {
        double c = 6.25;
        double area = (c - c * c / 20) + 0.03 * (100 - c * c);
        double moment = c * c / 2 - c * c * c / 30 + 0.02 * (1000 - c * c * c);
        EQUAL(moment / area, output(0, 1, 0.6));
    }
    system_of("prod", "sum", "centroid", 0, 10, sets, TWO_RULES); /* 1 - 0.04 x */
    EQUAL((50 - 0.04 * 1000 / 3) / (10 - 2), output(0, 1, 0.6));
    system_of("prod", "probor", "centroid", 0, 10, sets,
              TWO_RULES); /* 1 - 0.04 x - 0.06 x + 0.006 x^2 */
    NEAR((50 - 0.1 * 1000 / 3 + 0.006 * 2500) / (10 - 5 + 2), output(0, 1, 0.6));
}

static void test_a_negated_set(void)
{
    /* 1 - trimf [0 5 10]: a V of area 5; symmetric, so look at the left half of it: range 0..5 */
    system_of("prod", "max", "centroid", 0, 5, "MF1='hill':'trimf',[0 5 10]", "1 0, -1 (1) : 1");
    EQUAL(5.0 / 3, output(0, 1, 0));
    system_of("min", "max", "lom", 0, 5, "MF1='hill':'trimf',[0 5 10]", "1 0, -1 (1) : 1");
    EQUAL(2.5, output(0, 0.5, 0));
}

static void test_steps_inside_the_range(void)
{
    /* a box from 2 to 4 and a ramp from 4, where it is 0 again, to 10 */
    static const char sets[] = "MF1='box':'trapmf',[2 2 4 4]\nMF2='ramp':'linsmf',[4 10]";
    double area = 2 + 3, moment = 6 + 0.5 * 6 * 8;

    system_of("prod", "max", "centroid", 0, 20, sets, TWO_RULES);
    area += 10;
    moment += 150;
    EQUAL(moment / area, output(0, 1, 1));
    system_of("prod", "max", "bisector", 0, 20, sets, TWO_RULES);
    EQUAL(12.5, output(0, 1, 1)); /* 7.5 from the right */
    system_of("prod", "max", "mom", 0, 20, sets, TWO_RULES);
    EQUAL((2 * 3 + 10 * 15) / 12.0, output(0, 1, 1));
    system_of("prod", "max", "som", 0, 20, sets, TWO_RULES);
    EQUAL(2, output(0, 1, 1));
}

static void test_crossed_shoulders(void)
{
    /* trapmf [0 8 2 10] is the triangle 0, (5, 0.625), 10 */
    system_of("min", "max", "centroid", 0, 5, "MF1='low':'trapmf',[0 8 2 10]", ONE_RULE);
    EQUAL(10.0 / 3, output(0, 1, 0));
    system_of("min", "max", "mom", 0, 10, "MF1='low':'trapmf',[0 8 2 10]", ONE_RULE);
    EQUAL(5, output(0, 1, 0));
}

static void test_open_trapezoids_end_with_the_range(void)
{
    system_of("min", "max", "centroid", -1, 3, "MF1='low':'trapmf',[-Inf -Inf 1 1]", ONE_RULE);
    EQUAL(0, output(0, 0.3, 0));
}

static void test_points_of_a_pwlmf(void)
{
    /* 1 at 0, 0.2 at 1 and 2, 0 at 3: areas 0.6, 0.2, 0.1 with moments 0.6/2 - 0.8/12, 0.3,
     * 0.2*(2.5-1/6)/2... */
    double m1 = 0.6 * 0.5 - 0.8 / 12, m2 = 0.2 * 1.5, m3 = 0.1 * (2 + 1.0 / 3);

    system_of("prod", "max", "centroid", 0, 3, "MF1='s':'pwlmf',[0 1 1 0.2 2 0.2 3 0]", ONE_RULE);
    EQUAL((m1 + m2 + m3) / 0.9, output(0, 1, 0));
}

static void test_many_crossings(void)
{
    /* Eleven narrow triangles of one height, side by side, under max: each 1 wide and whole, so the
     * centroid is the middle; of two heights, one in the left half, by symmetry of each: sum of
     * areas times centres. */
    char sets[1024] = "", rules[1024] = "";
    double area = 0, moment = 0;

    for (int k = 0; k < 11; k++) {
        snprintf(sets + strlen(sets), sizeof sets - strlen(sets), "MF%d='t':'trimf',[%d %g %d]\n",
                 k + 1, k, k + 0.5, k + 1);
        snprintf(rules + strlen(rules), sizeof rules - strlen(rules), "%s, %d (1) : 1\n",
                 k < 4 ? "1 0" : "0 1", k + 1);
        area += (k < 4 ? 0.3 : 0.8) / 2;
        moment += (k < 4 ? 0.3 : 0.8) / 2 * (k + 0.5);
    }
    system_of("prod", "max", "centroid", 0, 11, sets, rules);
    EQUAL(moment / area, output(0, 0.3, 0.8));
}

static void test_an_envelope_of_overlapping_sets(void)
{
    /* Three lines over 0..1: 1 - x, 0.6, x: cut at 0.4 and 0.6 */
    static const char sets[] =
        "MF1='falls':'linzmf',[0 1]\nMF2='level':'pwlmf',[0 0.6 1 0.6]\nMF3='rises':'linsmf',[0 1]";

    system_of("min", "max", "centroid", 0, 1, sets,
              "1 0, 1 (1) : 1\n1 0, 2 (1) : 1\n1 0, 3 (1) : 1");
    EQUAL(0.5, output(0, 1, 0));
    system_of("min", "max", "bisector", 0, 1, sets,
              "1 0, 1 (1) : 1\n1 0, 2 (1) : 1\n1 0, 3 (1) : 1");
    EQUAL(0.5, output(0, 1, 0));
    /* the rising one at 0.7: cut there, so at 0.6 .. 0.7 it climbs and then stays; 0.32 + 0.12 +
     * 0.065 + 0.21 */
    system_of("min", "max", "centroid", 0, 1, sets,
              "1 0, 1 (1) : 1\n1 0, 2 (1) : 1\n0 1, 3 (1) : 1");
    {
        double m1 = 0.4 * 0.4 / 2 - 0.4 * 0.4 * 0.4 / 3, m2 = 0.12 * 0.5;
        double m3 = (0.343 - 0.216) / 3, m4 = 0.21 * 0.85;
        EQUAL((m1 + m2 + m3 + m4) / 0.715, output(0, 1, 0.7));
    }
}

/* --- curved sets: to 1e-9 of the range ------------------------------------------------------- */

/* e^(-x^2/8) over 0..10: area 2 sqrt(pi/2) erf(10/(2 sqrt 2)), moment 4 (1 - e^-12.5). */
static void test_half_a_bell(void)
{
    system_of("prod", "max", "centroid", 0, 10, "MF1='g':'gaussmf',[2 0]", ONE_RULE);
    NEAR(4 * (1 - exp(-12.5)) / (2 * sqrt(M_PI / 2) * erf(10 / (2 * sqrt(2)))), output(0, 0.7, 0));
}

/* Cut at h: level to c = 2 sqrt(-2 ln h), then the bell. */
static void test_a_cut_bell(void)
{
    double h = 0.3, c = 2 * sqrt(-2 * log(h)), root = 2 * sqrt(2);
    double area = h * c + 2 * sqrt(M_PI / 2) * (erf(10 / root) - erf(c / root));
    double moment = h * c * c / 2 + 4 * (h - exp(-12.5));
    static const char sets[] = "MF1='g':'gaussmf',[2 0]";

    system_of("min", "max", "centroid", 0, 10, sets, ONE_RULE);
    NEAR(moment / area, output(0, h, 0));
    system_of("min", "max", "lom", 0, 10, sets, ONE_RULE);
    NEAR(c, output(0, h, 0));
    system_of("min", "max", "mom", 0, 10, sets, ONE_RULE);
    NEAR(c / 2, output(0, h, 0));
}

static void test_a_very_narrow_bell_far_from_zero(void)
{
    system_of("prod", "max", "centroid", 1e6, 1e6 + 1000, "MF1='g':'gaussmf',[1e-4 1000700]",
              ONE_RULE);
    NEAR(1000700, output(0, 1, 0));
    system_of("min", "max", "bisector", 1e6, 1e6 + 1000, "MF1='g':'gaussmf',[1e-4 1000700]",
              ONE_RULE);
    NEAR(1000700, output(0, 0.4, 0));
}

/* 1/(1 + x^2) over 0..3: area atan 3, moment ln(10)/2. */
static void test_a_generalized_bell(void)
{
    system_of("prod", "max", "centroid", 0, 3, "MF1='b':'gbellmf',[1 1 0]", ONE_RULE);
    NEAR(log(10) / 2 / atan(3), output(0, 1, 0));
    system_of("prod", "max", "bisector", 0, 3, "MF1='b':'gbellmf',[1 1 0]", ONE_RULE);
    NEAR(tan(atan(3) / 2), output(0, 1, 0));
}

/* A steep bell is nearly the box 3..5. */
static void test_a_steep_bell(void)
{
    system_of("prod", "max", "centroid", 0, 4, "MF1='b':'gbellmf',[1 5000 4]", ONE_RULE);
    /* its right half is outside; integral of 1/(1+t^10000) over 0..1 is 1 - ln2/10000 to the second
     * order */
    TEST_ASSERT_TRUE(fabs(output(0, 1, 0) - 3.5) < 1e-4);
    system_of("prod", "max", "centroid", 0, 8, "MF1='b':'gbellmf',[1 5000 4]", ONE_RULE);
    NEAR(4, output(0, 1, 0));
}

/* 1/(1+e^-x) over -2..3: area ln((1+e^3)/(1+e^-2)); moment by parts, dilogarithm avoided: symmetric
 * about 0 the set is 1/2 plus an odd part, so take -3..3: area 3, moment = integral of x
 * tanh(x/2)/2. */
static void test_a_sigmoid(void)
{
    double area = log((1 + exp(3)) / (1 + exp(-2)));

    system_of("prod", "max", "bisector", -2, 3, "MF1='s':'sigmf',[1 0]", ONE_RULE);
    /* ln(1+e^x) = ln(1+e^-2) + area/2 */
    NEAR(log(expm1(log1p(exp(-2)) + area / 2)), output(0, 1, 0));
}

/* smf [0 4]: 2 (x/4)^2 to 2, then 1 - 2 ((4-x)/4)^2: area 2, moment 1/2 + (6 - 5/6)... by Simpson,
 * exact for it */
static double simpson(double (*f)(double), double a, double b)
{
    return (b - a) / 6 * (f(a) + 4 * f((a + b) / 2) + f(b));
}

static double left_half(double x)
{
    return x * 2 * (x / 4) * (x / 4);
}

static double right_half(double x)
{
    return x * (1 - 2 * ((4 - x) / 4) * ((4 - x) / 4));
}

static void test_splines(void)
{
    double up = simpson(left_half, 0, 2) + simpson(right_half, 2, 4);

    system_of("prod", "max", "centroid", 0, 4, "MF1='s':'smf',[0 4]", ONE_RULE);
    NEAR(up / 2, output(0, 1, 0));
    system_of("prod", "max", "centroid", 0, 4, "MF1='z':'zmf',[0 4]", ONE_RULE);
    NEAR(4 - up / 2, output(0, 1, 0));
    system_of("prod", "max", "centroid", 0, 8, "MF1='p':'pimf',[0 4 4 8]", ONE_RULE);
    NEAR(4, output(0, 1, 0));
    system_of("min", "max", "lom", 0, 4, "MF1='z':'zmf',[0 4]", ONE_RULE);
    NEAR(3, output(0, 0.125, 0));
}

static void test_steps_of_degenerate_splines(void)
{
    system_of("min", "max", "centroid", 0, 10, "MF1='z':'zmf',[5 3]", ONE_RULE); /* 1 up to 4 */
    NEAR(2, output(0, 0.5, 0));
    system_of("min", "max", "mom", 0, 10, "MF1='s':'smf',[5 3]", ONE_RULE);
    NEAR(7, output(0, 0.5, 0));
}

static void test_tops_of_products_and_differences(void)
{
    /* overlapping shoulders: zmf * smf has its top in the middle by symmetry */
    system_of("prod", "max", "mom", 0, 10, "MF1='p':'pimf',[2 8 2 8]", ONE_RULE);
    NEAR(5, output(0, 1, 0));
    /* crossed centres 6 and 4, sigmas 1 and 2: weights 1 and 1/4 */
    system_of("prod", "max", "mom", 0, 10, "MF1='g':'gauss2mf',[1 6 2 4]", ONE_RULE);
    NEAR((6 + 4 * 0.25) / 1.25, output(0, 1, 0));
    /* sigmoids of slopes 2 and -1 at 3 and 5: where 2 (1 - s1) = (1 - s2), that is e^(2(x-3)) = 1 +
     * 2 e^-(x-5) */
    system_of("prod", "max", "mom", 0, 10, "MF1='p':'psigmf',[2 3 -1 5]", ONE_RULE);
    {
        double low = 3, high = 6;
        for (int i = 0; i < 100; i++) {
            double x = (low + high) / 2;
            if (2 / (1 + exp(2 * (x - 3))) > 1 / (1 + exp(-(x - 5)))) {
                low = x;
            } else {
                high = x;
            }
        }
        NEAR(low, output(0, 1, 0));
    }
    system_of("prod", "max", "mom", 0, 10, "MF1='d':'dsigmf',[2 3 2 7]", ONE_RULE);
    NEAR(5, output(0, 1, 0));
}

/* Two bells of sigma 1 at 4 and 5 under sum are one hill with its top at 4.5; scaled, where the
 * slopes cancel. */
static void test_a_top_that_only_the_sum_has(void)
{
    static const char sets[] = "MF1='a':'gaussmf',[1 4]\nMF2='b':'gaussmf',[1 5]";
    double low = 4, high = 5;

    for (int i = 0; i < 100; i++) {
        double x = (low + high) / 2;
        if ((5 - x) * 0.4 * exp(-(x - 5) * (x - 5) / 2) >
            (x - 4) * 0.9 * exp(-(x - 4) * (x - 4) / 2)) {
            low = x;
        } else {
            high = x;
        }
    }
    system_of("prod", "sum", "mom", 0, 10, sets, TWO_RULES);
    NEAR(4.5, output(0, 0.8, 0.8));
    NEAR(low, output(0, 0.9, 0.4));
    system_of("prod", "sum", "lom", 0, 10, sets, TWO_RULES);
    NEAR(low, output(0, 0.9, 0.4));
    system_of("prod", "sum", "centroid", -10, 20, sets, TWO_RULES);
    NEAR((4 * 0.9 + 5 * 0.4) / 1.3, output(0, 0.9, 0.4));
}

static void test_a_straight_and_a_curved_set_under_max(void)
{
    /* e^(-x^2/2) and x/4 over 0..4 meet once, at c */
    static const char sets[] = "MF1='g':'gaussmf',[1 0]\nMF2='r':'linsmf',[0 4]";
    double c = 1.5;

    for (int i = 0; i < 50; i++) {
        c -= (exp(-c * c / 2) - c / 4) / (-c * exp(-c * c / 2) - 0.25);
    }
    system_of("prod", "max", "centroid", 0, 4, sets, TWO_RULES);
    NEAR((1 - exp(-c * c / 2) + (64 - c * c * c) / 12) /
             (sqrt(M_PI / 2) * erf(c / sqrt(2)) + (16 - c * c) / 8),
         output(0, 1, 1));
}

/* --- against ever more samples --------------------------------------------------------------- */

/* The sampled answer tends to the exact one as 1 over the number of samples: with one more of
 * weight 1 at an end the centroid moves by less than two steps; the other methods are off by the
 * few steps that their sets' edges are. Curved and straight sets, all methods. */
static void test_that_exact_is_the_limit_of_samples(void)
{
    enum {
        SAMPLES = 2001
    }; /* a step is wider than the stretch where the bell is 1 to the last bit */

    TEST_ASSERT_EQUAL(EXIT_FINE, fis_read("tests/golden/asym.fis", &fis));
    for (int method = 0; method < 5 * 2 * 2; method++) {
        fis.block[0].imp_method = method / 5 % 2 == 0 ? TNORM_MIN : TNORM_PROD;
        for (int o = 0; o < 2; o++) {
            fis.output[o].defuzz_method = (enum fis_defuzz)(DEFUZZ_CENTROID + method % 5);
            fis.output[o].agg_method = method / 10 == 0 ? SNORM_MAX : SNORM_SUM;
        }
        for (int point = 0; point < 25; point++) {
            double x[2] = {-1.9 + 1.4 * (point % 5), 13 + 17 * (double)(point / 5)};
            double sampled[2], exact[2];
            char message[200];

            TEST_ASSERT_EQUAL(0, eval(SAMPLES, x, sampled));
            TEST_ASSERT_EQUAL(0, eval(0, x, exact));
            for (int o = 0; o < 2; o++) {
                double step = (fis.output[o].max - fis.output[o].min) / (SAMPLES - 1);
                snprintf(message, sizeof message,
                         "method %d, output %d at %g, %g: %.12g sampled, %.12g exact", method,
                         o + 1, x[0], x[1], sampled[o], exact[o]);
                TEST_ASSERT_TRUE_MESSAGE(fabs(sampled[o] - exact[o]) <= 4 * step, message);
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_cut_triangle);
    RUN_TEST(test_a_scaled_triangle_keeps_its_centre);
    RUN_TEST(test_aggregation_meets_at_the_crossing);
    RUN_TEST(test_a_negated_set);
    RUN_TEST(test_steps_inside_the_range);
    RUN_TEST(test_crossed_shoulders);
    RUN_TEST(test_open_trapezoids_end_with_the_range);
    RUN_TEST(test_points_of_a_pwlmf);
    RUN_TEST(test_many_crossings);
    RUN_TEST(test_an_envelope_of_overlapping_sets);
    RUN_TEST(test_half_a_bell);
    RUN_TEST(test_a_cut_bell);
    RUN_TEST(test_a_very_narrow_bell_far_from_zero);
    RUN_TEST(test_a_generalized_bell);
    RUN_TEST(test_a_steep_bell);
    RUN_TEST(test_a_sigmoid);
    RUN_TEST(test_splines);
    RUN_TEST(test_steps_of_degenerate_splines);
    RUN_TEST(test_tops_of_products_and_differences);
    RUN_TEST(test_a_top_that_only_the_sum_has);
    RUN_TEST(test_a_straight_and_a_curved_set_under_max);
    RUN_TEST(test_that_exact_is_the_limit_of_samples);
    return UNITY_END();
}
