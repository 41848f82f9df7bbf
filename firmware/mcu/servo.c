/* SPDX-License-Identifier: MIT */
/* Timer 0: the servo's pulses, two interrupts each 20 ms. They have the same priority as the PWM's
 * interrupt, so the two must not come at the same time. The edges of the PWM are at whole percents
 * of its period. A servo pulse starts 1.5 % of the PWM's period after one of its edges: so its
 * start never meets a PWM edge, and neither does its end if the pulse is whole tenths of a
 * millisecond long. */
#include "sfr.h"
#include "fixed.h"
#include "hal_head.h"
#include "phase.h"

#define PERIOD_MC (CYCLES_PER_S / 50U)
#define OFFSET_MC (CYCLES_PER_S / 1000U * 15U / 100U)

/* Cycles in one microsecond: whole ones, and the remainder in 1/65536. */
#define WHOLE_MC (CYCLES_PER_S / 1000000U)
#define REST_Q16 ((uint16_t)(CYCLES_PER_S % 1000000U * 65536ULL / 1000000U))

static volatile uint8_t reload_low, reload_high; /* for the phase that the next interrupt starts */
static uint8_t pulse_low, pulse_high, gap_low, gap_high;
static volatile uint8_t new_pulse_low, new_pulse_high, new_gap_low, new_gap_high;
static volatile __bit new_is_set, is_pulse;

void servo_interrupt(void) __interrupt(1) __using(1)
{
    pin_servo = is_pulse;
    PHASE_ADVANCE("0", "_reload_low", "_reload_high");
    if (is_pulse) {
        is_pulse = 0;
        reload_low = gap_low;
        reload_high = gap_high;
    } else {
        is_pulse = 1;
        if (new_is_set) {
            new_is_set = 0;
            pulse_low = new_pulse_low;
            pulse_high = new_pulse_high;
            gap_low = new_gap_low;
            gap_high = new_gap_high;
        }
        reload_low = pulse_low;
        reload_high = pulse_high;
    }
}

static void start(void)
{
    uint8_t high, low;
    uint16_t reload;

    pin_servo = 0;
    is_pulse = 1;
    new_is_set = 0;
    reload_low = pulse_low = new_pulse_low;
    reload_high = pulse_high = new_pulse_high;
    gap_low = new_gap_low;
    gap_high = new_gap_high;
    do {
        high = TH1;
        low = TL1;
    } while (high != TH1); /* rounds: 1, because TH1 changes each 256 cycles only */
    /* The PWM's next edge is when its timer overflows; this timer overflows OFFSET_MC later. */
    TMOD = (TMOD & 0xF0) | T0_M0; /* 16 bits */
    reload = (uint16_t)(((uint16_t)high << 8) | low) - OFFSET_MC;
    TL0 = (uint8_t)reload;
    TH0 = (uint8_t)(reload >> 8);
    PT0 = 1;
    ET0 = 1;
    TR0 = 1;
}

void hal_servo_set(uint16_t pulse_us)
{
    uint16_t pulse_mc = pulse_us * WHOLE_MC + mul_hi_u16(pulse_us, REST_Q16);
    uint16_t reload = PHASE_RELOAD(pulse_mc);

    new_is_set = 0;
    new_pulse_low = (uint8_t)reload;
    new_pulse_high = (uint8_t)(reload >> 8);
    reload = PHASE_RELOAD(PERIOD_MC - pulse_mc);
    new_gap_low = (uint8_t)reload;
    new_gap_high = (uint8_t)(reload >> 8);
    new_is_set = 1;
    if (!TR0) {
        start();
    }
}
