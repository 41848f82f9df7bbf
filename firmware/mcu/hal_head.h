/* The seam of controllers whose readings come as frames from a sensor head, beside hal.h: head.c
 * stands in for echo.c and uart.c, servo.c adds the servo. Only the file with main includes this:
 * it is where SDCC must see the interrupts. */
#ifndef FUZZY51_HAL_HEAD_H
#define FUZZY51_HAL_HEAD_H

#include "hal.h"

/* Bytes that have come in and wait, HAL_WAITING_MAX at most: 16 ms at 9600 Bd. A byte beyond that
 * is dropped, and the frame's check sum fails. */
#define HAL_WAITING_MAX 16U
uint8_t hal_waiting(void);
uint8_t hal_take(void); /* the oldest; only if one waits */

/* Pulses for a servo, every 20 ms, from the first call on; 500..2500 us, each as exact as the PWM.
 */
void hal_servo_set(uint16_t pulse_us);

/* The driver's throttle is cut. */
void hal_cut_set(bool on);

/* The next lane is asked for. */
void hal_lane_set(bool on);

void head_interrupt(void) __interrupt(4) __using(2);
#ifdef SERVO
void servo_interrupt(void) __interrupt(1) __using(1);
#endif

#endif
