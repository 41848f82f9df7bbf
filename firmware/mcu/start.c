/* SPDX-License-Identifier: MIT */
/* From reset to main: safe pins, reset cause, tests of RAM and stack. And the simple pins. */
#include "sfr.h"

/* The cause is kept in two general-purpose flags of PCON while RAM is cleared. A reset clears them.
 */
#define CAUSE_SHIFT 2U
#define CAUSE_MASK  (3U << CAUSE_SHIFT) /* GF1, GF0 */
#define POWER_OFF   0x10U               /* POF: power-on sets it, we clear it */

#define STACK_PAINT 0xAA
#define RAM_TOP     0xFF

#if defined(WATCHDOG_none)
/* A plain 8052 has no POF; there it reads 0. But RAM keeps its content through a reset. So the
 * paint at the end of the stack tells a restart from power-on, and one byte of two is enough: a
 * program that ran wild may have spoilt the other. SDCC's start-up clears all RAM, but only after
 * it has called _sdcc_external_startup. */
#define IS_PAINTED(address) (*(volatile uint8_t __idata *)(address) == STACK_PAINT)
#define IS_POWER_ON()                                                                              \
    ((PCON & POWER_OFF) != 0 || !(IS_PAINTED(RAM_TOP) || IS_PAINTED(RAM_TOP - 1U)))
#else
#define IS_POWER_ON() ((PCON & POWER_OFF) != 0)
#endif

__sfr __at(0xE1) WDT_CONTR; /* STC89 */
__sfr __at(0xA6) WDTRST;    /* AT89S52 */

static bool ram_is_good;

#ifdef WATCHDOG_none
volatile uint8_t round_guard;
#endif

/* Since version 4.3 SDCC's start-up calls this function by another name. */
#if __SDCC_VERSION_MAJOR > 4 || (__SDCC_VERSION_MAJOR == 4 && __SDCC_VERSION_MINOR >= 3)
#define EXTERNAL_STARTUP __sdcc_external_startup
#else
#define EXTERNAL_STARTUP _sdcc_external_startup
#endif

/* SDCC's start-up calls this before anything else, with an empty stack. The result 0 lets it go on
 * and initialise the variables. */
unsigned char EXTERNAL_STARTUP(void)
{
    uint8_t cause = HAL_RESET_POWER;

    EA = 0; /* a program that ran wild may come here without a reset */
    PSW = 0;
#if defined(WATCHDOG_none)
    __asm__("lcall _unused_interrupt"); /* its reti ends the PWM's interrupt, if it led here */
#endif
    pin_pwm = 1;
    pin_stop = 1;
    pin_lamp = 1;
    pin_buzzer = 1;
    pin_trigger = 0;
    if (!IS_POWER_ON()) {
#if defined(WATCHDOG_at89s52)
        cause = HAL_RESET_WATCHDOG; /* a reset by pin looks the same; take the worse cause */
#elif defined(WATCHDOG_stc89)
        cause = (WDT_CONTR & 0x80) ? HAL_RESET_WATCHDOG : HAL_RESET_PIN;
#else
        cause = HAL_RESET_PIN;
#endif
    }
    PCON = (uint8_t)(cause << CAUSE_SHIFT);
    /* Time to paint the stack again, even if the watchdog ran already. It clears the STC89's
     * flag. */
    hal_watchdog_feed();
    return 0;
}

uint8_t hal_reset_cause(void)
{
    return (PCON & CAUSE_MASK) >> CAUSE_SHIFT;
}

/* Writes and reads two patterns in each byte of RAM and restores it, except for the eight registers
 * that this code uses. It is assembly because SDCC 4.5 drops reads through a pointer to volatile
 * bytes: it compares with what it has just written there. */
static bool test_ram(void) __naked
{
    /* clang-format off */
    __asm
        mov     r0, #RAM_TOP
    00001$:
        mov     a, @r0              ; kept
        mov     @r0, #0x55
        cjne    @r0, #0x55, 00002$
        mov     @r0, #0xAA
        cjne    @r0, #0xAA, 00002$
        mov     @r0, a
        dec     r0
        cjne    r0, #7, 00001$
        mov     dpl, #1
        ret
    00002$:
        mov     dpl, #0
        ret
    __endasm; /* rounds: 248 */
    /* clang-format on */
}

static void paint_stack(void)
{
    uint8_t __idata *byte =
        (uint8_t __idata *)(uint8_t)(SP + 8); /* the next calls need some stack */

    do {
        *byte = STACK_PAINT;
        byte++;
    } while ((uint8_t)byte != 0); /* rounds: 248 */
}

void hal_init(void)
{
    /* A program that ran wild may come here without a reset, which stops timer 1. */
    pin_stop = 1;
    if (TR1) {
        PCON = HAL_RESET_WATCHDOG << CAUSE_SHIFT;
    }
    ram_is_good = test_ram();
    paint_stack();
    pwm_init();
    sensor_init();
    uart_init();
    hal_watchdog_feed(); /* the first feed starts it */
}

void unused_interrupt(void) __interrupt(5) __naked
{
    /* clang-format off */
    __asm
        reti
    __endasm;
    /* clang-format on */
}

bool hal_ram_is_good(void)
{
    return ram_is_good;
}

uint8_t hal_stack_unused(void)
{
    uint8_t __idata *byte = (uint8_t __idata *)RAM_TOP;

    while (*byte == STACK_PAINT) { /* rounds: 248 */
        byte--;
    }
    return RAM_TOP - (uint8_t)byte;
}

bool hal_stack_is_good(void)
{
    return *(volatile uint8_t __idata *)RAM_TOP == STACK_PAINT;
}

/* Each of these is a single instruction, so the pin has no glitch. */
void hal_stop_set(bool on)
{
    pin_stop = on;
}

void hal_lamp_set(bool on)
{
    pin_lamp = !on;
}

void hal_buzzer_set(bool on)
{
    pin_buzzer = !on;
}

bool hal_override_held(void)
{
    return !pin_override;
}

void hal_watchdog_feed(void)
{
#if defined(WATCHDOG_at89s52)
    WDTRST = 0x1E;
    WDTRST = 0xE1;
#elif defined(WATCHDOG_stc89)
    WDT_CONTR = 0x30; /* on, restarted, 12 * 2 * 32768 clocks: 65.5 ms at 12 MHz */
#elif defined(WATCHDOG_none)
    pwm_guard_ticks = PWM_GUARD_TICKS;
    round_guard = ROUND_GUARD_ROUNDS;
#else
#error the board must say WATCHDOG := none, at89s52 or stc89
#endif
}
