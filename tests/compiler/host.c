/* SPDX-License-Identifier: MIT */
/* The host's side: draws steps, makes them in this program and in the chip, and compares.
 *     steps IMAGE.ihx STEPS [SEED]
 * Prints one line and exits with 1 at the first byte that differs. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "cells.h"
#include "crc16.h"
#include "hexfile.h"
#include "mcs52.h"
#include "steps.h"

/* More than any step takes. */
enum { STEP_CYCLES = 1000000, BYTES_MAX = 512 };

struct bytes {
    uint8_t byte[BYTES_MAX];
    unsigned count;
};

static struct bytes input, host, chip;
static unsigned taken;
static struct mcs52 *mcs52;
static uint64_t random_state;

/* xorshift64*, after Marsaglia and Vigna. */
uint32_t chance(uint32_t below)
{
    random_state ^= random_state >> 12;
    random_state ^= random_state << 25;
    random_state ^= random_state >> 27;
    return (uint32_t)((random_state * 2685821657736338717U >> 32) * below >> 32);
}

uint16_t draw_u16(uint16_t low, uint16_t high)
{
    switch (chance(24)) {
    case 0:
        return low;
    case 1:
        return high;
    case 2:
        return (uint16_t)(low + chance(3) - 1);
    case 3:
        return (uint16_t)(high + chance(3) - 1);
    case 4:
        return (uint16_t)chance(65536);
    default:
        return (uint16_t)(low + chance((uint32_t)(uint16_t)(high - low) + 1));
    }
}

static void add(struct bytes *to, uint8_t byte)
{
    if (to->count == BYTES_MAX) {
        fprintf(stderr, "steps: error: a step has more than %d bytes; make BYTES_MAX larger\n",
                BYTES_MAX);
        exit(2);
    }
    to->byte[to->count++] = byte;
}

void give(uint8_t byte)
{
    add(&input, byte);
}

void give_u16(uint16_t number)
{
    give((uint8_t)(number >> 8));
    give((uint8_t)number);
}

uint8_t take(void)
{
    if (taken == input.count) {
        fprintf(stderr, "steps: error: step() takes more than draw() gave\n");
        exit(2);
    }
    return input.byte[taken++];
}

void put(uint8_t byte)
{
    add(&host, byte);
}

static void chip_put(void *user, uint64_t cycle, uint8_t byte)
{
    (void)user;
    (void)cycle;
    add(&chip, byte);
    if (chip.count == host.count) {
        mcs52_stop(mcs52);
    }
}

/* Runs the chip until it has put as many bytes as the host. */
static void step_on_chip(void)
{
    uint64_t until = mcs52_cycles(mcs52) + STEP_CYCLES;

    chip.count = 0;
    memcpy(mcs52_xdata(mcs52) + STEP_IN, input.byte, input.count);
    mcs52_xdata(mcs52)[STEP_GO] = 1;
    while (chip.count < host.count && mcs52_cycles(mcs52) + 4 < until) {
        mcs52_run(mcs52, until);
    }
}

static void show(const char *what, const struct bytes *bytes)
{
    printf("    %s", what);
    for (unsigned at = 0; at < bytes->count; at++) {
        printf(" %02x", bytes->byte[at]);
    }
    putchar('\n');
}

static bool is_same(unsigned long step_number)
{
    unsigned at = 0;

    while (at < host.count && at < chip.count && host.byte[at] == chip.byte[at]) {
        at++;
    }
    if (at == host.count) {
        return true;
    }
    if (at < chip.count) {
        printf("step %lu differs: byte %u is %u on the host and %u on the chip\n", step_number, at,
               host.byte[at], chip.byte[at]);
    } else {
        printf("step %lu differs: the chip put %u bytes of %u and then nothing for %d cycles\n",
               step_number, at, host.count, STEP_CYCLES);
    }
    show("input", &input);
    show("host ", &host);
    show("chip ", &chip);
    return false;
}

static void load(const char *path)
{
    static struct hexfile hex;
    static const struct mcs52_outside outside = {.xdata = chip_put};

    if (hexfile_read(&hex, path) != 0) {
        exit(2);
    }
    mcs52 = mcs52_create(MCS52_INTEL, &outside);
    if (mcs52 == NULL) {
        exit(2);
    }
    mcs52_load(mcs52, 0, hex.code, sizeof hex.code);
    mcs52_watch_xdata(mcs52, STEP_OUT);
}

int main(int count, char **args)
{
    unsigned long steps = count >= 3 ? strtoul(args[2], NULL, 0) : 0;
    uint64_t bytes = 0;
    uint8_t high = CRC16_START >> 8, low = (uint8_t)CRC16_START;

    if (steps == 0) {
        fprintf(stderr, "usage: steps IMAGE.ihx STEPS [SEED]\n");
        return 2;
    }
    random_state = 0x9E3779B97F4A7C15U ^ (count >= 4 ? strtoul(args[3], NULL, 0) : 0);
    load(args[1]);
    steps_begin();
    for (unsigned long number = 1; number <= steps; number++) {
        input.count = 0;
        host.count = 0;
        taken = 0;
        draw();
        step();
        step_on_chip();
        if (!is_same(number)) {
            return 1;
        }
        for (unsigned at = 0; at < host.count; at++) {
            CRC16_ADD(high, low, host.byte[at]);
        }
        bytes += host.count;
    }
    printf("%lu steps, %" PRIu64 " bytes, CRC %02X%02X, %" PRIu64 " cycles: no difference\n", steps,
           bytes, high, low, mcs52_cycles(mcs52));
    mcs52_destroy(mcs52);
    return 0;
}
