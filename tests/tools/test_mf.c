/* SPDX-License-Identifier: MIT */
/* Under test: tools/fistab/mf.c, every membership function against values worked out by hand. */
#include "fistab/mf.h"

#include <math.h>
#include <stdio.h>
#include <unity.h>

#define E_HALF       0.60653065971263342 /* e^(-1/2) */
#define E_2          7.38905609893065    /* e^2 */
#define COUNT(array) (sizeof(array) / sizeof(array)[0])

struct point {
    double x, degree;
};

void setUp(void)
{
}

void tearDown(void)
{
}

static void check(enum mf_kind kind, const double *p, size_t count, const struct point *point,
                  size_t points)
{
    TEST_ASSERT_NULL_MESSAGE(mf_fault(kind, p, count), mf_name(kind));
    for (size_t i = 0; i < points; i++) {
        double got = mf_degree(kind, p, count, point[i].x);
        char message[120];

        snprintf(message, sizeof message, "%s at %g: expected %.17g, got %.17g", mf_name(kind),
                 point[i].x, point[i].degree, got);
        TEST_ASSERT_TRUE_MESSAGE(fabs(got - point[i].degree) <= 1e-15, message);
    }
}

#define CHECK(kind, parameters, ...)                                                               \
    do {                                                                                           \
        const double p_[] = parameters;                                                            \
        const struct point point_[] = {__VA_ARGS__};                                               \
        check(kind, p_, COUNT(p_), point_, COUNT(point_));                                         \
    } while (0)
#define P(...) {__VA_ARGS__}

static void test_trimf(void)
{
    CHECK(MF_TRIMF, P(2, 4, 8), {1, 0}, {2, 0}, {3, 0.5}, {4, 1}, {5, 0.75}, {6, 0.5}, {8, 0},
          {9, 0});
}

static void test_trimf_with_a_vertical_side_is_1_at_it(void)
{
    CHECK(MF_TRIMF, P(0, 0, 10), {-0.001, 0}, {0, 1}, {5, 0.5}, {10, 0});
    CHECK(MF_TRIMF, P(0, 10, 10), {0, 0}, {5, 0.5}, {10, 1}, {10.001, 0});
    CHECK(MF_TRIMF, P(5, 5, 5), {4.999, 0}, {5, 1}, {5.001, 0});
}

static void test_trapmf(void)
{
    CHECK(MF_TRAPMF, P(1, 3, 4, 8), {0, 0}, {1, 0}, {2, 0.5}, {3, 1}, {3.5, 1}, {4, 1}, {6, 0.5},
          {8, 0});
    CHECK(MF_TRAPMF, P(0, 0, 2, 2), {-0.1, 0}, {0, 1}, {1, 1}, {2, 1}, {2.1, 0});
}

static void test_trapmf_with_crossed_shoulders_is_a_lower_triangle(void)
{
    CHECK(MF_TRAPMF, P(0, 8, 2, 10), {0, 0}, {4, 0.5}, {5, 0.625}, {6, 0.5}, {10, 0});
}

static void test_trapmf_may_be_open_to_one_side(void)
{
    CHECK(MF_TRAPMF, P(-INFINITY, -INFINITY, 2, 4), {-1e90, 1}, {2, 1}, {3, 0.5}, {4, 0});
    CHECK(MF_TRAPMF, P(2, 4, INFINITY, INFINITY), {2, 0}, {3, 0.5}, {4, 1}, {1e90, 1});
}

static void test_gaussmf(void)
{
    CHECK(MF_GAUSSMF, P(2, 5), {5, 1}, {7, E_HALF}, {3, E_HALF}, {9, 1 / E_2});
    CHECK(MF_GAUSSMF, P(-2, 5), {7, E_HALF});
}

static void test_gauss2mf(void)
{
    CHECK(MF_GAUSS2MF, P(1, 3, 2, 6), {2, E_HALF}, {3, 1}, {4, 1}, {6, 1}, {8, E_HALF},
          {1, 1 / E_2});
    /* centres crossed: both sides at once, e^(-1/2) * e^(-1/8) at 5 */
    CHECK(MF_GAUSS2MF, P(1, 6, 2, 4), {5, 0.53526142851899023});
}

static void test_gbellmf(void)
{
    CHECK(MF_GBELLMF, P(2, 4, 6), {6, 1}, {8, 0.5}, {4, 0.5}, {7, 256.0 / 257}, {10, 1.0 / 257});
    CHECK(MF_GBELLMF, P(2, 0.5, 6), {10, 1.0 / 3});
    CHECK(MF_GBELLMF, P(2, 0, 6), {6, 0.5}, {9, 0.5});
    CHECK(MF_GBELLMF, P(2, -1, 6), {6, 0}, {8, 0.5}, {10, 0.8});
}

static void test_sigmf(void)
{
    CHECK(MF_SIGMF, P(2, 4), {4, 0.5}, {5, E_2 / (E_2 + 1)}, {3, 1 / (E_2 + 1)}, {1e6, 1},
          {-1e6, 0});
    CHECK(MF_SIGMF, P(-2, 4), {5, 1 / (E_2 + 1)});
}

static void test_dsigmf_is_an_absolute_difference(void)
{
    /* 1/(1+e^-2) - 1/(1+e^2) = tanh(1) */
    CHECK(MF_DSIGMF, P(2, 3, 2, 5), {4, 0.76159415595576489}, {-100, 0}, {100, 0});
    CHECK(MF_DSIGMF, P(2, 5, 2, 3), {4, 0.76159415595576489});
}

static void test_psigmf(void)
{
    CHECK(MF_PSIGMF, P(2, 3, -2, 5), {4, E_2 * E_2 / ((E_2 + 1) * (E_2 + 1))}, {-100, 0}, {100, 0});
}

static void test_zmf(void)
{
    CHECK(MF_ZMF, P(3, 7), {2, 1}, {3, 1}, {4, 0.875}, {5, 0.5}, {6, 0.125}, {7, 0}, {8, 0});
    CHECK(MF_ZMF, P(5, 3), {3.9, 1}, {4, 1}, {4.1, 0}); /* a step in the middle */
}

static void test_smf(void)
{
    CHECK(MF_SMF, P(3, 7), {2, 0}, {3, 0}, {4, 0.125}, {5, 0.5}, {6, 0.875}, {7, 1}, {8, 1});
    CHECK(MF_SMF, P(5, 3), {3.9, 0}, {4, 1}, {4.1, 1});
}

static void test_pimf(void)
{
    CHECK(MF_PIMF, P(1, 3, 5, 9), {1, 0}, {2, 0.5}, {2.5, 0.875}, {3, 1}, {4, 1}, {5, 1},
          {6, 0.875}, {7, 0.5}, {9, 0});
    CHECK(MF_PIMF, P(0, 4, 0, 4), {1, 0.125 * 0.875}, {2, 0.25});
}

static void test_linzmf(void)
{
    CHECK(MF_LINZMF, P(4, 6), {3, 1}, {4, 1}, {5, 0.5}, {5.5, 0.25}, {6, 0}, {7, 0});
    CHECK(MF_LINZMF, P(4, 4), {3.9, 1}, {4, 0}, {4.1, 0});
}

static void test_linsmf(void)
{
    CHECK(MF_LINSMF, P(4, 6), {3, 0}, {4, 0}, {5, 0.5}, {5.5, 0.75}, {6, 1}, {7, 1});
    CHECK(MF_LINSMF, P(4, 4), {3.9, 0}, {4, 1}, {4.1, 1});
}

static void test_pwlmf_goes_from_point_to_point_and_stays_level_beyond(void)
{
    CHECK(MF_PWLMF, P(1, 0.25, 3, 0.75, 7, 0), {0, 0.25}, {1, 0.25}, {2, 0.5}, {3, 0.75},
          {5, 0.375}, {7, 0}, {9, 0});
}

static void test_pwlmf_is_the_larger_one_at_a_step(void)
{
    CHECK(MF_PWLMF, P(1, 0, 3, 1, 3, 0.5, 5, 0), {2, 0.5}, {3, 1}, {4, 0.25});
    CHECK(MF_PWLMF, P(1, 0, 3, 0.5, 3, 1, 5, 0), {2, 0.25}, {3, 1}, {4, 0.5});
    CHECK(MF_PWLMF, P(1, 1, 1, 0, 3, 0, 3, 1), {0.9, 1}, {1, 1}, {2, 0}, {3, 1}, {4, 1});
}

static void test_that_extreme_numbers_give_a_degree(void)
{
    static const double extreme[] = {-1e100, -5e-324, 0, 5e-324, 1, 1e100};
    enum { N = COUNT(extreme) };

    for (enum mf_kind kind = 0; kind < MF_CONSTANT; kind++) {
        for (int code = 0; code < N * N * N * N; code++) {
            for (int k = 0; k < N; k++) {
                double p[4] = {extreme[code % N], extreme[code / N % N], extreme[code / N / N % N],
                               extreme[code / N / N / N]};
                size_t count = mf_parameters(kind, 1) == 0 ? 4 : mf_parameters(kind, 1);
                double degree;

                if (mf_fault(kind, p, count) != NULL) {
                    continue;
                }
                degree = mf_degree(kind, p, count, extreme[k]);
                TEST_ASSERT_TRUE_MESSAGE(degree >= 0 && degree <= 1, mf_name(kind));
            }
        }
    }
}

static void test_that_names_and_kinds_agree(void)
{
    for (enum mf_kind kind = 0; kind < MF_UNKNOWN; kind++) {
        TEST_ASSERT_EQUAL(kind, mf_kind_by_name(mf_name(kind)));
    }
    TEST_ASSERT_EQUAL(MF_UNKNOWN, mf_kind_by_name("TRIMF"));
    TEST_ASSERT_EQUAL(MF_UNKNOWN, mf_kind_by_name(""));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_trimf);
    RUN_TEST(test_trimf_with_a_vertical_side_is_1_at_it);
    RUN_TEST(test_trapmf);
    RUN_TEST(test_trapmf_with_crossed_shoulders_is_a_lower_triangle);
    RUN_TEST(test_trapmf_may_be_open_to_one_side);
    RUN_TEST(test_gaussmf);
    RUN_TEST(test_gauss2mf);
    RUN_TEST(test_gbellmf);
    RUN_TEST(test_sigmf);
    RUN_TEST(test_dsigmf_is_an_absolute_difference);
    RUN_TEST(test_psigmf);
    RUN_TEST(test_zmf);
    RUN_TEST(test_smf);
    RUN_TEST(test_pimf);
    RUN_TEST(test_linzmf);
    RUN_TEST(test_linsmf);
    RUN_TEST(test_pwlmf_goes_from_point_to_point_and_stays_level_beyond);
    RUN_TEST(test_pwlmf_is_the_larger_one_at_a_step);
    RUN_TEST(test_that_extreme_numbers_give_a_degree);
    RUN_TEST(test_that_names_and_kinds_agree);
    return UNITY_END();
}
