/* From reset to main: safe pins, reset cause, RAM and stack. */
#include "sfr.h"

/* RAM keeps its bytes through a reset, so the signature tells a restart from power coming up.
 * SDCC's start-up clears all RAM, but after it has called _sdcc_external_startup. */
#define SIGNATURE_1 0x51
#define SIGNATURE_2 0xC3
#define SIGNATURE_3 0x2E
static volatile __idata uint8_t signature[3];

/* Two general flags of PCON take the finding over the clearing of RAM; reset clears them. */
#define CAUSE_SHIFT 2U
#define CAUSE_MASK  (3U << CAUSE_SHIFT) /* GF1, GF0 */
#define POWER_OFF   0x10U /* POF: set by power coming up, cleared by us; 0 where there is none */

#define STACK_PAINT 0xAA
#define RAM_TOP     0xFFU

__sfr __at(0xE1) WDT_CONTR; /* STC89 */
__sfr __at(0xA6) WDTRST;    /* AT89S52 */

static bool ram_is_good;

/* Runs before anything else, on an empty stack; 0 lets SDCC's start-up initialise the variables. */
unsigned char _sdcc_external_startup(void)
{
    uint8_t cause = HAL_RESET_POWER;

    pin_pwm = 1;
    pin_stop = 1;
    pin_lamp = 1;
    pin_buzzer = 1;
    pin_trigger = 0;
    if (signature[0] == SIGNATURE_1 && signature[1] == SIGNATURE_2 && signature[2] == SIGNATURE_3 &&
        (PCON & POWER_OFF) == 0) {
#if defined(WATCHDOG_at89s52)
        cause = HAL_RESET_WATCHDOG; /* the reset pin looks the same: the careful answer for both */
#elif defined(WATCHDOG_stc89)
        cause = (WDT_CONTR & 0x80) ? HAL_RESET_WATCHDOG : HAL_RESET_PIN;
#else
        cause = HAL_RESET_PIN;
#endif
    }
    PCON = (uint8_t)(cause << CAUSE_SHIFT);
    return 0;
}

uint8_t hal_reset_cause(void)
{
    return (PCON & CAUSE_MASK) >> CAUSE_SHIFT;
}

/* Each byte but the eight registers that this runs in takes two patterns and gets its own back. */
static bool test_ram(void)
{
    uint8_t __idata *byte = (uint8_t __idata *)RAM_TOP;

    do {
        volatile uint8_t __idata *cell = byte;
        uint8_t kept = *cell;
        *cell = 0x55;
        if (*cell != 0x55) {
            return false;
        }
        *cell = 0xAA;
        if (*cell != 0xAA) {
            return false;
        }
        *cell = kept;
        byte--;
    } while ((uint8_t)byte >= 8); /* rounds: 248 */
    return true;
}

static void paint_stack(void)
{
    uint8_t __idata *byte =
        (uint8_t __idata *)(uint8_t)(SP + 8); /* the calls below need some of it */

    do {
        *byte = STACK_PAINT;
        byte++;
    } while ((uint8_t)byte != 0); /* rounds: 248 */
}

void hal_init(void)
{
    ram_is_good = test_ram();
    paint_stack();
    signature[0] = SIGNATURE_1;
    signature[1] = SIGNATURE_2;
    signature[2] = SIGNATURE_3;
    pwm_init();
    sensor_init();
    uart_init();
#if defined(WATCHDOG_at89s52)
    hal_watchdog_feed(); /* the first feed starts it */
#elif defined(WATCHDOG_stc89)
    WDT_CONTR = 0x30;
#endif
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

/* Changes of the lamp, the buzzer and the stop line are single instructions: no glitch. */
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
    WDT_CONTR = 0x30; /* on, counted from now, 12 * 2 * 32768 clocks: 65.5 ms at 12 MHz */
#elif !defined(WATCHDOG_none)
#error the board must say WATCHDOG := none, at89s52 or stc89
#endif
}
