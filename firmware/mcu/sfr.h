/* SPDX-License-Identifier: MIT */
/* The 8052's registers and the board's pins. Only the C files of firmware/mcu include this. */
#ifndef FUZZY51_SFR_H
#define FUZZY51_SFR_H

#include <8052.h>
#include "hal.h"

#if !defined(CLK_HZ) || !defined(PIN_PWM) || !defined(PIN_STOP) || !defined(PIN_TRIGGER) ||        \
    !defined(PIN_LAMP) || !defined(PIN_BUZZER) || !defined(PIN_SERVO) || !defined(PIN_CUT) ||      \
    !defined(PIN_LANE) || !defined(PIN_ECHO) || !defined(PIN_OVERRIDE)
#error a board must say CLK_HZ and PIN_PWM, _STOP, _TRIGGER, _LAMP, _BUZZER, _SERVO, _CUT, _LANE, _ECHO, _OVERRIDE
#endif
#if PIN_ECHO != 0xB2
#error PIN_ECHO must be 0xB2 (P3.2): INT0 gates timer 0, which measures the echo
#endif
#if CLK_HZ < 6000000 || CLK_HZ > 24000000
#error CLK_HZ out of range 6..24 MHz: PWM and echo were checked for these clocks only
#endif

#define CYCLES_PER_S (CLK_HZ / 12U)

__sbit __at(PIN_PWM) pin_pwm;           /* high: brake */
__sbit __at(PIN_STOP) pin_stop;         /* high: STOP */
__sbit __at(PIN_TRIGGER) pin_trigger;   /* 10 us high: measure */
__sbit __at(PIN_LAMP) pin_lamp;         /* low: on */
__sbit __at(PIN_BUZZER) pin_buzzer;     /* low: on */
__sbit __at(PIN_SERVO) pin_servo;       /* pulses of 1..2 ms, if the controller has a servo */
__sbit __at(PIN_CUT) pin_cut;           /* high: the driver's throttle is cut */
__sbit __at(PIN_LANE) pin_lane;         /* low: the next lane is asked for */
__sbit __at(PIN_ECHO) pin_echo;         /* high while the sound travels */
__sbit __at(PIN_OVERRIDE) pin_override; /* low: held */

/* Timer 2 makes the baud rate, 9600. */
#define BAUD        9600U
#define BAUD_RELOAD (65536UL - (CLK_HZ + 16UL * BAUD) / (32UL * BAUD))

#ifdef WATCHDOG_none
/* The PWM's interrupt starts the program again after so many ticks. */
#define PWM_GUARD_TICKS 8U
extern volatile uint8_t pwm_guard_ticks;
/* And after so many rounds without a tick hal_begin_round does: no interrupt comes any more. */
#define ROUND_GUARD_ROUNDS 100U
extern volatile uint8_t round_guard;
#endif

/* The PWM pin was not at its level at the end of the last first phase (pwm.c). */
extern volatile __bit pwm_is_wrong;

/* The parts of hal_init; each file of a peripheral has one. */
void pwm_init(void);
void sensor_init(void);
void uart_init(void);

#endif
