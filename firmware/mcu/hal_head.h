/* SPDX-License-Identifier: MIT */
/* The part of the seam that only the frame-fed controllers use, beside hal.h. For them head.c takes
 * the place of echo.c and uart.c, and servo.c adds the servo. Only a controller's main.c includes
 * this, through frames.h: there SDCC must see the prototypes of the interrupts. */
#ifndef FUZZY51_HAL_HEAD_H
#define FUZZY51_HAL_HEAD_H

#include "hal.h"

/* Received bytes that wait: at most HAL_WAITING_MAX, which is 16 ms at 9600 Bd. A byte that comes
 * when so many wait is dropped; then the frame's check sum fails. */
#define HAL_WAITING_MAX 16U
uint8_t hal_waiting(void); /* how many bytes wait */
uint8_t hal_take(void);    /* the oldest of them; call it only if one waits */

/* Sends servo pulses of 500..2500 us, one each 20 ms, from the first call on. They are as exact as
 * the PWM. */
void hal_servo_set(uint16_t pulse_us);

/* Cuts the driver's throttle. */
void hal_cut_set(bool on);

/* Asks for the next lane. */
void hal_lane_set(bool on);

void head_interrupt(void) __interrupt(4) __using(2);
#ifdef SERVO
void servo_interrupt(void) __interrupt(1) __using(1);
#endif

#endif
