/* cell: every distance and speed of the brake's table, and every axis whose cells two bytes can
 * tell, against the quotient. */
#include <stddef.h>
#include "unity.h"
#include "cell.c"
#include "cells.h"

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
    TEST_ASSERT_TRUE(FITS(4000UL, 100) && IS_NARROW(4000UL, 100));
    TEST_ASSERT_TRUE(FITS(7000UL, 100) && IS_NARROW(7000UL, 100));
    TEST_ASSERT_TRUE(FITS(35000UL, 100) && !IS_NARROW(35000UL, 100));
    TEST_ASSERT_FALSE(FITS(4950UL, 100)); /* 49.5 */
    TEST_ASSERT_FALSE(FITS(4096UL, 256)); /* 256 * 2^SHIFT / 16 is no byte */
}

#ifndef __SDCC_mcs51
static void test_every_axis_that_goes_by_bytes_is_right_for_every_value(void)
{
    uint32_t cells, width, value;

    for (cells = 5; cells <= 255; cells += 5) { /* each would take ten seconds */
        for (width = 1; width * cells <= 65535U && width <= 600; width++) {
            uint32_t span = width * cells;

            for (value = 0; FITS(span, cells) && value < span; value++) {
                uint16_t x = (uint16_t)value;
                uint8_t cell;

                if (IS_NARROW(span, cells)) {
                    CELL_NARROW(cell, x, span, cells);
                } else {
                    CELL_WIDE(cell, x, span, cells);
                }
                if (cell != value / width) {
                    TEST_ASSERT_EQUAL_UINT32_MESSAGE(value / width, cell, "not the quotient");
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
    RUN_TEST(test_every_axis_that_goes_by_bytes_is_right_for_every_value);
#endif
    return UNITY_END();
}
