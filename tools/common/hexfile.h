/* SPDX-License-Identifier: MIT */
/* Reads an Intel HEX image. drive checks an image with it before the simulator reads it, because
 * s51 runs an empty chip without a message if the image is missing or broken. */
#ifndef FUZZY51_HEXFILE_H
#define FUZZY51_HEXFILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { HEX_CODE_SIZE = 0x10000 };

struct hexfile {
    uint8_t code[HEX_CODE_SIZE];
    bool used[HEX_CODE_SIZE];
    size_t bytes; /* how many are used */
};

/* Reads the file PATH. Returns EXIT_FINE, or EXIT_USAGE after a message with the fault and its
 * line. */
int hexfile_read(struct hexfile *hex, const char *path);

#endif
