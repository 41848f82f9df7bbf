/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/random.c. The numbers of splitmix64 for the seed 1234567 are those
 * of Rosetta Code's page about it, where programs in many languages agree on them. */
#include "random.h"

#include <math.h>
#include <unity.h>

static const uint64_t numbers[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                   4593380528125082431u, 16408922859458223821u};
static struct random source;

void setUp(void)
{
    random_seed(&source, 1234567);
}

void tearDown(void)
{
}

/* The first 53 bits, as a part of 1. */
static double part(uint64_t number)
{
    return ldexp((double)(number >> 11), -53);
}

static void test_that_the_numbers_are_those_of_splitmix64(void)
{
    for (int i = 0; i < 5; i++) {
        TEST_ASSERT_TRUE(fabs(part(numbers[i]) - random_uniform(&source)) <= 0);
    }
}

static void test_that_a_normal_number_is_made_of_two_by_box_and_muller(void)
{
    for (int i = 0; i < 4; i += 2) {
        double radius = sqrt(2 * -log(1 - part(numbers[i])));
        double expected = radius * cos(2 * acos(-1) * part(numbers[i + 1]));

        TEST_ASSERT_DOUBLE_WITHIN(1e-14, expected, random_normal(&source));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_the_numbers_are_those_of_splitmix64);
    RUN_TEST(test_that_a_normal_number_is_made_of_two_by_box_and_muller);
    return UNITY_END();
}
