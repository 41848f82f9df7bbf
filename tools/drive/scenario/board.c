/* SPDX-License-Identifier: MIT */
#include "board.h"

#include <stdio.h>
#include <string.h>

#define BOARD(board_name, clk, type, dog, ...)                                                     \
    {.name = #board_name, .clk_hz = clk, .s51_type = type, .watchdog = dog, .pins = {__VA_ARGS__}},
static const struct board boards[] = {
#include "boards.h"
};
#undef BOARD

enum { BOARD_COUNT = sizeof boards / sizeof boards[0] };

const struct board *board_find(const char *name)
{
    for (int i = 0; i < BOARD_COUNT; i++) {
        if (strcmp(boards[i].name, name) == 0) {
            return &boards[i];
        }
    }
    return NULL;
}

const char *board_names(void)
{
    static char names[256];

    names[0] = '\0';
    for (int i = 0; i < BOARD_COUNT; i++) {
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i > 0 ? " " : "",
                 boards[i].name);
    }
    return names;
}

const char *board_pin_name(enum board_pin pin)
{
    static const char *const names[BOARD_PINS] = {"pwm",   "stop", "trigger", "lamp", "buzzer",
                                                  "servo", "cut",  "lane",    "echo", "override"};

    return names[pin];
}
