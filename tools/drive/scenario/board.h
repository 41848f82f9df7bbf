/* SPDX-License-Identifier: MIT */
/* What drive knows of a board: its clock, its chip in the simulator, and its pins. The facts come
 * out of firmware/boards through build/boards.h, so the firmware is built from the same ones. */
#ifndef FUZZY51_BOARD_H
#define FUZZY51_BOARD_H

#include <stdint.h>

/* The firmware's outputs come first: they are watched. The inputs after them are driven. */
enum board_pin {
    PIN_PWM,     /* high = brake */
    PIN_STOP,    /* high = full brake at once */
    PIN_TRIGGER, /* a high pulse starts a measurement */
    PIN_LAMP,    /* low = on */
    PIN_BUZZER,  /* low = on */
    PIN_SERVO,   /* pulses of 1..2 ms */
    PIN_CUT,     /* high = the driver's throttle is cut */
    PIN_LANE,    /* low = asks for the next lane */
    BOARD_OUTPUTS,
    PIN_ECHO = BOARD_OUTPUTS, /* high as long as the sound is on its way */
    PIN_OVERRIDE,             /* low = held by the driver */
    BOARD_PINS
};

struct board {
    const char *name;
    long clk_hz; /* oscillator; twelve clocks are one machine cycle */
    const char *s51_type;
    const char *watchdog;     /* "none", "at89s52" or "stc89" */
    uint8_t pins[BOARD_PINS]; /* bit addresses: 0x90 is P1.0, 0xB2 is P3.2 */
};

/* The board of that name, or NULL. */
const struct board *board_find(const char *name);

/* The known boards' names, separated by blanks; a static buffer. */
const char *board_names(void);

/* "pwm", "stop", ...: what a pin is called in traces. */
const char *board_pin_name(enum board_pin pin);

#endif
