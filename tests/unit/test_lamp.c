/* SPDX-License-Identifier: MIT */
/* lamp: what each pattern looks like, tick by tick. */
#include <stddef.h>
#include "unity.h"
#include "lamp.h"

void setUp(void)
{
    lamp_tick(LAMP_OFF);
}

void tearDown(void)
{
}

/* Flashes seen in so many ticks. */
static uint8_t flashes(uint8_t pattern, uint16_t ticks)
{
    bool was_lit = false;
    uint8_t count = 0;

    while (ticks-- != 0) {
        bool is_lit = lamp_tick(pattern);

        count = (uint8_t)(count + (is_lit && !was_lit));
        was_lit = is_lit;
    }
    return count;
}

static void test_off_and_on_are_steady(void)
{
    uint8_t i;

    for (i = 0; i < 250; i++) {
        TEST_ASSERT_FALSE(lamp_tick(LAMP_OFF));
    }
    for (i = 0; i < 250; i++) {
        TEST_ASSERT_TRUE(lamp_tick(LAMP_ON));
    }
}

static void test_a_flicker_is_five_a_second(void)
{
    uint8_t i;

    for (i = 0; i < 8; i++) { /* it has no pause */
        TEST_ASSERT_EQUAL_UINT8(50, flashes(LAMP_FLICKER, 1000));
    }
}

static void test_a_number_can_be_counted(void)
{
    uint8_t n;

    for (n = 2; n <= 9; n++) {
        uint16_t period =
            (uint16_t)(n * 50U + 75U); /* the last dark quarter is part of the pause */

        lamp_tick(LAMP_OFF);
        TEST_ASSERT_EQUAL_UINT8(n, flashes(n, period));
        TEST_ASSERT_EQUAL_UINT8(n, flashes(n, period));
    }
}

static void test_the_pause_is_a_second(void)
{
    uint8_t dark = 0;

    flashes(2, 75); /* lit, dark, lit */
    while (!lamp_tick(2)) {
        dark++;
    }
    TEST_ASSERT_EQUAL_UINT8(100, dark);
}

static void test_a_new_pattern_starts_at_once(void)
{
    flashes(3, 40);
    TEST_ASSERT_TRUE(lamp_tick(LAMP_ON));
    TEST_ASSERT_FALSE(lamp_tick(LAMP_OFF));
    TEST_ASSERT_TRUE(lamp_tick(4));
    TEST_ASSERT_TRUE(lamp_tick(LAMP_FLICKER));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_off_and_on_are_steady);
    RUN_TEST(test_a_flicker_is_five_a_second);
    RUN_TEST(test_a_number_can_be_counted);
    RUN_TEST(test_the_pause_is_a_second);
    RUN_TEST(test_a_new_pattern_starts_at_once);
    return UNITY_END();
}
