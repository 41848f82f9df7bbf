/* SPDX-License-Identifier: MIT */
/* Who an image is: a text such as
 *     fuzzy51 1.0 brake/tuned at89s52 12000000 Hz table=0xBDC8
 * Name, version, controller and image (one word where both have the same name), board, crystal,
 * check sum of the table. drive reads it in the hex file and
 * runs the image only where it belongs. firmware/rules.mk makes the text. The two bytes at
 * IDENTITY_AT of the code (Makefile) hold the address of the text, low byte first;
 * tools/identify.sh writes them. They lie between the jumps of the first two interrupt vectors,
 * where no program has anything else. */
#ifndef FUZZY51_IDENTITY_H
#define FUZZY51_IDENTITY_H

#include "cc51.h"
#include "telemetry.h"

extern const char __code identity[];

/* Starts the title line of the telemetry, which says the identity and what led to this start:
 *     # fuzzy51 1.0 brake/tuned at89s52 12000000 Hz table=0xBDC8 reset=power-on
 * It uses telemetry_values[0] and [1] until the line is out (telemetry.h). */
/*@ assigns telemetry_values[0 .. 1]; */
void identity_say(void);

#endif
