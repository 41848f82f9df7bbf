/* SPDX-License-Identifier: MIT */
/* The seam between the lockstep loop and what is around one kind of controller: its sensor, its
 * plant, what is measured. run.c knows only this; brake_world.c is the brake's. Times are
 * nanoseconds of the scenario, 0 at the controller's first trigger, or at the one that is_warm
 * picks, or as is_unasked says; before start, nanoseconds since reset. A new controller needs one
 * file NAME_world.c here, which defines NAME_world; the list of worlds is made from the files. */
#ifndef FUZZY51_WORLD_H
#define FUZZY51_WORLD_H

#include "board.h"
#include "expect.h"
#include "picture.h"
#include "scenario.h"
#include "telemetry.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    WORLD_COLUMNS = 14,
    WORLD_STEP_NS = 1000000,
    WORLD_ROW_NS = 10000000,
    WORLD_BYTES = 176,
    /* No input changes earlier than this: the caller notices the first trigger up to one sync late,
     * so what a scenario starts at 0 s reaches the pins now. */
    WORLD_FIRST_INPUT_NS = 450000
};

struct world;

/* A quantity of the trace. */
struct world_column {
    const char *name;
    int decimals;
};

struct world_class {
    const char *name;    /* the controller's, as in [scenario] app */
    const char *meaning; /* what it does, in a few words */

    /* The sections that a scenario of this world may have beside [expect]. The world's own ones
     * fill its settings struct, which is struct scenario's `settings`. */
    const struct section_use *sections;
    int section_count;

    const struct world_column *columns;
    int column_count;
    const char *const *reported; /* columns of the telemetry that the trace repeats */
    int reported_count;

    /* Makes the world of SCENARIO, standing still until start. */
    struct world *(*create)(const struct scenario *scenario, uint64_t seed, int64_t step_ns);
    void (*destroy)(struct world *world);

    /* Whether the trigger that comes now is the scenario's first; NULL: the very first is. */
    bool (*is_warm)(const struct world *world);

    /* The sensor that SCENARIO names, or NULL where it names none and the image says which one it
     * is. NULL for a world with one sensor. */
    const char *(*sensor)(const struct scenario *scenario);

    /* Whether the sensor of SCENARIO sends without a trigger. Then the scenario begins RUN_CALM_MS
     * after the STOP pin falls for the first time. NULL: it never does. */
    bool (*is_unasked)(const struct scenario *scenario);

    /* t = 0, with the output pins at LEVELS. */
    void (*start)(struct world *world, const bool levels[BOARD_OUTPUTS]);

    /* An output pin goes to LEVEL. Times never go back. Comes before start, too, where is_warm is
     * given. */
    void (*pin_changed)(struct world *world, int64_t t_ns, enum board_pin pin, bool level);

    /* The world runs until T_NS. */
    void (*advance)(struct world *world, int64_t t_ns);

    /* Takes the next change of an input pin that is due until UNTIL_NS. NULL: none ever is. */
    bool (*next_input)(struct world *world, int64_t until_ns, int64_t *t_ns, enum board_pin *pin,
                       bool *level);

    /* Inputs up to this time do not depend on outputs after T_NS: so far the simulator may run. */
    int64_t (*horizon_ns)(const struct world *world, int64_t t_ns);

    /* The same as a good guess: the controller has never yet been so early with its next trigger.
     */
    int64_t (*guess_ns)(const struct world *world, int64_t t_ns);

    /* The next time at which the world itself changes how it answers; INT64_MAX: none. The caller
     * advances to exactly there. */
    int64_t (*mark_ns)(const struct world *world);

    /* Takes the bytes that go out on the serial line at T_NS, a time of mark_ns; returns their
     * number. NULL: this world sends none; one with is_unasked sends some only where that is so. */
    size_t (*take_bytes)(struct world *world, int64_t t_ns, uint8_t bytes[WORLD_BYTES]);

    /* When the last measurement that the controller can know was made; 0: none was. */
    int64_t (*measured_ns)(const struct world *world);

    /* The controller has reported STATE ("CONTROL", ...) in a line that began at T_NS. */
    void (*state_reported)(struct world *world, int64_t t_ns, const char *state);

    /* The scenario has nothing more to show: an impact, both cars at rest. */
    bool (*is_over)(const struct world *world);

    /* The columns' values at the present time; NAN: none. */
    void (*values)(const struct world *world, double values[WORLD_COLUMNS]);

    /* Draws the present state, from the columns' values and what the controller has sent. */
    void (*draw)(struct picture *picture, const struct scenario *scenario, const double *values,
                 const struct telemetry *telemetry);

    /* Prints the outcome in a sentence or two; NULL: as for a car behind another one. */
    void (*tell)(const struct outcome *outcome, const struct scenario *scenario);

    /* What has been measured until T_NS, the scenario's end. */
    void (*measure)(const struct world *world, int64_t t_ns, struct outcome *outcome);
};

/* For a world class: its sections, from an array. */
#define WORLD_SECTIONS(array)                                                                      \
    .sections = (array), .section_count = (int)(sizeof(array) / sizeof(array)[0])

/* For a world with settings: TYPE fits into a scenario. */
#define WORLD_SETTINGS_FIT(type)                                                                   \
    _Static_assert(sizeof(type) <= SCENARIO_SETTINGS, "enlarge SCENARIO_SETTINGS")

/* The classes of all worlds, each named after its file, in alphabetical order. */
#define WORLD(name) extern const struct world_class name##_world;
#include "worlds.h"
#undef WORLD

/* The worlds, by index from 0 on; NULL: there are no more. */
const struct world_class *world_at(int index);

/* The world of that name, or NULL. */
const struct world_class *world_find(const char *name);

/* The names of all worlds, separated by blanks; a static buffer. */
const char *world_names(void);

#endif
