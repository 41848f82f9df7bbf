/* SPDX-License-Identifier: MIT */
/* lut: known cells and the check sum. Every cell of every encoding is looked up by
 * tests/tools/test_lut_on_chip.sh. */
#include <stddef.h>
#include "unity.h"
#include "lut.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* By hand: only "very large" holds, to the full. Over 101 samples its memberships sum to 25.5 and
 * their moments to 2200.17, which is 86.28. */
static void test_the_near_fast_corner_brakes_hardest(void)
{
    TEST_ASSERT_EQUAL_UINT8(86, lut_at(0, 99));
    TEST_ASSERT_EQUAL_UINT8(86, lut_at(24, 99));
}

/* The study of the table: its cells run from 13 to 86, the least in the far slow corner. */
static void test_the_cells_run_from_13_to_86(void)
{
    uint8_t row, col, least = 255, most = 0;

    for (row = 0; row < LUT_IN1_CELLS; row++) {
        for (col = 0; col < LUT_IN2_CELLS; col++) {
            uint8_t cell = lut_at(row, col);

            if (cell < least) {
                least = cell;
            }
            if (cell > most) {
                most = cell;
            }
        }
    }
    TEST_ASSERT_EQUAL_UINT8(13, least);
    TEST_ASSERT_EQUAL_UINT8(86, most);
    TEST_ASSERT_EQUAL_UINT8(13, lut_at(99, 0));
}

/* Rows are distance, columns speed: farther brakes less, faster brakes more; never the other way.
 */
static void test_rows_and_columns_are_not_swapped(void)
{
    TEST_ASSERT_EQUAL_UINT8(86, lut_at(0, 0));
    TEST_ASSERT_EQUAL_UINT8(13, lut_at(99, 0));
    TEST_ASSERT_EQUAL_UINT8(86, lut_at(0, 99));
    TEST_ASSERT_TRUE(lut_at(99, 99) > 80);
}

static uint16_t sum_in_slices(uint8_t slice)
{
    uint16_t crc = LUT_CRC16_START, offset = 0;

    while (offset != LUT_BYTES) {
        uint16_t left = LUT_BYTES - offset;
        uint8_t count = left < slice ? (uint8_t)left : slice;

        crc = lut_crc16(crc, offset, count);
        offset += count;
    }
    return crc;
}

static void test_the_check_sum_is_the_headers_in_slices_of_any_size(void)
{
    TEST_ASSERT_EQUAL_HEX16(LUT_CRC16, sum_in_slices(1));
    TEST_ASSERT_EQUAL_HEX16(LUT_CRC16, sum_in_slices(16));
    TEST_ASSERT_EQUAL_HEX16(LUT_CRC16, sum_in_slices(255));
}

static void test_the_check_sum_depends_on_place_and_length(void)
{
    TEST_ASSERT_NOT_EQUAL(lut_crc16(LUT_CRC16_START, 0, 100), lut_crc16(LUT_CRC16_START, 0, 99));
    TEST_ASSERT_NOT_EQUAL(lut_crc16(LUT_CRC16_START, 0, 100),
                          lut_crc16(LUT_CRC16_START, 5000, 100));
    TEST_ASSERT_NOT_EQUAL(LUT_CRC16_START, lut_crc16(LUT_CRC16_START, 0, 1));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_near_fast_corner_brakes_hardest);
    RUN_TEST(test_the_cells_run_from_13_to_86);
    RUN_TEST(test_rows_and_columns_are_not_swapped);
    RUN_TEST(test_the_check_sum_is_the_headers_in_slices_of_any_size);
    RUN_TEST(test_the_check_sum_depends_on_place_and_length);
    return UNITY_END();
}
