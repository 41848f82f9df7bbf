/* SPDX-License-Identifier: MIT */
/* law_none as its image is built: nothing ever brakes, not STOP, not FAULT. */
#define BRAKE_STOP_MM 0U
#define FAULT_PCT     0
#include <stddef.h>
#include "unity.h"
#include "brake.c"
#include "latch.c"
#include "law_none.c"
#include "step.h"

void setUp(void)
{
    brake_init(BRAKE_FAULT_NONE);
}

void tearDown(void)
{
}

static void check(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, brake.brake_pct);
    TEST_ASSERT_FALSE(brake.stop);
}

static void test_no_distance_brakes(void)
{
    uint16_t mm;

    for (mm = 20; mm <= 6000; mm += 20) {
        TEST_ASSERT_FALSE(brake_must_stop(mm));
        step(RANGE_ECHO, mm, 6);
        check();
    }
}

static void test_no_approach_brakes(void)
{
    uint16_t mm;

    for (mm = 6000; mm > 100; mm -= 60) {
        step(RANGE_ECHO, mm, 6);
        check();
    }
}

static void test_no_fault_brakes(void)
{
    uint8_t kind, fault, i;

    for (kind = RANGE_NO_TARGET; kind <= RANGE_DEAD_ZONE; kind++) {
        brake_init(BRAKE_FAULT_NONE);
        step(RANGE_ECHO, 1500, 6);
        for (i = 0; i < 20; i++) {
            brake_tick(false);
            check();
            step(kind, 0, 6);
            check();
        }
    }
    for (fault = BRAKE_FAULT_NOT_RISEN; fault <= BRAKE_FAULT_IDLE; fault++) {
        brake_init(fault);
        check();
        TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_distance_brakes);
    RUN_TEST(test_no_approach_brakes);
    RUN_TEST(test_no_fault_brakes);
    return UNITY_END();
}
