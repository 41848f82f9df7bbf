/* SPDX-License-Identifier: MIT */
/* The steps of what all controllers share. */
#include "fixed.h"
#include "lamp.h"
#include "lut.h"
#include "steps.h"
#include "telemetry.h"

enum what { WITH_TABLE = 1, WITH_LINE = 2 };

static const char __code LINE[] = "%u,%o%m,%o,%s%u,%s\r\n";
static const char __code *const __code TEXTS[] = {"", "-", "CONTROL", "FAULT"};

/* The table's check sum, and one cell. */
static void step_table(void)
{
    uint16_t crc = take_u16(), offset = take_u16();
    uint8_t first = take(), second = take(), count = take();

#ifdef LUT_NO_CRC16
    crc ^= offset ^ count;
#else
    crc = lut_crc16(crc, offset, count);
#endif
    put_u16(crc);
#if LUT_INPUTS == 3
    put(lut_at3(first, second, 0));
    put(lut2_at3(first, second, LUT_IN3_CELLS - 1));
#else
    put(lut_at(first, second));
#endif
}

static void step_line(void)
{
    uint8_t value;
    char c;

    for (value = 0; value < 4; value++) {
        telemetry_values[value].number = take_u16();
    }
    telemetry_values[4].text = TEXTS[take()];
    telemetry_values[5].number = take_u16();
    telemetry_values[6].text = TEXTS[take()];
    telemetry_say(LINE);
    do {
        c = telemetry_next();
        put((uint8_t)c);
        put(telemetry_is_busy());
    } while (c != 0);
}

void step_lib(void)
{
    uint8_t what = take();
    uint16_t a = take_u16(), b = take_u16();
    uint32_t product;

    put_u16(mul_u8((uint8_t)a, (uint8_t)b));
    put_u16(mul_hi_u16(a, b));
    product = mul_u16(a, b);
    put_u16((uint16_t)(product >> 16));
    put_u16((uint16_t)product);
    put_u16(magnitude_i16((int16_t)a));
    put(lamp_tick(take()));
    if (what & WITH_TABLE) {
        step_table();
    }
    if (what & WITH_LINE) {
        step_line();
    }
}

#ifndef __SDCC_mcs51

static void draw_table(void)
{
    uint32_t offset = chance(LUT_BYTES), most = LUT_BYTES - offset;

    give_u16((uint16_t)chance(65536));
    give_u16((uint16_t)offset);
    give((uint8_t)chance(LUT_IN1_CELLS));
#if LUT_INPUTS == 1
    give(0);
#else
    give((uint8_t)chance(LUT_IN2_CELLS));
#endif
    give((uint8_t)(1 + chance(most < 32 ? most : 32)));
}

static void draw_line(void)
{
    for (int value = 0; value < 4; value++) {
        give_u16(chance(3) == 0 ? 0 : (uint16_t)(chance(65536) >> chance(16)));
    }
    give((uint8_t)chance(4));
    give_u16((uint16_t)chance(65536));
    give((uint8_t)chance(4));
}

void draw_lib(void)
{
    static const uint8_t patterns[] = {LAMP_OFF, LAMP_ON, 2, 3, 5, 9, LAMP_FLICKER};
    static uint8_t pattern;
    uint8_t what = (uint8_t)((chance(8) == 0) * WITH_TABLE + (chance(64) == 0) * WITH_LINE);

    give(what);
    give_u16(draw_u16(0, 65535));
    give_u16(draw_u16(0, 65535));
    if (chance(300) == 0) {
        pattern = patterns[chance(sizeof patterns)];
    }
    give(pattern);
    if (what & WITH_TABLE) {
        draw_table();
    }
    if (what & WITH_LINE) {
        draw_line();
    }
}

#endif
