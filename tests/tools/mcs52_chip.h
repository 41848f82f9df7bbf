/* SPDX-License-Identifier: MIT */
/* What the tests of tools/drive/sim/mcs52 share: a chip, and notes of what it tells the outside.
 * Each test file is a program of its own and includes this once. Times are machine cycles. */
#ifndef FUZZY51_MCS52_CHIP_H
#define FUZZY51_MCS52_CHIP_H

#include "mcs52.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

/* Special function registers, and what instructions are made of. They come from the manual, not
 * from the library, so that a wrong address in the library is found. */
enum {
    P0 = 0x80,
    SP = 0x81,
    PCON = 0x87,
    TCON = 0x88,
    TMOD = 0x89,
    TL0 = 0x8A,
    TL1 = 0x8B,
    TH0 = 0x8C,
    TH1 = 0x8D,
    AUXR = 0x8E,
    P1 = 0x90,
    SCON = 0x98,
    SBUF = 0x99,
    WDTRST = 0xA6,
    IE = 0xA8,
    P3 = 0xB0,
    IP = 0xB8,
    T2CON = 0xC8,
    T2MOD = 0xC9,
    RCAP2L = 0xCA,
    RCAP2H = 0xCB,
    TL2 = 0xCC,
    TH2 = 0xCD,
    PSW = 0xD0,
    ACC = 0xE0,
    WDT_CONTR = 0xE1,
    NOP = 0x00,
    MOV_DIRECT = 0x75, /* MOV direct, #data: 2 cycles */
    SETB = 0xD2,       /* SETB bit: 1 cycle */
    CPL = 0xB2,        /* CPL bit: 1 cycle */
    SJMP = 0x80,       /* 2 cycles */
    HERE = 0xFE,       /* SJMP HERE: for ever */
    INC_DIRECT = 0x05, /* 1 cycle */
    RETI = 0x32,
    MAX_NOTES = 128
};

struct note {
    uint64_t cycle;
    int pin; /* 10 * port + bit */
    int value;
};

static struct mcs52 *chip;
static struct note edges[MAX_NOTES], bytes[MAX_NOTES], writes[MAX_NOTES];
static int edge_count, byte_count, write_count, reset_count;
static uint64_t reset_cycle;

static void note_edge(void *user, uint64_t cycle, int port, int bit, bool level)
{
    (void)user;
    if (edge_count < MAX_NOTES) {
        edges[edge_count++] = (struct note){cycle, 10 * port + bit, level};
    }
}

static void note_byte(void *user, uint64_t cycle, uint8_t byte)
{
    (void)user;
    if (byte_count < MAX_NOTES) {
        bytes[byte_count++] = (struct note){cycle, 0, byte};
    }
}

static void note_xdata(void *user, uint64_t cycle, uint8_t value)
{
    (void)user;
    if (write_count < MAX_NOTES) {
        writes[write_count++] = (struct note){cycle, 0, value};
    }
}

static void note_reset(void *user, uint64_t cycle)
{
    (void)user;
    reset_cycle = cycle;
    reset_count++;
}

static void make_chip(enum mcs52_part part)
{
    const struct mcs52_outside outside = {
        .edge = note_edge, .byte = note_byte, .xdata = note_xdata, .reset = note_reset};

    mcs52_destroy(chip);
    chip = mcs52_create(part, &outside);
    edge_count = byte_count = write_count = reset_count = 0;
}

void setUp(void)
{
    make_chip(MCS52_INTEL);
}

void tearDown(void)
{
    mcs52_destroy(chip);
    chip = NULL;
}

/* Puts these bytes of code to ADDRESS. */
#define LOAD(address, ...)                                                                         \
    mcs52_load(chip, address, (const uint8_t[]){__VA_ARGS__},                                      \
               sizeof((const uint8_t[]){__VA_ARGS__}))

/* Sets a register as an instruction before the test would have done. */
static inline void set(uint8_t address, unsigned value)
{
    mcs52_poke(chip, address, (uint8_t)value);
}

static inline unsigned sfr(uint8_t address)
{
    return mcs52_sfr(chip, address);
}

#endif
