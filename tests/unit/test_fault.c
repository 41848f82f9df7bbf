/* SPDX-License-Identifier: MIT */
/* fault: each row of the table in fault.h. */
#include <stddef.h>
#include "unity.h"
#include "fault.h"

void setUp(void)
{
    fault_init(BRAKE_FAULT_NONE);
}

void tearDown(void)
{
}

static bool wait_cs(uint8_t time_cs)
{
    bool began = false;

    while (time_cs-- != 0) {
        began |= fault_tick();
    }
    return began;
}

static void test_starts_good_in_fault_or_lasting(void)
{
    uint8_t code;

    TEST_ASSERT_EQUAL_UINT8(FAULT_GOOD, fault_state);
    for (code = BRAKE_FAULT_NOT_RISEN; code <= BRAKE_FAULT_IDLE; code++) {
        fault_init(code);
        TEST_ASSERT_EQUAL_UINT8(code, fault_code);
        TEST_ASSERT_EQUAL_UINT8(code >= BRAKE_FAULT_TABLE ? FAULT_LASTING : FAULT_ON, fault_state);
    }
}

static void test_good_says_what_is_wrong_with_the_last_reading(void)
{
    fault_take(BRAKE_FAULT_JUMP);
    TEST_ASSERT_EQUAL_UINT8(FAULT_GOOD, fault_state);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_JUMP, fault_code);
    fault_take(BRAKE_FAULT_NONE);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
}

static void test_fault_begins_once_180_ms_after_the_last_believed_reading(void)
{
    TEST_ASSERT_FALSE(wait_cs(10));
    fault_take(BRAKE_FAULT_NONE);
    TEST_ASSERT_FALSE(wait_cs(FAULT_SILENCE_CS));
    fault_take(BRAKE_FAULT_LOST);
    TEST_ASSERT_TRUE(wait_cs(1));
    TEST_ASSERT_EQUAL_UINT8(FAULT_ON, fault_state);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_LOST, fault_code);
    TEST_ASSERT_FALSE(wait_cs(255));
}

static void test_fault_ends_with_the_third_believed_reading_in_a_row(void)
{
    uint8_t round;

    for (round = 0; round < 2; round++) {
        wait_cs(30);
        fault_take(BRAKE_FAULT_NONE);
        fault_take(BRAKE_FAULT_NONE);
        fault_take(BRAKE_FAULT_STUCK);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, fault_code);
        fault_take(BRAKE_FAULT_NONE);
        fault_take(BRAKE_FAULT_NONE);
        TEST_ASSERT_EQUAL_UINT8(FAULT_ON, fault_state);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STUCK, fault_code); /* why it is in FAULT */
        fault_take(BRAKE_FAULT_NONE);
        TEST_ASSERT_EQUAL_UINT8(FAULT_GOOD, fault_state);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_NONE, fault_code);
    }
}

static void test_a_lasting_fault_lasts(void)
{
    uint8_t i;

    TEST_ASSERT_TRUE(fault_fail(BRAKE_FAULT_STACK));
    TEST_ASSERT_FALSE(fault_fail(BRAKE_FAULT_RAM));
    for (i = 0; i < 10; i++) {
        fault_take(i == 5 ? BRAKE_FAULT_JUMP : BRAKE_FAULT_NONE);
        TEST_ASSERT_FALSE(wait_cs(30));
        TEST_ASSERT_EQUAL_UINT8(FAULT_LASTING, fault_state);
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT_STACK, fault_code);
    }
}

static void test_a_lasting_fault_comes_in_fault_too(void)
{
    wait_cs(30);
    TEST_ASSERT_TRUE(fault_fail(BRAKE_FAULT_RAM));
    TEST_ASSERT_EQUAL_UINT8(FAULT_LASTING, fault_state);
}

static void test_init_forgets_what_was_before(void)
{
    fault_init(BRAKE_FAULT_WATCHDOG);
    fault_take(BRAKE_FAULT_NONE);
    fault_take(BRAKE_FAULT_NONE);
    wait_cs(10);
    fault_init(BRAKE_FAULT_WATCHDOG);
    fault_take(BRAKE_FAULT_NONE);
    fault_take(BRAKE_FAULT_NONE);
    TEST_ASSERT_EQUAL_UINT8(FAULT_ON, fault_state);
    fault_take(BRAKE_FAULT_NONE);
    TEST_ASSERT_EQUAL_UINT8(FAULT_GOOD, fault_state);

    wait_cs(10);
    fault_init(BRAKE_FAULT_NONE);
    TEST_ASSERT_FALSE(wait_cs(FAULT_SILENCE_CS));
    TEST_ASSERT_TRUE(wait_cs(1));
}

/* Whatever the other bytes are. */
static void test_the_sum_shows_each_byte(void)
{
    uint8_t sum;

    fault_state = 0xFF;
    fault_code = 0;
    sum = fault_sum();
    fault_code = 1;
    TEST_ASSERT_TRUE(fault_sum() != sum);
    fault_code = 0;
    wait_cs(1);
    TEST_ASSERT_TRUE(fault_sum() != sum);

    fault_init(BRAKE_FAULT_WATCHDOG);
    fault_take(BRAKE_FAULT_NONE);
    fault_state = 0xFF;
    fault_code = 0;
    sum = fault_sum();
    fault_state = FAULT_ON;
    fault_take(BRAKE_FAULT_NONE);
    fault_state = 0xFF;
    fault_code = 0;
    TEST_ASSERT_TRUE(fault_sum() != sum);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_starts_good_in_fault_or_lasting);
    RUN_TEST(test_good_says_what_is_wrong_with_the_last_reading);
    RUN_TEST(test_fault_begins_once_180_ms_after_the_last_believed_reading);
    RUN_TEST(test_fault_ends_with_the_third_believed_reading_in_a_row);
    RUN_TEST(test_a_lasting_fault_lasts);
    RUN_TEST(test_a_lasting_fault_comes_in_fault_too);
    RUN_TEST(test_init_forgets_what_was_before);
    RUN_TEST(test_the_sum_shows_each_byte);
    return UNITY_END();
}
