/* SPDX-License-Identifier: MIT */
/* Faults put into the chip: bits that flip once or stick; when the others of mcs52_electric.c act.
 */
#include "mcs52_inside.h"

static unsigned bits_at(const struct mcs52_fault *fault)
{
    return fault->place == MCS52_IN_PC ? 16 : 8;
}

static unsigned read_place(struct mcs52 *chip, const struct mcs52_fault *fault)
{
    switch (fault->place) {
    case MCS52_IN_RAM:
        return chip->ram[fault->address];
    case MCS52_IN_SFR:
        return mcs52_sfr(chip, (uint8_t)fault->address);
    case MCS52_IN_REGISTER:
        return mcs52_bank(chip)[fault->address];
    case MCS52_IN_PC:
        return chip->pc;
    default:
        return chip->xdata[fault->address];
    }
}

static void write_place(struct mcs52 *chip, const struct mcs52_fault *fault, unsigned value)
{
    switch (fault->place) {
    case MCS52_IN_RAM:
        chip->ram[fault->address] = (uint8_t)value;
        break;
    case MCS52_IN_SFR:
        mcs52_poke(chip, (uint8_t)fault->address, (uint8_t)value);
        break;
    case MCS52_IN_REGISTER:
        mcs52_bank(chip)[fault->address] = (uint8_t)value;
        break;
    case MCS52_IN_PC:
        chip->pc = (uint16_t)value;
        break;
    default:
        chip->xdata[fault->address] = (uint8_t)value;
        break;
    }
}

static void force(struct mcs52 *chip, const struct mcs52_fault *fault)
{
    unsigned old = read_place(chip, fault), bit = 1u << fault->bit;
    unsigned value = fault->kind == MCS52_FLIP        ? old ^ bit
                     : fault->kind == MCS52_STUCK_LOW ? old & ~bit
                                                      : old | bit;

    if (value != old) {
        write_place(chip, fault, value);
    }
}

static bool is_of_bit(const struct mcs52_fault *fault)
{
    return fault->kind <= MCS52_STUCK_HIGH;
}

static uint64_t sooner(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

static void plan(struct mcs52 *chip)
{
    uint64_t first = NEVER, probe_from = NEVER;

    for (int i = 0; i < chip->fault_count; i++) {
        const struct mcs52_fault *fault = &chip->faults[i];
        bool is_done = chip->fault_done[i];

        if (!is_of_bit(fault)) {
            first = sooner(first, chip->fault_next[i]);
            continue;
        }
        if (fault->kind != MCS52_FLIP || (fault->counts_instructions && !is_done)) {
            /* An instruction takes a cycle at least, so no count of them comes sooner. */
            probe_from = sooner(probe_from, fault->when);
        }
        if (!is_done && !fault->counts_instructions) {
            first = sooner(first, fault->when);
        }
    }
    chip->probe_from = probe_from;
    mcs52_schedule(chip, EVENT_FAULT, first);
}

/* At the begin of an instruction: all faults whose time has come, and each stuck bit again. */
void mcs52_faults_strike(struct mcs52 *chip)
{
    for (int i = 0; i < chip->fault_count; i++) {
        const struct mcs52_fault *fault = &chip->faults[i];
        bool is_due;

        if (!is_of_bit(fault)) {
            if (chip->fault_next[i] <= chip->now) {
                chip->fault_next[i] = mcs52_upset(chip, fault);
            }
            continue;
        }
        is_due = (fault->counts_instructions ? chip->instructions : chip->now) >= fault->when;

        if (is_due && (fault->kind != MCS52_FLIP || !chip->fault_done[i])) {
            chip->fault_done[i] = true;
            force(chip, fault);
        }
    }
    plan(chip);
}

static bool is_pin(unsigned address)
{
    return (address & ~0x37u) == P0; /* bits 5 and 4 are the port, 2 to 0 its bit */
}

/* A fault that is not of a bit makes sense. */
static bool is_possible(const struct mcs52_fault *fault)
{
    switch (fault->kind) {
    case MCS52_PIN_LOW:
    case MCS52_PIN_HIGH:
        return is_pin(fault->address);
    case MCS52_PINS_TIED:
        return is_pin(fault->address) && ((fault->address ^ fault->other) & 0xF8) == 0;
    default:
        return fault->cycles > 0;
    }
}

static bool exists(const struct mcs52_fault *fault)
{
    static const struct {
        unsigned first, last;
    } addresses[] = {[MCS52_IN_RAM] = {0, 0xFF},
                     [MCS52_IN_SFR] = {0x80, 0xFF},
                     [MCS52_IN_REGISTER] = {0, 7},
                     [MCS52_IN_PC] = {0, 0xFFFF},
                     [MCS52_IN_XDATA] = {0, 0xFFFF}};

    return (unsigned)fault->bit < bits_at(fault) &&
           fault->address >= addresses[fault->place].first &&
           fault->address <= addresses[fault->place].last;
}

bool mcs52_inject(struct mcs52 *chip, const struct mcs52_fault *fault)
{
    if (chip->fault_count == MCS52_FAULTS ||
        !(is_of_bit(fault) ? exists(fault) : is_possible(fault))) {
        return false;
    }
    chip->fault_done[chip->fault_count] = false;
    chip->fault_next[chip->fault_count] = fault->when;
    chip->faults[chip->fault_count++] = *fault;
    plan(chip);
    return true;
}

void mcs52_heal(struct mcs52 *chip)
{
    chip->fault_count = 0;
    mcs52_calm(chip);
    plan(chip);
}
