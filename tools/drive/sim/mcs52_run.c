/* SPDX-License-Identifier: MIT */
/* Time: what is due when, and what happens between two instructions. */
#include "mcs52_inside.h"

enum { LONGEST_MC = 4 /* MUL, DIV */, INTERRUPT_MC = 2 };

void mcs52_attend(struct mcs52 *chip)
{
    chip->next = 0;
}

void mcs52_schedule(struct mcs52 *chip, enum event event, uint64_t cycle)
{
    chip->due[event] = cycle;
    if (cycle < chip->next) {
        chip->next = cycle;
    }
}

/* The first thing that is due, of those that do not wait for the end of an instruction. In
 * power-down the oscillator stands: only the outside goes on. */
static int first_due(const struct mcs52 *chip)
{
    int first = 0;

    if (chip->power_down) {
        return EVENT_PIN;
    }
    for (int event = 1; event < EVENT_FAULT; event++) {
        if (chip->due[event] < chip->due[first]) {
            first = event;
        }
    }
    return first;
}

static void happen(struct mcs52 *chip, int event, uint64_t cycle)
{
    chip->due[event] = NEVER;
    switch (event) {
    case EVENT_COUNT_0:
    case EVENT_COUNT_1:
    case EVENT_COUNT_2:
        mcs52_timer_count(chip, event - EVENT_COUNT_0, cycle);
        break;
    case EVENT_PIN:
        mcs52_pins_event(chip, cycle);
        break;
    case EVENT_T0:
    case EVENT_T1:
    case EVENT_T2:
        mcs52_timer_sync(chip, event - EVENT_T0, cycle);
        mcs52_timers_plan(chip);
        break;
    case EVENT_TX:
        mcs52_uart_tx(chip, cycle);
        break;
    case EVENT_RX:
        mcs52_uart_rx(chip, cycle);
        break;
    default: /* the watchdog: resets at the end of the instruction */
        chip->bitten = true;
        break;
    }
}

void mcs52_catch_up(struct mcs52 *chip, uint64_t through)
{
    for (;;) {
        int event = first_due(chip);

        if (chip->due[event] > through) {
            return;
        }
        happen(chip, event, chip->due[event]);
    }
}

static uint64_t next_due(const struct mcs52 *chip)
{
    uint64_t first = chip->due[first_due(chip)], fault = chip->due[EVENT_FAULT];

    return first < fault ? first : fault;
}

/* Near UNTIL, each instruction may be the last one. */
static uint64_t next_look(const struct mcs52 *chip)
{
    uint64_t last = chip->until > LONGEST_MC ? chip->until - LONGEST_MC : 0, next = next_due(chip);

    return next < last ? next : last;
}

/* Idle or power-down: time goes on to whatever comes next. */
static void sleep_on(struct mcs52 *chip)
{
    uint64_t next = chip->poll ? chip->now + 1 : next_due(chip);

    chip->now = next < chip->until ? next : chip->until;
}

/* Brings the chip to the next instruction. Returns false when mcs52_run has to return. */
bool mcs52_boundary(struct mcs52 *chip)
{
    while (!chip->stop) {
        int source;

        mcs52_catch_up(chip, chip->now);
        if (chip->bitten) {
            mcs52_watchdog_bite(chip);
            continue;
        }
        if (chip->due[EVENT_FAULT] <= chip->now) {
            mcs52_faults_strike(chip);
        }
        source = chip->poll && !chip->power_down ? mcs52_interrupt(chip) : -1;
        if (source >= 0) {
            if (chip->now + INTERRUPT_MC > chip->until) {
                break;
            }
            mcs52_vector(chip, source);
            continue;
        }
        if (chip->idle || chip->power_down) {
            if (chip->now >= chip->until) {
                break;
            }
            sleep_on(chip);
            continue;
        }
        if (chip->stop || chip->now + mcs52_op_cycles[chip->code[chip->pc]] > chip->until) {
            break;
        }
        chip->next = chip->poll ? 0 : next_look(chip);
        return true;
    }
    chip->stop = false;
    return false;
}

static bool is_probed(const struct mcs52 *chip)
{
    return chip->covered != NULL || chip->probe_from < chip->until;
}

uint64_t mcs52_run(struct mcs52 *chip, uint64_t until)
{
    chip->until = until;
    chip->stop = false;
    mcs52_attend(chip);
    if (is_probed(chip)) {
        mcs52_execute_probed(chip, false);
    } else {
        mcs52_execute(chip);
    }
    return chip->now;
}

void mcs52_step(struct mcs52 *chip)
{
    chip->until = chip->idle || chip->power_down ? chip->now + 1 : NEVER;
    chip->stop = false;
    mcs52_execute_probed(chip, true);
}

void mcs52_stop(struct mcs52 *chip)
{
    chip->stop = true;
    mcs52_attend(chip);
}

/* --- power-down --------------------------------------------------------------------------- */

void mcs52_power_down(struct mcs52 *chip, uint64_t end)
{
    chip->power_down = true;
    chip->slept_from = end;
    mcs52_attend(chip);
    if (mcs52_pins_wake(chip)) {
        mcs52_wake(chip, end);
    }
}

/* The oscillator starts again: all that was due comes that much later. */
void mcs52_wake(struct mcs52 *chip, uint64_t cycle)
{
    uint64_t slept = cycle - chip->slept_from;

    for (int event = 0; event < EVENT_FAULT; event++) {
        if (event != EVENT_PIN && chip->due[event] != NEVER) {
            chip->due[event] += slept;
        }
    }
    for (int n = 0; n < 3; n++) {
        chip->timer_at[n] += slept;
    }
    mcs52_uart_shift(chip, slept);
    chip->power_down = false;
    chip->sfr[PCON] &= (uint8_t)~PCON_PD;
    mcs52_pins_follow(chip, cycle);
}
