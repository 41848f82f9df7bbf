/* SPDX-License-Identifier: MIT */
/* The gap controller: its table, and each quotient that it needs. */
#include "lut.c"
#undef LUT_DATA
#include "fixed.c"
#include "mul_u16.c"
#include "frame.c"
#include "gap.c"
#include "tried.h"

static bool is_every_value_between(void)
{
    for (unsigned low = 0; low <= UINT8_MAX; low++) {
        for (unsigned high = 0; high <= UINT8_MAX; high++) {
            for (unsigned part_q8 = 0; part_q8 <= UINT8_MAX; part_q8++) {
                uint8_t value = between((uint8_t)low, (uint8_t)high, (uint8_t)part_q8);

                if ((value < low || value > high) && (value < high || value > low)) {
                    return false;
                }
            }
        }
    }
    return true;
}

static bool is_every_braking_way_right(void)
{
    for (uint32_t a = 0; a <= 2 * GAP_SPEED_MAX_CMPS; a++) {
        for (uint32_t b = 0; a + b <= 2 * GAP_SPEED_MAX_CMPS; b++) {
            uint32_t way_cm = over_2a_cm((uint16_t)a, (uint16_t)b);

            if (way_cm != a * b / 1200 || way_cm > 20833) {
                return false;
            }
        }
    }
    return true;
}

static bool is_every_pull_right(void)
{
    for (uint16_t h_cs = 90; h_cs <= 923; h_cs++) {
        for (uint16_t diff_cmps = 0; diff_cmps <= GAP_SPEED_MAX_CMPS; diff_cmps++) {
            uint16_t pull = over_h_cmps2(diff_cmps, h_cs);

            if (pull != 100UL * diff_cmps / h_cs || pull > 5555) {
                return false;
            }
        }
    }
    return true;
}

/* The ways of the cars, for each speed and each deceleration with a way that fits 16 bits. */
static bool is_every_way_right(void)
{
    for (uint16_t decel_cmps2 = 1; decel_cmps2 <= GAP_LEAD_MAX_CMPS2; decel_cmps2++) {
        for (uint16_t speed_cmps = 0; speed_cmps <= GAP_SPEED_MAX_CMPS; speed_cmps++) {
            uint32_t way_cm = (uint32_t)speed_cmps * speed_cmps / (2U * decel_cmps2);

            if (way_cm <= UINT16_MAX && divided((uint32_t)speed_cmps * speed_cmps,
                                                (uint16_t)(2U * decel_cmps2)) != way_cm) {
                return false;
            }
        }
    }
    return true;
}

int main(void)
{
    say_cells();
    say("lut.c: what is between two nodes", is_every_value_between());
    say("gap.c: a * b / 1200 for each a and b", is_every_braking_way_right());
    say("gap.c: 100 * difference / h", is_every_pull_right());
    say("gap.c: the way from each speed at each deceleration", is_every_way_right());
    return is_proved ? EXIT_SUCCESS : EXIT_FAILURE;
}
