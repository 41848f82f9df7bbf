/* SPDX-License-Identifier: MIT */
/* Looks at an Intel HEX image before the simulator gets it: s51 itself runs an empty chip when the
 * image is missing or broken, and says so nowhere. */
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

/* Reads PATH. Returns EXIT_FINE, or EXIT_USAGE after a message that names the fault and the line.
 */
int hexfile_read(struct hexfile *hex, const char *path);

#endif
