/* SPDX-License-Identifier: MIT */
/* The serial port, bit by bit ([I], serial interface).
 *
 * Modes 1 to 3 send and receive with clocks of sixteen times the baud rate. Their ticks come at a
 * state (a sixth of a cycle) and are not simulated one by one: a clock says when its next tick
 * comes and how far apart they are; only roll-overs in a frame and the samples of a bit are events.
 */
#include "mcs52_inside.h"

enum {
    STATES = 6, /* a cycle */
    TICKS = 16, /* a bit */
    FIRST_SAMPLE = 7,
    SAMPLES = 3,
    LAST_SAMPLE = FIRST_SAMPLE + SAMPLES - 1,
    DETECT = 1, /* positions of the receiver */
    START_BIT = 2,
    LAST_BIT = 11,
    AFTER_FRAME = 12
};

static unsigned mode(const struct mcs52 *chip)
{
    return chip->sfr[SCON] >> 6;
}

/* Bits of a frame but the start bit: 8 data bits, in modes 2 and 3 the ninth, the stop bit. */
static unsigned frame_bits(const struct mcs52 *chip)
{
    return mode(chip) == 1 ? 9 : 10;
}

static void set_flags(struct mcs52 *chip, uint8_t flags, uint64_t cycle)
{
    chip->sfr[SCON] |= flags;
    mcs52_requests_of(chip, SCON, cycle);
}

/* --- the two clocks ----------------------------------------------------------------------- */

static bool by_timer2(const struct mcs52 *chip, const struct baud *clock)
{
    return chip->sfr[T2CON] & (clock == &chip->tx_clock ? T2_TCLK : T2_RCLK);
}

static void stop_clock(struct baud *clock)
{
    clock->next_state = NEVER;
    clock->period = 1;
}

static void from_timer2(struct mcs52 *chip, struct baud *clock)
{
    if (!mcs52_timer_counts_cycles(chip, 2)) {
        stop_clock(clock);
        return;
    }
    clock->next_state = STATES * chip->timer_at[2] + mcs52_timer_distance(chip, 2) - 1;
    clock->period = mcs52_timer_period(chip, 2);
}

/* Every overflow of timer 1, or with SMOD = 0 every other one. */
static void from_timer1(struct mcs52 *chip, struct baud *clock)
{
    uint64_t period = STATES * (uint64_t)mcs52_timer_period(chip, 1);
    bool halved = !(chip->sfr[PCON] & PCON_SMOD);

    if (!mcs52_timer_counts_cycles(chip, 1)) {
        stop_clock(clock);
        return;
    }
    clock->next_state = STATES * (chip->timer_at[1] + mcs52_timer_distance(chip, 1) - 1);
    if (halved && !chip->t1_is_odd) {
        clock->next_state += period;
    }
    clock->period = halved ? 2 * period : period;
}

static void set_clock(struct mcs52 *chip, struct baud *clock, uint64_t end)
{
    if (mode(chip) == 0) {
        stop_clock(clock);
    } else if (mode(chip) == 2) { /* the oscillator / 64 or 32 */
        clock->next_state = STATES * end;
        clock->period = chip->sfr[PCON] & PCON_SMOD ? 1 : 2;
    } else if (by_timer2(chip, clock)) {
        from_timer2(chip, clock);
    } else {
        from_timer1(chip, clock);
    }
}

/* Takes the ticks before cycle END. */
static void advance(struct baud *clock, uint64_t end)
{
    if (clock->next_state < STATES * end) {
        uint64_t ticks = 1 + (STATES * end - 1 - clock->next_state) / clock->period;

        clock->next_state += ticks * clock->period;
        clock->phase = (clock->phase + ticks) % TICKS;
    }
}

static void advance_by(struct baud *clock, unsigned ticks)
{
    if (clock->next_state != NEVER) {
        clock->next_state += ticks * clock->period;
    }
    clock->phase = (clock->phase + ticks) % TICKS;
}

static uint64_t cycle_of_tick(const struct baud *clock, unsigned ticks)
{
    return clock->next_state == NEVER ? NEVER
                                      : (clock->next_state + (ticks - 1) * clock->period) / STATES;
}

/* --- what is due -------------------------------------------------------------------------- */

/* Ticks until the receiver has to do something. */
static unsigned rx_ticks(const struct mcs52 *chip)
{
    if (chip->rx_position == DETECT) {
        return 1;
    }
    if (chip->rx_position == AFTER_FRAME) {
        return (LAST_SAMPLE - 1 - chip->rx_clock.phase) % TICKS + 1;
    }
    return (FIRST_SAMPLE + chip->rx_sample - chip->rx_clock.phase) % TICKS;
}

static void plan_tx(struct mcs52 *chip)
{
    if (mode(chip) != 0 && chip->tx_position > 0 && !chip->tx_rolled) {
        uint64_t at = cycle_of_tick(&chip->tx_clock, TICKS - chip->tx_clock.phase);

        mcs52_schedule(chip, EVENT_TX, at == NEVER ? NEVER : at + 1);
    }
}

static void plan_rx(struct mcs52 *chip)
{
    if (mode(chip) != 0) {
        mcs52_schedule(chip, EVENT_RX,
                       chip->rx_position > 0 ? cycle_of_tick(&chip->rx_clock, rx_ticks(chip))
                                             : NEVER);
    }
}

/* The tick at which the phase of the sending clock becomes 0; what it leads to is due a cycle
 * later. */
static void roll_over(struct mcs52 *chip)
{
    advance_by(&chip->tx_clock, TICKS - chip->tx_clock.phase);
    chip->tx_rolled = true;
}

/* Before the source of a clock changes at END: all ticks of the old one. */
void mcs52_uart_advance(struct mcs52 *chip, uint64_t end)
{
    if (mode(chip) != 0 && chip->due[EVENT_TX] <= end && !chip->tx_rolled) {
        roll_over(chip);
    }
    advance(&chip->tx_clock, end);
    advance(&chip->rx_clock, end);
}

/* After it. */
void mcs52_uart_plan(struct mcs52 *chip, uint64_t end)
{
    set_clock(chip, &chip->tx_clock, end);
    set_clock(chip, &chip->rx_clock, end);
    plan_tx(chip);
    plan_rx(chip);
}

/* A timer that counts a pin has overflowed: a tick for the clocks that it drives. */
void mcs52_uart_overflow(struct mcs52 *chip, int timer, uint64_t cycle)
{
    bool ticks = timer == 2 || (chip->sfr[PCON] & PCON_SMOD) || !chip->t1_is_odd;

    if (timer == 0 || !ticks || !(mode(chip) & 1)) {
        return;
    }
    if (by_timer2(chip, &chip->tx_clock) == (timer == 2)) {
        advance_by(&chip->tx_clock, 1);
        if (chip->tx_clock.phase == 0 && chip->tx_position > 0) {
            chip->tx_rolled = true;
            mcs52_schedule(chip, EVENT_TX, cycle + 1);
        }
    }
    if (by_timer2(chip, &chip->rx_clock) == (timer == 2) && chip->rx_position > 0) {
        if (rx_ticks(chip) == 1) {
            mcs52_uart_rx(chip, cycle);
        } else {
            advance_by(&chip->rx_clock, 1);
        }
    }
}

void mcs52_uart_shift(struct mcs52 *chip, uint64_t cycles)
{
    if (chip->tx_clock.next_state != NEVER) {
        chip->tx_clock.next_state += STATES * cycles;
    }
    if (chip->rx_clock.next_state != NEVER) {
        chip->rx_clock.next_state += STATES * cycles;
    }
}

/* --- sending ------------------------------------------------------------------------------ */

static void set_txd(struct mcs52 *chip, bool level, uint64_t cycle)
{
    mcs52_alternate(chip, 3, P3_TXD, level, cycle);
}

static void report_byte(struct mcs52 *chip, uint64_t cycle)
{
    chip->tx_position = 0;
    if (chip->outside.byte != NULL) {
        chip->outside.byte(chip->outside.user, cycle, chip->tx_byte);
    }
}

/* The shift register takes the byte of SBUF. */
static void load(struct mcs52 *chip)
{
    chip->tx_waits = false;
    chip->tx_byte = chip->tx_next;
    chip->tx_bits = (uint16_t)(0x400 | (chip->tx_next_ninth ? 0x200 : 0) | chip->tx_byte << 1);
    chip->tx_position = 1;
}

/* Mode 0: one bit a cycle on RXD, a low pulse of TXD within each; position N is bit N-1. */
static void tx_shift(struct mcs52 *chip, uint64_t cycle)
{
    if (chip->tx_position > 8) {
        mcs52_alternate(chip, 3, P3_RXD, true, cycle);
        set_flags(chip, SCON_TI, cycle);
        report_byte(chip, cycle);
        return;
    }
    mcs52_alternate(chip, 3, P3_RXD, chip->tx_byte >> (chip->tx_position - 1) & 1, cycle);
    set_txd(chip, false, cycle);
    set_txd(chip, true, cycle);
    chip->tx_position++;
    mcs52_schedule(chip, EVENT_TX, cycle + 1);
}

/* S1P1 of the cycle after a roll-over: the next bit; with the stop bit comes TI. */
static void tx_bit(struct mcs52 *chip, uint64_t cycle)
{
    unsigned stop = 1 + frame_bits(chip);

    if (chip->tx_position > stop) {
        report_byte(chip, cycle);
        if (!chip->tx_waits) {
            return;
        }
        load(chip);
    }
    set_txd(chip, chip->tx_bits & 1, cycle);
    chip->tx_bits >>= 1;
    if (chip->tx_position == stop) {
        set_flags(chip, SCON_TI, cycle);
    }
    chip->tx_position++;
    plan_tx(chip);
}

void mcs52_uart_tx(struct mcs52 *chip, uint64_t cycle)
{
    chip->due[EVENT_TX] = NEVER;
    if (mode(chip) == 0) {
        tx_shift(chip, cycle);
        return;
    }
    if (!chip->tx_rolled) {
        roll_over(chip);
    }
    chip->tx_rolled = false;
    tx_bit(chip, cycle);
}

/* A write to SBUF. During the stop bit it waits for the stop bit's end; earlier in a frame it
 * breaks that off. The new frame begins at the next roll-over. */
void mcs52_uart_send(struct mcs52 *chip, uint8_t byte, uint64_t end)
{
    mcs52_uart_advance(chip, end);
    if (chip->tx_rolled) { /* before the write, so it is still the earlier frame's */
        mcs52_uart_tx(chip, end);
    }
    chip->tx_next = byte;
    chip->tx_next_ninth = mode(chip) == 1 || (chip->sfr[SCON] & SCON_TB8);
    if (mode(chip) != 0 && chip->tx_position > 1 + frame_bits(chip)) {
        chip->tx_waits = true;
        return;
    }
    load(chip);
    if (mode(chip) == 0) {
        mcs52_schedule(chip, EVENT_TX, end + 1);
    }
    plan_tx(chip);
}

/* --- receiving ---------------------------------------------------------------------------- */

/* RXD falls: if the receiver looks for a start bit, it sees that at its next tick. */
void mcs52_uart_fall(struct mcs52 *chip, uint64_t cycle)
{
    if (mode(chip) != 0 && (chip->sfr[SCON] & SCON_REN) && chip->rx_position == 0) {
        advance(&chip->rx_clock, cycle);
        chip->rx_position = DETECT;
        plan_rx(chip);
    }
}

/* The ninth bit, or in mode 1 the stop bit, is in: the byte is kept or lost. */
static void finish(struct mcs52 *chip, bool ninth, uint64_t cycle)
{
    uint8_t control = chip->sfr[SCON];

    if (!(control & SCON_RI) && (!(control & SCON_SM2) || ninth)) {
        chip->sfr[SBUF] = (uint8_t)chip->rx_bits;
        chip->sfr[SCON] &= (uint8_t)~SCON_RB8;
        set_flags(chip, ninth ? SCON_RI | SCON_RB8 : SCON_RI, cycle);
    }
    chip->rx_position = mode(chip) == 1 ? 0 : AFTER_FRAME;
}

static void rx_bit(struct mcs52 *chip, bool bit, uint64_t cycle)
{
    if (chip->rx_position == LAST_BIT) {
        finish(chip, bit, cycle);
    } else if (chip->rx_position == START_BIT && bit) {
        chip->rx_position = 0; /* a spike */
    } else {
        chip->rx_bits = (uint16_t)(chip->rx_bits >> 1 | (bit ? 0x80 : 0));
        chip->rx_position++;
    }
}

static void rx_sampled(struct mcs52 *chip, bool level, uint64_t cycle)
{
    chip->rx_ones = (uint8_t)(chip->rx_ones + level);
    if (++chip->rx_sample == SAMPLES) {
        bool bit = chip->rx_ones >= 2;

        chip->rx_sample = chip->rx_ones = 0;
        rx_bit(chip, bit, cycle);
    }
}

/* Mode 0: a bit a cycle from RXD; position N takes bit N-1. */
static void rx_shift(struct mcs52 *chip, bool level, uint64_t cycle)
{
    if (chip->rx_position > 8) {
        chip->rx_position = 0;
        chip->sfr[SBUF] = (uint8_t)chip->rx_bits;
        set_flags(chip, SCON_RI, cycle);
        return;
    }
    chip->rx_bits = (uint16_t)(chip->rx_bits >> 1 | (level ? 0x80 : 0));
    chip->rx_position++;
    mcs52_schedule(chip, EVENT_RX, cycle + 1);
}

void mcs52_uart_rx(struct mcs52 *chip, uint64_t cycle)
{
    bool level = chip->pins[3] & P3_RXD;

    if (mode(chip) == 0) {
        rx_shift(chip, level, cycle);
        return;
    }
    advance_by(&chip->rx_clock, rx_ticks(chip));
    if (chip->rx_position == DETECT) {
        chip->rx_position = level ? 0 : START_BIT;
        chip->rx_sample = chip->rx_ones = 0;
        chip->rx_clock.phase = 0;
    } else if (chip->rx_position == AFTER_FRAME) {
        chip->rx_position = 0;
    } else {
        rx_sampled(chip, level, cycle);
    }
    plan_rx(chip);
}

/* --- control ------------------------------------------------------------------------------ */

void mcs52_uart_break(struct mcs52 *chip, uint64_t cycle)
{
    chip->tx_position = chip->rx_position = 0;
    chip->tx_waits = chip->tx_rolled = false;
    chip->due[EVENT_TX] = chip->due[EVENT_RX] = NEVER;
    mcs52_alternate(chip, 3, P3_RXD | P3_TXD, true, cycle);
}

/* SCON was OLD until END. */
void mcs52_uart_control(struct mcs52 *chip, uint8_t old, uint64_t end)
{
    uint8_t control = chip->sfr[SCON];

    if ((old ^ control) & SCON_MODE) {
        mcs52_uart_break(chip, end);
    }
    if (!(control & SCON_REN)) {
        chip->rx_position = 0;
        chip->due[EVENT_RX] = NEVER;
    } else if (mode(chip) == 0 && !(control & SCON_RI) && chip->rx_position == 0) {
        chip->rx_position = 1;
        mcs52_schedule(chip, EVENT_RX, end + 1);
    }
}
