/* SPDX-License-Identifier: MIT */
/* The radar's steps. */
#include "radar.h"
#include "fmcw.h"
#include "frames.h"
#include "lane.h"
#include "safe.h"

void steps_begin(void)
{
    begin_frames(FRAME_RADAR, RADAR_PAYLOAD_BYTES, RADAR_TARGET_BYTES);
    radar_init();
}

void step(void)
{
    step_lib();
    put_u16(lane_sine_q16(take_u16()));
    put(radar_row((int16_t)take_u16()));
    put(radar_col(take_u16()));
    put_u16(safe_distance_cm(take_u16()));
    if (take_frame(radar_read, radar_read_target)) {
        radar_decide();
    } else if (take()) {
        radar_lose(take());
    }
    put_u16(radar.range_cm);
    put_u16((uint16_t)radar.closing_dkmh);
    put_u16(radar.own_dkmh);
    put(radar.target);
    put_u16(radar.safe_cm);
    put(radar.row);
    put(radar.col);
    put(radar.level);
    put(radar.brake_pct);
    put(radar.state);
    put(radar_cuts_throttle());
}

#ifndef __SDCC_mcs51

static uint8_t *add_i24(uint8_t *to, int32_t number)
{
    *to++ = (uint8_t)((uint32_t)number >> 16);
    return add_u16(to, (uint16_t)number);
}

static uint8_t *add_target(uint8_t *to)
{
    int32_t sum_hz = (int32_t)chance(chance(3) ? 120000 : FMCW_SUM_END_HZ + 1000);
    int32_t diff_hz = (int32_t)chance(2 * FMCW_DIFF_END_HZ) - FMCW_DIFF_END_HZ;

    to = add_i24(to, (sum_hz - diff_hz) / 2);
    to = add_i24(to, (sum_hz + diff_hz) / 2);
    if (chance(10) == 0) {
        return add_u16(to, (uint16_t)RADAR_NO_TARGET);
    }
    return add_u16(to, (uint16_t)(draw_u16(0, chance(2) ? 400 : 2 * LANE_AZIMUTH_MAX_TURN16) -
                                  (chance(2) ? 200 : LANE_AZIMUTH_MAX_TURN16)));
}

void draw(void)
{
    uint8_t payload[RADAR_PAYLOAD_BYTES + RADAR_TARGETS_MAX * RADAR_TARGET_BYTES], *to = payload;
    uint32_t curve = chance(3), targets = chance(chance(3) ? 3 : RADAR_TARGETS_MAX + 1);

    draw_lib();
    give_u16((uint16_t)chance(LANE_AZIMUTH_MAX_TURN16 + 1));
    give_u16((uint16_t)chance(65536));
    give_u16((uint16_t)chance(65536));
    give_u16((uint16_t)chance(SAFE_SPEED_MAX_DKMH + 1));
    to = add_u16(to, draw_u16(0, SAFE_SPEED_MAX_DKMH));
    to = add_u16(to, curve == 0 ? 0
                                : (uint16_t)(chance(curve == 1 ? 4000 : 65536) -
                                             (curve == 1 ? 2000 : 32768)));
    *to++ = (uint8_t)(chance(40) == 0 ? chance(256) : targets | (chance(8) ? RADAR_SIGNED : 0));
    for (uint32_t target = 0; target < targets; target++) {
        to = add_target(to);
    }
    draw_frame(FRAME_RADAR, payload, (int)(to - payload));
    give(chance(4) == 0);
    give((uint8_t)chance(101));
}

#endif
