/* SPDX-License-Identifier: MIT */
/* What the tests of the range sensors share: the settings of a sensor and of its faults. Each test
 * file is a program of its own and includes this once. */
#ifndef FUZZY51_SENSOR_SETTINGS_H
#define FUZZY51_SENSOR_SETTINGS_H

#include "sensor.h"

#include <string.h>

static struct sensor_settings settings;

/* As a scenario says that has an empty [sensor] and no [fault]. */
static void default_settings(void)
{
    memset(&settings, 0, sizeof settings);
    section_defaults(&sensor_section, &settings.sensor);
    for (int i = 0; i < SENSOR_FAULTS; i++) {
        section_defaults(&fault_section, &settings.faults[i]);
    }
}

/* The fault number WHICH (0 .. SENSOR_FAULTS - 1) is of that KIND, from FROM_S on. */
static struct fault *fault(int which, enum fault_kind kind, double from_s)
{
    settings.faults[which].kind = kind;
    settings.faults[which].from_s = from_s;
    return &settings.faults[which];
}

#endif
