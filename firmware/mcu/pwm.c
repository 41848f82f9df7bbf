/* SPDX-License-Identifier: MIT */
/* Timer 1: the brake's PWM. Its periods are the ticks of the clock. Two interrupts a period. */
#include "sfr.h"
#include "fixed.h"
#include "phase.h"

#define PERIOD_MC (CYCLES_PER_S / (1000U / HAL_TICK_MS))

/* One percent of the period: whole cycles, and the remainder in 1/256 cycle. */
#define PERCENT_MC      (PERIOD_MC / 100U)
#define PERCENT_MC_REST ((PERIOD_MC % 100U * 256U + 50U) / 100U)

#if PERIOD_MC / 100U > 255U
#error CLK_HZ too high: one percent of the PWM period must fit a byte of cycles
#endif

/* A period has two phases. The first is high unless the brake is released; the second is low unless
 * the brake is full. At a steady level both phases are equally long. This is what the timer is
 * advanced by for both together: */
#define BOTH_RELOADS (PHASE_RELOAD(PERIOD_MC) + PHASE_STOPPED_MC)

/* Only the interrupt writes these variables, except those whose name starts with new_.
 * hal_brake_set writes them while new_is_set is 0. When new_is_set is 1 they are taken: by the
 * interrupt that starts a second phase, or by hal_brake_set itself if the second phase has enough
 * time left. So the interrupt never has to be disabled; that would move an edge. */
static volatile uint8_t ticks;
static volatile __bit level;     /* the pin's level from the next interrupt on */
static volatile uint16_t reload; /* for the phase that the next interrupt starts */
static volatile __bit is_second; /* the next interrupt starts a second phase */
static volatile uint16_t first_reload;
static volatile __bit first_level, second_level;
static volatile uint16_t new_first_reload;
static volatile __bit new_first_level, new_second_level, new_is_set;

#ifdef WATCHDOG_none
volatile uint8_t pwm_guard_ticks;
#endif

static volatile __bit pin_was; /* at the end of a phase */
volatile __bit pwm_is_wrong;

/* Not static: of a static inline function SDCC keeps a copy that nobody calls. */

/* The next first phase will be the new one. */
inline void take_new(void)
{
    new_is_set = 0;
    first_reload = new_first_reload;
    first_level = new_first_level;
    second_level = new_second_level;
}

inline void prepare_first(void)
{
    level = first_level;
    reload = first_reload;
}

void pwm_interrupt(void) __interrupt(3) __using(1)
{
    pin_was = pin_pwm;
    pin_pwm = level; /* first, so that both edges are late by the same time */
    PHASE_ADVANCE("1", "_reload", "(_reload + 1)");
    if (is_second) {
        is_second = 0;
        pwm_is_wrong = pin_was ^ first_level;
        if (new_is_set) {
            take_new();
        }
        prepare_first();
    } else {
        is_second = 1;
        ticks++;
#ifdef WATCHDOG_none
        if (--pwm_guard_ticks == 0) {
            __asm__("pop psw\n pop acc\n ljmp 0"); /* as from a reset */
        }
#endif
        level = second_level;
        reload = BOTH_RELOADS - first_reload;
    }
}

void pwm_init(void)
{
    uint16_t half = PHASE_RELOAD(PERIOD_MC / 2U);

    first_reload = half;
    first_level = second_level = 1;
    prepare_first();
    is_second = 1;
    TMOD = (TMOD & 0x0F) | T1_M0; /* 16 bits */
    TL1 = (uint8_t)half;
    TH1 = (uint8_t)(half >> 8);
    TR1 = 1;
    ET1 = 1;
    EA = 1;
}

void hal_brake_set(uint8_t brake_pct)
{
    uint8_t high;

    new_is_set = 0;
    new_first_level = 1;
    new_second_level = 0;
    if (brake_pct != 0 && brake_pct < 100) {
        new_first_reload =
            PHASE_RELOAD(mul_u8(brake_pct, PERCENT_MC) + (mul_u8(brake_pct, PERCENT_MC_REST) >> 8));
    } else {
        new_first_reload = PHASE_RELOAD(PERIOD_MC / 2U);
        if (brake_pct == 0) {
            new_first_level = 0;
        } else {
            new_second_level = 1;
        }
    }
    new_is_set = 1;
    /* If the next edge is at least 128 cycles away there is time for what follows: 40 cycles, and
     * 75 of other interrupts in between. So the high byte is rounded up; from 128 on there is time.
     * If the timer overflows between the two reads, its interrupt comes before is_second is read,
     * and sets it. */
    high = TH1;
    high += TL1 >> 7;
    if ((high & 0x80U) != 0 && !is_second) {
        take_new();
        prepare_first();
    }
}

uint8_t hal_ticks(void)
{
    return ticks;
}
