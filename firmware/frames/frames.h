/* SPDX-License-Identifier: MIT */
/* The frame-fed controllers. frames.c has what they share: the jobs of the main loop, that is
 * self-test, trigger, link, telemetry, lamp and watchdog. A controller's main.c has `main` and the
 * app_ functions below, which frames.c calls. */
#ifndef FUZZY51_FRAMES_H
#define FUZZY51_FRAMES_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"
#include "frame.h"
#include "hal.h"
#include "hal_head.h"
#include "lamp.h"
#include "telemetry.h"

/* For a controller's main. frames_init starts the machine; call it first and once. Then call
 * frames_round for ever: each call does the jobs that are due. */
void frames_init(void);
void frames_round(void);

/* The faults, as telemetry reports them. From FRAMES_FAULT_TABLE on they last until the next
 * start. */
enum frames_fault {
    FRAMES_FAULT_NONE,
    FRAMES_FAULT_LINK,     /* the link is lost, and not up again yet (link.h) */
    FRAMES_FAULT_WATCHDOG, /* this start was a watchdog reset, and the link is not up yet */
    FRAMES_FAULT_TABLE,    /* self-test: check sum of the table */
    FRAMES_FAULT_RAM,      /* self-test: patterns in RAM */
    FRAMES_FAULT_STACK,    /* self-test: the stack reached the end of RAM */
};

struct frames_app {
    uint8_t kind;              /* enum frame_kind */
    uint8_t payload_bytes;     /* without its items */
    uint8_t item_bytes;        /* of each item; 0: the payload has none */
    uint8_t period_ticks;      /* from one trigger to the next, in HAL_TICK_MS */
    const char __code *header; /* the first line of telemetry: "seq,ms,...,state,fault\r\n" */
    const char __code *line;   /* the format of the other lines: "%u,%o%m,...,%s,%u\r\n" */
};
extern const struct frames_app __code app;

/* Sets the state to start in. Called once, after the self-test. */
void app_init(void);

/* Reads an item of a frame that is still being received, and may turn out to be bad. Called only if
 * item_bytes is not 0. */
void app_item(void);

/* Reads the payload of a good frame. Returns false if a value is out of range; then nothing was
 * taken from the frame. */
bool app_read(void);

/* Makes one control step with what was read. Called only while the link is up. */
void app_decide(void);

/* Sets the state for a lost link or a failed self-test. Called every 10 ms while that lasts. */
void app_lose(void);

/* Sets the pins as decided. Called after each of app_init, app_decide and app_lose. */
void app_apply(void);

/* Sets telemetry_values from index FRAMES_VALUES_FROM on, and returns the index after them; there
 * frames.c puts the fault. */
#define FRAMES_VALUES_FROM 3
uint8_t app_report(void);

/* Returns the lamp's pattern while there is no fault (lamp.h). */
uint8_t app_lamp(void);

#endif
