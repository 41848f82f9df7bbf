/* SPDX-License-Identifier: MIT */
/* The gap controller's steps. */
#include <stddef.h>
#include "gap.h"
#include "frames.h"

void steps_begin(void)
{
    begin_frames(FRAME_GAP, GAP_PAYLOAD_BYTES, 0);
    gap_init();
}

void step(void)
{
    step_lib();
    if (take_frame(gap_read, NULL)) {
        gap_decide();
        put_u16((uint16_t)gap_lq_cmps2());
        put_u16((uint16_t)gap_fuzzy_cmps2());
    } else if (take()) {
        gap_lose(take());
    }
    put_u16(gap.gap_cm);
    put_u16(gap.own_cmps);
    put_u16(gap.lead_cmps);
    put_u16((uint16_t)gap.lead_cmps2);
    put_u16(gap.set_cmps);
    put_u16(gap.safe_cm);
    put_u16((uint16_t)gap.accel_cmps2);
    put(gap.brake_pct);
    put(gap.stop);
    put_u16(gap.throttle_us);
    put(gap.lead);
    put(gap.state);
}

#ifndef __SDCC_mcs51

void draw(void)
{
    uint8_t payload[GAP_PAYLOAD_BYTES], *to = payload;

    draw_lib();
    to = add_u16(to, draw_u16(0, chance(2) ? GAP_MAX_CM : 6000));
    to = add_u16(to, draw_u16(0, chance(2) ? GAP_SPEED_MAX_CMPS : 60));
    to = add_u16(to, draw_u16(0, chance(3) ? GAP_SPEED_MAX_CMPS : 8));
    to = add_u16(to, (uint16_t)(draw_u16(0, 2 * GAP_LEAD_MAX_CMPS2) - GAP_LEAD_MAX_CMPS2));
    *to = (uint8_t)chance(chance(20) == 0 ? 256 : GAP_SET_MAX + 1);
    draw_frame(FRAME_GAP, payload, sizeof payload);
    give(chance(4) == 0);
    give((uint8_t)chance(101));
}

#endif
