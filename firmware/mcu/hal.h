/* The seam between a controller and the machine that it runs on: start.c, pwm.c, echo.c and uart.c
 * are the 8051's side of it. All calls return at once; costs are machine cycles with call and
 * return, SDCC's small model. */
#ifndef FUZZY51_HAL_H
#define FUZZY51_HAL_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

/* Pins are safe (full brake, stop) before this runs and stay so. Timers, UART and watchdog start.
 */
void hal_init(void);

/* Time: ticks of HAL_TICK_MS since hal_init, wrapping; one is one PWM period. */
#define HAL_TICK_MS 10U
uint8_t hal_ticks(void);

/* Distance sensor: trigger, then ask until the answer is not HAL_ECHO_WAITING. Whoever waits no
 * longer takes NOT_RISEN or NOT_FALLEN as the fault. Ticks are machine cycles, valid once DONE. */
enum hal_echo { HAL_ECHO_NOT_RISEN, HAL_ECHO_NOT_FALLEN, HAL_ECHO_DONE };
void hal_trigger(void); /* 40 mc, of which the pulse takes 12 or more */
uint8_t hal_echo(void); /* enum hal_echo */
uint16_t hal_echo_cycles(void);
bool hal_echo_is_high(void); /* the sensor's line, for a test of its idle level */

/* Actuators. The duty, 0..100 % (more is 100), holds from the first PWM period on that begins 0.3
 * ms or more after the call. */
void hal_brake_set(uint8_t brake_pct); /* up to 80 mc */
void hal_stop_set(bool on);
void hal_lamp_set(bool on);
void hal_buzzer_set(bool on);

/* The driver's override button is held. */
bool hal_override_held(void);

/* UART, 9600 8N1. */
bool hal_uart_ready(void); /* the next hal_uart_put will not overwrite anything */
void hal_uart_put(char c);
char hal_uart_get(void); /* 0: nothing came */

/* Watchdog: reset unless fed again within 16 ms (at89s52), 65 ms (stc89), ever (none). */
void hal_watchdog_feed(void);

/* What led to this start. */
enum hal_reset { HAL_RESET_POWER, HAL_RESET_WATCHDOG, HAL_RESET_PIN };
uint8_t hal_reset_cause(void); /* enum hal_reset */

/* Self-test: RAM held its patterns at start; bytes of stack never used so far (0: overflown). */
bool hal_ram_is_good(void);
uint8_t hal_stack_unused(void); /* up to 2,000 mc */
bool hal_stack_is_good(void);

/* For the linker: SDCC sets an interrupt's vector only where main's file sees the prototype. */
void pwm_interrupt(void) __interrupt(3) __using(1);

#endif
