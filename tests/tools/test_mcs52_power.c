/* SPDX-License-Identifier: MIT */
/* Under test: reset, idle, power-down, the watchdogs, ports and the rest of
 * tools/drive/sim/mcs52, by cases worked out by hand from Intel's MCS-51 Microcontroller Family
 * User's Manual ("Intel") and the data sheets of AT89S52 ("Atmel") and STC89C51RC/RD+ ("STC"). */
#include "mcs52_chip.h"

enum {
    PD = 0x02,
    IDL = 0x01,
    POF = 0x10,
    EN_WDT = 0x20,
    CLR_WDT = 0x10,
    IDL_WDT = 0x08,
    WDT_FLAG = 0x80,
    WDIDLE = 0x10,
    AT89S52_MC = 16384,
    STC89_MC = 65536 /* with a prescaler of 2 */
};

/* Runs these two bytes' writes where the chip stands, and takes them out of its way again. */
static void write_twice(uint8_t address, uint8_t first, uint8_t second)
{
    uint16_t pc = mcs52_pc(chip);

    LOAD(pc, MOV_DIRECT, address, first, MOV_DIRECT, address, second);
    mcs52_run(chip, mcs52_cycles(chip) + 4);
    LOAD(pc, NOP, NOP, NOP, NOP, NOP, NOP);
}

static void feed_at89s52(void)
{
    write_twice(WDTRST, 0x1E, 0xE1);
}

static void write_stc89(unsigned value)
{
    write_twice(WDT_CONTR, (uint8_t)value, (uint8_t)value);
}

/* --- reset ---------------------------------------------------------------------------------- */

/* Intel: reset values; RAM outlives a reset. */
static void test_that_reset_gives_each_register_its_value(void)
{
    static const uint8_t zero[] = {ACC, 0xF0, PSW, 0x82, 0x83, TCON, TMOD,
                                   TL0, TH0,  IE,  IP,   SCON, T2CON};

    set(SBUF, 0x5A);
    LOAD(0, MOV_DIRECT, 0x30, 0x12, MOV_DIRECT, SP, 0x60, MOV_DIRECT, IE, 0x85, MOV_DIRECT, TCON,
         0x55, 0x74, 0x99);
    mcs52_run(chip, 20);
    TEST_ASSERT_EQUAL_HEX8(0x99, sfr(ACC));
    mcs52_reset(chip);
    TEST_ASSERT_EQUAL(MCS52_PIN, mcs52_reset_cause(chip));
    TEST_ASSERT_EQUAL_HEX16(0, mcs52_pc(chip));
    TEST_ASSERT_EQUAL_HEX8(7, sfr(SP));
    for (size_t i = 0; i < sizeof zero; i++) {
        TEST_ASSERT_EQUAL_HEX8(0, sfr(zero[i]));
    }
    for (int port = 0; port < 4; port++) {
        TEST_ASSERT_EQUAL_HEX8(0xFF, sfr((uint8_t)(P0 + 16 * port)));
    }
    TEST_ASSERT_EQUAL_HEX8(0x12, mcs52_ram(chip)[0x30]);
    TEST_ASSERT_EQUAL_HEX8(0x5A, sfr(SBUF));
}

/* Each latch that was low rises once, at the reset; what the outside does later stays planned. */
static void test_that_a_reset_lets_the_pins_rise(void)
{
    for (int port = 0; port < 4; port++) {
        for (int bit = 0; bit < 8; bit++) {
            mcs52_watch(chip, port, bit);
        }
    }
    set(P1, 0xFE);
    set(P3, 0x7F);
    mcs52_set_pin(chip, 100, 3, 2, false);
    mcs52_run(chip, 50);
    edge_count = 0;
    mcs52_reset(chip);
    mcs52_run(chip, 200);
    TEST_ASSERT_EQUAL(3, edge_count);
    TEST_ASSERT_EQUAL(10, edges[0].pin);
    TEST_ASSERT_EQUAL(37, edges[1].pin);
    TEST_ASSERT_EQUAL(32, edges[2].pin);
    TEST_ASSERT_EQUAL_UINT64(50, edges[0].cycle);
    TEST_ASSERT_EQUAL_UINT64(50, edges[1].cycle);
    TEST_ASSERT_EQUAL_UINT64(100, edges[2].cycle);
    TEST_ASSERT_EQUAL(0, edges[2].value);
    mcs52_reset(chip);
    TEST_ASSERT_EQUAL_HEX8(0x02, sfr(TCON)); /* INT0 is low, by level */
}

/* Atmel: POF is set when power comes up and stays through a reset. Intel's part has none. */
static void test_that_pof_tells_power_from_reset(void)
{
    TEST_ASSERT_EQUAL_HEX8(0, sfr(PCON) & POF);
    make_chip(MCS52_AT89S52);
    TEST_ASSERT_EQUAL(MCS52_POWER, mcs52_reset_cause(chip));
    TEST_ASSERT_EQUAL_HEX8(POF, sfr(PCON));
    set(PCON, POF | 0x8C | IDL);
    mcs52_reset(chip);
    TEST_ASSERT_EQUAL_HEX8(POF, sfr(PCON));
    set(PCON, 0x8C | IDL);
    mcs52_reset(chip);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(PCON));
}

/* --- watchdogs ------------------------------------------------------------------------------ */

/* Atmel: 1Eh and E1h in sequence to WDTRST start it and feed it; it counts 14 bits. RAM outlives
 * the reset. */
static void test_that_the_at89s52_watchdog_bites(void)
{
    make_chip(MCS52_AT89S52);
    feed_at89s52();
    mcs52_ram(chip)[0x30] = 0x77;
    mcs52_run(chip, 4 + AT89S52_MC - 10);
    feed_at89s52();
    uint64_t fed = mcs52_cycles(chip);
    mcs52_run(chip, fed + 1000);
    set(SCON, 0x40); /* no matter to it */
    mcs52_run(chip, fed + AT89S52_MC - 1);
    TEST_ASSERT_EQUAL(0, reset_count);
    mcs52_run(chip, fed + AT89S52_MC);
    TEST_ASSERT_EQUAL(1, reset_count);
    TEST_ASSERT_EQUAL_UINT64(fed + AT89S52_MC, reset_cycle);
    TEST_ASSERT_EQUAL(MCS52_WATCHDOG, mcs52_reset_cause(chip));
    TEST_ASSERT_EQUAL_HEX8(0x77, mcs52_ram(chip)[0x30]);
}

/* Other bytes, or the two the wrong way about, are no feed; and other parts have storage there. */
static void test_that_only_the_right_two_bytes_feed(void)
{
    static const uint8_t wrong[][2] = {{0xE1, 0x1E}, {0x1E, 0x1E}, {0x00, 0xE1}};

    for (int i = 0; i < 3; i++) {
        make_chip(MCS52_AT89S52);
        LOAD(0, MOV_DIRECT, WDTRST, wrong[i][0], MOV_DIRECT, WDTRST, wrong[i][1]);
        mcs52_run(chip, 3 * AT89S52_MC);
        TEST_ASSERT_EQUAL(0, reset_count);
    }
    make_chip(MCS52_AT89S52); /* a reset between them */
    LOAD(0, MOV_DIRECT, WDTRST, 0x1E);
    mcs52_run(chip, 2);
    mcs52_reset(chip);
    LOAD(0, MOV_DIRECT, WDTRST, 0xE1);
    mcs52_run(chip, 3 * AT89S52_MC);
    TEST_ASSERT_EQUAL(0, reset_count);
    for (enum mcs52_part part = MCS52_INTEL; part <= MCS52_STC89; part++) {
        make_chip(part);
        LOAD(0, MOV_DIRECT, WDTRST, 0x1E, MOV_DIRECT, WDTRST, 0xE1, MOV_DIRECT, WDT_CONTR,
             part == MCS52_STC89 ? 0 : 0x35);
        mcs52_run(chip, 10);
        TEST_ASSERT_EQUAL_HEX8(part == MCS52_AT89S52 ? 0 : 0xE1, sfr(WDTRST));
        TEST_ASSERT_EQUAL_HEX8(part == MCS52_STC89 ? 0 : 0x35, sfr(WDT_CONTR));
    }
}

/* STC: 12 * prescaler * 32768 clocks, prescaler 2 for PS = 0; CLR_WDT feeds and reads as 0;
 * WDT_FLAG says so after the reset and is the program's to clear. */
static void test_that_the_stc89_watchdog_bites(void)
{
    make_chip(MCS52_STC89);
    write_stc89(EN_WDT);
    mcs52_run(chip, STC89_MC - 20);
    write_stc89(EN_WDT | CLR_WDT);
    TEST_ASSERT_EQUAL_HEX8(EN_WDT, sfr(WDT_CONTR));
    uint64_t fed = mcs52_cycles(chip);
    mcs52_run(chip, fed + 1000);
    write_stc89(EN_WDT); /* without CLR_WDT it is not fed */
    mcs52_run(chip, fed + STC89_MC - 1);
    TEST_ASSERT_EQUAL(0, reset_count);
    mcs52_run(chip, fed + STC89_MC);
    TEST_ASSERT_EQUAL_UINT64(fed + STC89_MC, reset_cycle);
    TEST_ASSERT_EQUAL_HEX8(WDT_FLAG, sfr(WDT_CONTR));
    mcs52_run(chip, fed + STC89_MC + 100);
    mcs52_reset(chip);
    TEST_ASSERT_EQUAL_HEX8(WDT_FLAG, sfr(WDT_CONTR));
    write_stc89(WDT_FLAG);
    TEST_ASSERT_EQUAL_HEX8(WDT_FLAG, sfr(WDT_CONTR));
    write_stc89(0);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(WDT_CONTR));
    write_stc89(EN_WDT | IDL_WDT | 7);
    mcs52_reset(chip); /* the pin's reset does not set it */
    TEST_ASSERT_EQUAL_HEX8(0, sfr(WDT_CONTR));
}

static void test_that_the_stc89_watchdog_can_be_stopped(void)
{
    make_chip(MCS52_STC89);
    write_stc89(EN_WDT | 7);
    mcs52_run(chip, (uint64_t)STC89_MC * 127);
    write_stc89(0);
    mcs52_run(chip, (uint64_t)STC89_MC * 200);
    TEST_ASSERT_EQUAL(0, reset_count);
}

/* Atmel: with WDIDLE, STC: without IDL_WDT, the watchdog stands in idle and goes on with what was
 * left. */
static void test_that_a_watchdog_may_stand_in_idle(void)
{
    static const struct {
        enum mcs52_part part;
        bool stands;
    } cases[] = {
        {MCS52_AT89S52, false}, {MCS52_AT89S52, true}, {MCS52_STC89, false}, {MCS52_STC89, true}};

    for (int i = 0; i < 4; i++) {
        uint64_t period = cases[i].part == MCS52_AT89S52 ? AT89S52_MC : STC89_MC, started, asleep;

        make_chip(cases[i].part);
        LOAD(3, RETI);
        mcs52_jump(chip, 0x100);
        if (cases[i].part == MCS52_AT89S52) {
            set(AUXR, cases[i].stands ? WDIDLE : 0);
            feed_at89s52();
        } else {
            write_stc89(EN_WDT | CLR_WDT | (cases[i].stands ? 0 : IDL_WDT));
        }
        started = mcs52_cycles(chip);
        set(TCON, 1);
        set(IE, 0x81);
        mcs52_run(chip, 1000);
        set(PCON, IDL);
        asleep = mcs52_cycles(chip);
        mcs52_set_pin(chip, asleep + 3 * period, 3, 2, false);
        mcs52_run(chip, asleep + 2 * period);
        TEST_ASSERT_EQUAL(!cases[i].stands, reset_count);
        if (cases[i].stands) {
            mcs52_run(chip, asleep + 5 * period);
            TEST_ASSERT_EQUAL(1, reset_count);
            /* It stood until the LCALL, two cycles after the fall. */
            TEST_ASSERT_TRUE(reset_cycle == started + period + 3 * period + 2);
        } else {
            TEST_ASSERT_TRUE(reset_cycle == started + period);
        }
    }
}

/* Idle without a watchdog that runs. */
static void test_that_idle_needs_no_watchdog(void)
{
    make_chip(MCS52_AT89S52);
    set(AUXR, WDIDLE);
    set(PCON, IDL);
    mcs52_run(chip, 100000);
    TEST_ASSERT_EQUAL(0, reset_count);
    TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
}

/* --- idle and power-down --------------------------------------------------------------------- */

/* Intel: an enabled interrupt ends idle, and RETI leads to the instruction after; timers run on. */
static void test_that_an_interrupt_ends_idle(void)
{
    LOAD(0, 0x02, 0x00, 0x20);
    LOAD(3, INC_DIRECT, 0x30, RETI);
    LOAD(0x20, MOV_DIRECT, TCON, 0x11, MOV_DIRECT, TMOD, 0x01, MOV_DIRECT, IE, 0x81, MOV_DIRECT,
         PCON, IDL, INC_DIRECT, 0x31, SJMP, HERE);
    mcs52_run(chip, 1000);
    TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
    TEST_ASSERT_TRUE(sfr(TL0) + 256 * sfr(TH0) > 900);
    mcs52_step(chip);
    TEST_ASSERT_EQUAL_UINT64(1001, mcs52_cycles(chip));
    mcs52_set_pin(chip, 1500, 3, 2, false);
    mcs52_run(chip, 2000);
    TEST_ASSERT_FALSE(mcs52_is_asleep(chip));
    TEST_ASSERT_EQUAL(1, mcs52_ram(chip)[0x30]);
    TEST_ASSERT_EQUAL(1, mcs52_ram(chip)[0x31]);
}

/* Intel: in power-down the oscillator stands, and only reset ends it. */
static void test_that_only_reset_ends_intels_power_down(void)
{
    mcs52_watch(chip, 3, 2);
    set(TMOD, 0x01);
    set(TCON, 0x11);
    set(IE, 0x81);
    mcs52_run(chip, 100);
    set(PCON, PD);
    unsigned count = sfr(TL0);
    mcs52_set_pin(chip, 1000, 3, 2, false);
    mcs52_run(chip, 100000);
    mcs52_step(chip);
    TEST_ASSERT_EQUAL_UINT64(100001, mcs52_cycles(chip));
    TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
    TEST_ASSERT_EQUAL(1, edge_count);
    TEST_ASSERT_EQUAL(count, sfr(TL0));
    mcs52_reset(chip);
    TEST_ASSERT_FALSE(mcs52_is_asleep(chip));
}

/* Atmel: an enabled INT0 or INT1 ends it, too. All that was due comes so much later: the timers,
 * the byte on its way, the watchdog. */
static void test_that_an_interrupt_pin_ends_power_down(void)
{
    static const struct {
        int pin;
        uint8_t enable;
    } inputs[] = {{2, 0x81}, {3, 0x84}};
    enum { SLEPT = 50000 };

    for (int i = 0; i < 2; i++) {
        make_chip(MCS52_AT89S52);
        LOAD(3, RETI);
        LOAD(0x13, RETI);
        mcs52_jump(chip, 0x100);
        LOAD(0x100, MOV_DIRECT, SBUF, 0x55);
        set(TMOD, 0x21);
        set(TH1, 0xFD);
        set(TL1, 0xFD);
        set(TCON, 0x55);
        set(SCON, i == 0 ? 0x50 : 0);
        set(IE, inputs[i].enable);
        mcs52_run(chip, 5);
        uint64_t from = mcs52_cycles(chip);
        unsigned count = sfr(TL0);
        set(PCON, PD);
        mcs52_set_pin(chip, from + SLEPT, 3, inputs[i].pin, false);
        mcs52_run(chip, from + SLEPT - 1);
        TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
        TEST_ASSERT_EQUAL(0, byte_count);
        mcs52_run(chip, from + SLEPT + 3);
        TEST_ASSERT_FALSE(mcs52_is_asleep(chip));
        TEST_ASSERT_EQUAL_HEX8(0, sfr(PCON) & PD);
        TEST_ASSERT_UINT_WITHIN(4, count + 3, sfr(TL0));
        mcs52_run(chip, from + SLEPT + 2000);
        TEST_ASSERT_EQUAL(1, byte_count);
        TEST_ASSERT_EQUAL_HEX8(0x55, bytes[0].value);
    }
}

/* The pin that is low already ends it at once; one that is not enabled, or without EA, does not. */
static void test_that_a_low_pin_ends_power_down_at_once(void)
{
    static const struct {
        uint8_t enable;
        bool wakes;
    } cases[] = {{0x81, true}, {0x84, false}, {0x01, false}};

    for (int i = 0; i < 3; i++) {
        make_chip(MCS52_STC89);
        LOAD(3, RETI);
        mcs52_set_pin(chip, 0, 3, 2, false);
        set(TCON, 0x05);
        mcs52_run(chip, 10);
        set(TCON, 0x05);
        set(IE, cases[i].enable);
        set(PCON, PD);
        mcs52_set_pin(chip, 20, 3, 7, false); /* has no say */
        TEST_ASSERT_EQUAL(!cases[i].wakes, mcs52_is_asleep(chip));
        mcs52_run(chip, 100);
        TEST_ASSERT_EQUAL(!cases[i].wakes, mcs52_is_asleep(chip));
    }
}

/* A fall of any other pin leaves the chip asleep. */
static void test_that_only_the_enabled_pin_ends_power_down(void)
{
    static const struct {
        int bit;
        uint8_t enable;
    } cases[] = {{2, 0x81}, {3, 0x84}};

    for (int i = 0; i < 2; i++) {
        make_chip(MCS52_AT89S52);
        set(TCON, 0x05);
        set(IE, cases[i].enable);
        set(PCON, PD);
        for (int pin = 0; pin < 32; pin++) {
            if (pin != 24 + cases[i].bit) {
                mcs52_set_pin(chip, 100, pin / 8, pin % 8, false);
            }
        }
        mcs52_run(chip, 200);
        TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
        mcs52_set_pin(chip, 300, 3, cases[i].bit, false);
        mcs52_run(chip, 301);
        TEST_ASSERT_FALSE(mcs52_is_asleep(chip));
    }
}

/* By level, a flag is what its pin has become in power-down. */
static void test_that_levels_are_looked_at_after_power_down(void)
{
    make_chip(MCS52_AT89S52);
    set(TCON, 0x01); /* INT0 by edge, INT1 by level */
    set(IE, 0x81);
    set(PCON, PD);
    mcs52_set_pin(chip, 100, 3, 3, false);
    mcs52_set_pin(chip, 200, 3, 2, false);
    mcs52_run(chip, 199);
    TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
    mcs52_run(chip, 200);
    TEST_ASSERT_FALSE(mcs52_is_asleep(chip));
    TEST_ASSERT_EQUAL_HEX8(0x0B, sfr(TCON)); /* IE1, IE0, IT0 */
}

/* --- ports and the outside -------------------------------------------------------------------- */

/* Intel: read-modify-write takes the latch, all else the pin. */
static void test_that_a_port_is_latch_and_pin(void)
{
    mcs52_set_pin(chip, 0, 1, 3, false);
    LOAD(0, 0xE5, P1, CPL, 0x90, SJMP, HERE); /* MOV A, P1; CPL P1.0 */
    mcs52_run(chip, 10);
    TEST_ASSERT_EQUAL_HEX8(0xF7, sfr(ACC));
    TEST_ASSERT_EQUAL_HEX8(0xFE, sfr(P1));
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 3));
}

/* Changes are sorted by their cycle; what is past comes at once; a full queue is said. */
static void test_that_pin_changes_come_in_order(void)
{
    mcs52_watch(chip, 2, 0);
    TEST_ASSERT_TRUE(mcs52_set_pin(chip, 50, 2, 0, true));
    TEST_ASSERT_TRUE(mcs52_set_pin(chip, 30, 2, 0, false));
    mcs52_run(chip, 100);
    TEST_ASSERT_EQUAL(2, edge_count);
    TEST_ASSERT_EQUAL_UINT64(30, edges[0].cycle);
    TEST_ASSERT_EQUAL_UINT64(50, edges[1].cycle);
    TEST_ASSERT_TRUE(mcs52_set_pin(chip, 7, 2, 0, false));
    mcs52_run(chip, 101);
    TEST_ASSERT_EQUAL_UINT64(100, edges[2].cycle);
    edge_count = 0;
    for (uint64_t i = 0; i < MCS52_PIN_QUEUE; i++) { /* two at a time, through all places */
        TEST_ASSERT_TRUE(mcs52_set_pin(chip, 200 + 10 * i, 2, 0, true));
        TEST_ASSERT_TRUE(mcs52_set_pin(chip, 203 + 10 * i, 2, 0, false));
        mcs52_run(chip, 206 + 10 * i);
        TEST_ASSERT_EQUAL(2, edge_count);
        TEST_ASSERT_EQUAL_UINT64(200 + 10 * i, edges[0].cycle);
        TEST_ASSERT_EQUAL_UINT64(203 + 10 * i, edges[1].cycle);
        edge_count = 0;
    }
    for (int i = 0; i < MCS52_PIN_QUEUE; i++) {
        TEST_ASSERT_TRUE(mcs52_set_pin(chip, 1000, 2, 0, true));
    }
    TEST_ASSERT_FALSE(mcs52_set_pin(chip, 1000, 2, 0, true));
    TEST_ASSERT_EQUAL_UINT64(0, mcs52_feed(chip, 2000, 0x55, 100));
}

/* Nobody need listen. */
static void test_that_a_chip_without_listeners_runs(void)
{
    struct mcs52 *alone = mcs52_create(MCS52_AT89S52, NULL);
    static const uint8_t code[] = {MOV_DIRECT, SBUF,   0x55, MOV_DIRECT, WDTRST, 0x1E,
                                   MOV_DIRECT, WDTRST, 0xE1, 0x90,       0x12,   0x34,
                                   0xF0,       CPL,    0x90, SJMP,       HERE}; /* MOVX @DPTR, A */

    mcs52_load(alone, 0, code, sizeof code);
    mcs52_watch(alone, 1, 0);
    mcs52_watch_xdata(alone, 0x1234);
    mcs52_run(alone, 2 * AT89S52_MC);
    TEST_ASSERT_EQUAL(MCS52_WATCHDOG, mcs52_reset_cause(alone));
    mcs52_destroy(alone);
}

/* The address that is watched is told, any other not; the functions see the chip's state. */
static void test_that_external_ram_is_told_and_kept(void)
{
    mcs52_watch_xdata(chip, 0x1234);
    LOAD(0, 0x74, 0x5A, 0x90, 0x12, 0x34, 0xF0, 0xA3,
         0xF0); /* MOV A; MOV DPTR; MOVX; INC DPTR; MOVX */
    mcs52_run(chip, 20);
    TEST_ASSERT_EQUAL(1, write_count);
    TEST_ASSERT_EQUAL_HEX8(0x5A, writes[0].value);
    TEST_ASSERT_EQUAL_UINT64(5, writes[0].cycle);
    TEST_ASSERT_EQUAL_HEX8(0x5A, mcs52_xdata(chip)[0x1235]);
}

static void stop_at_byte(void *user, uint64_t cycle, int port, int bit, bool level)
{
    (void)cycle, (void)port, (void)bit, (void)level;
    mcs52_stop(*(struct mcs52 **)user);
}

static void test_that_a_listener_stops_a_run(void)
{
    struct mcs52 *own;
    const struct mcs52_outside outside = {.user = &own, .edge = stop_at_byte};

    own = mcs52_create(MCS52_INTEL, &outside);
    mcs52_load(own, 0, (const uint8_t[]){NOP, CPL, 0x90, NOP}, 4);
    mcs52_watch(own, 1, 0);
    mcs52_watch(own, 1, 1);
    TEST_ASSERT_EQUAL_UINT64(2, mcs52_run(own, 1000));
    TEST_ASSERT_EQUAL_UINT64(2, mcs52_instructions(own));
    TEST_ASSERT_EQUAL_HEX16(3, mcs52_pc(own));
    mcs52_set_pin(own, 50, 1, 1, false); /* between two NOPs */
    TEST_ASSERT_EQUAL_UINT64(50, mcs52_run(own, 1000));
    TEST_ASSERT_EQUAL_UINT64(1000, mcs52_run(own, 1000));
    mcs52_poke(own, P1, 0xFF); /* an edge between two runs stops neither a run */
    TEST_ASSERT_EQUAL_UINT64(1010, mcs52_run(own, 1010));
    mcs52_poke(own, P1, 0xFE); /* nor a step */
    mcs52_step(own);
    TEST_ASSERT_EQUAL_UINT64(1011, mcs52_cycles(own));
    mcs52_destroy(own);
}

/* What is set is what is read: A, PSW with its parity, plain registers, the program counter. */
static void test_that_registers_can_be_set(void)
{
    static uint8_t map[8192];

    set(ACC, 0x13);
    set(PSW, 0xFE);
    TEST_ASSERT_EQUAL_HEX8(0x13, sfr(ACC));
    TEST_ASSERT_EQUAL_HEX8(0xFF, sfr(PSW)); /* three ones in A */
    set(ACC, 0x03);
    set(PSW, 0xFF);
    TEST_ASSERT_EQUAL_HEX8(0xFE, sfr(PSW)); /* two */
    set(0xF0, 0x77);
    TEST_ASSERT_EQUAL_HEX8(0x77, sfr(0xF0));
    set(TCON, 0x08);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(TCON)); /* by level, IE1 is the pin, which is high */
    make_chip(MCS52_AT89S52);
    set(WDTRST, 0x1E);
    set(WDTRST, 0xE1); /* feeds nothing */
    TEST_ASSERT_EQUAL_HEX8(0xE1, sfr(WDTRST));
    mcs52_run(chip, 3 * AT89S52_MC);
    make_chip(MCS52_STC89);
    set(WDT_CONTR, EN_WDT | CLR_WDT);
    TEST_ASSERT_EQUAL_HEX8(EN_WDT | CLR_WDT, sfr(WDT_CONTR));
    mcs52_run(chip, 3 * STC89_MC);
    TEST_ASSERT_EQUAL(0, reset_count);
    make_chip(MCS52_INTEL);
    set(SCON, 0x80);
    set(SBUF, 0x55); /* sends nothing */
    mcs52_run(chip, 1000);
    TEST_ASSERT_EQUAL(0, byte_count);
    make_chip(MCS52_INTEL);
    mcs52_jump(chip, 0x1235);
    mcs52_cover(chip, map);
    mcs52_run(chip, 2);
    TEST_ASSERT_EQUAL_HEX16(0x1237, mcs52_pc(chip));
    TEST_ASSERT_EQUAL_HEX8(0x60, map[0x1235 / 8]);
    TEST_ASSERT_EQUAL_HEX8(0, map[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_reset_gives_each_register_its_value);
    RUN_TEST(test_that_a_reset_lets_the_pins_rise);
    RUN_TEST(test_that_pof_tells_power_from_reset);
    RUN_TEST(test_that_the_at89s52_watchdog_bites);
    RUN_TEST(test_that_only_the_right_two_bytes_feed);
    RUN_TEST(test_that_the_stc89_watchdog_bites);
    RUN_TEST(test_that_the_stc89_watchdog_can_be_stopped);
    RUN_TEST(test_that_a_watchdog_may_stand_in_idle);
    RUN_TEST(test_that_idle_needs_no_watchdog);
    RUN_TEST(test_that_an_interrupt_ends_idle);
    RUN_TEST(test_that_only_reset_ends_intels_power_down);
    RUN_TEST(test_that_an_interrupt_pin_ends_power_down);
    RUN_TEST(test_that_a_low_pin_ends_power_down_at_once);
    RUN_TEST(test_that_only_the_enabled_pin_ends_power_down);
    RUN_TEST(test_that_levels_are_looked_at_after_power_down);
    RUN_TEST(test_that_a_port_is_latch_and_pin);
    RUN_TEST(test_that_pin_changes_come_in_order);
    RUN_TEST(test_that_a_chip_without_listeners_runs);
    RUN_TEST(test_that_external_ram_is_told_and_kept);
    RUN_TEST(test_that_a_listener_stops_a_run);
    RUN_TEST(test_that_registers_can_be_set);
    return UNITY_END();
}
