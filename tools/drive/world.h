/* The seam between the lockstep loop and what is around one kind of controller: its sensor, its
 * plant, what is measured. run.c knows only this; brake_world.c is the brake's. Times are
 * nanoseconds of the scenario, 0 at the controller's first trigger. */
#ifndef FUZZY51_WORLD_H
#define FUZZY51_WORLD_H

#include "board.h"
#include "expect.h"
#include "scenario.h"

#include <stdbool.h>
#include <stdint.h>

enum { WORLD_COLUMNS = 12, WORLD_STEP_NS = 1000000, WORLD_ROW_NS = 10000000 };

struct world;

/* A quantity of the trace. */
struct world_column {
    const char *name;
    int decimals;
};

struct world_class {
    const struct world_column *columns;
    int column_count;

    /* Makes the world of SCENARIO, standing still until start. */
    struct world *(*create)(const struct scenario *scenario, uint64_t seed, int64_t step_ns);
    void (*destroy)(struct world *world);

    /* t = 0, with the output pins at LEVELS. */
    void (*start)(struct world *world, const bool levels[BOARD_OUTPUTS]);

    /* An output pin goes to LEVEL. Times never go back. */
    void (*pin_changed)(struct world *world, int64_t t_ns, enum board_pin pin, bool level);

    /* The world runs until T_NS. */
    void (*advance)(struct world *world, int64_t t_ns);

    /* Takes the next change of an input pin that is due until UNTIL_NS. */
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

    /* The controller has reported STATE ("CONTROL", ...) in a line that began at T_NS. */
    void (*state_reported)(struct world *world, int64_t t_ns, const char *state);

    /* The scenario has nothing more to show: an impact, both cars at rest. */
    bool (*is_over)(const struct world *world);

    /* The columns' values at the present time; NAN: none. */
    void (*values)(const struct world *world, double values[WORLD_COLUMNS]);

    /* What has been measured until T_NS, the scenario's end. */
    void (*measure)(const struct world *world, int64_t t_ns, struct outcome *outcome);
};

extern const struct world_class brake_world;

#endif
