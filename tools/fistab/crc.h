/* SPDX-License-Identifier: MIT */
/* The two check sums of a table header. */
#ifndef FUZZY51_CRC_H
#define FUZZY51_CRC_H

#include <stddef.h>
#include <stdint.h>

/* CRC-32 as zip and `cksum -a crc32b` have it; begin with 0. */
uint32_t crc32_update(uint32_t crc, const void *data, size_t length);

/* CRC-16/CCITT-FALSE: polynomial 0x1021, begin with 0xFFFF, not reflected. */
uint16_t crc16_update(uint16_t crc, const void *data, size_t length);

#endif
