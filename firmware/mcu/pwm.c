/* Timer 1: the brake's PWM and, counted in its periods, the clock. Two interrupts a period. */
#include "sfr.h"
#include "fixed.h"
#include "phase.h"

#define PERIOD_MC (CYCLES_PER_S / (1000U / HAL_TICK_MS))

/* One percent of the period in whole cycles, and the rest of it in 1/256 cycle. */
#define PERCENT_MC      (PERIOD_MC / 100U)
#define PERCENT_MC_REST ((PERIOD_MC % 100U * 256U + 50U) / 100U)

#if PERIOD_MC / 100U > 255U
#error CLK_HZ too high: one percent of the PWM period must fit a byte of cycles
#endif

/* Each period has a first phase, high unless the brake is released, and a second one, low unless it
 * is full; steady levels have two equal phases. All below belongs to the interrupt, but what starts
 * with new_: that is written by hal_brake_set while new_is_set is 0, and taken by the interrupt when
 * it is 1. So nothing needs the interrupt disabled, which would move an edge. */
static volatile uint8_t ticks;
static volatile __bit level;         /* of the pin from the next interrupt on */
static volatile uint8_t reload_low;  /* for the phase that the next interrupt starts */
static volatile uint8_t reload_high;
static volatile __bit is_second;     /* the next interrupt starts a second phase */
static uint8_t first_low, first_high, second_low, second_high;
static __bit first_level, second_level;
static volatile uint8_t new_first_low, new_first_high, new_second_low, new_second_high;
static volatile __bit new_first_level, new_second_level, new_is_set;

void pwm_interrupt(void) __interrupt(3) __using(1)
{
    pin_pwm = level; /* first, so that both edges come equally late */
    PHASE_ADVANCE("1", "_reload_low", "_reload_high");
    if (is_second) {
        is_second = 0;
        if (new_is_set) {
            new_is_set = 0;
            first_low = new_first_low;
            first_high = new_first_high;
            first_level = new_first_level;
            second_low = new_second_low;
            second_high = new_second_high;
            second_level = new_second_level;
        }
        level = first_level;
        reload_low = first_low;
        reload_high = first_high;
    } else {
        is_second = 1;
        ticks++;
        level = second_level;
        reload_low = second_low;
        reload_high = second_high;
    }
}

void pwm_init(void)
{
    uint16_t half = PHASE_RELOAD(PERIOD_MC / 2U);

    hal_brake_set(100);
    level = 1;
    is_second = 1;
    first_level = second_level = 1;
    reload_low = first_low = second_low = (uint8_t)half;
    reload_high = first_high = second_high = (uint8_t)(half >> 8);
    TMOD = (TMOD & 0x0F) | T1_M0; /* 16 bits */
    TL1 = (uint8_t)half;
    TH1 = (uint8_t)(half >> 8);
    TR1 = 1;
    ET1 = 1;
    EA = 1;
}

void hal_brake_set(uint8_t brake_pct)
{
    uint16_t first_mc = PERIOD_MC / 2U, reload;

    new_is_set = 0;
    new_first_level = brake_pct != 0;
    new_second_level = brake_pct >= 100;
    if (brake_pct != 0 && brake_pct < 100) {
        first_mc = mul_u8(brake_pct, PERCENT_MC) + (mul_u8(brake_pct, PERCENT_MC_REST) >> 8);
    }
    reload = PHASE_RELOAD(first_mc);
    new_first_low = (uint8_t)reload;
    new_first_high = (uint8_t)(reload >> 8);
    reload = PHASE_RELOAD(PERIOD_MC) + first_mc;
    new_second_low = (uint8_t)reload;
    new_second_high = (uint8_t)(reload >> 8);
    new_is_set = 1;
}

uint8_t hal_ticks(void)
{
    return ticks;
}
