/* SPDX-License-Identifier: MIT */
/* What the steps of the frame-fed controllers share: a frame comes byte by byte, right or wrong, on
 * time or late. */
#ifndef FUZZY51_STEP_FRAMES_H
#define FUZZY51_STEP_FRAMES_H

#include "frame.h"
#include "link.h"
#include "steps.h"

/* For steps_begin. */
static void begin_frames(uint8_t kind, uint8_t payload_bytes, uint8_t item_bytes)
{
    frame_init(kind, payload_bytes, item_bytes);
    link_init(LINK_WAITING, 0);
}

/* Takes a frame. Returns whether the controller is to decide. `read` and `read_item` are its
 * functions. */
static bool take_frame(bool (*read)(void), void (*read_item)(void))
{
    uint16_t now_ms = take_u16();
    uint8_t left = take(), result = FRAME_NONE;
    bool is_up = false;

    if (take()) {
        put(frame_ask());
    }
    while (left != 0) {
        result = frame_push(take());
        put(result);
        if (result == FRAME_ITEM) {
            read_item();
        }
        left--;
    }
    if (result == FRAME_GOOD) {
        if (read()) {
            is_up = link_good(now_ms);
        } else {
            frame_refuse();
            link_bad();
        }
    } else if (result == FRAME_BAD) {
        link_bad();
    }
    put(link_check(now_ms));
    put_u16(frame_bad_count());
    put(is_up);
    return is_up;
}

#ifndef __SDCC_mcs51
#include "head.h"

/* Draws a frame with this payload; now and then late, with a bit that turned over, cut short, or
 * with the count of the one before, unasked, or with a number that does not follow. */
static void draw_frame(uint8_t kind, const uint8_t *payload, int bytes)
{
    static uint16_t now_ms;
    static uint8_t count, number;
    uint8_t line[HEAD_LINE_MAX];
    uint32_t used;

    now_ms = (uint16_t)(now_ms + (chance(100) == 0 ? chance(800) : 20 + chance(90)));
    count = (uint8_t)((count + (chance(100) != 0)) & 15);
    number = (uint8_t)(number + (chance(50) == 0 ? chance(256) : 1));
    used = (uint32_t)head_encode(kind, count, payload, bytes, number, line);
    if (chance(60) == 0) {
        line[chance(used)] ^= (uint8_t)(1u << chance(8));
    }
    if (chance(200) == 0) {
        used = 1 + chance(used);
    }
    give_u16(now_ms);
    give((uint8_t)used);
    give(chance(30) != 0);
    for (uint32_t at = 0; at < used; at++) {
        give(line[at]);
    }
}

static uint8_t *add_u16(uint8_t *to, uint16_t number)
{
    *to++ = (uint8_t)(number >> 8);
    *to++ = (uint8_t)number;
    return to;
}

#endif
#endif
