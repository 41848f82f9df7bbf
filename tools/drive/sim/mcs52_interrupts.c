/* SPDX-License-Identifier: MIT */
/* Interrupts: [I]'s sampling, polling and two levels.
 *
 * A flag that is set in cycle C is sampled at its end, polled in C+1 and, if C+1 is the last cycle
 * of an instruction, answered by an LCALL in C+2 and C+3. So between two instructions at cycle N,
 * what counts is the sample of cycle N-2. TF2 is set at the begin of its cycle and polled in it;
 * its request counts as a sample of the cycle before. */
#include "mcs52_inside.h"

static bool is_requested(const struct mcs52 *chip, int source)
{
    return chip->on[source] != NEVER && chip->off[source] == NEVER;
}

/* A request may be waiting: look at the next instruction. */
void mcs52_poll(struct mcs52 *chip)
{
    chip->poll = true;
    mcs52_attend(chip);
}

/* The flag of SOURCE is set or cleared so that the sample of CYCLE is the first one to see it. */
void mcs52_request(struct mcs52 *chip, enum source source, bool on, uint64_t cycle)
{
    if (on == is_requested(chip, source)) {
        return;
    }
    if (on) {
        chip->on[source] = cycle;
        chip->off[source] = NEVER;
        mcs52_poll(chip);
    } else {
        chip->off[source] = cycle;
    }
}

/* The flags in register ADDRESS have changed. */
void mcs52_requests_of(struct mcs52 *chip, uint8_t address, uint64_t cycle)
{
    uint8_t value = chip->sfr[address];

    if (address == TCON) {
        mcs52_request(chip, SOURCE_IE0, value & TCON_IE0, cycle);
        mcs52_request(chip, SOURCE_TF0, value & TCON_TF0, cycle);
        mcs52_request(chip, SOURCE_IE1, value & TCON_IE1, cycle);
        mcs52_request(chip, SOURCE_TF1, value & TCON_TF1, cycle);
    } else if (address == SCON) {
        mcs52_request(chip, SOURCE_SERIAL, value & (SCON_TI | SCON_RI), cycle);
    } else {
        /* [A]: EXF2 is no interrupt while the timer counts up or down. */
        bool external = (value & T2_EXF2) && !(chip->sfr[T2MOD] & T2MOD_DCEN);

        mcs52_request(chip, SOURCE_TIMER2, (value & T2_TF2) || external, cycle);
    }
}

static bool is_allowed(const struct mcs52 *chip, int source, bool *is_high)
{
    if (!(chip->sfr[IE] & IE_EA) || !(chip->sfr[IE] >> source & 1)) {
        return false;
    }
    *is_high = chip->sfr[IP] >> source & 1;
    return *is_high ? !(chip->in_service & 2) : chip->in_service == 0;
}

/* The source whose interrupt begins now, or -1. */
int mcs52_interrupt(struct mcs52 *chip)
{
    int best = -1;
    bool best_is_high = false;

    chip->poll = false;
    for (int source = 0; source < SOURCES; source++) {
        bool is_high;

        if (!is_allowed(chip, source, &is_high) || chip->on[source] == NEVER ||
            chip->off[source] + 2 <= chip->now) {
            continue;
        }
        chip->poll = true;
        if (chip->on[source] + 2 <= chip->now && (best < 0 || (is_high && !best_is_high))) {
            best = source;
            best_is_high = is_high;
        }
    }
    return chip->held == chip->now ? -1 : best;
}

/* The LCALL to the source's vector; the hardware clears the flags that belong to it alone. */
void mcs52_vector(struct mcs52 *chip, int source)
{
    static const uint8_t flags[SOURCES] = {TCON_IE0, TCON_TF0, TCON_IE1, TCON_TF1, 0, 0};
    uint8_t flag = flags[source];

    if ((flag == TCON_IE0 && !(chip->sfr[TCON] & TCON_IT0)) ||
        (flag == TCON_IE1 && !(chip->sfr[TCON] & TCON_IT1))) {
        flag = 0; /* by level: the pin decides */
    }
    mcs52_timers_sync(chip, chip->now - 1); /* overflows while the flag was set are over */
    chip->sfr[TCON] &= (uint8_t)~flag;
    mcs52_requests_of(chip, TCON, chip->now);
    mcs52_timers_plan(chip);
    chip->ram[++chip->sfr[SP]] = (uint8_t)chip->pc;
    chip->ram[++chip->sfr[SP]] = (uint8_t)(chip->pc >> 8);
    chip->pc = (uint16_t)(3 + 8 * source);
    chip->in_service |= chip->sfr[IP] >> source & 1 ? 2 : 1;
    if (chip->idle) {
        chip->idle = false;
        chip->sfr[PCON] &= (uint8_t)~PCON_IDL;
        mcs52_watchdog_go_on(chip, chip->now);
    }
    chip->now += 2;
    chip->poll = true;
}

/* RETI: one more instruction, then the next interrupt. */
void mcs52_return(struct mcs52 *chip, uint64_t end)
{
    chip->in_service &= chip->in_service & 2 ? 1 : 0;
    chip->held = end;
    mcs52_poll(chip);
}
