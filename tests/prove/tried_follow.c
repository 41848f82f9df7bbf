/* SPDX-License-Identifier: MIT */
/* The follower's table. */
#include "lut.c"
#undef LUT_DATA
#include "frame.c"
#include "follow.c"
#include "tried.h"

static bool is_every_cell_in_range(void)
{
    for (uint8_t gap = 0; gap < LUT_IN1_CELLS; gap++) {
        for (uint8_t closing = 0; closing < LUT_IN2_CELLS; closing++) {
            for (uint8_t change = 0; change < LUT_IN3_CELLS; change++) {
                int command_level = lut_at3(gap, closing, change);
                int change_level = lut2_at3(gap, closing, change);

                if (command_level < LEVEL_ZERO - 1 || command_level > LEVEL_ZERO + 1 ||
                    change_level < LEVEL_ZERO || change_level > LEVEL_ZERO + 1) {
                    return false;
                }
            }
        }
    }
    return true;
}

int main(void)
{
    say_cells();
    say("follow.c: each command is -1..1, each change 0 or 1", is_every_cell_in_range());
    return is_proved ? EXIT_SUCCESS : EXIT_FAILURE;
}
