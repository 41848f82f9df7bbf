/* SPDX-License-Identifier: MIT */
/* Ports: a pin is high when the latch, the outside and the alternate function all let it be ([I],
 * port structures and operation; open pins of port 0 count as pulled up). Changes of input pins
 * reach interrupts, timers and the serial port here. */
#include "mcs52_inside.h"

#include <math.h>

static uint8_t level_of(const struct mcs52 *chip, int port)
{
    uint8_t own = chip->sfr[P0 + 16 * port] & chip->outside_pins[port] & chip->alternate[port];
    uint8_t level = (own | chip->shorted_high[port]) & (uint8_t)~chip->shorted_low[port];
    uint8_t tied = chip->tied[port];

    return (level & tied) == tied ? level : level & (uint8_t)~tied;
}

static void report(struct mcs52 *chip, int port, uint8_t changed, uint64_t cycle)
{
    changed &= chip->watched[port];
    for (int bit = 0; changed != 0; bit++, changed >>= 1) {
        if (changed & 1) {
            chip->outside.edge(chip->outside.user, cycle, port, bit, chip->pins[port] >> bit & 1);
        }
    }
}

/* --- what pins do ------------------------------------------------------------------------- */

void mcs52_pins_follow(struct mcs52 *chip, uint64_t cycle)
{
    static const struct {
        uint8_t pin, type, flag;
    } inputs[] = {{P3_INT0, TCON_IT0, TCON_IE0}, {P3_INT1, TCON_IT1, TCON_IE1}};

    for (int i = 0; i < 2; i++) {
        if (!(chip->sfr[TCON] & inputs[i].type)) {
            bool is_low = !(chip->pins[3] & inputs[i].pin);
            uint8_t others = chip->sfr[TCON] & (uint8_t)~inputs[i].flag;

            chip->sfr[TCON] = (uint8_t)(others | (is_low ? inputs[i].flag : 0));
        }
    }
    mcs52_requests_of(chip, TCON, cycle);
}

/* A timer that counts this pin's falls does so in the next cycle. */
static void count_fall(struct mcs52 *chip, bool is_counter, int n, uint64_t cycle)
{
    if (is_counter) {
        mcs52_schedule(chip, (enum event)(EVENT_COUNT_0 + n), cycle + 1);
    }
}

static void port3_changed(struct mcs52 *chip, uint8_t changed, uint64_t cycle)
{
    uint8_t falls = changed & (uint8_t)~chip->pins[3];

    if (changed & (P3_INT0 | P3_INT1)) {
        chip->sfr[TCON] |= (uint8_t)((falls & P3_INT0 ? TCON_IE0 : 0) | /* by edge */
                                     (falls & P3_INT1 ? TCON_IE1 : 0));
        mcs52_pins_follow(chip, cycle);
    }
    if (falls & P3_T0) {
        count_fall(chip, chip->sfr[TMOD] & TMOD_CT, 0, cycle);
    }
    if (falls & P3_T1) {
        count_fall(chip, chip->sfr[TMOD] >> 4 & TMOD_CT, 1, cycle);
    }
    if (falls & P3_RXD) {
        mcs52_uart_fall(chip, cycle);
    }
}

static void port1_changed(struct mcs52 *chip, uint8_t changed, uint64_t cycle)
{
    uint8_t falls = changed & (uint8_t)~chip->pins[1];

    if (falls & P1_T2) {
        count_fall(chip, chip->sfr[T2CON] & T2_CT2, 2, cycle);
    }
    if (falls & P1_T2EX) {
        mcs52_timer2_pin(chip, cycle);
    }
}

/* [A], [S]: an enabled external interrupt ends power-down. */
bool mcs52_pins_wake(const struct mcs52 *chip)
{
    uint8_t enabled =
        (uint8_t)((chip->sfr[IE] & 1 ? P3_INT0 : 0) | (chip->sfr[IE] & 4 ? P3_INT1 : 0));

    return chip->power_down && !chip->clock_stands && chip->part != MCS52_INTEL &&
           (chip->sfr[IE] & IE_EA) && (enabled & ~level_of(chip, 3)) != 0;
}

/* Takes over what the latch, the outside and the alternate function make of the pins from CYCLE on.
 */
void mcs52_pins_update(struct mcs52 *chip, int port, uint64_t cycle)
{
    uint8_t changed = chip->pins[port] ^ level_of(chip, port);
    bool gates =
        (port == 3 && (changed & (P3_INT0 | P3_INT1))) || (port == 1 && (changed & P1_T2EX));

    if (changed == 0) {
        return;
    }
    if (mcs52_pins_wake(chip)) {
        mcs52_wake(chip, cycle);
    }
    gates = gates && !chip->power_down;
    if (gates) {
        mcs52_uart_advance(chip, cycle);
        mcs52_timers_sync(chip, cycle - 1);
    }
    chip->pins[port] ^= changed;
    report(chip, port, changed, cycle);
    if (chip->power_down) {
        return;
    }
    if (port == 3) {
        port3_changed(chip, changed, cycle);
    } else if (port == 1) {
        port1_changed(chip, changed, cycle);
    }
    if (gates) {
        mcs52_timers_plan(chip);
        mcs52_uart_plan(chip, cycle);
    }
}

void mcs52_pins_release(struct mcs52 *chip)
{
    for (int port = 0; port < 4; port++) {
        chip->sfr[P0 + 16 * port] = chip->alternate[port] = 0xFF;
        mcs52_pins_update(chip, port, chip->now);
    }
}

void mcs52_alternate(struct mcs52 *chip, int port, uint8_t mask, bool level, uint64_t cycle)
{
    uint8_t others = chip->alternate[port] & (uint8_t)~mask;

    chip->alternate[port] = (uint8_t)(others | (level ? mask : 0));
    mcs52_pins_update(chip, port, cycle);
}

/* --- the outside -------------------------------------------------------------------------- */

static struct pin_change *queued(struct mcs52 *chip, unsigned n)
{
    return &chip->queue[(chip->queue_first + n) % MCS52_PIN_QUEUE];
}

bool mcs52_set_pin(struct mcs52 *chip, uint64_t cycle, int port, int bit, bool level)
{
    struct pin_change change = {
        .port = (uint8_t)port, .mask = (uint8_t)(1u << bit), .level = level};
    unsigned n = chip->queue_count;

    if (n == MCS52_PIN_QUEUE) {
        return false;
    }
    change.cycle = cycle > chip->now ? cycle : chip->now;
    for (; n > 0 && queued(chip, n - 1)->cycle > change.cycle; n--) {
        *queued(chip, n) = *queued(chip, n - 1);
    }
    *queued(chip, n) = change;
    chip->queue_count++;
    mcs52_schedule(chip, EVENT_PIN, queued(chip, 0)->cycle);
    return true;
}

uint64_t mcs52_feed(struct mcs52 *chip, uint64_t cycle, uint8_t byte, double bit_cycles)
{
    unsigned bits = 0x200u | (unsigned)byte << 1;
    enum { BITS = 10 };

    if (chip->queue_count + BITS > MCS52_PIN_QUEUE) {
        return 0;
    }
    for (int i = 0; i < BITS; i++) {
        if (i == 0 || ((bits >> i ^ bits >> (i - 1)) & 1)) {
            mcs52_set_pin(chip, cycle + (uint64_t)llround(i * bit_cycles), 3, 0, bits >> i & 1);
        }
    }
    return cycle + (uint64_t)llround(BITS * bit_cycles);
}

/* All changes of one cycle are one: a pin is sampled once a cycle. */
void mcs52_pins_event(struct mcs52 *chip, uint64_t cycle)
{
    while (chip->queue_count > 0 && queued(chip, 0)->cycle <= cycle) {
        const struct pin_change *change = queued(chip, 0);
        uint8_t *outside = &chip->outside_pins[change->port];

        *outside = (uint8_t)(change->level ? *outside | change->mask : *outside & ~change->mask);
        chip->queue_first = (chip->queue_first + 1) % MCS52_PIN_QUEUE;
        chip->queue_count--;
    }
    for (int port = 0; port < 4; port++) {
        mcs52_pins_update(chip, port, cycle);
    }
    mcs52_schedule(chip, EVENT_PIN, chip->queue_count > 0 ? queued(chip, 0)->cycle : NEVER);
}

void mcs52_watch(struct mcs52 *chip, int port, int bit)
{
    if (chip->outside.edge != NULL) {
        chip->watched[port] |= (uint8_t)(1u << bit);
    }
}

bool mcs52_pin(const struct mcs52 *chip, int port, int bit)
{
    return chip->pins[port] >> bit & 1;
}
