/* SPDX-License-Identifier: MIT */
/* The seam between a controller and the machine that it runs on. For the 8051 it is implemented by
 * the files of this folder. All calls return at once. Costs are in machine cycles (mc)
 * with call and return, in SDCC's small model. */
#ifndef FUZZY51_HAL_H
#define FUZZY51_HAL_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

/* Starts the timers, the UART and the watchdog. Before it runs the pins are already safe (full
 * brake, STOP), and they stay so. */
void hal_init(void);

/* Time: ticks of HAL_TICK_MS since hal_init; wraps from 255 to 0. A tick is one PWM period. */
#define HAL_TICK_MS 10U
uint8_t hal_ticks(void);

/* The range sensor: echo.c or tfluna.c. hal_trigger starts a measurement; a sensor that measures by
 * itself forgets what it said before. Then ask hal_range until it says DONE: a reading is there. If
 * that takes RANGE_WAIT_CS (range.h), its answer is the fault: the echo never rose, or never fell.
 * range_mm makes a distance of the reading, range_kind says its kind. Its time is the one from
 * trigger to trigger, or, of a sensor that measures by itself, counted by hal_range_is_late. An
 * echo that is 12 ms longer than the ticks since the trigger, or 20 ms shorter, counts as never
 * fallen: one of the two timers is wrong. */
enum hal_range { HAL_RANGE_NOT_RISEN, HAL_RANGE_NOT_FALLEN, HAL_RANGE_DONE };
void hal_trigger(void);       /* 40 mc; the pulse is at least 10 us long */
uint8_t hal_range(void);      /* enum hal_range */
uint16_t hal_range_raw(void); /* for range_mm: the echo's machine cycles, or mm; valid after DONE */
bool hal_range_is_busy(void); /* the sensor's line is not at rest; the self-test looks at it */

/* Only of a sensor that measures by itself, each 10 ms: whether a reading that was due has not
 * come. True once, 15 ms after the last reading, and once more for each 10 ms from then on. Ask it
 * in each round. 20 mc. */
bool hal_range_is_late(void);

/* Actuators. The brake takes 0..100 %; more counts as 100. The new duty holds from the first PWM
 * period on that begins at least 0.3 ms after the call. */
void hal_brake_set(uint8_t brake_pct); /* up to 80 mc */
void hal_stop_set(bool on);            /* the STOP pin */
/* How many times in a row the PWM pin was not as hal_brake_set wants it, at the end of what should
 * be high in its period, or low; or the STOP pin not as `stop` says, which hal_stop_set has set it
 * to. Ask it every tick; it counts up to HAL_WRONG_TICKS. That is three because a bit that flips is
 * right again sooner, and because no flip of one bit makes it of 0. 22 mc. */
#define HAL_WRONG_TICKS 3U
uint8_t hal_outputs_wrong_ticks(bool stop);
void hal_lamp_set(bool on);
void hal_buzzer_set(bool on);

/* Whether the driver holds the override button. */
bool hal_override_held(void);

/* UART, 9600 8N1. */
bool hal_uart_ready(void); /* whether hal_uart_put may be called: the last character is out */
void hal_uart_put(char c); /* sends a character */
char hal_uart_get(void);   /* the character that came in, or 0 if none came */

/* At the begin of a round of main, where nothing is on the stack: tests the processor's registers
 * and flags, and sets the flags with their register bank again. hal_restart if one is broken, or if
 * the stack pointer is not where it was then: something has run that main did not call. On a board
 * without a watchdog hal_restart, too, after 100 rounds without hal_watchdog_feed. 87 mc. */
void hal_begin_round(void);

/* Starts the program again, as the watchdog would, but at once. Does not return. */
void hal_restart(void);

/* Sets again what hal_init set in the brake's registers of timers, interrupts, UART and inputs: a
 * bit that has flipped there is right again. 35 mc. */
void hal_registers_restore(void);

/* Feeds the watchdog. Without it the chip is reset after 16 ms (at89s52) or 65 ms (stc89); a
 * generic8052 has no watchdog: there the PWM's interrupt starts the program again after 80 ms. */
void hal_watchdog_feed(void);

/* What led to this start. WATCHDOG is hal_restart, too, and a program that ran wild to address 0.
 */
enum hal_reset { HAL_RESET_POWER, HAL_RESET_WATCHDOG, HAL_RESET_PIN };
uint8_t hal_reset_cause(void); /* enum hal_reset */

/* Self-test. */
bool hal_ram_is_good(void);     /* whether each byte of RAM kept its test patterns at start */
uint8_t hal_stack_unused(void); /* bytes of stack that were never used; 0: overflow; 2,000 mc */
/* Sums up 8 more bytes of the code. GOOD or BAD at the end of a pass over all code, RUNNING before.
 * Each round of the main loop. 142 mc. */
enum hal_code { HAL_CODE_RUNNING, HAL_CODE_GOOD, HAL_CODE_BAD };
uint8_t hal_code_test(void); /* enum hal_code */
/* Tests one more byte of RAM, but for R0 and R1, and an address line with it. False if one is
 * broken. Each round of the main loop. All bytes have their turn in 256 rounds, all lines with all
 * bytes in 2,048. 76 mc. */
bool hal_ram_test(void);
bool hal_stack_is_good(void); /* whether the last byte of the stack was never used */

/* SDCC writes an interrupt's vector only if the file with main sees the interrupt's prototype. */
void pwm_interrupt(void) __interrupt(3) __using(1);

#ifdef SENSOR_tfluna
void tfluna_interrupt(void) __interrupt(4);
#endif

/* The last vector, so that each one before it is there, too: an interrupt that a bit's flip has let
 * through returns at once. */
void unused_interrupt(void) __interrupt(5) __naked;

#endif
