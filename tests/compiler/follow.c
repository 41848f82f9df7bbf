/* SPDX-License-Identifier: MIT */
/* The follower's steps. */
#include <stddef.h>
#include "follow.h"
#include "frames.h"

void steps_begin(void)
{
    begin_frames(FRAME_FOLLOW, FOLLOW_PAYLOAD_BYTES, 0);
    follow_init();
}

void step(void)
{
    step_lib();
    if (take_frame(follow_read, NULL)) {
        follow_decide();
    } else if (take()) {
        follow_lose(take());
    }
    put_u16(follow.gap_mm);
    put_u16(follow.own_mmps);
    put_u16(follow.lead_mmps);
    put_u16(follow.change_mm);
    put(follow.lane_is_taken);
    put((uint8_t)follow.command_x2);
    put(follow.change_x2);
    put(follow.asks_for_lane);
    put(follow.brake_pct);
    put(follow.stop);
    put_u16(follow.throttle_us);
    put(follow.state);
}

#ifndef __SDCC_mcs51

/* On a threshold, beside it, or anywhere. */
static uint16_t draw_gap_mm(void)
{
    static const uint16_t thresholds_mm[] = {950, 1050, 2000, 4000, 6000, 8000, 10000};

    if (chance(3) == 0) {
        return draw_u16(0, FOLLOW_GAP_MAX_MM);
    }
    return (uint16_t)(thresholds_mm[chance(sizeof thresholds_mm / sizeof thresholds_mm[0])] +
                      chance(3) - 1);
}

void draw(void)
{
    uint8_t payload[FOLLOW_PAYLOAD_BYTES], *to = payload;
    uint16_t lead_mmps = draw_u16(0, FOLLOW_SPEED_MAX_MMPS);
    uint16_t own_mmps = draw_u16(0, FOLLOW_SPEED_MAX_MMPS);

    if (chance(4) == 0) {
        own_mmps = (uint16_t)(lead_mmps + (chance(2) ? 1000 : -1000) + (int)chance(3) - 1);
    }
    draw_lib();
    to = add_u16(to, draw_gap_mm());
    to = add_u16(to, own_mmps);
    to = add_u16(to, lead_mmps);
    *to++ = (uint8_t)(chance(50) == 0 ? chance(256) : chance(2));
    add_u16(to, draw_u16(FOLLOW_CHANGE_MIN_MM - 1, FOLLOW_CHANGE_MAX_MM + 1));
    draw_frame(FRAME_FOLLOW, payload, sizeof payload);
    give(chance(4) == 0);
    give((uint8_t)chance(101));
}

#endif
