/* Lines of text, made one character at a time while they are sent: no line buffer, and no call
 * takes long. Portable; whoever has the UART asks for the next character when it can take one. */
#ifndef FUZZY51_TELEMETRY_H
#define FUZZY51_TELEMETRY_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

/* A line's values in the order of its format. They must stay as they are until the line is out. */
#define TELEMETRY_VALUES 12U
union telemetry_value {
    uint16_t number;
    const char __code *text;
};
extern __idata union telemetry_value telemetry_values[TELEMETRY_VALUES];

/* A line is still on its way: its values must not change, and no other may start. */
bool telemetry_is_busy(void);

/* Starts a line. The format holds text and
 *     %u  a number               %o  a number, nothing if it is 0
 *     %s  a text                 %x  a number in four hexadecimal digits
 *     %m  a number below 1000 in three digits, but as %u if the value before it was 0:
 *         "%o%m" prints seconds and milliseconds as milliseconds */
void telemetry_say(const char __code *format);

/* The next character; 0: the line is out. At most 1,540 mc, as tools/bound finds them. */
char telemetry_next(void);

#endif
