/* What a controller that lives on frames gives to frames.c, which has main and all that such
 * controllers have in common: self-test, trigger, link, telemetry, lamp, watchdog. */
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

/* What is wrong, as telemetry says it. From FRAMES_FAULT_TABLE on they last until the next start.
 */
enum frames_fault {
    FRAMES_FAULT_NONE,
    FRAMES_FAULT_LINK,     /* silence for 200 ms (link.h), or three good frames in a row not yet */
    FRAMES_FAULT_WATCHDOG, /* this start was a watchdog reset, and the link is not yet up again */
    FRAMES_FAULT_TABLE,    /* self-test: check sum of the table */
    FRAMES_FAULT_RAM,      /* self-test: pattern in RAM */
    FRAMES_FAULT_STACK,    /* self-test: the stack reached the end of RAM */
};

struct frames_app {
    uint8_t kind; /* enum frame_kind */
    uint8_t payload_bytes;
    uint8_t period_ticks; /* of HAL_TICK_MS: from one trigger to the next */
    const char __code *name;
    const char __code *header; /* of the telemetry: "seq,ms,....,state,fault\r\n" */
    const char __code *line;   /* its format: "%u,%o%m,....,%s,%u\r\n" */
};
extern const struct frames_app __code app;

/* The self-test is over: the state to start in. */
void app_init(void);

/* Takes the payload of a good frame; false: a value is out of range, and nothing was taken. */
bool app_read(void);

/* One control step on what was read. The link is up. */
void app_decide(void);

/* The link is lost, or the self-test failed: the state for that. Called every 10 ms. */
void app_lose(void);

/* From the decision to the pins. Called after each of the three above. */
void app_apply(void);

/* Fills the telemetry's values from this one on, but for the last one, which is the fault. Returns
 * that one's index. */
#define FRAMES_VALUES_FROM 3
uint8_t app_report(void);

/* What the lamp shows, but in a fault: LAMP_OFF, LAMP_FLICKER. */
uint8_t app_lamp(void);

#endif
