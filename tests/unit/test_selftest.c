/* SPDX-License-Identifier: MIT */
/* selftest: the slices cover the table once, whole, and one wrong bit fails. */
#include <stddef.h>
#include "unity.h"
#include "lut.h"

/* The files under test, with a table's bytes that change between the runs in place of lut_crc16. */
static uint16_t seen_bytes;
static uint16_t wrong_at = 0xFFFFU;
static uint16_t fake_crc16(uint16_t crc, uint16_t offset, uint8_t count);
#define lut_crc16 fake_crc16
#include "../../firmware/lib/selftest.c"
#undef lut_crc16

static uint16_t fake_crc16(uint16_t before, uint16_t start, uint8_t count)
{
    TEST_ASSERT_EQUAL_UINT16_MESSAGE(seen_bytes, start, "a slice does not follow the one before");
    TEST_ASSERT_TRUE(count != 0 && count <= SLICE_BYTES);
    seen_bytes = (uint16_t)(seen_bytes + count);
    before = lut_crc16(before, start, count);
    return wrong_at >= start && wrong_at < start + count ? before ^ 1U : before;
}

void setUp(void)
{
    crc = LUT_CRC16_START;
    offset = 0;
    seen_bytes = 0;
}

void tearDown(void)
{
}

static uint16_t slices; /* of the last run */

static uint8_t run(void)
{
    uint8_t result;

    slices = 0;
    do {
        result = selftest_table();
        slices++;
    } while (result == SELFTEST_RUNNING);
    return result;
}

static void test_the_whole_table_passes(void)
{
    wrong_at = 0xFFFFU;
    TEST_ASSERT_EQUAL_UINT8(SELFTEST_PASSED, run());
    TEST_ASSERT_EQUAL_UINT16(LUT_BYTES, seen_bytes);
    TEST_ASSERT_EQUAL_UINT16((LUT_BYTES + 15U) / 16U, slices);
}

static void test_one_wrong_slice_fails_wherever_it_is(void)
{
    static const uint16_t __code places[] = {0, 15, 16, LUT_BYTES / 2, LUT_BYTES - 1};
    uint8_t i;

    for (i = 0; i < 5; i++) {
        setUp();
        wrong_at = places[i];
        TEST_ASSERT_EQUAL_UINT8(SELFTEST_FAILED, run());
        TEST_ASSERT_EQUAL_UINT16(LUT_BYTES, seen_bytes);
    }
}

static void test_last_slice_may_be_short(void)
{
    static const uint8_t __code last_bytes[] = {1, 5, 15};
    uint16_t at;
    uint8_t i;

    wrong_at = 0xFFFFU;
    for (i = 0; i < 3; i++) {
        setUp();
        for (at = 0; at < LUT_BYTES - last_bytes[i]; at++) {
            crc = lut_crc16(crc, at, 1);
        }
        offset = LUT_BYTES - last_bytes[i];
        seen_bytes = offset;
        TEST_ASSERT_EQUAL_UINT8(SELFTEST_PASSED, selftest_table());
        TEST_ASSERT_EQUAL_UINT16(LUT_BYTES, seen_bytes);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_whole_table_passes);
    RUN_TEST(test_one_wrong_slice_fails_wherever_it_is);
    RUN_TEST(test_last_slice_may_be_short);
    return UNITY_END();
}
