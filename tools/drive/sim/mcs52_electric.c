/* SPDX-License-Identifier: MIT */
/* What befalls the chip as a whole, and its pins: shorts, a dip of the supply, an oscillator that
 * stops, more interrupts than there should be. */
#include "mcs52_inside.h"

#include <string.h>

/* --- pins --------------------------------------------------------------------------------- */

static int port_of(uint8_t pin)
{
    return (pin - P0) >> 4;
}

static uint8_t mask_of(uint8_t pin)
{
    return (uint8_t)(1u << (pin & 7));
}

static void join(struct mcs52 *chip, uint8_t masks[4], int port, uint8_t mask, bool on)
{
    masks[port] = (uint8_t)(on ? masks[port] | mask : masks[port] & ~mask);
    mcs52_pins_update(chip, port, chip->now);
}

static void short_pins(struct mcs52 *chip, const struct mcs52_fault *fault, bool on)
{
    uint8_t pin = (uint8_t)fault->address, mask = mask_of(pin);

    if (fault->kind == MCS52_PINS_TIED) {
        join(chip, chip->tied, port_of(pin), mask | mask_of(fault->other), on);
    } else {
        join(chip, fault->kind == MCS52_PIN_LOW ? chip->shorted_low : chip->shorted_high,
             port_of(pin), mask, on);
    }
}

/* --- supply and clock --------------------------------------------------------------------- */

/* Without a supply the chip drives nothing, and the pull-ups outside make its pins high. When it is
 * back, RAM holds anything: here the bytes of a linear congruence (Knuth's MMIX constants). */
static void lose_power(struct mcs52 *chip, uint64_t cycles)
{
    uint64_t noise = chip->now;

    mcs52_pins_release(chip);
    for (int i = 0; i < MCS52_RAM_BYTES; i++) {
        noise = noise * 6364136223846793005u + 1442695040888963407u;
        chip->ram[i] = (uint8_t)(noise >> 56);
    }
    chip->now += cycles;
    mcs52_restart(chip, MCS52_POWER);
}

static void stop_clock(struct mcs52 *chip)
{
    if (!chip->power_down) {
        chip->clock_stands = chip->power_down = true;
        chip->slept_from = chip->now;
        mcs52_attend(chip);
    }
}

static void start_clock(struct mcs52 *chip)
{
    if (chip->clock_stands) {
        chip->clock_stands = false;
        mcs52_wake(chip, chip->now);
    }
}

/* --- interrupts --------------------------------------------------------------------------- */

static void request_all(struct mcs52 *chip)
{
    const uint8_t flags = TCON_IE0 | TCON_TF0 | TCON_IE1 | TCON_TF1;

    mcs52_poke(chip, TCON, mcs52_sfr(chip, TCON) | flags);
    mcs52_poke(chip, SCON, mcs52_sfr(chip, SCON) | SCON_TI | SCON_RI);
    mcs52_poke(chip, T2CON, mcs52_sfr(chip, T2CON) | T2_TF2 | T2_EXF2);
}

/* --- all ---------------------------------------------------------------------------------- */

uint64_t mcs52_upset(struct mcs52 *chip, const struct mcs52_fault *fault)
{
    uint64_t end = fault->cycles == 0 ? NEVER : fault->when + fault->cycles;
    bool over = chip->now >= end;

    switch (fault->kind) {
    case MCS52_POWER_DIP:
        lose_power(chip, fault->cycles);
        return NEVER;
    case MCS52_CLOCK_STOP:
        if (over) {
            start_clock(chip);
        } else {
            stop_clock(chip);
        }
        return over ? NEVER : end;
    case MCS52_INTERRUPTS:
        request_all(chip);
        return chip->now + MCS52_BURST_MC < end ? chip->now + MCS52_BURST_MC : NEVER;
    default:
        short_pins(chip, fault, !over);
        return over ? NEVER : end;
    }
}

void mcs52_calm(struct mcs52 *chip)
{
    memset(chip->shorted_low, 0, sizeof chip->shorted_low);
    memset(chip->shorted_high, 0, sizeof chip->shorted_high);
    memset(chip->tied, 0, sizeof chip->tied);
    for (int port = 0; port < 4; port++) {
        mcs52_pins_update(chip, port, chip->now);
    }
    start_clock(chip);
}
