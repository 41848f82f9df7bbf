/* SPDX-License-Identifier: MIT */
/* Timers 0, 1 and 2 ([I], timer/counters; [A] for T2MOD). Nothing is counted cycle by cycle: the
 * registers are brought up to date when somebody looks, and at overflows that somebody must hear
 * of. */
#include "mcs52_inside.h"

static unsigned pair(const struct mcs52 *chip, uint8_t high, uint8_t low)
{
    return (unsigned)(chip->sfr[high] << 8 | chip->sfr[low]);
}

static void set_pair(struct mcs52 *chip, uint8_t high, uint8_t low, unsigned value)
{
    chip->sfr[high] = (uint8_t)(value >> 8);
    chip->sfr[low] = (uint8_t)value;
}

unsigned mcs52_timer_mode(const struct mcs52 *chip, int n)
{
    return chip->sfr[TMOD] >> 4 * n & TMOD_MODE;
}

/* The timer is neither stopped nor gated. */
static bool runs(const struct mcs52 *chip, int n)
{
    bool gated = chip->sfr[TMOD] >> 4 * n & TMOD_GATE;

    switch (n) {
    case 0:
        return (chip->sfr[TCON] & TCON_TR0) && (!gated || (chip->pins[3] & P3_INT0));
    case 1:
        if (mcs52_timer_mode(chip, 1) == 3) {
            return false;
        }
        return mcs52_timer_mode(chip, 0) == 3 ||
               ((chip->sfr[TCON] & TCON_TR1) && (!gated || (chip->pins[3] & P3_INT1)));
    default:
        return chip->sfr[T2CON] & T2_TR2;
    }
}

static bool is_counter(const struct mcs52 *chip, int n)
{
    return n == 2 ? chip->sfr[T2CON] & T2_CT2 : chip->sfr[TMOD] >> 4 * n & TMOD_CT;
}

bool mcs52_timer_counts_cycles(const struct mcs52 *chip, int n)
{
    return runs(chip, n) && !is_counter(chip, n);
}

/* --- timer 2's kinds ---------------------------------------------------------------------- */

static bool is_clock_out(const struct mcs52 *chip)
{
    return (chip->sfr[T2MOD] & T2MOD_OE) && !(chip->sfr[T2CON] & T2_CT2);
}

static bool is_baud(const struct mcs52 *chip)
{
    return chip->sfr[T2CON] & (T2_RCLK | T2_TCLK);
}

/* Overflows are nobody's interrupt then. */
static bool is_generator(const struct mcs52 *chip)
{
    return is_baud(chip) || is_clock_out(chip);
}

static bool is_up_down(const struct mcs52 *chip)
{
    return (chip->sfr[T2MOD] & T2MOD_DCEN) && !(chip->sfr[T2CON] & T2_CAPTURE) &&
           !is_generator(chip);
}

static bool is_down(const struct mcs52 *chip)
{
    return is_up_down(chip) && !(chip->pins[1] & P1_T2EX);
}

/* Counts a cycle: as a generator timer 2 counts states, six a cycle. */
static unsigned rate_of(const struct mcs52 *chip, int n)
{
    return n == 2 && is_generator(chip) ? 6 : 1;
}

/* --- counting ----------------------------------------------------------------------------- */

/* Counts until the overflow, and from one overflow to the next. */
unsigned mcs52_timer_distance(const struct mcs52 *chip, int n)
{
    if (n == 2) {
        unsigned value = pair(chip, TH2, TL2);

        return is_down(chip) ? ((value - pair(chip, RCAP2H, RCAP2L) - 1) & 0xFFFF) + 1
                             : 0x10000 - value;
    }
    switch (mcs52_timer_mode(chip, n)) {
    case 0:
        return 0x2000u - (unsigned)(chip->sfr[TH0 + n] << 5 | (chip->sfr[TL0 + n] & 31));
    case 1:
        return 0x10000 - pair(chip, (uint8_t)(TH0 + n), (uint8_t)(TL0 + n));
    default:
        return 0x100u - chip->sfr[TL0 + n];
    }
}

unsigned mcs52_timer_period(const struct mcs52 *chip, int n)
{
    if (n == 2) {
        bool captures = (chip->sfr[T2CON] & T2_CAPTURE) && !is_generator(chip);
        unsigned reload = pair(chip, RCAP2H, RCAP2L);

        return captures        ? 0x10000
               : is_down(chip) ? ((0xFFFFu - reload - 1) & 0xFFFF) + 1
                               : 0x10000 - reload;
    }
    switch (mcs52_timer_mode(chip, n)) {
    case 0:
        return 0x2000;
    case 1:
        return 0x10000;
    case 2:
        return 0x100u - chip->sfr[TH0 + n];
    default:
        return 0x100;
    }
}

static void set_value(struct mcs52 *chip, int n, unsigned to_overflow)
{
    uint8_t high = (uint8_t)(TH0 + n), low = (uint8_t)(TL0 + n);

    if (n == 2) {
        unsigned down = pair(chip, RCAP2H, RCAP2L) + to_overflow;

        set_pair(chip, TH2, TL2, is_down(chip) ? down : 0x10000 - to_overflow);
        return;
    }
    switch (mcs52_timer_mode(chip, n)) {
    case 0: {
        unsigned value = 0x2000 - to_overflow;

        chip->sfr[high] = (uint8_t)(value >> 5);
        chip->sfr[low] = (uint8_t)((chip->sfr[low] & 0xE0) | (value & 31));
        break;
    }
    case 1:
        set_pair(chip, high, low, 0x10000 - to_overflow);
        break;
    default:
        chip->sfr[low] = (uint8_t)(0x100 - to_overflow);
        break;
    }
}

static void set_flag(struct mcs52 *chip, uint8_t flag, uint64_t cycle)
{
    chip->sfr[TCON] |= flag;
    mcs52_requests_of(chip, TCON, cycle);
}

/* OVERFLOWS of timer N, the first in cycle FIRST. */
static void overflow(struct mcs52 *chip, int n, uint64_t overflows, uint64_t first)
{
    if (n == 0) {
        set_flag(chip, TCON_TF0, first);
    } else if (n == 1) {
        chip->t1_is_odd ^= overflows & 1;
        if (mcs52_timer_mode(chip, 0) != 3) {
            set_flag(chip, TCON_TF1, first);
        }
    } else if (is_generator(chip)) {
        if (is_clock_out(chip) && (overflows & 1)) { /* all of one cycle: each is an event */
            mcs52_alternate(chip, 1, P1_T2, !(chip->alternate[1] & P1_T2), first);
        }
    } else {
        chip->sfr[T2CON] |= T2_TF2;
        if (is_up_down(chip)) { /* each overflow is an event then */
            chip->sfr[T2CON] ^= T2_EXF2;
        }
        mcs52_requests_of(chip, T2CON, first - 1);
    }
}

/* COUNTS counts, the first ones in cycle FIRST. */
static void advance(struct mcs52 *chip, int n, uint64_t counts, uint64_t first)
{
    unsigned distance = mcs52_timer_distance(chip, n);

    if (counts < distance) {
        set_value(chip, n, distance - (unsigned)counts);
    } else {
        unsigned period = mcs52_timer_period(chip, n);
        uint64_t beyond = counts - distance, more = beyond / period;

        set_value(chip, n, period - (unsigned)(beyond % period));
        overflow(chip, n, 1 + more, first + (distance - 1) / rate_of(chip, n));
    }
}

/* Mode 3 of timer 0: TH0 is a timer of its own, with TR1 and TF1. */
static bool has_second_half(const struct mcs52 *chip)
{
    return mcs52_timer_mode(chip, 0) == 3 && (chip->sfr[TCON] & TCON_TR1);
}

static void advance_second_half(struct mcs52 *chip, uint64_t counts, uint64_t first)
{
    unsigned distance = 0x100u - chip->sfr[TH0];

    if (counts >= distance) {
        set_flag(chip, TCON_TF1, first + distance - 1);
    }
    chip->sfr[TH0] = (uint8_t)(chip->sfr[TH0] + counts);
}

void mcs52_timer_sync(struct mcs52 *chip, int n, uint64_t through)
{
    uint64_t from = chip->timer_at[n], cycles = through + 1 - from;

    if (through < from || chip->power_down) {
        return;
    }
    chip->timer_at[n] = through + 1;
    if (mcs52_timer_counts_cycles(chip, n)) {
        advance(chip, n, cycles * rate_of(chip, n), from);
    }
    if (n == 0 && has_second_half(chip)) {
        advance_second_half(chip, cycles, from);
    }
}

void mcs52_timers_sync(struct mcs52 *chip, uint64_t through)
{
    for (int n = 0; n < 3; n++) {
        mcs52_timer_sync(chip, n, through);
    }
}

/* A pin's fall is counted in CYCLE. */
void mcs52_timer_count(struct mcs52 *chip, int n, uint64_t cycle)
{
    bool overflows;

    if (!runs(chip, n) || !is_counter(chip, n)) {
        return;
    }
    overflows = mcs52_timer_distance(chip, n) == 1;
    advance(chip, n, 1, cycle);
    if (overflows) {
        mcs52_uart_overflow(chip, n, cycle);
    }
}

/* T2EX falls in CYCLE. */
void mcs52_timer2_pin(struct mcs52 *chip, uint64_t cycle)
{
    if (!(chip->sfr[T2CON] & T2_EXEN2) || is_up_down(chip)) {
        return;
    }
    mcs52_timer_sync(chip, 2, cycle);
    if (!is_generator(chip)) {
        if (chip->sfr[T2CON] & T2_CAPTURE) {
            set_pair(chip, RCAP2H, RCAP2L, pair(chip, TH2, TL2));
        } else {
            set_pair(chip, TH2, TL2, pair(chip, RCAP2H, RCAP2L));
        }
    }
    chip->sfr[T2CON] |= T2_EXF2;
    mcs52_requests_of(chip, T2CON, cycle);
    mcs52_timers_plan(chip);
}

/* --- what is due -------------------------------------------------------------------------- */

static uint64_t overflow_cycle(const struct mcs52 *chip, int n)
{
    return chip->timer_at[n] + (mcs52_timer_distance(chip, n) - 1) / rate_of(chip, n);
}

void mcs52_timers_plan(struct mcs52 *chip)
{
    uint64_t due[3] = {NEVER, NEVER, NEVER};
    uint8_t flags = chip->sfr[TCON];

    if (mcs52_timer_counts_cycles(chip, 0) && !(flags & TCON_TF0)) {
        due[0] = overflow_cycle(chip, 0);
    }
    if (mcs52_timer_mode(chip, 0) == 3) {
        uint64_t second = chip->timer_at[0] + 0xFFu - chip->sfr[TH0];

        if (has_second_half(chip) && !(flags & TCON_TF1) && second < due[0]) {
            due[0] = second;
        }
    } else if (mcs52_timer_counts_cycles(chip, 1) && !(flags & TCON_TF1)) {
        due[1] = overflow_cycle(chip, 1);
    }
    if (mcs52_timer_counts_cycles(chip, 2) &&
        (is_generator(chip) ? is_clock_out(chip)
                            : is_up_down(chip) || !(chip->sfr[T2CON] & T2_TF2))) {
        due[2] = overflow_cycle(chip, 2);
    }
    for (int n = 0; n < 3; n++) {
        mcs52_schedule(chip, (enum event)(EVENT_T0 + n), due[n]);
    }
}
