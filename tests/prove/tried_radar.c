/* SPDX-License-Identifier: MIT */
/* The radar: its table, each range and speed as row and column, each own speed, each angle. */
#include <math.h>
#include "lut.c"
#undef LUT_DATA
#include "fixed.c"
#include "mul_u16.c"
#include "fmcw.c"
#include "lane.c"
#include "safe.c"
#include "frame.c"
#include "radar.c"
#include "tried.h"

/* All values of three bytes. */
static bool is_every_beat_right(void)
{
    for (int32_t value = -8388608; value <= 8388607; value++) {
        frame_body[0] = (uint8_t)(value >> 16);
        frame_body[1] = (uint8_t)(value >> 8);
        frame_body[2] = (uint8_t)value;
        if (frame_i24(0) != value) {
            return false;
        }
    }
    return true;
}

static bool is_every_level_right(void)
{
    for (long x = 0; x <= UINT16_MAX; x++) {
        long closing_dkmh = (int16_t)x;

        if (radar_row((int16_t)closing_dkmh) != (closing_dkmh < 0     ? 0
                                                 : closing_dkmh > 600 ? 12
                                                                      : (closing_dkmh + 25) / 50) ||
            radar_col((uint16_t)x) != (x > 10000 ? 12 : (x * 3 + 1250) / 2500)) {
            return false;
        }
    }
    return true;
}

/* By the formula of safe.h. */
static bool is_every_distance_right(void)
{
    for (unsigned own_dkmh = 0; own_dkmh <= SAFE_SPEED_MAX_DKMH; own_dkmh++) {
        double v = own_dkmh / 36.0;
        double safe_cm = 100.0 * (v * (1.5 + 1.0) + v * v / (2 * 2.5) + 5.0 - v * v / (2 * 6.5));

        if (fabs(safe_distance_cm((uint16_t)own_dkmh) - fmin(safe_cm, 65535.0)) > 2.1) {
            return false;
        }
    }
    return true;
}

static bool is_every_sine_right(void)
{
    for (unsigned angle = 0; angle <= LANE_AZIMUTH_MAX_TURN16; angle++) {
        double sine = sin(angle * 6.283185307179586 / 65536.0) * 65536.0;

        if (fabs(lane_sine_q16((uint16_t)angle) - sine) > 5.0) {
            return false;
        }
    }
    return true;
}

int main(void)
{
    say_cells();
    say("frame.h: each number of three bytes", is_every_beat_right());
    say("radar.h: the row of each speed and the column of each range", is_every_level_right());
    say("safe.h: the safe distance at each speed", is_every_distance_right());
    say("lane.h: the sine of each angle", is_every_sine_right());
    return is_proved ? EXIT_SUCCESS : EXIT_FAILURE;
}
