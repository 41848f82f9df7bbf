/* SPDX-License-Identifier: MIT */
/* A machine that can deliver anything, in any order, for ever: hal.h and hal_head.h for Eva. What a
 * controller hands to it is checked. */
#ifndef FUZZY51_PROVE_MACHINE_H
#define FUZZY51_PROVE_MACHINE_H

#include "__fc_builtin.h"
#include "hal.h"
#ifdef SENSOR_tfluna
#include "range.h"
#endif

/* What is at the pins, as in pins.h. */
uint8_t pin_brake_pct = 100;
bool pin_stop = true;

static uint8_t any_byte(void)
{
    return (uint8_t)Frama_C_unsigned_char_interval(0, 255);
}

static uint16_t any_word(void)
{
    return (uint16_t)Frama_C_unsigned_int_interval(0, 65535);
}

static bool any_bool(void)
{
    return Frama_C_unsigned_char_interval(0, 1) != 0;
}

void hal_init(void)
{
}
uint8_t hal_ticks(void)
{
    return any_byte();
}
void hal_trigger(void)
{
}
#ifdef SENSOR_tfluna
/* Whatever bytes have come, and however many. */
uint8_t hal_range(void)
{
    uint8_t count = any_byte();

    for (uint8_t i = 0; i < RANGE_RING_BYTES; i++) {
        range_ring[i] = any_byte();
    }
    range_came = (uint8_t)(range_taken + count);
    return range_take() ? HAL_RANGE_DONE : HAL_RANGE_NOT_RISEN;
}
uint16_t hal_range_raw(void)
{
    return range_raw();
}
bool hal_range_is_late(void)
{
    return any_bool();
}
#else
uint8_t hal_range(void)
{
    return (uint8_t)Frama_C_unsigned_char_interval(HAL_RANGE_NOT_RISEN, HAL_RANGE_DONE);
}
uint16_t hal_range_raw(void)
{
    return any_word();
}
#endif
bool hal_range_is_busy(void)
{
    return any_bool();
}
void hal_brake_set(uint8_t brake_pct)
{
    /*@ assert duty: brake_pct <= 100; */
    pin_brake_pct = brake_pct;
}
void hal_stop_set(bool on)
{
    pin_stop = on;
}
uint8_t hal_outputs_wrong_ticks(bool stop)
{
    return any_byte();
}
void hal_lamp_set(bool on)
{
}
void hal_buzzer_set(bool on)
{
}
bool hal_override_held(void)
{
    return any_bool();
}
bool hal_uart_ready(void)
{
    return any_bool();
}
void hal_uart_put(char c)
{
}
char hal_uart_get(void)
{
    return (char)any_byte();
}
void hal_watchdog_feed(void)
{
}
void hal_begin_round(void)
{
}
void hal_restart(void)
{
    for (;;) {
    }
}
void hal_registers_restore(void)
{
}
uint8_t hal_reset_cause(void)
{
    return (uint8_t)Frama_C_unsigned_char_interval(HAL_RESET_POWER, HAL_RESET_PIN);
}
bool hal_ram_is_good(void)
{
    return any_bool();
}
uint8_t hal_stack_unused(void)
{
    return any_byte();
}
uint8_t hal_code_test(void)
{
    return (uint8_t)Frama_C_unsigned_char_interval(HAL_CODE_RUNNING, HAL_CODE_BAD);
}
bool hal_ram_test(void)
{
    return any_bool();
}
bool hal_stack_is_good(void)
{
    return any_bool();
}

#ifdef FUZZY51_HAL_HEAD_H
uint8_t hal_waiting(void)
{
    return (uint8_t)Frama_C_unsigned_char_interval(0, HAL_WAITING_MAX);
}
uint8_t hal_take(void)
{
    return any_byte();
}
void hal_servo_set(uint16_t pulse_us)
{
    /*@ assert pulse: 500 <= pulse_us <= 2500; */
}
void hal_cut_set(bool on)
{
}
void hal_lane_set(bool on)
{
}
#endif

#endif
