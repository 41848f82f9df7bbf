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

    for (mm = 1; mm < 20; mm++) { /* nearer than any echo */
        TEST_ASSERT_FALSE(brake_must_stop(mm));
        brake_expect(6);
        brake_step(RANGE_ECHO, mm);
        check();
        brake_finish();
        check();
        TEST_ASSERT_EQUAL_UINT8(0, law_pct(mm, &closing_smooth));
    }
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

static void test_there_is_no_cell(void)
{
    law_answer.brake_pct = 1;
    law_answer.row = 1;
    law_answer.col = 1;
    law_step(TARGET_TRACKED, 1500);
    TEST_ASSERT_EQUAL_UINT8(0, law_answer.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(0, law_answer.row);
    TEST_ASSERT_EQUAL_UINT8(0, law_answer.col);
}

/* FAULT_PCT = 0 lets go even of a brake that is on. */
static void test_a_fault_lets_go(void)
{
    demand_pct = 40;
    brake_fail(BRAKE_FAULT_STACK);
    check();
}

/* Its STOP is at 0 mm: one second ahead at the speed of two readings, the target is 1 mm away, or
 * at that place. */
static void test_warns_where_the_target_would_be_hit(void)
{
    step(RANGE_ECHO, 1061, 6);
    step(RANGE_ECHO, 1001, 6); /* 60 mm in 60 ms */
    TEST_ASSERT_EQUAL_UINT16(1000, closing_smooth.closing_mmps);
    TEST_ASSERT_FALSE(brake.warn);
    brake_init(BRAKE_FAULT_NONE);
    step(RANGE_ECHO, 1060, 6);
    step(RANGE_ECHO, 1000, 6);
    TEST_ASSERT_TRUE(brake.warn);
}

/* And not before it is there. */
static void test_it_lets_go_when_the_fault_comes(void)
{
    uint8_t i;

    demand_pct = 40;
    for (i = 0; i < FAULT_SILENCE_CS; i++) {
        brake_tick(false);
        TEST_ASSERT_EQUAL_UINT8(40, brake.brake_pct);
    }
    brake_tick(false);
    TEST_ASSERT_EQUAL_UINT8(BRAKE_FAULT, brake.state);
    check();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_distance_brakes);
    RUN_TEST(test_no_approach_brakes);
    RUN_TEST(test_no_fault_brakes);
    RUN_TEST(test_there_is_no_cell);
    RUN_TEST(test_a_fault_lets_go);
    RUN_TEST(test_warns_where_the_target_would_be_hit);
    RUN_TEST(test_it_lets_go_when_the_fault_comes);
    return UNITY_END();
}
