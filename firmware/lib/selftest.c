/* SPDX-License-Identifier: MIT */
/* The table's check sum in slices. */
#include "selftest.h"
#include "lut.h"

#define SLICE_BYTES 16U

static uint16_t crc = LUT_CRC16_START;
static uint16_t offset; /* bytes that are in the sum */

/*@ requires offset < LUT_BYTES;
    assigns crc, offset;
    ensures offset == \min(\old(offset) + SLICE_BYTES, LUT_BYTES);
    ensures \result == SELFTEST_RUNNING <==> offset < LUT_BYTES;
    ensures \result == SELFTEST_PASSED <==> (offset == LUT_BYTES && crc == LUT_CRC16); */
uint8_t selftest_table(void)
{
    uint16_t left = LUT_BYTES - offset;
    uint8_t count = left < SLICE_BYTES ? (uint8_t)left : SLICE_BYTES;

    crc = lut_crc16(crc, offset, count);
    offset += count;
    if (offset != LUT_BYTES) {
        return SELFTEST_RUNNING;
    }
    return crc == LUT_CRC16 ? SELFTEST_PASSED : SELFTEST_FAILED;
}
