/* SPDX-License-Identifier: MIT */
#include "sonar.h"

#define AT(member) offsetof(struct sensor, member)
static const struct key sensor_keys[] = {
    {.name = "noise_m", .meaning = "standard deviation of a reading", .at = AT(noise_m), .high = 1},
    {.name = "dropout",
     .meaning = "probability that a reading finds no target",
     .at = AT(dropout),
     .high = 1},
    {.name = "step_m",
     .meaning = "readings are rounded to this; 0: not",
     .at = AT(step_m),
     .high = 1},
    {.name = "temp_c",
     .meaning = "temperature of the air, which sets the speed of sound",
     .at = AT(temp_c),
     .low = -40,
     .high = 60,
     .initial = 20},
    {.name = "min_m",
     .meaning = "nearest distance that it sees",
     .at = AT(min_m),
     .high = 1,
     .initial = 0.02},
    {.name = "max_m",
     .meaning = "farthest distance that it sees",
     .at = AT(max_m),
     .low = 0.5,
     .high = 6,
     .initial = 5},
    {.name = "delay_us",
     .meaning = "from the end of the trigger to the rise of the echo line",
     .at = AT(delay_us),
     .low = 450,
     .high = 2000,
     .initial = 450},
    {.name = "no_echo_us",
     .meaning = "length of the pulse that says: no target",
     .at = AT(no_echo_us),
     .low = 20000,
     .high = 60000,
     .initial = 38000},
    {.name = "no_target",
     .meaning = "how it says: no target. pulse: as the HC-SR04; silent: no pulse; high: as the "
                "HC-SR04P, the line stays high until there is a target",
     .kind = VALUE_CHOICE,
     .at = AT(no_target),
     .choices = "pulse silent high"},
};
#undef AT

static void check_sensor(struct section_check *check, const void *values)
{
    const struct sensor *sensor = values;

    if (sensor->min_m >= sensor->max_m) {
        section_complain(check, "min_m", "min_m is not below max_m; exchange them");
    }
}

const struct section sensor_section = {.name = "sensor",
                                       .meaning = "the ultrasonic sensor",
                                       SECTION_KEYS(sensor_keys),
                                       .size = sizeof(struct sensor),
                                       .check = check_sensor};

#define AT(member) offsetof(struct fault, member)
static const struct key fault_keys[] = {
    {.name = "kind",
     .meaning = "off, high: no answers; stuck: one reading for ever; garbage: readings at random; "
                "wrong: scale and offset; slow: few answers; delayed: old readings; intermittent: "
                "off and on; glitch: a few readings of dist_m",
     .kind = VALUE_CHOICE,
     .at = AT(kind),
     .choices = "off stuck garbage wrong slow delayed intermittent glitch high",
     .initial = -1,
     .required = true},
    {.name = "from_s",
     .meaning = "when it begins",
     .at = AT(from_s),
     .high = 3600,
     .required = true},
    {.name = "for_s",
     .meaning = "how long it lasts",
     .at = AT(for_s),
     .low = 0.001,
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .unset = "to the end",
     .kinds = "off stuck garbage wrong slow delayed intermittent high"},
    {.name = "line",
     .meaning = "level of the echo line meanwhile",
     .kind = VALUE_CHOICE,
     .at = AT(line),
     .choices = "low high",
     .kinds = "off intermittent"},
    {.name = "dist_m",
     .meaning = "the distance that is read",
     .at = AT(dist_m),
     .low = 0.01,
     .high = 6,
     .initial = SCENARIO_UNSET,
     .unset = "stuck: the last one before",
     .kinds = "stuck glitch"},
    {.name = "readings",
     .meaning = "number of readings",
     .kind = VALUE_COUNT,
     .at = AT(readings),
     .low = 1,
     .high = 1000,
     .initial = 1,
     .kinds = "glitch"},
    {.name = "scale",
     .meaning = "factor on the distance",
     .at = AT(scale),
     .low = 0.1,
     .high = 10,
     .initial = 1,
     .kinds = "wrong"},
    {.name = "offset_m",
     .meaning = "added to the distance",
     .at = AT(offset_m),
     .low = -5,
     .high = 5,
     .kinds = "wrong"},
    {.name = "period_s",
     .meaning = "shortest time between two answers",
     .at = AT(period_s),
     .low = 0.01,
     .high = 10,
     .kinds = "slow",
     .required = true},
    {.name = "delay_s",
     .meaning = "age of the readings",
     .at = AT(delay_s),
     .low = 0.001,
     .high = 10,
     .kinds = "delayed",
     .required = true},
    {.name = "on_s",
     .meaning = "time with answers",
     .at = AT(on_s),
     .low = 0.001,
     .high = 100,
     .kinds = "intermittent",
     .required = true},
    {.name = "off_s",
     .meaning = "time without answers, which comes first",
     .at = AT(off_s),
     .low = 0.001,
     .high = 100,
     .kinds = "intermittent",
     .required = true},
};
#undef AT

static void check_fault(struct section_check *check, const void *values)
{
    const struct fault *fault = values;

    if (fault->kind == FAULT_GLITCH && fault->dist_m < 0) {
        section_complain(check, NULL, "lacks dist_m; add it");
    }
}

const struct section fault_section = {.name = "fault",
                                      .meaning = "what is wrong with the sensor for a time",
                                      SECTION_KEYS(fault_keys),
                                      .size = sizeof(struct fault),
                                      .check = check_fault};
