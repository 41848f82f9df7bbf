/* SPDX-License-Identifier: MIT */
/* The parking controller's steps. */
#include <stddef.h>
#include "park.h"
#include "cordic.h"
#include "frames.h"

void steps_begin(void)
{
    begin_frames(FRAME_PARK, PARK_PAYLOAD_BYTES, 0);
    park_init();
}

void step(void)
{
    step_lib();
    if (take()) {
        park_init();
    }
    if (take_frame(park_read, NULL)) {
        park_decide();
    } else if (take()) {
        park_lose();
    }
    put_u16((uint16_t)park.x);
    put_u16((uint16_t)park.y);
    put_u16(park.heading);
    put_u16(park.dist_mm);
    put(park.weight);
    put_u16((uint16_t)park.theta_far);
    put_u16((uint16_t)park.theta_near);
    put_u16((uint16_t)park.theta);
    put_u16(park.servo_us);
    put(park.state);
    put(park_must_stand());
    put_u16(cordic_polar.length);
    put_u16((uint16_t)cordic_polar.angle);
}

#ifndef __SDCC_mcs51

void draw(void)
{
    uint8_t payload[PARK_PAYLOAD_BYTES], *to = payload;
    uint16_t reach = chance(2) ? PARK_Y_MAX_512 : 2048;

    draw_lib();
    give(chance(20) == 0);
    to = add_u16(to, (uint16_t)(draw_u16(0, (uint16_t)(2 * reach)) - reach));
    to = add_u16(to, chance(50) == 0 ? draw_u16((uint16_t)PARK_Y_MIN_512, 0) : draw_u16(1, reach));
    add_u16(to, chance(3) == 0 ? (uint16_t)chance(65536) : (uint16_t)(8192 + chance(16385)));
    draw_frame(FRAME_PARK, payload, sizeof payload);
    give(chance(4) == 0);
}

#endif
