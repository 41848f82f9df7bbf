/* SPDX-License-Identifier: MIT */
/* The brake's steps: one measurement as main.c takes it. */
#include "brake.h"
#include "law.h"
#include "range.h"
#include "steps.h"
#include "target.h"

enum event { MEASURE, START, FAIL };

void steps_begin(void)
{
    brake_init(BRAKE_FAULT_NONE);
}

static void put_speed(const struct closing_speed __data *speed)
{
    put_u16(speed->closing_mmps);
    put_u16(speed->opening_mmps);
}

static void put_all(void)
{
    put(brake.brake_pct);
    put(brake.stop);
    put(brake.warn);
    put(brake.state);
    put(brake.overridden);
    put(fault_state);
    put(fault_code);
    put(latch_state);
    put(target_worth);
}

#if RANGE_IS_TRIGGERED
#define take_raw take_u16
#else
#define FRAME_BYTES 9U

/* The distance in the last good frame, after the bytes of one more. */
static uint16_t take_raw(void)
{
    uint8_t left = FRAME_BYTES;
    bool is_good = false;

    do {
        RANGE_NEXT = take();
        range_came++;
        is_good |= range_take();
    } while (--left != 0);
    put(is_good);
    return range_raw();
}
#endif

/* What is foreseen for the next reading. */
static void expect(uint8_t elapsed_cs)
{
#if RANGE_IS_TRIGGERED
    brake_expect(elapsed_cs);
#else
    for (; elapsed_cs != 0; elapsed_cs--) {
        brake_expect(RANGE_PERIOD_CS);
    }
#endif
    put_u16(closing_foreseen_mm);
}

static void measure(void)
{
    uint8_t kind, ticks;
    uint16_t dist_mm;

    expect(take());
    kind = take();
    dist_mm = range_mm(take_raw());
    put_u16(dist_mm);
    if (kind == RANGE_ECHO) {
        kind = range_kind(dist_mm);
        put(brake_must_stop(dist_mm));
    }
    brake_step(kind, dist_mm);
    put_all();
    brake_finish();
    put_all();
    put_speed(&closing_difference);
    put_speed(&closing_smooth);
    put_u16(closing_place_mm);
    put(law_answer.brake_pct);
    put(law_answer.row);
    put(law_answer.col);
    for (ticks = take(); ticks != 0; ticks--) {
        brake_tick(take() != 0);
    }
    put_all();
}

void step(void)
{
    uint8_t event = take();

    step_lib();
    if (event == START) {
        brake_init(take());
    } else if (event == FAIL) {
        brake_fail(take());
    }
    measure();
}

#ifndef __SDCC_mcs51

/* A target that drives for a while, and what a sensor makes of it: at times one that is stuck. */
static struct {
    double place_mm, mmps;
    unsigned left, still, held, clear;
} drive;

static void draw_target(void)
{
    drive.place_mm = 100 + chance(6000);
    drive.mmps = (double)chance(chance(4) == 0 ? 36000 : 4000) - 1500;
    drive.left = 5 + chance(80);
}

#if RANGE_IS_TRIGGERED
static uint16_t raw_of(double dist_mm)
{
    double ticks = dist_mm * 2.0 / SOUND_MMPS * (CLK_HZ / 12.0);

    return ticks < 0 ? 0 : ticks > 65535 ? 65535 : (uint16_t)ticks;
}

#define CLEAR_RAW 50000
#define give_raw  give_u16
#else
static uint16_t raw_of(double dist_mm)
{
    return dist_mm < 0 ? 0 : (uint16_t)(dist_mm / 10);
}

#define CLEAR_RAW 0

/* A frame of that distance; now and then it is weak, blinded, bad or out of step. */
static void give_raw(uint16_t raw)
{
    uint8_t sum = 0x59 + 0x59;
    uint16_t strength = chance(40) == 0 ? (chance(2) == 0 ? 65535 : 99) : 800;
    uint8_t bytes[] = {0x59,
                       0x59,
                       (uint8_t)raw,
                       (uint8_t)(raw >> 8),
                       raw == CLEAR_RAW ? 0 : (uint8_t)strength,
                       raw == CLEAR_RAW ? 0 : (uint8_t)(strength >> 8),
                       0,
                       8,
                       0};

    for (unsigned i = 2; i < FRAME_BYTES - 1U; i++) {
        sum = (uint8_t)(sum + bytes[i]);
    }
    bytes[FRAME_BYTES - 1U] = chance(60) == 0 ? (uint8_t)chance(256) : sum;
    if (chance(60) == 0) {
        bytes[0] = (uint8_t)chance(256);
    }
    for (unsigned i = 0; i < FRAME_BYTES; i++) {
        give(bytes[i]);
    }
}
#endif

static void draw_event(void)
{
    uint32_t event = chance(2000) != 0 ? MEASURE : START + chance(2);

    give((uint8_t)event);
    draw_lib();
    if (event == START) {
        give(chance(2) == 0 ? BRAKE_FAULT_NONE
                            : (uint8_t)(BRAKE_FAULT_WATCHDOG +
                                        chance(BRAKE_FAULT_IDLE - BRAKE_FAULT_WATCHDOG + 1)));
    } else if (event == FAIL) {
        give(chance(4) == 0
                 ? BRAKE_FAULT_OUTPUT
                 : (uint8_t)(BRAKE_FAULT_TABLE + chance(BRAKE_FAULT_IDLE - BRAKE_FAULT_TABLE + 1)));
    }
}

static void draw_reading(uint8_t elapsed_cs)
{
    uint8_t kind = RANGE_ECHO;
    uint16_t raw;

    drive.place_mm -= drive.mmps * elapsed_cs / 100;
    if (drive.left-- == 0 || drive.place_mm < 0) {
        draw_target();
    }
    drive.still = chance(150) == 0 ? chance(60) : drive.still - (drive.still != 0);
    drive.clear = chance(150) == 0 ? chance(50) : drive.clear - (drive.clear != 0);
    if (drive.still == 0) {
        raw = raw_of(drive.place_mm + (double)chance(21) - 10);
    } else {
        raw = raw_of((double)((long)(drive.place_mm / 1000) * 1000));
    }
    if (drive.clear != 0) {
        raw = CLEAR_RAW;
    }
    switch (chance(40)) {
    case 0:
        kind = (uint8_t)(RANGE_NOT_RISEN + chance(2));
        break;
    case 1:
        raw = draw_u16(0, 65535);
        break;
    case 2:
        raw = raw_of(995 + chance(10));
        break;
    case 3:
        raw = raw_of(1290 + chance(20));
        break;
    default:
        break;
    }
    give(kind);
    give_raw(raw);
}

void draw(void)
{
    uint8_t elapsed_cs = chance(30) == 0 ? (uint8_t)chance(256) : RANGE_PERIOD_CS;
    uint32_t ticks = chance(20) == 0 ? chance(40) : RANGE_PERIOD_CS;

    draw_event();
    give(elapsed_cs);
    draw_reading(elapsed_cs);
    drive.held = chance(300) == 0 ? chance(60) : drive.held - (drive.held != 0);
    give((uint8_t)ticks);
    while (ticks-- != 0) {
        give(drive.held != 0);
    }
}

#endif
