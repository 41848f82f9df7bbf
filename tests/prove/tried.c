/* SPDX-License-Identifier: MIT */
/* Proofs by trying all values, where the provers give up: the whole product of two 16-bit numbers,
 * and each line of bits.h. Contracts call such a clause `tried`. Prints a line for each, and exits
 * with 1 if one fails. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include "fixed.h"

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

int main(void)
{
    say("mul_u16 is exact for all pairs", is_every_product_exact());
    say("bits.h: casts, masks and shifts are remainders, quotients and products",
        is_every_shift_a_quotient());
    say("bits.h: `or` of parts that do not overlap is their sum", is_every_or_a_sum());
    return is_proved ? EXIT_SUCCESS : EXIT_FAILURE;
}
