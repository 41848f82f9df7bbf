/* SPDX-License-Identifier: MIT */
/* Looks up every cell on the chip, with the look-up and the memory model that ship, and times it.
 * In s51 (tests/tools/test_lut_on_chip.sh) the cells go to the simulator interface's file as raw
 * bytes, row after row; the last line printed says what was measured. */
#include <8052.h>
#include "lut.h"

#define SIMULATOR (*(volatile uint8_t __xdata *)0xFFFF)

/* Timer 0 counts machine cycles; starting and stopping it is one of them. */
#define START()                                                                                    \
    do {                                                                                           \
        TH0 = 0;                                                                                   \
        TL0 = 0;                                                                                   \
        TR0 = 1;                                                                                   \
    } while (0)
#define STOP() TR0 = 0

#if LUT_INPUTS == 1
#define COLS 1
#else
#define COLS LUT_IN2_CELLS
#endif

/* Not in registers, so that no call has to save them. */
static uint8_t row, col, value;
static uint16_t least = 65535U, most;

/* A call without a look-up: a bare `ret`. */
uint8_t nothing(uint8_t first, uint8_t second)
{
    (void)second;
    return first;
}

static void print(const char __code *text)
{
    for (; *text != 0; text++) {
        SIMULATOR = 'p';
        SIMULATOR = (uint8_t)*text;
    }
}

static void print_number(uint16_t number)
{
    uint16_t unit = 10000;

    while (unit > 1 && number < unit) {
        unit /= 10;
    }
    for (; unit > 0; unit /= 10) {
        SIMULATOR = 'p';
        SIMULATOR = (uint8_t)('0' + number / unit % 10);
    }
}

static uint16_t cycles(void)
{
    return (uint16_t)(TH0 << 8) | TL0;
}

static uint16_t call_cycles(void)
{
    START();
    value = nothing(row, col);
    STOP();
    return cycles() - 2; /* the look-up has a ret too */
}

static void look_up_all(void)
{
    row = 0;
    do {
        col = 0;
        do {
            uint16_t taken;

            START();
            value = lut_at(row, col);
            STOP();
            taken = cycles();
            if (taken < least) {
                least = taken;
            }
            if (taken > most) {
                most = taken;
            }
            SIMULATOR = 'w';
            SIMULATOR = value;
        } while (++col != (uint8_t)COLS);
    } while (++row != (uint8_t)LUT_IN1_CELLS);
}

static uint16_t check_sum(uint8_t slice)
{
    uint16_t crc = LUT_CRC16_START, offset = 0;

    while (offset != LUT_BYTES) {
        uint16_t left = LUT_BYTES - offset;
        uint8_t count = left < slice ? (uint8_t)left : slice;

        crc = lut_crc16(crc, offset, count);
        offset += count;
    }
    return crc;
}

static uint16_t slice_cycles(uint8_t count)
{
    START();
    lut_crc16(LUT_CRC16_START, 0, count);
    STOP();
    return cycles();
}

void main(void)
{
    uint16_t call, byte;

    TMOD = 0x01;
    look_up_all();
    call = call_cycles();
    byte = (slice_cycles(21) - slice_cycles(1)) / 20;
    print("bytes ");
    print_number(LUT_BYTES);
    print(" least ");
    print_number(least - call);
    print(" most ");
    print_number(most - call);
    print(" call ");
    print_number(call);
    print(" crc_byte ");
    print_number(byte);
    print(" crc_slice ");
    print_number(slice_cycles(1) - byte);
    print(check_sum(255) == LUT_CRC16 && check_sum(16) == LUT_CRC16 ? " crc right" : " crc wrong");
    print(" end\n");
    SIMULATOR = 's';
    for (;;)
        ;
}
