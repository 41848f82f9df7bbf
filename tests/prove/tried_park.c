/* SPDX-License-Identifier: MIT */
/* Parking: its table, and the polar form of every point that cordic_to_polar takes. */
#include <math.h>
#include "lut.c"
#include "cordic.c"
#include "fixed.c"
#include "tried.h"

#define TURN16 65536

/* sin of 0..TURN16 - 1. */
static double sine[TURN16];

/* The length and the angle of cordic_polar are as right as cordic.h says. The mirror image only
 * changes the sign of the angle. */
static bool is_point_right(int16_t across, int16_t along)
{
    double gain2 = CORDIC_GAIN * CORDIC_GAIN;
    double r2 = (double)across * across + (double)along * along;
    double low = cordic_polar.length - 9.0, high = cordic_polar.length + 9.0;
    uint16_t angle = (uint16_t)cordic_polar.angle;
    /* r sin(angle - true angle) */
    double off = along * sine[angle] - across * sine[(uint16_t)(angle + TURN16 / 4)];

    return cordic_polar.length <= 47700 && cordic_polar.angle >= -18180 &&
           cordic_polar.angle <= 18180 && high * high >= gain2 * r2 &&
           (low < 0 || low * low <= gain2 * r2) &&
           (r2 < 300.0 * 300.0 || off * off <= r2 * sine[10] * sine[10]);
}

static bool is_every_point_right(void)
{
    for (int turn = 0; turn < TURN16; turn++) {
        sine[turn] = sin(turn * 6.283185307179586 / TURN16);
    }
    for (int across = 0; across <= CORDIC_ACROSS_MAX; across++) {
        for (int along = 0; along <= CORDIC_ALONG_MAX; along++) {
            cordic_to_polar((int16_t)across, (int16_t)along);
            if (!is_point_right((int16_t)across, (int16_t)along)) {
                return false;
            }
        }
    }
    return true;
}

int main(void)
{
    say_cells();
    say("cordic.h: length and angle of each point", is_every_point_right());
    return is_proved ? EXIT_SUCCESS : EXIT_FAILURE;
}
