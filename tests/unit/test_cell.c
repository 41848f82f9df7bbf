/* SPDX-License-Identifier: MIT */
/* cell: every distance and speed of the brake's table, and every axis whose cells two bytes can
 * tell, against the quotient. */
#include <stddef.h>
#include "unity.h"
#include "cell.c"
#include "cells.h"
#include "sweep.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_every_distance_and_speed_lies_in_its_cell(void)
{
    check_cells();
}

static void test_axes_go_by_bytes_where_their_cells_allow(void)
{
    TEST_ASSERT_TRUE(GOES_BY_BYTES(4000UL, 100) && IS_NARROW(4000UL, 100));
    TEST_ASSERT_TRUE(GOES_BY_BYTES(7000UL, 100) && IS_NARROW(7000UL, 100));
    TEST_ASSERT_TRUE(GOES_BY_BYTES(35000UL, 100) && !IS_NARROW(35000UL, 100));
    TEST_ASSERT_FALSE(GOES_BY_BYTES(4950UL, 100)); /* 49.5 */
    TEST_ASSERT_FALSE(GOES_BY_BYTES(4096UL, 256)); /* 256 * 2^SHIFT / 16 is no byte */
}

#ifndef __SDCC_mcs51
/* Each value of an axis of CELLS cells, WIDTH wide. What is the same for all is worked out once. */
static void check_axis_by_bytes(uint32_t width, uint32_t cells)
{
    const uint32_t span = width * cells;
    const uint8_t shift = SHIFT(span), factor = (uint8_t)FACTOR(span, cells);
    const bool is_narrow = IS_NARROW(span, cells);
    uint16_t x = 0;

    for (uint32_t wanted = 0; wanted < cells; wanted++) {
        for (uint32_t i = 0; i < width; i++, x++) {
            uint8_t cell = is_narrow ? cell_of_narrow(x, shift, factor, (uint8_t)width)
                                     : cell_of_wide(x, shift, factor, (uint16_t)width);

            if (cell != wanted) {
                TEST_ASSERT_EQUAL_UINT32_MESSAGE(wanted, cell, "not the quotient");
            }
        }
    }
}

static void test_every_axis_that_goes_by_bytes_is_right_for_every_value(void)
{
    uint32_t cells, width;

    for (cells = 5; cells <= 255; cells += 5 * SWEEP) { /* each would take ten seconds */
        for (width = 1; width * cells <= 65535U && width <= 600; width++) {
            uint32_t span = width * cells;

            if (GOES_BY_BYTES(span, cells)) {
                check_axis_by_bytes(width, cells);
            }
        }
    }
}

/* Every value on axes of any length, whole cells or not, and shorter than their number of cells. */
static void test_every_axis_that_goes_by_subtraction_is_right_for_every_value(void)
{
    static const uint16_t spans[] = {1, 2, 99, 255, 256, 2999, 4001, 32767, 32768, 64999, 65535};
    static const uint16_t counts[] = {1, 2, 3, 99, 100, 127, 128, 200, 255, 256};

    for (size_t s = 0; s < sizeof spans / sizeof spans[0]; s++) {
        for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
            for (uint32_t x = 0; x < spans[s]; x++) {
                uint8_t cell = cell_by_subtraction((uint16_t)x, spans[s], (uint8_t)(counts[c] - 1));

                if (cell != x * counts[c] / spans[s]) {
                    TEST_ASSERT_EQUAL_UINT32_MESSAGE(x * counts[c] / spans[s], cell,
                                                     "not the quotient");
                }
            }
        }
    }
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_distance_and_speed_lies_in_its_cell);
    RUN_TEST(test_axes_go_by_bytes_where_their_cells_allow);
#ifndef __SDCC_mcs51
    RUN_TEST(test_every_axis_that_goes_by_subtraction_is_right_for_every_value);
    RUN_TEST(test_every_axis_that_goes_by_bytes_is_right_for_every_value);
#endif
    return UNITY_END();
}
