/* SPDX-License-Identifier: MIT */
/* The machine's contracts, for WP: what the pins show, and that everything else is anything. */
#ifndef FUZZY51_PROVE_PINS_H
#define FUZZY51_PROVE_PINS_H

#include "hal.h"
#include "../../firmware/lib/telemetry.h"

/* What is at the pins. A reset sets full brake and STOP; then the controller does. */
uint8_t pin_brake_pct = 100;
bool pin_stop = true;

/*@ assigns \nothing; */
void hal_init(void);
/*@ assigns \nothing; */
uint8_t hal_ticks(void);
/*@ assigns \nothing; */
void hal_trigger(void);
/*@ assigns \nothing;
    ensures \result <= HAL_RANGE_DONE; */
uint8_t hal_range(void);
/*@ assigns \nothing; */
uint16_t hal_range_raw(void);
/*@ assigns \nothing; */
bool hal_range_is_busy(void);
/*@ assigns \nothing; */
bool hal_range_is_late(void);
/*@ requires brake_pct <= 100;
    assigns pin_brake_pct;
    ensures pin_brake_pct == brake_pct; */
void hal_brake_set(uint8_t brake_pct);
/*@ assigns pin_stop;
    ensures pin_stop == on; */
void hal_stop_set(bool on);
/*@ assigns \nothing; */
uint8_t hal_outputs_wrong_ticks(bool stop);
/*@ assigns \nothing; */
void hal_lamp_set(bool on);
/*@ assigns \nothing; */
void hal_buzzer_set(bool on);
/*@ assigns \nothing; */
bool hal_override_held(void);
/*@ assigns \nothing; */
bool hal_uart_ready(void);
/*@ assigns \nothing; */
void hal_uart_put(char c);
/*@ assigns \nothing; */
char hal_uart_get(void);
/*@ assigns \nothing; */
void hal_begin_round(void);
/*@ assigns \nothing;
    ensures \false; */
void hal_restart(void);
/*@ assigns \nothing; */
void hal_registers_restore(void);
/*@ assigns \nothing; */
void hal_watchdog_feed(void);
/*@ assigns \nothing;
    ensures \result <= HAL_RESET_PIN; */
uint8_t hal_reset_cause(void);
/*@ assigns \nothing; */
bool hal_ram_is_good(void);
/*@ assigns \nothing; */
uint8_t hal_stack_unused(void);
/*@ assigns \nothing;
    ensures \result <= HAL_CODE_BAD; */
uint8_t hal_code_test(void);
/*@ assigns \nothing; */
bool hal_ram_test(void);
/*@ assigns \nothing; */
bool hal_stack_is_good(void);

#endif
