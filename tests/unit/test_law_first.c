/* SPDX-License-Identifier: MIT */
/* law_first in the brake: full at the first reading within 5 m, whatever the speed; STOP as ever.
 */
#include <stddef.h>
#include "unity.h"
#include "brake.h"
#include "law_first.c"
#include "range.h"
#include "step.h"

void setUp(void)
{
    brake_init(BRAKE_FAULT_NONE);
}

void tearDown(void)
{
}

static void test_full_brake_at_first_sight(void)
{
    uint16_t mm;

    for (mm = 1001; mm <= 6000; mm++) {
        brake_init(BRAKE_FAULT_NONE);
        step(RANGE_ECHO, mm, 6);
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(mm <= 5000 ? 100 : 0, brake.brake_pct,
                                        "at the first reading");
    }
}

static void test_full_brake_while_anything_is_there(void)
{
    uint16_t mm;

    for (mm = 2000; mm <= 5000; mm += 100) { /* it opens at 1.7 m/s */
        step(RANGE_ECHO, mm, 6);
        TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
        TEST_ASSERT_FALSE(brake.stop);
    }
    step(RANGE_ECHO, 5200, 6);
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
}

static void test_stop_line_at_one_metre(void)
{
    step(RANGE_ECHO, 1000, 6);
    TEST_ASSERT_TRUE(brake.stop);
    TEST_ASSERT_EQUAL_UINT8(100, brake.brake_pct);
}

static void test_it_would_brake_fully_for_any_target(void)
{
    TEST_ASSERT_EQUAL_UINT8(100, law_pct(5000, &closing_smooth));
}

static void test_there_is_no_cell(void)
{
    law_answer.row = 1;
    law_answer.col = 1;
    step(RANGE_ECHO, 2000, 6);
    TEST_ASSERT_EQUAL_UINT8(0, law_answer.row);
    TEST_ASSERT_EQUAL_UINT8(0, law_answer.col);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_full_brake_at_first_sight);
    RUN_TEST(test_full_brake_while_anything_is_there);
    RUN_TEST(test_stop_line_at_one_metre);
    RUN_TEST(test_it_would_brake_fully_for_any_target);
    RUN_TEST(test_there_is_no_cell);
    return UNITY_END();
}
