/* SPDX-License-Identifier: MIT */
/* Proofs by trying all values, where the provers give up: the whole product of two 16-bit numbers,
 * and each line of bits.h. Contracts call such a clause `tried`. Prints a line for each, and exits
 * with 1 if one fails. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include "fixed.h"
#include "cell.h"

static bool is_proved = true;

static void say(const char *what, bool holds)
{
    printf("tried: %s: %s\n", what, holds ? "proved" : "WRONG");
    is_proved = is_proved && holds;
}

/* All 4,294,967,296 pairs. */
static bool is_every_product_exact(void)
{
    for (uint32_t a = 0; a <= UINT16_MAX; a++) {
        uint32_t wrong = 0;

        for (uint32_t b = 0; b <= UINT16_MAX; b++) {
            wrong |= mul_u16((uint16_t)a, (uint16_t)b) ^ (a * b);
        }
        if (wrong != 0) {
            return false;
        }
    }
    return true;
}

/* The firmware shifts and masks numbers of up to 25 bits; so each of them is tried. */
static bool is_every_shift_a_quotient(void)
{
    for (uint32_t x = 0; x < 1UL << 25; x++) {
        if ((uint8_t)x != x % 256 || (uint16_t)x != x % 65536 || (x & 15) != x % 16 ||
            (x & 255) != x % 256) {
            return false;
        }
        for (unsigned n = 1; n <= 16; n++) {
            if (x >> n != x / (1UL << n) || (uint64_t)x << n != x * (1ULL << n)) {
                return false;
            }
        }
    }
    for (int32_t x = -65536; x < 0; x++) {
        if ((uint16_t)x != x + 65536) {
            return false;
        }
    }
    return true;
}

static bool is_every_or_a_sum(void)
{
    for (uint32_t x = 0; x <= UINT16_MAX; x++) {
        for (uint32_t y = 0; y < 256; y++) {
            if (((x * 256) | y) != x * 256 + y) {
                return false;
            }
        }
    }
    for (uint64_t x = 0; x <= UINT16_MAX; x++) {
        for (uint64_t y = 0; y <= UINT16_MAX; y++) {
            if (((x * 65536) | y) != x * 65536 + y) {
                return false;
            }
        }
    }
    return true;
}

/* The cell of x, x mm or mm/s above the low end of an axis. */
static long cell_at(long x, long span, long cells)
{
    return x < 0 ? 0 : x >= span ? cells - 1 : x * cells / span;
}

/* Of the brake's table: each distance, each speed, each cell. */
static bool is_every_cell_right(void)
{
    for (long x = 0; x <= UINT16_MAX; x++) {
        uint16_t value = (uint16_t)x;

        if (cell_row(value) != cell_at(x - LUT_IN1_MIN_MILLI, LUT_IN1_SPAN_MILLI, LUT_IN1_CELLS) ||
            cell_col(value, 0) !=
                cell_at(x - LUT_IN2_MIN_MILLI, LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS) ||
            cell_col(0, value) !=
                cell_at(-x - LUT_IN2_MIN_MILLI, LUT_IN2_SPAN_MILLI, LUT_IN2_CELLS)) {
            return false;
        }
    }
    for (unsigned row = 0; row < LUT_IN1_CELLS; row++) {
        for (unsigned col = 0; col < LUT_IN2_CELLS; col++) {
            if (lut_at((uint8_t)row, (uint8_t)col) > LUT_LEVELS) {
                return false;
            }
        }
    }
    return true;
}

/* The sum in one step against the sum bit by bit, for each sum and each byte. */
static bool is_every_crc_right(void)
{
    for (uint32_t sum = 0; sum <= UINT16_MAX; sum++) {
        for (unsigned byte = 0; byte < 256; byte++) {
            uint8_t high = (uint8_t)(sum >> 8), low = (uint8_t)sum;
            uint16_t bits = (uint16_t)(sum ^ byte << 8);

            for (unsigned n = 0; n < 8; n++) {
                bits = (uint16_t)(bits & 0x8000U ? (unsigned)bits << 1 ^ 0x1021U
                                                 : (unsigned)bits << 1);
            }
            CRC16_ADD(high, low, byte);
            if ((high << 8 | low) != bits) {
                return false;
            }
        }
    }
    return true;
}

int main(void)
{
    say("mul_u16 is exact for all pairs", is_every_product_exact());
    say("bits.h: casts, masks and shifts are remainders, quotients and products",
        is_every_shift_a_quotient());
    say("bits.h: `or` of parts that do not overlap is their sum", is_every_or_a_sum());
    say("cell.h: the row of each distance and the column of each speed; lut.h: each cell is a "
        "level",
        is_every_cell_right());
    say("crc16.h: the sum in one step is that of the polynomial", is_every_crc_right());
    return is_proved ? EXIT_SUCCESS : EXIT_FAILURE;
}
