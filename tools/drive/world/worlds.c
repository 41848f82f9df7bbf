/* SPDX-License-Identifier: MIT */
#include "world.h"

#include <stdio.h>
#include <string.h>

#define WORLD(name) &name##_world,
static const struct world_class *const worlds[] = {
#include "worlds.h"
};
#undef WORLD

enum { WORLD_COUNT = sizeof worlds / sizeof worlds[0] };

const struct world_class *world_at(int index)
{
    return index < WORLD_COUNT ? worlds[index] : NULL;
}

const struct world_class *world_find(const char *name)
{
    for (int i = 0; i < WORLD_COUNT; i++) {
        if (strcmp(worlds[i]->name, name) == 0) {
            return worlds[i];
        }
    }
    return NULL;
}

const char *world_names(void)
{
    static char names[256];

    names[0] = '\0';
    for (int i = 0; i < WORLD_COUNT; i++) {
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i > 0 ? " " : "",
                 worlds[i]->name);
    }
    return names;
}
