/* Table look-up and its check sum. */
#define LUT_DATA
#include "lut.h"

#if LUT_INPUTS == 1
uint8_t lut_at(uint8_t row, uint8_t col)
{
    (void)col;
    return lut_out1[row];
}
#elif LUT_INPUTS == 2
typedef const uint8_t __code lut_row[LUT_IN2_CELLS];

uint8_t lut_at(uint8_t row, uint8_t col)
{
    /* Seen as rows of bytes SDCC indexes it by one `mul ab`; row * CELLS + col would take 15 mc more. */
    return ((lut_row *)lut_out1)[row][col];
}
#else
#error "lut_at serves tables of one or two inputs; read lut_out1 itself, row-major"
#endif

uint16_t lut_crc16(uint16_t crc, uint16_t offset, uint8_t count)
{
    const uint8_t __code *byte = lut_out1 + offset;
    uint8_t high = (uint8_t)(crc >> 8), low = (uint8_t)crc;

    do {
        CRC16_ADD(high, low, *byte);
        byte++;
    } while (--count != 0);
    return (uint16_t)((uint16_t)(high << 8) | low);
}
