/* SPDX-License-Identifier: MIT */
#include "sensor.h"

#include "scenario.h"

#include <math.h>

#define AT(member) offsetof(struct sensor, member)
static const struct key sensor_keys[] = {
    {.name = "kind",
     .meaning = "what measures",
     .kind = VALUE_CHOICE,
     .at = AT(kind),
     .choices = "hcsr04 tfluna",
     .initial = -1,
     .unset = "that of the image"},
    {.name = "noise_m",
     .meaning = "standard deviation of a reading",
     .at = AT(noise_m),
     .high = 1,
     .initial = SCENARIO_UNSET,
     .unset = "hcsr04: 0; tfluna: by the strength, 0.005 to 0.03"},
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
     .initial = 20,
     .kinds = "hcsr04"},
    {.name = "min_m",
     .meaning = "nearest distance that it sees",
     .at = AT(min_m),
     .high = 1,
     .initial = SCENARIO_UNSET,
     .unset = "hcsr04: 0.02; tfluna: 0.2"},
    {.name = "max_m",
     .meaning = "farthest distance that it sees",
     .at = AT(max_m),
     .low = 0.5,
     .high = 9,
     .initial = SCENARIO_UNSET,
     .unset = "hcsr04: 5; tfluna: 8"},
    {.name = "delay_us",
     .meaning = "from the end of the trigger to the rise of the echo line",
     .at = AT(delay_us),
     .low = 450,
     .high = 2000,
     .initial = 450,
     .kinds = "hcsr04"},
    {.name = "no_echo_us",
     .meaning = "length of the pulse that says: no target",
     .at = AT(no_echo_us),
     .low = 20000,
     .high = 60000,
     .initial = 38000,
     .kinds = "hcsr04"},
    {.name = "no_target",
     .meaning = "how it says: no target. pulse: as the HC-SR04; silent: no pulse; high: as the "
                "HC-SR04P, the line stays high until there is a target",
     .kind = VALUE_CHOICE,
     .at = AT(no_target),
     .choices = "pulse silent high",
     .kinds = "hcsr04"},
    {.name = "reflectivity_pct",
     .meaning = "of what is ahead: 90 is a white car, 10 a black one",
     .at = AT(reflectivity_pct),
     .low = 1,
     .high = 100,
     .initial = 90,
     .kinds = "tfluna"},
    {.name = "rate_hz",
     .meaning = "frames a second: 500/5, 500/6, ..., as 9600 baud carry",
     .at = AT(rate_hz),
     .low = 1,
     .high = 100,
     .initial = 100,
     .kinds = "tfluna"},
    {.name = "start_up_s",
     .meaning = "from the start to its first frame",
     .at = AT(start_up_s),
     .high = 100,
     .kinds = "tfluna"},
};
#undef AT

/* Its pulse of 36 ms or more means: no target. */
static const double hcsr04_max_m = 6;

static void check_sensor(struct section_check *check, const void *values)
{
    const struct sensor *sensor = values;
    const struct uart *uart = section_values(check, "uart");
    double share = 500 / sensor->rate_hz;

    if (sensor_min_m(sensor) >= sensor_max_m(sensor)) {
        section_complain(check, "min_m", "min_m is not below max_m; exchange them");
    }
    if (sensor_kind(sensor) != SENSOR_TFLUNA) {
        if (sensor->max_m > hcsr04_max_m) {
            section_complain(check, "max_m",
                             "max_m is above %g m, from where no hcsr04 answers; lower it",
                             hcsr04_max_m);
        }
        return;
    }
    if (fabs(share - round(share)) > 0.01) {
        section_complain(
            check, "rate_hz",
            "rate_hz is not 500 divided by a whole number, as a tfluna wants it; the nearest "
            "below is %.2f",
            500 / ceil(share));
    }
    if (uart->at_s >= 0) {
        section_complain(check, "kind", "a tfluna has the serial line for itself; take [uart] out");
    }
}

const struct section sensor_section = {.name = "sensor",
                                       .meaning = "the range sensor",
                                       SECTION_KEYS(sensor_keys),
                                       .size = sizeof(struct sensor),
                                       .check = check_sensor};

#define AT(member) offsetof(struct fault, member)
static const struct key fault_keys[] = {
    {.name = "kind",
     .meaning =
         "off, high: no answers; stuck: one reading for ever; garbage: readings at random; "
         "wrong: scale and offset; slow: few answers; delayed: old readings; intermittent: "
         "off and on; glitch: a few readings of dist_m; for a tfluna alone, blind: sunlight; "
         "rain: less strength, false near echoes; sum: wrong check sums; torn: a byte of a "
         "frame is missing",
     .kind = VALUE_CHOICE,
     .at = AT(kind),
     .choices = "off stuck garbage wrong slow delayed intermittent glitch high blind rain sum torn",
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
     .kinds = "off stuck garbage wrong slow delayed intermittent high blind rain sum torn"},
    {.name = "line",
     .meaning = "level of the echo line meanwhile",
     .kind = VALUE_CHOICE,
     .at = AT(line),
     .choices = "low high",
     .kinds = "off intermittent"},
    {.name = "dist_m",
     .meaning = "the distance that is read; rain: drops are nearer than this",
     .at = AT(dist_m),
     .low = 0.01,
     .high = 9,
     .initial = SCENARIO_UNSET,
     .unset = "stuck: the last one before; rain: 1",
     .kinds = "stuck glitch rain"},
    {.name = "readings",
     .meaning = "number of readings",
     .kind = VALUE_COUNT,
     .at = AT(readings),
     .low = 1,
     .high = 1000,
     .initial = 1,
     .kinds = "glitch"},
    {.name = "scale",
     .meaning = "factor on the distance; rain: on the strength",
     .at = AT(scale),
     .low = 0.1,
     .high = 10,
     .initial = 1,
     .kinds = "wrong rain"},
    {.name = "share",
     .meaning = "of the frames, at random; rain: of the readings that are a drop",
     .at = AT(share),
     .high = 1,
     .initial = 1,
     .kinds = "rain sum torn"},
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
    const struct sensor *sensor = section_values(check, "sensor");
    bool is_tfluna = sensor_kind(sensor) == SENSOR_TFLUNA;

    if (sensor->kind >= 0 && fault->kind >= 0 &&
        (is_tfluna ? fault->kind == FAULT_HIGH : fault->kind >= FAULT_BLIND)) {
        section_complain(check, "kind", "a %s has no such fault; take the section out",
                         sensor_kind_name(sensor_kind(sensor)));
    }
    if (is_tfluna && section_line(check, "line") != 0) {
        section_complain(check, "line",
                         "line is about the echo line, which a tfluna does not have; take it out");
    }
    if (fault->kind == FAULT_GLITCH && fault->dist_m < 0) {
        section_complain(check, NULL, "lacks dist_m; add it");
    }
}

const struct section fault_section = {.name = "fault",
                                      .meaning = "what is wrong with the sensor for a time",
                                      SECTION_KEYS(fault_keys),
                                      .size = sizeof(struct fault),
                                      .check = check_fault};
