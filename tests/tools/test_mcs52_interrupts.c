/* SPDX-License-Identifier: MIT */
/* Under test: interrupts of tools/drive/sim/mcs52, by cases worked out by hand from Intel's MCS-51
 * Microcontroller Family User's Manual ("Intel"). Each routine counts in a byte of RAM of its own,
 * at 40h and the number of its source, so the first cycle of that INC is where it began. */
#include "mcs52_chip.h"

enum { IT1 = 0x04, IT0 = 0x01, TF0 = 0x20, TF1 = 0x80, MUL = 0xA4, SOURCES = 6, COUNTS = 0x40 };

static uint8_t *counts(void)
{
    return mcs52_ram(chip) + COUNTS;
}

/* A program of NOPs from 100h on, and a routine for each source: INC 4Nh, RETI. */
static void load_routines(void)
{
    LOAD(0, 0x02, 0x01, 0x00); /* LJMP 100h, cycles 0 and 1 */
    for (unsigned n = 0; n < SOURCES; n++) {
        LOAD((uint16_t)(3 + 8 * n), INC_DIRECT, (uint8_t)(COUNTS + n), RETI);
    }
    mcs52_run(chip, 2);
}

/* The cycle in which the first instruction of source N's routine begins, or 0. */
static uint64_t begins(int n, uint64_t until)
{
    uint8_t before = counts()[n];

    for (uint64_t cycle = mcs52_cycles(chip); cycle <= until; cycle++) {
        mcs52_run(chip, cycle);
        if (counts()[n] != before) {
            return mcs52_cycles(chip) - 1;
        }
    }
    return 0;
}

/* Intel, response time: at least three complete cycles between the request and the first
 * instruction of its routine (polled in the next cycle, then an LCALL of two); a MUL or DIV before
 * it makes it up to three more, RETI or a write to IE or IP and a MUL up to five more: 3 to 8. */
static void test_that_an_interrupt_takes_three_to_eight_cycles(void)
{
    uint64_t least = 100, most = 0;

    for (uint64_t at = 1000; at < 1020; at++) {
        setUp();
        LOAD(0, 0x02, 0x00, 0x20);
        LOAD(3, INC_DIRECT, COUNTS, RETI);
        LOAD(0x20, MOV_DIRECT, TCON, IT0, MOV_DIRECT, IE, 0x81, MUL, MOV_DIRECT, IP, 0x00, MUL,
             SJMP, 0xF9); /* MUL; MOV IP, #0; MUL; SJMP to the first MUL */
        mcs52_set_pin(chip, at, 3, 2, false);
        uint64_t latency = begins(0, 2000) - (at + 1); /* complete cycles between */
        least = latency < least ? latency : least;
        most = latency > most ? latency : most;
    }
    TEST_ASSERT_EQUAL_UINT64(3, least);
    TEST_ASSERT_EQUAL_UINT64(8, most);
}

/* Intel: TF2 is set in S2P2 and polled in the same cycle, so it is a cycle faster than TF0. */
static void test_that_timer_2_is_polled_in_the_cycle_of_its_overflow(void)
{
    load_routines();
    set(TMOD, 0x01);
    set(TH0, 0xFF);
    set(TL0, 0xF0);
    set(TH2, 0xFF);
    set(TL2, 0xF0);
    set(IE, 0x82);
    set(TCON, 0x10);
    uint64_t timer_0 = begins(1, 100);

    setUp();
    load_routines();
    set(TH2, 0xFF);
    set(TL2, 0xF0);
    set(IE, 0xA0);
    set(T2CON, 0x04);
    TEST_ASSERT_TRUE(begins(5, 100) == timer_0 - 1);
}

/* Intel: requests of one level at once are served in the order of polling: IE0, TF0, IE1, TF1,
 * serial, timer 2. RETI lets one instruction of the program run in between. */
static void test_that_the_polling_sequence_decides_within_a_level(void)
{
    uint64_t before = 0;

    load_routines();
    set(TCON, 0xAA | IT0 | IT1); /* all four flags */
    set(SCON, 0x01);             /* RI */
    set(T2CON, 0x80);            /* TF2 */
    set(IE, 0xBF);
    for (int n = 0; n < SOURCES - 2; n++) {
        uint64_t at = begins(n, 200);

        TEST_ASSERT_TRUE(at > before);
        for (int later = n + 1; later < SOURCES; later++) {
            TEST_ASSERT_EQUAL(0, counts()[later]);
        }
        if (n > 0) { /* INC, RETI, a NOP, LCALL */
            TEST_ASSERT_EQUAL_UINT64(1 + 2 + 1 + 2, at - before);
        }
        before = at;
    }
    set(IE, 0x80 | 0x20); /* RI and TF2 are the program's to clear: they come again and again */
    TEST_ASSERT_TRUE(begins(5, 300) > 0);
    TEST_ASSERT_TRUE(begins(5, 300) > 0);
}

/* Intel: a high priority goes first, and interrupts a low one; a low one interrupts nothing. */
static void test_that_a_high_level_interrupts_a_low_one(void)
{
    load_routines();
    LOAD(3 + 8 * 1, 0x02, 0x02, 0x00); /* timer 0's routine is a long one */
    LOAD(0x200 + 50, INC_DIRECT, COUNTS + 1, RETI);
    set(IP, 0x08); /* timer 1 */
    set(IE, 0x8F);
    set(TCON, TF0 | IT0 | IT1);
    mcs52_run(chip, 20);
    TEST_ASSERT_TRUE(mcs52_pc(chip) > 0x200);
    set(TCON, TF1 | IT0 | IT1);
    mcs52_set_pin(chip, 20, 3, 2, false); /* INT0 is low */
    TEST_ASSERT_TRUE(begins(3, 40) > 0);
    TEST_ASSERT_EQUAL(0, counts()[1]);
    TEST_ASSERT_EQUAL(0, counts()[0]);
    TEST_ASSERT_TRUE(begins(1, 100) > 0); /* the low one goes on */
    TEST_ASSERT_EQUAL(0, counts()[0]);
    TEST_ASSERT_TRUE(begins(0, 120) > 0);
}

/* At once: the high one is served first, though its place in the sequence is later; and of two high
 * ones the first in the sequence. While it is in service no other high one comes. */
static void test_that_the_level_comes_before_the_sequence(void)
{
    load_routines();
    set(IP, 0x0C);
    set(TCON, 0xAA | IT0 | IT1);
    set(IE, 0x8F);
    TEST_ASSERT_TRUE(begins(2, 50) > 0);
    TEST_ASSERT_EQUAL(0, counts()[0] + counts()[1] + counts()[3]);
    TEST_ASSERT_TRUE(begins(3, 60) > 0);
    TEST_ASSERT_EQUAL(0, counts()[0] + counts()[1]);
    TEST_ASSERT_TRUE(begins(0, 60) > 0);
}

/* Intel: IT = 0 makes an interrupt of the level: the flag is the pin, comes again while that is
 * low, and is gone with it. IT = 1: once an edge; the hardware clears the flag. */
static void test_that_levels_come_again_and_edges_do_not(void)
{
    static const struct {
        int source, pin;
        uint8_t type, enable;
    } inputs[] = {{0, 2, IT0, 0x81}, {2, 3, IT1, 0x84}};

    for (int i = 0; i < 2; i++) {
        for (int edge = 0; edge < 2; edge++) {
            setUp();
            load_routines();
            set(TCON, edge ? inputs[i].type : 0);
            set(IE, inputs[i].enable);
            mcs52_set_pin(chip, 100, 3, inputs[i].pin, false);
            mcs52_set_pin(chip, 200, 3, inputs[i].pin, true);
            mcs52_run(chip, 400);
            if (edge) {
                TEST_ASSERT_EQUAL(1, counts()[inputs[i].source]);
            } else {
                TEST_ASSERT_TRUE(counts()[inputs[i].source] > 10);
            }
            TEST_ASSERT_EQUAL_HEX8(0, sfr(TCON) & 0x0A);
        }
    }
}

/* The flag of the edge stays when its pin rises, that of the level goes, whatever type the other
 * input is of; and serving the level leaves the types as they are. */
static void test_that_each_input_has_its_own_type(void)
{
    for (unsigned types = 0; types < 4; types++) {
        unsigned control = (types & 1 ? IT0 : 0) | (types & 2 ? IT1 : 0);

        setUp();
        load_routines();
        set(TCON, control);
        mcs52_set_pin(chip, 10, 3, 2, false);
        mcs52_set_pin(chip, 10, 3, 3, false);
        mcs52_run(chip, 11);
        TEST_ASSERT_EQUAL_HEX8(control | 0x0A, sfr(TCON));
        mcs52_set_pin(chip, 20, 3, 2, true);
        mcs52_set_pin(chip, 30, 3, 3, true);
        mcs52_run(chip, 21);
        TEST_ASSERT_EQUAL_HEX8(control | 0x08 | (types & 1 ? 0x02 : 0), sfr(TCON));
        mcs52_run(chip, 31);
        TEST_ASSERT_EQUAL_HEX8(control | (types & 2 ? 0x08 : 0) | (types & 1 ? 0x02 : 0),
                               sfr(TCON));
        mcs52_set_pin(chip, 40, 3, 2, false);
        mcs52_set_pin(chip, 40, 3, 3, false);
        set(IE, 0x85);
        mcs52_run(chip, 100);
        TEST_ASSERT_EQUAL_HEX8(control, sfr(TCON) & (IT0 | IT1));
    }
}

/* A pin that falls in an instruction's first or only its last cycle sets a flag that the
 * instruction then writes over. */
static void test_that_a_write_comes_after_what_its_instruction_saw(void)
{
    for (uint64_t fall = 10; fall < 13; fall++) {
        setUp();
        set(TCON, IT0);
        LOAD(10, MOV_DIRECT, TCON, IT0 | IT1);
        mcs52_set_pin(chip, fall, 3, 2, false);
        mcs52_run(chip, 20);
        TEST_ASSERT_EQUAL_HEX8(IT0 | IT1 | (fall < 12 ? 0 : 0x02), sfr(TCON));
    }
}

/* Intel: TI and RI are set by the hardware or by software, and share a vector. */
static void test_that_software_may_request_the_serial_interrupt(void)
{
    for (unsigned flag = 1; flag <= 2; flag++) {
        setUp();
        load_routines();
        set(IE, 0xB0); /* serial and timer 2 */
        set(SCON, flag);
        TEST_ASSERT_TRUE(begins(4, 20) > 0);
        set(SCON, 0);
        mcs52_run(chip, 30);
        TEST_ASSERT_EQUAL(0, begins(4, 100));
        TEST_ASSERT_EQUAL(0, counts()[5]);
    }
}

/* A reset in a routine: none is in service afterwards, high or low. */
static void test_that_a_reset_ends_all_service(void)
{
    for (unsigned high = 0; high < 2; high++) {
        setUp();
        load_routines();
        LOAD(3 + 8 * 1, SJMP, HERE); /* timer 0's routine does not end */
        set(IP, high ? 0x02 : 0);
        set(IE, 0x82);
        set(TCON, TF0);
        mcs52_run(chip, 50);
        TEST_ASSERT_EQUAL_HEX16(3 + 8 * 1, mcs52_pc(chip));
        mcs52_reset(chip);
        set(IP, high ? 0x08 : 0);
        set(IE, 0x88);
        set(TCON, TF1);
        TEST_ASSERT_TRUE(begins(3, 70) > 0);
    }
}

/* Nothing is requested after a reset. */
static void test_that_a_reset_ends_all_requests(void)
{
    load_routines();
    set(TCON, 0xAA | IT0 | IT1);
    set(SCON, 0x03);
    set(T2CON, 0xC0);
    mcs52_run(chip, 50);
    mcs52_reset(chip);
    set(IE, 0xBF);
    mcs52_run(chip, 150);
    for (int n = 0; n < SOURCES; n++) {
        TEST_ASSERT_EQUAL(0, counts()[n]);
    }
}

/* A request that is gone before it is polled is none; and one that no enable bit lets through
 * waits. */
static void test_that_a_request_must_last_until_it_is_polled(void)
{
    load_routines();
    set(IE, 0x01); /* EA is 0 */
    set(TCON, 0x02 | IT0);
    mcs52_run(chip, 50);
    TEST_ASSERT_EQUAL(0, counts()[0]);
    set(TCON, IT0);
    mcs52_run(chip, 51); /* each takes an instruction */
    set(IE, 0x81);
    mcs52_run(chip, 100);
    TEST_ASSERT_EQUAL(0, counts()[0]);
    set(IE, 0x80);
    set(TCON, 0x02 | IT0);
    mcs52_run(chip, 150);
    TEST_ASSERT_EQUAL(0, counts()[0]);
    set(IE, 0x81);
    mcs52_run(chip, 200);
    TEST_ASSERT_EQUAL(1, counts()[0]);
}

/* Intel: TF2 and EXF2 share a vector. Atmel: EXF2 is no request while DCEN lets timer 2 count up
 * and down. */
static void test_that_exf2_is_a_request_but_with_dcen(void)
{
    for (int up_down = 0; up_down < 2; up_down++) {
        make_chip(MCS52_AT89S52);
        load_routines();
        set(T2MOD, (unsigned)up_down);
        set(IE, 0xA0);
        set(T2CON, 0x40);
        mcs52_run(chip, 50);
        TEST_ASSERT_EQUAL(up_down, counts()[5] == 0);
    }
}

/* Intel: EXF2 needs capture mode off to be the 17th bit: with it DCEN has no say. */
static void test_that_dcen_counts_in_reload_mode_only(void)
{
    make_chip(MCS52_AT89S52);
    set(T2MOD, 0x01);
    set(TH2, 0x10);
    set(T2CON, 0x0D); /* capture, EXEN2 */
    mcs52_set_pin(chip, 5, 1, 1, false);
    mcs52_run(chip, 5);
    TEST_ASSERT_EQUAL_HEX8(0x10, sfr(RCAP2H));
    set(T2CON, 0x34); /* a baud rate generator counts up whatever T2EX is */
    mcs52_run(chip, 20);
    TEST_ASSERT_TRUE((sfr(TH2) << 8 | sfr(TL2)) > 0x1010);
}

/* Intel: the LCALL clears TF0. Timer 0 overflows in the cycles 17, 33, 49, 65; those that found TF0
 * set are no further requests. */
static void test_that_overflows_do_not_add_up(void)
{
    load_routines();
    set(TMOD, 0x02);
    set(TH0, 0xF0);
    set(TL0, 0xF0);
    set(TCON, 0x10);
    mcs52_run(chip, 54);
    set(IE, 0x82);
    TEST_ASSERT_EQUAL_UINT64(57, begins(1, 60)); /* one instruction after the write to IE */
    mcs52_run(chip, 64);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(TCON) & TF0);
    TEST_ASSERT_EQUAL_UINT64(69, begins(1, 80));
    TEST_ASSERT_EQUAL(2, counts()[1]);
}

/* Where a run ends does not show: the LCALL of two cycles waits for the next run when it does not
 * fit. */
static void test_that_an_interrupt_waits_at_the_end_of_a_run(void)
{
    load_routines();
    set(TCON, 0x02 | IT0);
    set(IE, 0x81);
    for (uint64_t cycle = 3; cycle < 8; cycle++) {
        TEST_ASSERT_TRUE(mcs52_run(chip, cycle) <= cycle);
    }
    TEST_ASSERT_TRUE(begins(0, 20) < 10);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_an_interrupt_takes_three_to_eight_cycles);
    RUN_TEST(test_that_timer_2_is_polled_in_the_cycle_of_its_overflow);
    RUN_TEST(test_that_the_polling_sequence_decides_within_a_level);
    RUN_TEST(test_that_a_high_level_interrupts_a_low_one);
    RUN_TEST(test_that_the_level_comes_before_the_sequence);
    RUN_TEST(test_that_levels_come_again_and_edges_do_not);
    RUN_TEST(test_that_each_input_has_its_own_type);
    RUN_TEST(test_that_a_write_comes_after_what_its_instruction_saw);
    RUN_TEST(test_that_software_may_request_the_serial_interrupt);
    RUN_TEST(test_that_a_reset_ends_all_service);
    RUN_TEST(test_that_a_reset_ends_all_requests);
    RUN_TEST(test_that_a_request_must_last_until_it_is_polled);
    RUN_TEST(test_that_exf2_is_a_request_but_with_dcen);
    RUN_TEST(test_that_dcen_counts_in_reload_mode_only);
    RUN_TEST(test_that_overflows_do_not_add_up);
    RUN_TEST(test_that_an_interrupt_waits_at_the_end_of_a_run);
    return UNITY_END();
}
