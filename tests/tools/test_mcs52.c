/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/sim/mcs52, by cases worked out by hand from Intel's MCS-51
 * Microcontroller Family User's Manual ("Intel") and the data sheets of AT89S52 and
 * STC89C51RC/RD+. Each case names its rule. Times are machine cycles. */
#include "mcs52.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

enum {
    P1 = 0x90,
    P3 = 0xB0,
    TCON = 0x88,
    TMOD = 0x89,
    TL0 = 0x8A,
    TH0 = 0x8C,
    SCON = 0x98,
    SBUF = 0x99,
    IE = 0xA8,
    T2CON = 0xC8,
    ACC = 0xE0,
    PCON = 0x87,
    NOP = 0x00,
    MAX_NOTES = 64
};

struct note {
    uint64_t cycle;
    int pin; /* 10 * port + bit */
    int value;
};

static struct mcs52 *chip;
static struct note edges[MAX_NOTES], bytes[MAX_NOTES];
static int edge_count, byte_count, reset_count;
static uint64_t reset_cycle;

static void note_edge(void *user, uint64_t cycle, int port, int bit, bool level)
{
    (void)user;
    if (edge_count < MAX_NOTES) {
        edges[edge_count++] = (struct note){cycle, 10 * port + bit, level};
    }
}

static void note_byte(void *user, uint64_t cycle, uint8_t byte)
{
    (void)user;
    if (byte_count < MAX_NOTES) {
        bytes[byte_count++] = (struct note){cycle, 0, byte};
    }
}

static void note_reset(void *user, uint64_t cycle)
{
    (void)user;
    reset_cycle = cycle;
    reset_count++;
}

static void make_chip(enum mcs52_part part)
{
    const struct mcs52_outside outside = {
        .edge = note_edge, .byte = note_byte, .reset = note_reset};

    mcs52_destroy(chip);
    chip = mcs52_create(part, &outside);
    edge_count = byte_count = reset_count = 0;
}

void setUp(void)
{
    make_chip(MCS52_INTEL);
}

void tearDown(void)
{
    mcs52_destroy(chip);
    chip = NULL;
}

#define LOAD(address, ...)                                                                         \
    mcs52_load(chip, address, (const uint8_t[]){__VA_ARGS__},                                      \
               sizeof((const uint8_t[]){__VA_ARGS__}))

/* --- timers ------------------------------------------------------------------------------- */

/* Intel: in the timer function the register is incremented every machine cycle. */
static void test_that_a_timer_counts_each_cycle(void)
{
    LOAD(0, 0x75, TMOD, 0x01,  /* 0: MOV TMOD, #1 */
         0xD2, 0x8C,           /* 2: SETB TR0 */
         NOP, NOP, 0xE5, TL0); /* 3, 4: NOP, 5: MOV A, TL0 */
    mcs52_run(chip, 6);
    TEST_ASSERT_EQUAL(3, mcs52_sfr(chip, ACC)); /* the cycles 3, 4 and 5 */
}

/* Intel, timer 0 in mode 2: TL0 is reloaded from TH0, and TF0 is set at the overflow. */
static void test_that_mode_2_overflows_every_period(void)
{
    LOAD(0, 0x75, TMOD, 0x02, 0x75, TL0, 0x9C, 0x75, TH0, 0x9C, /* 6 cycles; 256 - 100 */
         0xD2, 0x8C,                                            /* SETB TR0, ends at 7 */
         0x30, 0x8D, 0xFD,                                      /* JNB TF0, $ */
         0xC2, 0x8D, 0xB2, 0x90, 0x80, 0xF7);                   /* CLR TF0; CPL P1.0; SJMP */
    mcs52_watch(chip, 1, 0);
    mcs52_run(chip, 100000);
    for (int i = 2; i < MAX_NOTES; i++) {
        uint64_t period = edges[i].cycle - edges[i - 1].cycle;

        TEST_ASSERT_TRUE(period >= 98 && period <= 102);
    }
    TEST_ASSERT_UINT64_WITHIN(2, 1000, edges[61].cycle - edges[51].cycle);
}

/* Intel: with GATE the timer runs while INT0 is high: it measures a pulse. */
static void test_that_a_gated_timer_measures_a_pulse(void)
{
    mcs52_set_pin(chip, 0, 3, 2, false);
    LOAD(0, 0x75, TMOD, 0x09, 0xD2, 0x8C, 0x80, 0xFE);
    mcs52_set_pin(chip, 1000, 3, 2, true);
    mcs52_set_pin(chip, 6800, 3, 2, false);
    mcs52_run(chip, 10000);
    TEST_ASSERT_EQUAL(5800, mcs52_sfr(chip, TH0) << 8 | mcs52_sfr(chip, TL0));
}

/* Intel: a counter counts falls of its pin; the new count is there in the cycle after. */
static void test_that_a_counter_counts_falls(void)
{
    LOAD(0, 0x75, TMOD, 0x05, 0xD2, 0x8C, 0x80, 0xFE);
    for (int i = 0; i < 7; i++) {
        mcs52_set_pin(chip, 100 + 20 * (uint64_t)i, 3, 4, false);
        mcs52_set_pin(chip, 110 + 20 * (uint64_t)i, 3, 4, true);
    }
    mcs52_run(chip, 1000);
    TEST_ASSERT_EQUAL(7, mcs52_sfr(chip, TL0));
}

/* Intel, timer 2: auto-reload from RCAP2; capture at T2EX. */
static void test_that_timer_2_reloads_and_captures(void)
{
    LOAD(0, 0x75, 0xCB, 0xFF, 0x75, 0xCA, 0x9C, 0x75, 0xCD, 0xFF, 0x75, 0xCC, 0x9C, /* 8 cycles */
         0x75, T2CON, 0x04, 0x80, 0xFE);                                            /* ends at 10 */
    mcs52_run(chip, 10 + 99);
    TEST_ASSERT_EQUAL_HEX8(0x04, mcs52_sfr(chip, T2CON) & 0x84);
    mcs52_run(chip, 10 + 102);
    TEST_ASSERT_EQUAL_HEX8(0x84, mcs52_sfr(chip, T2CON) & 0x84);
    setUp();
    LOAD(0, 0x75, T2CON, 0x0D, 0x80, 0xFE); /* counts from cycle 2 on */
    mcs52_set_pin(chip, 1001, 1, 1, false);
    mcs52_run(chip, 2000);
    TEST_ASSERT_EQUAL(1000, mcs52_sfr(chip, 0xCB) << 8 | mcs52_sfr(chip, 0xCA));
    TEST_ASSERT_EQUAL_HEX8(0x40, mcs52_sfr(chip, T2CON) & 0x40);
}

/* AT89S52, clock out: oscillator / (4 * (65536 - RCAP2)), 50 % duty: with FFF4h an edge every 12
 * states, which are 2 cycles. */
static void test_that_timer_2_puts_out_a_clock(void)
{
    make_chip(MCS52_AT89S52);
    mcs52_watch(chip, 1, 0);
    LOAD(0, 0x75, 0xC9, 0x02, 0x75, 0xCB, 0xFF, 0x75, 0xCA, 0xF4, 0x75, T2CON, 0x04, 0x80, 0xFE);
    mcs52_run(chip, 40000);
    for (int i = 50; i < 60; i++) {
        TEST_ASSERT_EQUAL_UINT64(2, edges[i].cycle - edges[i - 1].cycle);
    }
}

/* --- interrupts --------------------------------------------------------------------------- */

/* Intel, response time: at least three complete cycles between the request and the first
 * instruction of its routine; the LCALL takes two. */
static void test_that_an_interrupt_takes_three_to_eight_cycles(void)
{
    uint64_t least = 100, most = 0;

    for (uint64_t at = 1000; at < 1020; at++) {
        setUp();
        mcs52_watch(chip, 1, 0);
        LOAD(0, 0x02, 0x00, 0x20);
        LOAD(0x20, 0x75, TCON, 0x01, 0x75, IE, 0x81, 0xA4, 0x80, 0xFD); /* MUL; SJMP to it */
        LOAD(3, 0xB2, 0x90, 0x32);                                      /* CPL P1.0; RETI */
        mcs52_set_pin(chip, at, 3, 2, false);
        mcs52_run(chip, 2000);
        TEST_ASSERT_EQUAL(1, edge_count);
        uint64_t latency = edges[0].cycle - 1 - at; /* to the begin of CPL */
        least = latency < least ? latency : least;
        most = latency > most ? latency : most;
    }
    TEST_ASSERT_EQUAL_UINT64(3 + 1, least); /* with the cycle of the request itself */
    TEST_ASSERT_TRUE(most <= 8 + 1);
}

/* --- serial port -------------------------------------------------------------------------- */

/* Intel: T2 as baud rate generator, oscillator / (32 * (65536 - RCAP2)): with FFD9h a bit takes
 * 39 * 16 states or 104 cycles. TI comes with the stop bit. */
static void test_that_a_byte_leaves_bit_by_bit(void)
{
    static const int levels[] = {0, 1, 0, 1, 0, 1}; /* 55h begins 0 1 0 1 0 1 */

    mcs52_watch(chip, 3, 1);
    LOAD(0, 0x75, 0xCB, 0xFF, 0x75, 0xCA, 0xD9, 0x75, 0xCD, 0xFF, 0x75, 0xCC, 0xD9, 0x75, T2CON,
         0x34, 0x75, SCON, 0x40, 0x75, SBUF, 0x55, 0x80, 0xFE);
    mcs52_run(chip, 5000);
    for (int i = 0; i < 6; i++) {
        TEST_ASSERT_EQUAL(levels[i], edges[i].value);
        TEST_ASSERT_EQUAL_UINT64(104 * (uint64_t)i, edges[i].cycle - edges[0].cycle);
    }
    TEST_ASSERT_EQUAL(1, byte_count);
    TEST_ASSERT_EQUAL_HEX8(0x55, bytes[0].value);
    TEST_ASSERT_EQUAL_UINT64(edges[0].cycle + 1040, bytes[0].cycle);
    TEST_ASSERT_EQUAL_HEX8(0x02, mcs52_sfr(chip, SCON) & 0x02);
}

static void test_that_a_byte_comes_in(void)
{
    LOAD(0, 0x75, 0xCB, 0xFF, 0x75, 0xCA, 0xD9, 0x75, T2CON, 0x34, 0x75, SCON, 0x50, 0x80, 0xFE);
    mcs52_run(chip, 500000); /* timer 2 has come to its first reload */
    mcs52_feed(chip, 500100, 0xA7, 104.1667);
    mcs52_run(chip, 503000);
    TEST_ASSERT_EQUAL_HEX8(0x51, mcs52_sfr(chip, SCON) & 0x51);
    TEST_ASSERT_EQUAL_HEX8(0xA7, mcs52_sfr(chip, SBUF));
}

/* --- ports, power, watchdogs -------------------------------------------------------------- */

/* Intel: read-modify-write takes the latch, all else the pin. */
static void test_that_a_port_is_latch_and_pin(void)
{
    mcs52_set_pin(chip, 0, 1, 3, false);
    LOAD(0, 0xE5, P1, 0xB2, 0x90, 0x80, 0xFE); /* MOV A, P1; CPL P1.0 */
    mcs52_run(chip, 10);
    TEST_ASSERT_EQUAL_HEX8(0xF7, mcs52_sfr(chip, ACC));
    TEST_ASSERT_EQUAL_HEX8(0xFE, mcs52_sfr(chip, P1));
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 3));
}

/* Intel: an enabled interrupt ends idle, and RETI leads to the instruction after. */
static void test_that_an_interrupt_ends_idle(void)
{
    LOAD(0, 0x02, 0x00, 0x20);
    LOAD(3, 0x05, 0x30, 0x32); /* INC 30h; RETI */
    LOAD(0x20, 0x75, TCON, 0x01, 0x75, IE, 0x81, 0x75, PCON, 0x01, 0x05, 0x31, 0x80, 0xFE);
    mcs52_run(chip, 1000);
    TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
    mcs52_set_pin(chip, 1500, 3, 2, false);
    mcs52_run(chip, 2000);
    TEST_ASSERT_FALSE(mcs52_is_asleep(chip));
    TEST_ASSERT_EQUAL(1, mcs52_ram(chip)[0x30]);
    TEST_ASSERT_EQUAL(1, mcs52_ram(chip)[0x31]);
}

/* Atmel: the watchdog counts 14 bits from 1Eh, E1h on; RAM outlives the reset. */
static void test_that_the_at89s52_watchdog_bites(void)
{
    make_chip(MCS52_AT89S52);
    LOAD(0, 0x75, 0x30, 0x77, 0x75, 0xA6, 0x1E, 0x75, 0xA6, 0xE1, 0x80, 0xFE);
    mcs52_run(chip, 16384 + 5);
    TEST_ASSERT_EQUAL(0, reset_count);
    mcs52_run(chip, 16384 + 8);
    TEST_ASSERT_EQUAL(1, reset_count);
    TEST_ASSERT_EQUAL(MCS52_WATCHDOG, mcs52_reset_cause(chip));
    TEST_ASSERT_EQUAL_HEX8(0x77, mcs52_ram(chip)[0x30]);
}

/* STC: 12 * prescaler * 32768 clocks, prescaler 2 for PS = 0; WDT_FLAG says so after the reset. */
static void test_that_the_stc89_watchdog_bites(void)
{
    make_chip(MCS52_STC89);
    LOAD(0, 0x75, 0xE1, 0x30, 0x80, 0xFE);
    mcs52_run(chip, 65536);
    TEST_ASSERT_EQUAL(0, reset_count);
    mcs52_run(chip, 65536 + 5); /* bitten at 65,538; the program would clear the flag at 65,542 */
    TEST_ASSERT_EQUAL(1, reset_count);
    TEST_ASSERT_EQUAL_HEX8(0x80, mcs52_sfr(chip, 0xE1) & 0x80);
}

/* --- faults, checkpoints, any code -------------------------------------------------------- */

static void test_that_bits_flip_and_stick(void)
{
    const struct mcs52_fault flip = {
        .kind = MCS52_FLIP, .place = MCS52_IN_RAM, .address = 0x40, .bit = 3, .when = 500};
    const struct mcs52_fault stuck = {.kind = MCS52_STUCK_HIGH,
                                      .place = MCS52_IN_REGISTER,
                                      .address = 2,
                                      .bit = 7,
                                      .counts_instructions = true,
                                      .when = 10};
    const struct mcs52_fault wrong = {.kind = MCS52_FLIP, .place = MCS52_IN_SFR, .address = 0x40};

    LOAD(0, 0x7A, 0x00, 0x80, 0xFC); /* MOV R2, #0; SJMP to it */
    TEST_ASSERT_TRUE(mcs52_inject(chip, &flip));
    TEST_ASSERT_TRUE(mcs52_inject(chip, &stuck));
    TEST_ASSERT_FALSE(mcs52_inject(chip, &wrong));
    mcs52_run(chip, 1001);
    TEST_ASSERT_EQUAL_HEX8(0x08, mcs52_ram(chip)[0x40]);
    mcs52_step(chip);
    mcs52_step(chip);
    mcs52_step(chip);
    TEST_ASSERT_EQUAL_HEX8(0x80, mcs52_ram(chip)[2] & 0x80);
}

/* Random code runs to the end. Run in two parts, it ends in the same state. */
static void test_that_any_code_runs(void)
{
    static uint8_t code[MCS52_CODE_BYTES];
    uint32_t seed = 1;

    for (int round = 0; round < 60; round++) {
        struct mcs52 *other;

        make_chip((enum mcs52_part)(round % 3));
        for (size_t i = 0; i < sizeof code; i++) {
            seed = seed * 1664525 + 1013904223;
            code[i] = (uint8_t)(seed >> 24);
        }
        mcs52_load(chip, 0, code, sizeof code);
        for (int port = 0; port < 4; port++) {
            for (int bit = 0; bit < 8; bit++) {
                mcs52_watch(chip, port, bit);
            }
        }
        for (uint64_t i = 0; i < 500; i++) {
            seed = seed * 1664525 + 1013904223;
            mcs52_set_pin(chip, i * 40 + (seed >> 28), (int)(seed >> 24 & 3), (int)(seed >> 20 & 7),
                          seed >> 16 & 1);
        }
        other = mcs52_create(MCS52_INTEL, NULL);
        mcs52_copy(other, chip);
        mcs52_run(chip, 20000);
        for (uint64_t cycle = 0; cycle < 20000; cycle += 77) {
            mcs52_run(other, cycle);
        }
        mcs52_run(other, 20000);
        TEST_ASSERT_TRUE_MESSAGE(mcs52_equal(chip, other), "cut runs differ");
        mcs52_destroy(other);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_timer_counts_each_cycle);
    RUN_TEST(test_that_mode_2_overflows_every_period);
    RUN_TEST(test_that_a_gated_timer_measures_a_pulse);
    RUN_TEST(test_that_a_counter_counts_falls);
    RUN_TEST(test_that_timer_2_reloads_and_captures);
    RUN_TEST(test_that_timer_2_puts_out_a_clock);
    RUN_TEST(test_that_an_interrupt_takes_three_to_eight_cycles);
    RUN_TEST(test_that_a_byte_leaves_bit_by_bit);
    RUN_TEST(test_that_a_byte_comes_in);
    RUN_TEST(test_that_a_port_is_latch_and_pin);
    RUN_TEST(test_that_an_interrupt_ends_idle);
    RUN_TEST(test_that_the_at89s52_watchdog_bites);
    RUN_TEST(test_that_the_stc89_watchdog_bites);
    RUN_TEST(test_that_bits_flip_and_stick);
    RUN_TEST(test_that_any_code_runs);
    return UNITY_END();
}
