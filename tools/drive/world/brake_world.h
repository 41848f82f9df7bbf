/* SPDX-License-Identifier: MIT */
/* What a scenario says of the brake's world alone. The laboratory, too, makes such scenarios. */
#ifndef FUZZY51_BRAKE_WORLD_H
#define FUZZY51_BRAKE_WORLD_H

#include "scenario.h"
#include "sensor.h"

struct brake_settings {
    struct sensor_settings sensing;
    struct {
        double from_s, for_s; /* the driver holds the override; unset from_s: never */
    } override;
};

/* The settings in a SCENARIO of the brake's world. */
struct brake_settings *brake_settings(struct scenario *scenario);

#endif
