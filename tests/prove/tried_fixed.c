/* SPDX-License-Identifier: MIT */
/* The whole product of two 16-bit numbers, each line of bits.h, and the check sum. */
#include "crc16.h"
#include "fixed.c"
#include "mul_u16.c"
#include "tried.h"

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
        if ((uint16_t)x != x + 65536 || x >> 1 != (x - 1) / 2) {
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
    say("crc16.h: the sum in one step is that of the polynomial", is_every_crc_right());
    return is_proved ? EXIT_SUCCESS : EXIT_FAILURE;
}
