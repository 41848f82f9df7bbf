/* SPDX-License-Identifier: MIT */
/* range: every tick count, both clocks, against the exact quotient. */
#include <stddef.h>
#include "unity.h"
#include "sweep.h"
#include "fixed.h"

/* The file under test once more, with the other clock. */
#undef CLK_HZ
#define CLK_HZ     11059200UL
#define range_mm   range_mm_11059200
#define range_kind range_kind_11059200
#include "range.c"
#undef range_mm
#undef range_kind
uint16_t range_mm(uint16_t ticks);
#ifdef __SDCC_mcs51
#define range_kind range_kind_11059200 /* inline, so the library has none */
#else
uint8_t range_kind(uint16_t dist_mm);
#endif

void setUp(void)
{
}

void tearDown(void)
{
}

/* ticks * 12 / clk * sound / 2 in steps: whole mm and the rest of it, in 1 / clk mm. */
static void sweep(uint16_t (*mm_of)(uint16_t), uint32_t clk_hz)
{
    const uint32_t step = SOUND_MMPS * 6UL; /* a tick, in 1 / clk mm */
    uint32_t rest = 0;
    uint16_t exact_mm = 0, before_mm = 0, ticks = 0;

    do {
        uint16_t mm = mm_of(ticks);

        if (mm < before_mm || mm < exact_mm || mm > exact_mm + 1U) {
            TEST_ASSERT_EQUAL_UINT16_MESSAGE(exact_mm, mm, "not within 1 mm, or falling");
        }
        before_mm = mm;
        rest += step;
        while (rest >= clk_hz) {
            rest -= clk_hz;
            exact_mm++;
        }
    } while (++ticks != 0);
    TEST_ASSERT_UINT16_WITHIN(1, exact_mm, before_mm);
}

static void test_every_tick_count_is_within_1_mm_at_12_mhz(void)
{
    sweep(range_mm, 12000000UL);
}

static void test_every_tick_count_is_within_1_mm_at_11_mhz(void)
{
    sweep(range_mm_11059200, 11059200UL);
}

static void test_known_echoes_have_known_distances(void)
{
    TEST_ASSERT_EQUAL_UINT16(0, range_mm(0));
    TEST_ASSERT_EQUAL_UINT16(995, range_mm(5800));            /* 995.28 */
    TEST_ASSERT_EQUAL_UINT16(1000, range_mm(5828));           /* 1000.08 */
    TEST_ASSERT_EQUAL_UINT16(5000, range_mm(29138));          /* 5000.08 */
    TEST_ASSERT_EQUAL_UINT16(6521, range_mm(38000));          /* 6520.80 */
    TEST_ASSERT_EQUAL_UINT16(995, range_mm_11059200(5345));   /* 995.23 */
    TEST_ASSERT_EQUAL_UINT16(5000, range_mm_11059200(26853)); /* 4999.97 */
}

static void test_kind_changes_at_the_limits_and_nowhere_else(void)
{
    uint16_t mm;

    for (mm = 0; mm <= RANGE_MAX_MM + 100U; mm++) {
        uint8_t kind = mm < 20 ? RANGE_DEAD_ZONE : mm <= 6000 ? RANGE_ECHO : RANGE_NO_TARGET;

        if (range_kind(mm) != kind || range_kind_11059200(mm) != kind) {
            SWEEP_FAIL(mm, "the kind of this distance in mm");
        }
    }
    TEST_ASSERT_EQUAL_UINT8(RANGE_NO_TARGET, range_kind(11246));
    TEST_ASSERT_EQUAL_UINT8(RANGE_NO_TARGET, range_kind(65535U));
}

/* A tick is 343.2 mm * 6 / f there and back: 0.1716 mm at 12 MHz, 0.18620 mm at 11.0592 MHz. Times
 * 65536 and rounded, 11246 and 12203; so much for each tick, rounded to whole mm. */
static void test_every_tick_count_is_rounded(void)
{
    uint16_t ticks = 0;

    do {
        uint16_t mm_12 = (uint16_t)((ticks * 11246UL + 32768UL) >> 16);
        uint16_t mm_11 = (uint16_t)((ticks * 12203UL + 32768UL) >> 16);

        if (range_mm(ticks) != mm_12 || range_mm_11059200(ticks) != mm_11) {
            SWEEP_FAIL(ticks, "not rounded at this count of ticks");
        }
    } while (++ticks != 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_tick_count_is_within_1_mm_at_12_mhz);
    RUN_TEST(test_every_tick_count_is_within_1_mm_at_11_mhz);
    RUN_TEST(test_known_echoes_have_known_distances);
    RUN_TEST(test_kind_changes_at_the_limits_and_nowhere_else);
    RUN_TEST(test_every_tick_count_is_rounded);
    return UNITY_END();
}
