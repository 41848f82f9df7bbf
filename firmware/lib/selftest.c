/* The table's check sum in slices. */
#include "selftest.h"
#include "lut.h"

#define SLICE_BYTES 16U

static uint16_t crc = LUT_CRC16_START;
static uint16_t offset;

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
