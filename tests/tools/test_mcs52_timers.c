/* SPDX-License-Identifier: MIT */
/* Under test: the timers of tools/drive/sim/mcs52, by cases worked out by hand from Intel's MCS-51
 * Microcontroller Family User's Manual ("Intel") and the data sheet of the AT89S52 ("Atmel"). A
 * register that is set at cycle 0 counts in cycle 0 for the first time; a look at cycle N sees what
 * an instruction there would read, the count of cycle N included. */
#include "mcs52_chip.h"

enum {
    TF1 = 0x80,
    TR1 = 0x40,
    TF0 = 0x20,
    TR0 = 0x10,
    TF2 = 0x80,
    EXF2 = 0x40,
    RCLK = 0x20,
    EXEN2 = 0x08,
    TR2 = 0x04,
    CT2 = 0x02,
    DCEN = 0x01,
    OE = 0x02
};

static unsigned t2(void)
{
    return sfr(TH2) << 8 | sfr(TL2);
}

static void set_t2(unsigned value, unsigned reload)
{
    set(RCAP2H, reload >> 8);
    set(RCAP2L, reload & 0xFF);
    set(TH2, value >> 8);
    set(TL2, value & 0xFF);
}

/* Levels of a pin that has fallen at CYCLE and rises a while later. */
static void fall(int port, int bit, uint64_t cycle)
{
    mcs52_set_pin(chip, cycle, port, bit, false);
    mcs52_set_pin(chip, cycle + 5, port, bit, true);
}

/* --- timers 0 and 1 ------------------------------------------------------------------------ */

/* Intel: in the timer function the register is incremented every machine cycle. */
static void test_that_a_timer_counts_each_cycle(void)
{
    LOAD(0, MOV_DIRECT, TMOD, 0x01, /* cycles 0 and 1 */
         SETB, 0x8C,                /* 2: TR0 */
         NOP, NOP, 0xE5, TL0);      /* 3, 4: NOP, 5: MOV A, TL0 */
    mcs52_run(chip, 6);
    TEST_ASSERT_EQUAL(3, sfr(ACC)); /* the cycles 3, 4 and 5 */
}

/* Intel, mode 0: 13 bits, the lower five in TL0, whose upper three are of no account. From 1FFEh
 * two counts lead to the overflow. */
static void test_that_mode_0_counts_13_bits(void)
{
    set(TMOD, 0x00);
    set(TH0, 0xFF);
    set(TL0, 0xFE);
    set(TCON, TR0);
    TEST_ASSERT_EQUAL_HEX8(0xFF, sfr(TL0));
    TEST_ASSERT_EQUAL_HEX8(0, sfr(TCON) & TF0);
    mcs52_run(chip, 1);
    TEST_ASSERT_EQUAL_HEX8(TF0, sfr(TCON) & TF0);
    TEST_ASSERT_EQUAL_HEX8(0x00, sfr(TH0));
    TEST_ASSERT_EQUAL_HEX8(0x00, sfr(TL0) & 0x1F);
    mcs52_run(chip, 1 + 8192 + 33);
    TEST_ASSERT_EQUAL_HEX8(1, sfr(TH0));
    TEST_ASSERT_EQUAL_HEX8(1, sfr(TL0) & 0x1F);
}

/* Intel, mode 1: 16 bits; the overflow is where all ones become all zeros. */
static void test_that_mode_1_counts_16_bits(void)
{
    set(TMOD, 0x10);
    set(TH1, 0xFF);
    set(TL1, 0x00);
    set(TCON, TR1);
    mcs52_run(chip, 254);
    TEST_ASSERT_EQUAL_HEX8(0xFF, sfr(TL1));
    TEST_ASSERT_EQUAL_HEX8(0, sfr(TCON) & TF1);
    mcs52_run(chip, 255);
    TEST_ASSERT_EQUAL_HEX8(TF1, sfr(TCON) & TF1);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(TH1) | sfr(TL1));
    mcs52_run(chip, 255 + 65536 + 7);
    TEST_ASSERT_EQUAL_HEX8(7, sfr(TL1));
}

/* Intel, mode 2: TL0 is reloaded from TH0, and TF0 is set at the overflow. */
static void test_that_mode_2_overflows_every_period(void)
{
    LOAD(0, MOV_DIRECT, TMOD, 0x02, MOV_DIRECT, TL0, 0x9C, MOV_DIRECT, TH0, 0x9C, /* 256 - 100 */
         SETB, 0x8C,                                                              /* TR0 */
         0x30, 0x8D, 0xFD,                                                        /* JNB TF0, $ */
         0xC2, 0x8D, CPL, 0x90, SJMP, 0xF7); /* CLR TF0; CPL P1.0; SJMP */
    mcs52_watch(chip, 1, 0);
    mcs52_run(chip, 100000);
    for (int i = 2; i < 64; i++) {
        uint64_t period = edges[i].cycle - edges[i - 1].cycle;

        TEST_ASSERT_TRUE(period >= 98 && period <= 102);
    }
    TEST_ASSERT_UINT64_WITHIN(2, 1000, edges[61].cycle - edges[51].cycle);
}

/* Intel, mode 3: TL0 uses the control bits of timer 0, TH0 those of timer 1, TF1 among them. */
static void test_that_mode_3_makes_two_timers_of_timer_0(void)
{
    set(TMOD, 0x03);
    set(TL0, 0xFE);
    set(TH0, 0xFD);
    set(TCON, TR0 | TR1);
    mcs52_run(chip, 1);
    TEST_ASSERT_EQUAL_HEX8(TF0, sfr(TCON) & (TF0 | TF1));
    mcs52_run(chip, 2);
    TEST_ASSERT_EQUAL_HEX8(TF0 | TF1, sfr(TCON) & (TF0 | TF1));
    TEST_ASSERT_EQUAL_HEX8(0x01, sfr(TL0));
    TEST_ASSERT_EQUAL_HEX8(0x00, sfr(TH0));
    set(TCON, TR0);
    mcs52_run(chip, 12);
    TEST_ASSERT_EQUAL_HEX8(0x00, sfr(TH0));
}

/* The earlier of the two halves wakes first, whichever it is. */
static void test_that_either_half_may_come_first(void)
{
    set(TMOD, 0x03);
    set(TL0, 0x00);
    set(TH0, 0xF0);
    set(TCON, TR0 | TR1);
    mcs52_run(chip, 15);
    TEST_ASSERT_EQUAL_HEX8(TF1, sfr(TCON) & (TF0 | TF1));
    mcs52_run(chip, 255);
    TEST_ASSERT_EQUAL_HEX8(TF0 | TF1, sfr(TCON) & (TF0 | TF1));
}

/* TF1 of the half TH0 asks in its cycle, whatever TCON's other bits are. */
static void test_that_the_second_half_sets_tf1_in_its_cycle(void)
{
    for (unsigned types = 0; types < 16; types++) {
        unsigned wanted = types & 5; /* by level, IE0 and IE1 are the pins, which are high */

        setUp();
        set(TMOD, 0x03);
        set(TH0, 0xF0);
        set(TCON, TR1 | wanted);
        mcs52_run(chip, 14);
        TEST_ASSERT_EQUAL_HEX8(TR1 | wanted, sfr(TCON));
        mcs52_run(chip, 15);
        TEST_ASSERT_EQUAL_HEX8(TF1 | TR1 | wanted, sfr(TCON));
    }
}

/* Intel: with timer 0 in mode 3, timer 1 runs without TR1 and sets no flag; its own mode 3 stops
 * it. */
static void test_that_timer_1_runs_alone_beside_mode_3(void)
{
    set(TMOD, 0x23);
    set(TH1, 0xF0);
    set(TL1, 0xF0);
    mcs52_run(chip, 15);
    TEST_ASSERT_EQUAL_HEX8(0xF0, sfr(TL1)); /* reloaded in cycle 15 */
    TEST_ASSERT_EQUAL_HEX8(0, sfr(TCON) & TF1);
    set(TMOD, 0x33);
    mcs52_run(chip, 100);
    TEST_ASSERT_EQUAL_HEX8(0xF0, sfr(TL1) & 0xF0);
    TEST_ASSERT_EQUAL_HEX8(sfr(TL1), (mcs52_run(chip, 200), sfr(TL1)));
}

static void test_that_timer_1_stands_in_its_mode_3(void)
{
    set(TMOD, 0x30);
    set(TL1, 0x12);
    set(TCON, TR1);
    mcs52_run(chip, 1000);
    TEST_ASSERT_EQUAL_HEX8(0x12, sfr(TL1));
}

/* Intel: with GATE the timer runs while its INT pin is high: it measures a pulse. */
static void test_that_a_gated_timer_measures_a_pulse(void)
{
    static const struct {
        uint8_t mode, run, low, high;
        int bit;
    } timers[] = {{0x09, TR0, TL0, TH0, 2}, {0x90, TR1, TL1, TH1, 3}};

    for (int n = 0; n < 2; n++) {
        setUp();
        mcs52_set_pin(chip, 0, 3, timers[n].bit, false);
        set(TMOD, timers[n].mode);
        mcs52_run(chip, 2);
        set(TCON, timers[n].run);
        mcs52_set_pin(chip, 1000, 3, timers[n].bit, true);
        mcs52_set_pin(chip, 6800, 3, timers[n].bit, false);
        mcs52_run(chip, 10000);
        TEST_ASSERT_EQUAL(5800, sfr(timers[n].high) << 8 | sfr(timers[n].low));
    }
}

/* Intel: a counter counts falls of its pin; the new count is there in the cycle after the one in
 * which the fall was seen. */
static void test_that_a_counter_counts_falls(void)
{
    static const struct {
        uint8_t mode, run, low;
        int bit;
    } timers[] = {
        {0x05, TR0, TL0, 4}, {0x50, TR1, TL1, 5}, {0x04, TR0, TL0, 4}, {0x40, TR1, TL1, 5}};

    for (int n = 0; n < 4; n++) {
        setUp();
        set(TMOD, timers[n].mode);
        set(TCON, timers[n].run);
        for (int pin = 0; pin < 32; pin++) {
            if (pin != 24 + timers[n].bit) {
                fall(pin / 8, pin % 8, 50); /* no matter to it */
            }
        }
        for (unsigned i = 0; i < 7; i++) {
            fall(3, timers[n].bit, 100 + 20 * i);
        }
        mcs52_run(chip, 100);
        TEST_ASSERT_EQUAL(0, sfr(timers[n].low));
        mcs52_run(chip, 101);
        TEST_ASSERT_EQUAL(1, sfr(timers[n].low));
        mcs52_run(chip, 1000);
        TEST_ASSERT_EQUAL(7, sfr(timers[n].low));
        set(TCON, 0);
        fall(3, timers[n].bit, 1100);
        mcs52_run(chip, 1200);
        TEST_ASSERT_EQUAL(7, sfr(timers[n].low));
    }
}

/* Between the fall and its count the program makes a timer of the counter: it counts cycles. */
static void test_that_a_fall_counts_for_a_counter_only(void)
{
    set(TMOD, 0x05);
    set(TCON, TR0);
    fall(3, 4, 10);
    mcs52_run(chip, 10);
    set(TMOD, 0x01);
    mcs52_run(chip, 20);
    TEST_ASSERT_EQUAL(11, sfr(TL0)); /* the cycles 10 to 20 */
}

/* Intel: the overflow of a counter sets its flag, too. */
static void test_that_a_counter_overflows(void)
{
    set(TMOD, 0x06);
    set(TL0, 0xFF);
    set(TH0, 0x40);
    set(TCON, TR0);
    fall(3, 4, 50);
    mcs52_run(chip, 50);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(TCON) & TF0);
    mcs52_run(chip, 51);
    TEST_ASSERT_EQUAL_HEX8(TF0, sfr(TCON) & TF0);
    TEST_ASSERT_EQUAL_HEX8(0x40, sfr(TL0));
}

/* --- timer 2 ------------------------------------------------------------------------------- */

/* Intel, auto-reload: at the overflow TF2 is set and RCAP2 is loaded. */
static void test_that_timer_2_reloads(void)
{
    set_t2(0xFFFE, 0xFF9C);
    set(T2CON, TR2);
    mcs52_run(chip, 1);
    TEST_ASSERT_EQUAL_HEX8(TF2, sfr(T2CON) & TF2);
    TEST_ASSERT_EQUAL_HEX16(0xFF9C, t2());
    mcs52_run(chip, 1 + 99);
    TEST_ASSERT_EQUAL_HEX16(0xFFFF, t2());
    mcs52_run(chip, 1 + 100);
    TEST_ASSERT_EQUAL_HEX16(0xFF9C, t2());
}

/* Intel: with EXEN2 a fall of T2EX reloads, too, and sets EXF2; without it does nothing. */
static void test_that_t2ex_reloads(void)
{
    set_t2(0x1000, 0x2345);
    set(T2CON, TR2);
    fall(1, 1, 10);
    mcs52_run(chip, 20);
    TEST_ASSERT_EQUAL_HEX16(0x1000 + 21, t2());
    set(T2CON, TR2 | EXEN2);
    fall(1, 1, 30);
    mcs52_run(chip, 30);
    TEST_ASSERT_EQUAL_HEX16(0x2345, t2());
    TEST_ASSERT_EQUAL_HEX8(EXF2, sfr(T2CON) & (EXF2 | TF2));
}

/* Intel, capture: a fall of T2EX copies the count to RCAP2 and the count goes on through FFFFh. */
static void test_that_timer_2_captures(void)
{
    set_t2(0xFFF0, 0x4444);
    set(T2CON, TR2 | EXEN2 | 0x01);
    fall(1, 1, 5);
    mcs52_run(chip, 5);
    TEST_ASSERT_EQUAL_HEX16(0xFFF6, sfr(RCAP2H) << 8 | sfr(RCAP2L));
    TEST_ASSERT_EQUAL_HEX8(EXF2, sfr(T2CON) & (EXF2 | TF2));
    mcs52_run(chip, 15);
    TEST_ASSERT_EQUAL_HEX16(0x0000, t2());
    TEST_ASSERT_EQUAL_HEX8(TF2, sfr(T2CON) & TF2);
    mcs52_run(chip, 15 + 65536);
    TEST_ASSERT_EQUAL_HEX16(0x0000, t2());
}

/* Intel: C/T2 makes a counter of falls of T2. */
static void test_that_timer_2_counts_falls(void)
{
    set(T2CON, TR2 | CT2);
    for (unsigned i = 0; i < 3; i++) {
        fall(1, 0, 100 + 20 * i);
    }
    mcs52_run(chip, 200);
    TEST_ASSERT_EQUAL_HEX16(3, t2());
    set(T2CON, CT2);
    fall(1, 0, 300);
    mcs52_run(chip, 400);
    TEST_ASSERT_EQUAL_HEX16(3, t2());
}

/* Atmel, DCEN: with T2EX high it counts up, reloads RCAP2 at the overflow and sets TF2; each
 * overflow and underflow toggles EXF2. */
static void test_that_timer_2_counts_up_with_t2ex_high(void)
{
    make_chip(MCS52_AT89S52);
    set(T2MOD, DCEN);
    set_t2(0xFFFE, 0xFFF0);
    set(T2CON, TR2 | EXEN2);
    mcs52_run(chip, 1);
    TEST_ASSERT_EQUAL_HEX16(0xFFF0, t2());
    TEST_ASSERT_EQUAL_HEX8(TF2 | EXF2, sfr(T2CON) & (TF2 | EXF2));
    mcs52_run(chip, 1 + 16);
    TEST_ASSERT_EQUAL_HEX8(TF2, sfr(T2CON) & (TF2 | EXF2));
}

/* With T2EX low it counts down; where it comes to RCAP2 it is set to FFFFh. */
static void test_that_timer_2_counts_down_with_t2ex_low(void)
{
    make_chip(MCS52_AT89S52);
    mcs52_set_pin(chip, 0, 1, 1, false);
    mcs52_run(chip, 1);
    set(T2MOD, DCEN);
    set_t2(0x0103, 0x0100);
    set(T2CON, TR2 | EXEN2);
    TEST_ASSERT_EQUAL_HEX16(0x0102, t2());
    mcs52_run(chip, 3);
    TEST_ASSERT_EQUAL_HEX16(0xFFFF, t2());
    TEST_ASSERT_EQUAL_HEX8(TF2 | EXF2, sfr(T2CON) & (TF2 | EXF2));
    mcs52_run(chip, 4);
    TEST_ASSERT_EQUAL_HEX16(0xFFFE, t2());
    mcs52_set_pin(chip, 10, 1, 1, true); /* up again */
    mcs52_run(chip, 9);
    TEST_ASSERT_EQUAL_HEX16(0xFFF9, t2());
    mcs52_run(chip, 11);
    TEST_ASSERT_EQUAL_HEX16(0xFFFB, t2());
    mcs52_set_pin(chip, 12, 1, 1, false); /* a fall of T2EX neither reloads nor sets EXF2 */
    mcs52_run(chip, 13);
    TEST_ASSERT_EQUAL_HEX16(0xFFF9, t2());
    mcs52_run(chip, 3 + 65535 + 40); /* once more through RCAP2 */
    TEST_ASSERT_EQUAL_HEX8(TF2, sfr(T2CON) & (TF2 | EXF2));
}

/* Nobody looks in between: T2EX falls in cycle 50 and rises in cycle 80, so of the cycles 0 to 99
 * 70 count up and 30 down. */
static void test_that_timer_2_turns_in_the_cycle_of_t2ex(void)
{
    make_chip(MCS52_AT89S52);
    set(T2MOD, DCEN);
    set_t2(0x1000, 0x0000);
    set(T2CON, TR2);
    mcs52_set_pin(chip, 50, 1, 1, false);
    mcs52_set_pin(chip, 80, 1, 1, true);
    mcs52_run(chip, 99);
    TEST_ASSERT_EQUAL_HEX16(0x1000 + 70 - 30, t2());
}

/* Intel: as a baud rate generator it sets no TF2; T2EX is then an interrupt pin that reloads
 * nothing. It counts every state. */
static void test_that_a_baud_generator_sets_no_flag(void)
{
    set_t2(0xFF00, 0xFF00);
    set(TMOD, 0x11);
    set(TCON, TR0 | TR1);
    set(T2CON, TR2 | RCLK | EXEN2);
    fall(1, 1, 20);
    mcs52_run(chip, 19);
    TEST_ASSERT_EQUAL_HEX8(20, sfr(TL0)); /* the others count cycles */
    TEST_ASSERT_EQUAL_HEX8(20, sfr(TL1));
    TEST_ASSERT_EQUAL_HEX16(0xFF00 + 6 * 20, t2());
    mcs52_run(chip, 20);
    TEST_ASSERT_EQUAL_HEX16(0xFF00 + 6 * 21, t2());
    mcs52_run(chip, 1000);
    TEST_ASSERT_EQUAL_HEX8(EXF2, sfr(T2CON) & (EXF2 | TF2));
}

/* Atmel, clock out: oscillator / (4 * (65536 - RCAP2)), 50 % duty: with FFF4h an edge every 12
 * states, which are 2 cycles. As a counter (C/T2) it puts out no clock. */
static void test_that_timer_2_puts_out_a_clock(void)
{
    make_chip(MCS52_AT89S52);
    mcs52_watch(chip, 1, 0);
    set(T2MOD, OE);
    set_t2(0xFFF4, 0xFFF4);
    set(T2CON, TR2);
    mcs52_run(chip, 100);
    for (int i = 1; i < 40; i++) {
        TEST_ASSERT_EQUAL_UINT64(2, edges[i].cycle - edges[i - 1].cycle);
    }
    TEST_ASSERT_EQUAL_HEX8(0, sfr(T2CON) & TF2);
    set(T2CON, TR2 | CT2);
    edge_count = 0;
    mcs52_run(chip, 200);
    TEST_ASSERT_EQUAL(0, edge_count);
    for (unsigned i = 0; i < 12; i++) { /* its overflow is an ordinary one */
        fall(1, 0, 300 + 20 * i);
    }
    mcs52_run(chip, 600);
    TEST_ASSERT_EQUAL_HEX8(TF2, sfr(T2CON) & TF2);
}

/* A clock too fast for its pin to be seen change each time: two overflows in a cycle are none. */
static void test_that_the_fastest_clock_is_steady(void)
{
    make_chip(MCS52_AT89S52);
    mcs52_watch(chip, 1, 0);
    set(T2MOD, OE);
    set_t2(0xFFFF, 0xFFFF);
    set(T2CON, TR2);
    mcs52_run(chip, 20);
    TEST_ASSERT_EQUAL(0, edge_count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_timer_counts_each_cycle);
    RUN_TEST(test_that_mode_0_counts_13_bits);
    RUN_TEST(test_that_mode_1_counts_16_bits);
    RUN_TEST(test_that_mode_2_overflows_every_period);
    RUN_TEST(test_that_mode_3_makes_two_timers_of_timer_0);
    RUN_TEST(test_that_either_half_may_come_first);
    RUN_TEST(test_that_the_second_half_sets_tf1_in_its_cycle);
    RUN_TEST(test_that_timer_1_runs_alone_beside_mode_3);
    RUN_TEST(test_that_timer_1_stands_in_its_mode_3);
    RUN_TEST(test_that_a_gated_timer_measures_a_pulse);
    RUN_TEST(test_that_a_counter_counts_falls);
    RUN_TEST(test_that_a_fall_counts_for_a_counter_only);
    RUN_TEST(test_that_a_counter_overflows);
    RUN_TEST(test_that_timer_2_reloads);
    RUN_TEST(test_that_t2ex_reloads);
    RUN_TEST(test_that_timer_2_captures);
    RUN_TEST(test_that_timer_2_counts_falls);
    RUN_TEST(test_that_timer_2_counts_up_with_t2ex_high);
    RUN_TEST(test_that_timer_2_counts_down_with_t2ex_low);
    RUN_TEST(test_that_timer_2_turns_in_the_cycle_of_t2ex);
    RUN_TEST(test_that_a_baud_generator_sets_no_flag);
    RUN_TEST(test_that_timer_2_puts_out_a_clock);
    RUN_TEST(test_that_the_fastest_clock_is_steady);
    return UNITY_END();
}
