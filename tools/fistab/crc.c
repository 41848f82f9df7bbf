/* SPDX-License-Identifier: MIT */
/* Check sums, bit by bit: the files are small. */
#include "crc.h"

uint32_t crc32_update(uint32_t crc, const void *data, size_t length)
{
    const uint8_t *byte = data;

    crc = ~crc;
    while (length-- > 0) {
        crc ^= *byte++;
        for (int bit = 0; bit < 8; bit++) {
            crc = crc >> 1 ^ (0xEDB88320U & -(crc & 1));
        }
    }
    return ~crc;
}

uint16_t crc16_update(uint16_t crc, const void *data, size_t length)
{
    const uint8_t *byte = data;

    while (length-- > 0) {
        crc = (uint16_t)(crc ^ *byte++ << 8);
        for (int bit = 0; bit < 8; bit++) {
            crc = (uint16_t)(crc & 0x8000 ? crc << 1 ^ 0x1021 : crc << 1);
        }
    }
    return crc;
}
