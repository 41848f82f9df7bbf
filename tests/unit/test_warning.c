/* SPDX-License-Identifier: MIT */
/* warning: each row of the table in warning.h. */
#include <stddef.h>
#include "unity.h"
#include "target.h"
#include "warning.h"

void setUp(void)
{
    warning_init();
    target_worth = TARGET_TRACKED;
}

void tearDown(void)
{
}

static void test_is_off_without_a_reason(void)
{
    TEST_ASSERT_FALSE(warning_take(false));
}

static void test_is_on_with_a_reason_and_ends_half_a_second_after_the_last(void)
{
    uint8_t i, round;

    for (round = 0; round < 3; round++) {
        TEST_ASSERT_TRUE(warning_take(true));
        for (i = 1; i < WARNING_CALM_READINGS; i++) {
            TEST_ASSERT_TRUE(warning_take(false));
        }
        if (round != 1) { /* and begins anew at any time */
            TEST_ASSERT_FALSE(warning_take(false));
        }
    }
}

static void test_ends_with_the_target(void)
{
    warning_take(true);
    target_worth = TARGET_NONE;
    TEST_ASSERT_FALSE(warning_take(false));
    target_worth = TARGET_GLIMPSE;
    TEST_ASSERT_FALSE(warning_take(false));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_is_off_without_a_reason);
    RUN_TEST(test_is_on_with_a_reason_and_ends_half_a_second_after_the_last);
    RUN_TEST(test_ends_with_the_target);
    return UNITY_END();
}
