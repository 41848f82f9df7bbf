/* SPDX-License-Identifier: MIT */
/* The chip as a whole: life, reset, special function registers, checkpoints. */
#include "mcs52_inside.h"

#include <stdlib.h>
#include <string.h>

enum {
    OWN = READ_SPECIAL | WRITE_SPECIAL, /* the processor has it */
    PORT = READ_SPECIAL | WRITE_SPECIAL | IS_PORT,
    COUNT = READ_SPECIAL | WRITE_SPECIAL | IS_COUNT,
    SETTING = WRITE_SPECIAL | IS_SETTING,
    ACTION = WRITE_SPECIAL
};

const uint8_t mcs52_special[256] = {
    [P0] = PORT,         [P1] = PORT,       [P2] = PORT,        [P3] = PORT,
    [PCON] = ACTION,     [TCON] = SETTING,  [TMOD] = SETTING,   [TL0] = COUNT,
    [TL1] = COUNT,       [TH0] = COUNT,     [TH1] = COUNT,      [SCON] = SETTING,
    [SBUF] = ACTION,     [WDTRST] = ACTION, [IE] = SETTING,     [IP] = SETTING,
    [T2CON] = SETTING,   [T2MOD] = SETTING, [RCAP2L] = SETTING, [RCAP2H] = SETTING,
    [TL2] = COUNT,       [TH2] = COUNT,     [PSW] = OWN,        [ACC] = OWN,
    [WDT_CONTR] = ACTION};

/* --- special function registers ----------------------------------------------------------- */

uint8_t mcs52_read(struct mcs52 *chip, uint8_t address, uint64_t cycle)
{
    if (mcs52_special[address] & IS_PORT) {
        return chip->pins[(address - P0) / 16];
    }
    if (chip->next <= cycle) {
        mcs52_catch_up(chip, cycle);
    }
    if (mcs52_special[address] & IS_COUNT) {
        mcs52_timers_sync(chip, cycle);
    }
    return chip->sfr[address];
}

static void settle_power(struct mcs52 *chip, uint64_t end)
{
    if (chip->sfr[PCON] & PCON_PD) {
        mcs52_power_down(chip, end);
    } else if (chip->sfr[PCON] & PCON_IDL) {
        chip->idle = true;
        mcs52_watchdog_stand(chip, end);
        mcs52_attend(chip);
    }
}

/* A register on which timers, the serial port or interrupts depend becomes VALUE at END. */
static void settle(struct mcs52 *chip, uint8_t address, uint8_t value, uint64_t end)
{
    uint8_t old = chip->sfr[address];

    mcs52_uart_advance(chip, end);
    mcs52_timers_sync(chip, end - 1);
    chip->sfr[address] = value;
    switch (address) {
    case TCON:
        mcs52_pins_follow(chip, end);
        break;
    case SCON:
        mcs52_requests_of(chip, SCON, end);
        mcs52_uart_control(chip, old, end);
        break;
    case T2CON:
    case T2MOD:
        mcs52_requests_of(chip, T2CON, end);
        break;
    case PCON:
        settle_power(chip, end);
        break;
    default:
        break;
    }
    mcs52_timers_plan(chip);
    mcs52_uart_plan(chip, end);
}

void mcs52_write(struct mcs52 *chip, uint8_t address, uint8_t value, uint64_t end)
{
    if (chip->next < end) {
        mcs52_catch_up(chip, end - 1);
    }
    if (mcs52_special[address] & IS_PORT) {
        chip->sfr[address] = value;
        mcs52_pins_update(chip, (address - P0) / 16, end);
    } else if (address == SBUF) {
        mcs52_uart_send(chip, value, end);
    } else if (address == WDTRST || address == WDT_CONTR) {
        mcs52_watchdog_write(chip, address, value, end);
    } else if (address == IE || address == IP) {
        chip->held = end;
        if (value != chip->sfr[address]) {
            chip->sfr[address] = value;
            mcs52_poll(chip);
        }
    } else if (!(mcs52_special[address] & IS_SETTING) || value != chip->sfr[address]) {
        settle(chip, address, value, end);
    }
}

uint8_t mcs52_sfr(struct mcs52 *chip, uint8_t address)
{
    switch (address) {
    case ACC:
        return chip->a;
    case PSW:
        return (uint8_t)(chip->psw | __builtin_parity(chip->a));
    default:
        return mcs52_special[address] & IS_PORT ? chip->sfr[address]
                                                : mcs52_read(chip, address, chip->now);
    }
}

void mcs52_poke(struct mcs52 *chip, uint8_t address, uint8_t value)
{
    bool acts = address == SBUF || address == WDTRST || address == WDT_CONTR;

    if (address == ACC) {
        chip->a = value;
    } else if (address == PSW) {
        chip->psw = value & (uint8_t)~PSW_P;
    } else if (acts) {
        chip->sfr[address] = value;
    } else {
        mcs52_write(chip, address, value, chip->now);
    }
}

void mcs52_jump(struct mcs52 *chip, uint16_t pc)
{
    chip->pc = pc;
}

/* --- reset -------------------------------------------------------------------------------- */

/* [I], reset values; RAM, SBUF and what only power clears stay. While the clock stands, it stands
 * on. */
void mcs52_restart(struct mcs52 *chip, enum mcs52_reset cause)
{
    uint8_t pof = chip->sfr[PCON] & PCON_POF, flag = chip->sfr[WDT_CONTR] & WDT_FLAG;
    uint8_t received = chip->sfr[SBUF];
    uint64_t pin_due = chip->due[EVENT_PIN], fault_due = chip->due[EVENT_FAULT];

    memset(chip->sfr, 0, sizeof chip->sfr);
    chip->sfr[SBUF] = received;
    chip->sfr[SP] = 7;
    if (chip->part != MCS52_INTEL) {
        chip->sfr[PCON] = cause == MCS52_POWER ? PCON_POF : pof;
    }
    if (chip->part == MCS52_STC89) {
        chip->sfr[WDT_CONTR] = cause == MCS52_WATCHDOG ? WDT_FLAG : flag;
    }
    chip->cause = cause;
    chip->pc = 0;
    chip->a = chip->psw = 0;
    chip->idle = chip->poll = chip->bitten = false;
    chip->power_down = chip->clock_stands;
    chip->in_service = 0;
    chip->watchdog_half = false;
    chip->watchdog_left = NEVER;
    chip->t1_is_odd = false;
    for (int source = 0; source < SOURCES; source++) {
        chip->on[source] = chip->off[source] = NEVER;
    }
    for (int event = 0; event < EVENTS; event++) {
        chip->due[event] = NEVER;
    }
    chip->due[EVENT_PIN] = pin_due;
    chip->due[EVENT_FAULT] = fault_due;
    mcs52_pins_release(chip);
    chip->tx_clock.phase = chip->rx_clock.phase = 0;
    mcs52_uart_plan(chip, chip->now);
    mcs52_uart_break(chip, chip->now);
    mcs52_pins_follow(chip, chip->now);
}

void mcs52_reset(struct mcs52 *chip)
{
    mcs52_restart(chip, MCS52_PIN);
}

enum mcs52_reset mcs52_reset_cause(const struct mcs52 *chip)
{
    return chip->cause;
}

/* --- life --------------------------------------------------------------------------------- */

struct mcs52 *mcs52_create(enum mcs52_part part, const struct mcs52_outside *outside)
{
    struct mcs52 *chip = calloc(1, sizeof *chip);

    if (chip == NULL) {
        return NULL;
    }
    chip->part = part;
    if (outside != NULL) {
        chip->outside = *outside;
    }
    chip->xdata_watch = MCS52_XDATA_BYTES;
    chip->due[EVENT_PIN] = chip->due[EVENT_FAULT] = chip->probe_from = NEVER;
    memset(chip->outside_pins, 0xFF, sizeof chip->outside_pins);
    memset(chip->pins, 0xFF, sizeof chip->pins);
    mcs52_restart(chip, MCS52_POWER);
    return chip;
}

void mcs52_destroy(struct mcs52 *chip)
{
    free(chip);
}

void mcs52_load(struct mcs52 *chip, uint16_t address, const uint8_t *code, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        chip->code[(address + i) & 0xFFFF] = code[i];
    }
    memcpy(chip->code + MCS52_CODE_BYTES, chip->code, sizeof chip->code - MCS52_CODE_BYTES);
}

void mcs52_watch_xdata(struct mcs52 *chip, uint16_t address)
{
    chip->xdata_watch = address;
}

void mcs52_cover(struct mcs52 *chip, uint8_t *map)
{
    chip->covered = map;
}

uint64_t mcs52_cycles(const struct mcs52 *chip)
{
    return chip->now;
}

uint64_t mcs52_instructions(const struct mcs52 *chip)
{
    return chip->instructions;
}

uint16_t mcs52_pc(const struct mcs52 *chip)
{
    return chip->pc;
}

bool mcs52_is_asleep(const struct mcs52 *chip)
{
    return chip->idle || chip->power_down;
}

uint8_t *mcs52_ram(struct mcs52 *chip)
{
    return chip->ram;
}

uint8_t *mcs52_xdata(struct mcs52 *chip)
{
    return chip->xdata;
}
