#include "world.h"

const struct world_class *world_class(enum world_kind kind)
{
    static const struct world_class *const classes[WORLD_KINDS] = {
        [WORLD_BRAKE] = &brake_world,   [WORLD_RADAR] = &radar_world, [WORLD_GAP] = &gap_world,
        [WORLD_FOLLOW] = &follow_world, [WORLD_PARK] = &park_world,
    };

    return classes[kind];
}
