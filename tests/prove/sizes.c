/* SPDX-License-Identifier: MIT */
/* What the proofs take from mcs51.ml: both SDCC and Frama-C must agree with each line. */
#include <stddef.h>
#include <stdint.h>
#include "telemetry.h"

struct unaligned {
    uint8_t byte;
    uint32_t word;
};

#define IS(name, holds) typedef char name[(holds) ? 1 : -1]

IS(char_has_no_sign, (char)-1 > 0);
IS(bool_has_1_byte, sizeof(bool) == 1);
IS(short_has_2_bytes, sizeof(short) == 2);
IS(int_has_2_bytes, sizeof(int) == 2);
IS(long_has_4_bytes, sizeof(long) == 4);
IS(words_are_of_stdint, sizeof(int16_t) == 2 && sizeof(int32_t) == 4);
IS(size_t_has_2_bytes, sizeof(size_t) == 2 && (size_t)-1 > 0);
IS(difference_has_4_bytes, sizeof(ptrdiff_t) == 4);
IS(pointer_to_code_has_2_bytes, sizeof(const char __code *) == 2);
IS(value_has_2_bytes, sizeof(union telemetry_value) == 2);
IS(nothing_is_aligned, sizeof(struct unaligned) == 5);
IS(shift_keeps_the_sign, -2 >> 1 == -1);
IS(right_operand_wins, (uint16_t)65535U + (uint16_t)1 == 0);
IS(byte_becomes_int, (uint8_t)255 + (uint8_t)1 == 256 && -(uint8_t)1 < 0);
