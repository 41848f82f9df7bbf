/* SPDX-License-Identifier: MIT */
/* What an image says of itself, at the fixed place of its code that firmware/mcu/identity.h
 * describes. */
#ifndef FUZZY51_DRIVE_IDENTITY_H
#define FUZZY51_DRIVE_IDENTITY_H

#include "hexfile.h"

#include <stdbool.h>

enum { IDENTITY_TEXT = 96, IDENTITY_WORD = 32 };

struct identity {
    char text[IDENTITY_TEXT]; /* "" where the image does not say who it is */
    char controller[IDENTITY_WORD], board[IDENTITY_WORD];
    char sensor[IDENTITY_WORD]; /* as [sensor] calls its kind */
    long clk_hz;                /* crystal, Hz; 0: not said */
};

/* Finds the identity in an image; one that has none gets empty texts. */
void identity_find(struct identity *identity, const struct hexfile *hex);

/* Whether the image HEX belongs to the board and to the controller's world. An image that does not
 * say who it is belongs everywhere. Returns EXIT_FINE, or EXIT_USAGE after a message. */
int identity_check(const struct identity *identity, const char *hex, const char *board,
                   const char *controller);

#endif
