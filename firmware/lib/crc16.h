/* SPDX-License-Identifier: MIT */
/* CRC-16/CCITT-FALSE, the check sum of tables and frames: polynomial x^16 + x^12 + x^5 + 1, start
 * value 0xFFFF, no reflection. The sum of the nine characters "123456789" is 0x29B1. */
#ifndef FUZZY51_CRC16_H
#define FUZZY51_CRC16_H

#include <stdint.h>

#define CRC16_START 0xFFFFU

/* Adds one byte to the sum in `high` and `low`, two variables of type uint8_t. About 25 mc: all
 * eight steps of the polynomial are done at once by shifts of bytes, without a loop or a table. It
 * is a macro because the two halves must stay in registers or direct memory of the caller. */
#define CRC16_ADD(high, low, byte)                                                                 \
    do {                                                                                           \
        uint8_t crc16_x = (uint8_t)((byte) ^ (high));                                              \
        crc16_x ^= crc16_x >> 4;                                                                   \
        (high) = (uint8_t)((low) ^ (uint8_t)(crc16_x << 4) ^ (crc16_x >> 3));                      \
        (low) = (uint8_t)((uint8_t)(crc16_x << 5) ^ crc16_x);                                      \
    } while (0)

#endif
