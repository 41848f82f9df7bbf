/* SPDX-License-Identifier: MIT */
/* Who an image is: a text such as
 *     fuzzy51 1.0 brake/tuned at89s52 12000000 Hz table=0xBDC8
 * Name, version, controller and image (one word where both have the same name), board, crystal,
 * check sum of the table. The telemetry's title line says it. drive reads it in the hex file and
 * runs the image only where it belongs. firmware/rules.mk makes the text. The two bytes at
 * IDENTITY_AT of the code (Makefile) hold the address of the text, low byte first;
 * tools/identify.sh writes them. They lie between the jumps of the first two interrupt vectors,
 * where no program has anything else. */
#ifndef FUZZY51_IDENTITY_H
#define FUZZY51_IDENTITY_H

#include "cc51.h"

extern const char __code identity[];

#endif
