/* SPDX-License-Identifier: MIT */
/* controller: brake
 * sanitized: yes
 *
 * The brake's table: each distance, each speed, each cell. The published one; the tuned law's and that of brake_far,
 * and the packed ones, which the small boards have, by the units that include this one. */
#include "lut.c"
#undef LUT_DATA
#include "cell.c"
#include "fixed.c"
#include "tried.h"

/* The cell of x, x mm or mm/s above the low end of an axis. */
static long cell_at(long x, long span, long cells)
{
    return x < 0 ? 0 : x >= span ? cells - 1 : x * cells / span;
}

static bool is_every_cell_right(void)
{
    for (long x = 0; x <= UINT16_MAX; x++) {
        uint16_t value = (uint16_t)x;

        if (cell_row(value) != cell_at(x - LUT_IN1_MIN_MILLI, LUT_IN1_SPAN_MILLI, LUT_IN1_CELLS) ||
            cell_col(value, 0) !=
                cell_at(x - LUT_IN2_MIN_MILLI, LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS) ||
            cell_col(0, value) !=
                cell_at(-x - LUT_IN2_MIN_MILLI, LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS)) {
            return false;
        }
    }
    return true;
}

/* Each width, shift and x that the two ways by bytes take. */
static bool is_every_quotient_right(void)
{
    for (unsigned width = 1; width <= 510; width++) {
        for (unsigned shift = 3; shift <= 8; shift++) {
            unsigned factor = (256U << shift) / width;

            if ((1U << shift) + (256U << shift) % width >= width) {
                continue;
            }
            for (unsigned x = 0; x < 256U << shift; x++) {
                if ((width <= 128 && (x >> 8) << (8 - shift) > 255) ||
                    (width <= 128 && cell_of_narrow((uint16_t)x, (uint8_t)shift, (uint8_t)factor,
                                                    (uint8_t)width) != x / width) ||
                    cell_of_wide((uint16_t)x, (uint8_t)shift, (uint8_t)factor, (uint16_t)width) !=
                        x / width) {
                    return false;
                }
            }
        }
    }
    return true;
}

int main(void)
{
    say("cell.h: the row of each distance and the column of each speed", is_every_cell_right());
    say("cell.c: the quotients by bytes", is_every_quotient_right());
    say_cells();
    return is_proved ? EXIT_SUCCESS : EXIT_FAILURE;
}
