/* SPDX-License-Identifier: MIT */
/* Telemetry for Eva's main loops: any character at any time. The real one is tested, not proved. */
#ifndef FUZZY51_PROVE_TELEMETRY_H
#define FUZZY51_PROVE_TELEMETRY_H

#include "machine.h"
#include "../../firmware/lib/telemetry.h"

union telemetry_value telemetry_values[TELEMETRY_VALUES];

bool telemetry_is_busy(void)
{
    return any_bool();
}
void telemetry_say(const char *format)
{
    /*@ assert line: format != \null; */
}
char telemetry_next(void)
{
    return (char)any_byte();
}

#endif
