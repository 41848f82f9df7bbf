/* SPDX-License-Identifier: MIT */
/* Lines of text, made one character at a time while they are sent. So there is no line buffer, and
 * no call takes long. The owner of the UART asks for the next character when it can send one. */
#ifndef FUZZY51_TELEMETRY_H
#define FUZZY51_TELEMETRY_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

/* The values of a line in the order of its format. They must not change until the line is out. */
#define TELEMETRY_VALUES 12U
union telemetry_value {
    uint16_t number;
    const char __code *text;
};
extern __idata union telemetry_value telemetry_values[TELEMETRY_VALUES];

/* Returns whether a line is still being sent. Then the values must not change and telemetry_say
 * must not be called. */
/*@ assigns \nothing; */
bool telemetry_is_busy(void);

/* Starts a line. `format` is a text that may contain, at most TELEMETRY_VALUES times in all,
 *     %u  a number               %o  a number, or nothing if it is 0
 *     %s  a text
 *     %m  a number below 1000 as three digits, but as %u if the value before it was 0:
 *         "%o%m" prints seconds and milliseconds as milliseconds
 * %m must not be the first value. Nothing checks the format. */
/*@ requires format != \null;
    assigns \nothing; */
void telemetry_say(const char __code *format);

/* Returns the next character of the line, or 0 when the line is out. At most 1,540 mc, as
 * tools/bound finds. */
/*@ assigns \nothing; */
char telemetry_next(void);

#endif
