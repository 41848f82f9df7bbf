/* SPDX-License-Identifier: MIT */
/* Under test: the serial port of tools/drive/sim/mcs52, by cases worked out by hand from Intel's
 * MCS-51 Microcontroller Family User's Manual ("Intel"). An instruction that ends at cycle N writes
 * in cycle N-1; a bit of TXD is at the pin from the cycle on that its edge names. */
#include "mcs52_chip.h"

enum {
    SM2 = 0x20,
    REN = 0x10,
    TB8 = 0x08,
    RB8 = 0x04,
    TI = 0x02,
    RI = 0x01,
    MODE_1 = 0x40,
    MODE_2 = 0x80,
    MODE_3 = 0xC0,
    SMOD = 0x80,
    TR1 = 0x40,
    TR2 = 0x04,
    CT2 = 0x02,
    BOTH_BY_T2 = 0x30,
    RX_BY_T2 = 0x20,
    TXD = 31,
    RXD = 30
};

/* Timer 1 in mode 2 from RELOAD on, running. */
static void start_timer_1(unsigned reload)
{
    set(TMOD, 0x20);
    set(TH1, reload);
    set(TL1, reload);
    set(TCON, TR1);
}

/* A frame at RXD: COUNT bits, the start bit first. */
static void feed(uint64_t cycle, unsigned bits, int count, double bit_cycles)
{
    for (int i = 0; i < count; i++) {
        mcs52_set_pin(chip, cycle + (uint64_t)(i * bit_cycles + 0.5), 3, 0, bits >> i & 1);
    }
}

/* The level of TXD in the cycle CYCLE, by the edges. */
static int txd_at(uint64_t cycle)
{
    int level = 1;

    for (int i = 0; i < edge_count; i++) {
        if (edges[i].pin == TXD && edges[i].cycle <= cycle) {
            level = edges[i].value;
        }
    }
    return level;
}

/* The frame on TXD from its start bit at FIRST on, sampled in the middle of its COUNT bits. */
static unsigned frame_at(uint64_t first, int count, double bit_cycles)
{
    unsigned bits = 0;

    for (int i = 0; i < count; i++) {
        bits |= (unsigned)txd_at(first + (uint64_t)((i + 0.5) * bit_cycles)) << i;
    }
    return bits;
}

static void watch_line(void)
{
    mcs52_watch(chip, 3, 0);
    mcs52_watch(chip, 3, 1);
}

/* --- mode 0 -------------------------------------------------------------------------------- */

/* Intel, mode 0: one machine cycle passes between the write to SBUF and SEND; then a bit a cycle,
 * the lowest first, on RXD, with a clock pulse on TXD; TI comes in the tenth cycle after the
 * write. The write is in cycle 1, so the bits are in the cycles 3 to 10, and TI is there in cycle
 * 11. */
static void test_that_mode_0_shifts_a_byte_out(void)
{
    int pulses = 0;
    unsigned bits = 0;

    watch_line();
    LOAD(0, MOV_DIRECT, SBUF, 0x35);
    mcs52_run(chip, 10);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & TI);
    mcs52_run(chip, 11);
    TEST_ASSERT_EQUAL_HEX8(TI, sfr(SCON) & TI);
    for (uint64_t cycle = 3; cycle <= 10; cycle++) {
        int level = 1;

        for (int i = 0; i < edge_count; i++) {
            level = edges[i].pin == RXD && edges[i].cycle <= cycle ? edges[i].value : level;
        }
        bits |= (unsigned)level << (cycle - 3);
    }
    for (int i = 0; i < edge_count; i++) {
        pulses += edges[i].pin == TXD && edges[i].value == 0;
    }
    TEST_ASSERT_EQUAL_HEX8(0x35, bits);
    TEST_ASSERT_EQUAL(8, pulses);
    TEST_ASSERT_EQUAL(1, byte_count);
    TEST_ASSERT_EQUAL_UINT64(11, bytes[0].cycle);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 3, 0));
}

/* Intel: REN = 1 and RI = 0 begin a reception, which takes as long: RI is there in the tenth cycle
 * after the write to SCON. A second one begins when RI is cleared, and none while it is set. */
static void test_that_mode_0_shifts_a_byte_in(void)
{
    LOAD(0, MOV_DIRECT, SCON, REN);
    feed(3, 0xA6, 8, 1);
    mcs52_run(chip, 10);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
    mcs52_run(chip, 11);
    TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & RI);
    TEST_ASSERT_EQUAL_HEX8(0xA6, sfr(SBUF));
    set(SCON, REN | RI | TB8);
    mcs52_run(chip, 100);
    TEST_ASSERT_EQUAL_HEX8(0xA6, sfr(SBUF));
    set(SCON, REN);
    set(SCON, REN | TB8); /* a write in the middle does not begin it again */
    mcs52_set_pin(chip, 100, 3, 0, true);
    mcs52_run(chip, 109);
    TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & RI);
    TEST_ASSERT_EQUAL_HEX8(0xFF, sfr(SBUF));
}

/* REN = 0 breaks it off, and REN = 1 begins anew. */
static void test_that_mode_0_begins_anew(void)
{
    set(SCON, REN);
    mcs52_run(chip, 5);
    set(SCON, 0);
    mcs52_run(chip, 100);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
    feed(100, 0x1A6 << 2, 11, 1); /* its bit 0 comes in cycle 102 */
    LOAD(100, MOV_DIRECT, SCON, REN);
    mcs52_run(chip, 110);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
    mcs52_run(chip, 111);
    TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & RI);
}

/* --- mode 1 -------------------------------------------------------------------------------- */

/* Intel: T2 as baud rate generator, oscillator / (32 * (65536 - RCAP2)): with FFD9h a bit takes
 * 39 * 16 states or 104 cycles. TI comes with the stop bit. */
static void test_that_a_byte_leaves_bit_by_bit(void)
{
    watch_line();
    LOAD(0, MOV_DIRECT, RCAP2L, 0xD9, MOV_DIRECT, RCAP2H, 0xFF, MOV_DIRECT, TL2, 0xD9, MOV_DIRECT,
         TH2, 0xFF, MOV_DIRECT, T2CON, BOTH_BY_T2 | TR2, MOV_DIRECT, SCON, MODE_1, MOV_DIRECT, SBUF,
         0x55, SJMP, HERE);
    mcs52_run(chip, 5000);
    TEST_ASSERT_EQUAL_HEX16(0x2AA, frame_at(edges[0].cycle, 10, 104)); /* 1 0101 0101 0 */
    TEST_ASSERT_EQUAL(1, byte_count);
    TEST_ASSERT_EQUAL_HEX8(0x55, bytes[0].value);
    TEST_ASSERT_EQUAL_UINT64(edges[0].cycle + 1040, bytes[0].cycle);
    TEST_ASSERT_EQUAL_HEX8(TI, sfr(SCON) & TI);
}

/* Intel: timer 1's overflow rate / 32, or / 16 with SMOD: from FDh on, 96 or 48 cycles a bit. */
static void test_that_timer_1_gives_the_baud_rate(void)
{
    for (int doubled = 0; doubled < 2; doubled++) {
        unsigned bit = doubled ? 48 : 96;

        setUp();
        watch_line();
        start_timer_1(0xFD);
        set(PCON, doubled ? SMOD : 0);
        set(SCON, MODE_1);
        LOAD(0, MOV_DIRECT, SBUF, 0xC3);
        mcs52_run(chip, 3000);
        TEST_ASSERT_EQUAL_HEX16(0x386, frame_at(edges[0].cycle, 10, bit)); /* 1 1100 0011 0 */
        TEST_ASSERT_EQUAL_UINT64(edges[0].cycle + 10 * bit, bytes[0].cycle);
    }
}

/* From FDh on, timer 1 overflows in the cycles 2, 5, 8, ..; with SMOD = 0 every other overflow is a
 * tick, the second one the first: 5, 11, 17, .. A clock that starts with mode 1 rolls over at its
 * 16th tick, and the start bit is at the pin in the cycle after. */
static void test_that_a_frame_begins_after_sixteen_ticks(void)
{
    static const struct {
        unsigned at, smod, start;
    } cases[] = {{0, 0, 5 + 15 * 6 + 1},
                 {0, SMOD, 2 + 15 * 3 + 1},
                 {100, 0, 101 + 15 * 6 + 1}, /* 33 overflows are over */
                 {103, 0, 107 + 15 * 6 + 1}, /* 34 */
                 {101, SMOD, 101 + 15 * 3 + 1}};

    for (int i = 0; i < 5; i++) {
        setUp();
        watch_line();
        start_timer_1(0xFD);
        set(PCON, cases[i].smod);
        mcs52_run(chip, cases[i].at);
        set(SCON, MODE_1);
        LOAD((uint16_t)cases[i].at, MOV_DIRECT, SBUF, 0xC3);
        mcs52_run(chip, 3000);
        TEST_ASSERT_TRUE(edges[0].cycle == cases[i].start);
    }
}

/* The same by timer 2 from FFD9h on, which overflows in the states 38 + 39 k. At 6000 the 154th one
 * comes next, in state 6005. */
static void test_that_a_frame_by_timer_2_begins_after_sixteen_ticks(void)
{
    for (unsigned at = 0; at <= 1000; at += 1000) {
        unsigned first = at == 0 ? 38 : 6005;

        setUp();
        watch_line();
        set(RCAP2L, 0xD9);
        set(RCAP2H, 0xFF);
        set(TL2, 0xD9);
        set(TH2, 0xFF);
        set(T2CON, BOTH_BY_T2 | TR2);
        mcs52_run(chip, at);
        set(SCON, MODE_1);
        LOAD((uint16_t)at, MOV_DIRECT, SBUF, 0xC3);
        mcs52_run(chip, 3000);
        TEST_ASSERT_TRUE(edges[0].cycle == (first + 15 * 39) / 6 + 1);
    }
}

/* TI is set in cycle 960, RI in cycle 1019 (below): polled a cycle later, then an LCALL of two, so
 * INC 44h ends five cycles after the flag. */
static void test_that_both_flags_interrupt(void)
{
    for (int receives = 0; receives < 2; receives++) {
        unsigned flag = receives ? 1019 : 960;

        setUp();
        start_timer_1(0xFD);
        LOAD(0x23, INC_DIRECT, 0x44, RETI);
        mcs52_jump(chip, 0x1000);
        set(SCON, MODE_1 | REN);
        set(IE, 0x90);
        if (receives) {
            mcs52_feed(chip, 100, 0xA7, 96);
        } else {
            LOAD(0x1000, MOV_DIRECT, SBUF, 0x55);
        }
        mcs52_run(chip, flag + 4);
        TEST_ASSERT_EQUAL(0, mcs52_ram(chip)[0x44]);
        mcs52_run(chip, flag + 5);
        TEST_ASSERT_EQUAL(1, mcs52_ram(chip)[0x44]);
    }
}

/* In idle the serial port goes on: PCON's IDL is no SMOD. */
static void test_that_frames_go_on_in_idle(void)
{
    watch_line();
    start_timer_1(0xFD);
    set(SCON, MODE_1 | REN);
    LOAD(0, MOV_DIRECT, SBUF, 0x55, MOV_DIRECT, 0x87, 0x01);
    mcs52_feed(chip, 100, 0xA7, 96);
    mcs52_run(chip, 1018);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
    mcs52_run(chip, 1100);
    TEST_ASSERT_EQUAL_HEX8(0xA7, sfr(SBUF));
    TEST_ASSERT_EQUAL_HEX16(0x2AA, frame_at(96, 10, 96));
    TEST_ASSERT_EQUAL_UINT64(96 + 960, bytes[0].cycle);
    setUp();
    watch_line();
    set(SCON, MODE_2);
    LOAD(0, MOV_DIRECT, SBUF, 0x53, MOV_DIRECT, 0x87, 0x01);
    mcs52_run(chip, 200);
    TEST_ASSERT_EQUAL_HEX16(0x400 | 0x53 << 1, frame_at(edges[0].cycle, 11, 16 / 3.0));
}

/* After a reset, too: 33 overflows are over in cycle 100, and nothing is left of them, nor of the
 * frames on their way. */
static void test_that_a_reset_begins_anew(void)
{
    watch_line();
    start_timer_1(0xFD);
    set(SCON, MODE_1 | REN);
    mcs52_feed(chip, 10, 0x00, 5);
    LOAD(0, MOV_DIRECT, SBUF, 0x55);
    mcs52_run(chip, 100);
    TEST_ASSERT_FALSE(mcs52_pin(chip, 3, 1));
    mcs52_reset(chip);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 3, 1));
    edge_count = 0;
    mcs52_jump(chip, 0x100);
    start_timer_1(0xFD);
    set(SCON, MODE_1);
    LOAD(0x100, MOV_DIRECT, SBUF, 0xC3);
    mcs52_run(chip, 3000);
    TEST_ASSERT_EQUAL_UINT64(100 + 5 + 15 * 6 + 1, edges[0].cycle);
    TEST_ASSERT_EQUAL(1, byte_count);
    TEST_ASSERT_EQUAL_HEX8(0xC3, bytes[0].value);
}

/* The same ticks: RXD falls in cycle 100, the tick in 101 sees it, and the stop bit's third sample
 * is the ninth tick of the tenth bit. */
static void test_that_a_byte_is_in_with_the_stop_bits_last_sample(void)
{
    static const unsigned smods[] = {0, SMOD};

    for (int i = 0; i < 2; i++) {
        unsigned tick = i == 0 ? 6 : 3, in = 101 + (9 * 16 + 9) * tick;

        setUp();
        start_timer_1(0xFD);
        set(PCON, smods[i]);
        set(SCON, MODE_1 | REN);
        mcs52_feed(chip, 100, 0xA7, 16 * tick);
        mcs52_run(chip, in - 1);
        TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
        mcs52_run(chip, in);
        TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & RI);
        TEST_ASSERT_EQUAL_HEX8(0xA7, sfr(SBUF));
    }
}

/* Intel: a bit is what two of the samples at its ticks 7, 8 and 9 say. Bit 0 is low but in the
 * cycles from the first to before the last of each case. */
static void test_that_two_of_three_samples_decide(void)
{
    static const struct {
        unsigned from, to;
        bool bit;
    } cases[] = {{6, 7, false},  {6, 8, false}, {7, 9, true},   {8, 10, true},
                 {9, 11, false}, {0, 7, false}, {10, 16, false}};
    const unsigned start = 101 + 16 * 6; /* the tick at which bit 0 begins */

    for (int i = 0; i < 7; i++) {
        setUp();
        start_timer_1(0xFD);
        set(SCON, MODE_1 | REN);
        mcs52_set_pin(chip, 100, 3, 0, false);
        mcs52_set_pin(chip, start + 6 * cases[i].from, 3, 0, true);
        mcs52_set_pin(chip, start + 6 * cases[i].to, 3, 0, false);
        mcs52_set_pin(chip, 100 + 9 * 96, 3, 0, true);
        mcs52_run(chip, 1100);
        TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & RI);
        TEST_ASSERT_EQUAL_HEX8(cases[i].bit, sfr(SBUF));
    }
}

/* SMOD is set in cycle 144, eight ticks after the roll-over in 95: the other eight come in 146,
 * 149, .., 167. */
static void test_that_smod_halves_the_rest_of_a_bit(void)
{
    watch_line();
    start_timer_1(0xFD);
    set(SCON, MODE_1);
    LOAD(0, MOV_DIRECT, SBUF, 0x55);
    mcs52_run(chip, 144);
    set(PCON, SMOD);
    mcs52_run(chip, 3000);
    TEST_ASSERT_EQUAL_UINT64(96, edges[0].cycle);
    for (unsigned i = 1; i < 10; i++) {
        TEST_ASSERT_EQUAL_UINT64(168 + 48 * (i - 1), edges[i].cycle);
    }
}

/* Writes to SCON that leave the mode as it is, one a cycle: CPL TB8. */
static void test_that_writes_to_scon_do_not_disturb_frames(void)
{
    watch_line();
    for (unsigned at = 0; at < 0x1000; at += 2) {
        LOAD((uint16_t)at, CPL, 0x9B);
    }
    LOAD(0, MOV_DIRECT, SBUF, 0x55);
    LOAD(3, NOP);
    start_timer_1(0xFD);
    set(SCON, MODE_1 | REN);
    mcs52_feed(chip, 100, 0xA7, 96);
    mcs52_run(chip, 1018);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
    mcs52_run(chip, 1019);
    TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & RI);
    TEST_ASSERT_EQUAL_HEX8(0xA7, sfr(SBUF));
    mcs52_run(chip, 1100);
    TEST_ASSERT_EQUAL_HEX16(0x2AA, frame_at(96, 10, 96));
    TEST_ASSERT_EQUAL_UINT64(96 + 960, bytes[0].cycle);
}

/* The clock stands in the start bit, from cycle 150 on for 50,001 cycles: all later bits, sent and
 * received, come so much later. Power-down, which INT0 ends, or an oscillator that stops. */
static void test_that_frames_stand_still_with_the_clock(void)
{
    enum { STOOD = 50001 };
    const struct mcs52_fault stop = {.kind = MCS52_CLOCK_STOP, .when = 150, .cycles = STOOD};

    for (int by_fault = 0; by_fault < 2; by_fault++) {
        unsigned bit = 1;

        make_chip(MCS52_AT89S52);
        watch_line();
        LOAD(3, RETI);
        mcs52_jump(chip, 0x100);
        LOAD(0x100, MOV_DIRECT, SBUF, 0x55);
        start_timer_1(0xFD);
        set(TCON, TR1 | 0x01); /* INT0 by edge */
        set(IE, 0x81);
        set(SCON, MODE_1 | REN);
        for (unsigned i = 0; i < 10; i++) {
            mcs52_set_pin(chip, 100 + 96 * i + (i > 0 ? STOOD : 0), 3, 0, 0x34E >> i & 1); /* A7h */
        }
        if (by_fault) {
            TEST_ASSERT_TRUE(mcs52_inject(chip, &stop));
        } else {
            mcs52_set_pin(chip, 150 + STOOD, 3, 2, false);
        }
        mcs52_run(chip, 150);
        if (!by_fault) {
            set(PCON, 0x02);
        }
        edge_count = 0;
        mcs52_run(chip, 1018 + STOOD);
        TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
        mcs52_run(chip, 1019 + STOOD);
        TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & RI);
        TEST_ASSERT_EQUAL_HEX8(0xA7, sfr(SBUF));
        mcs52_run(chip, 1100 + STOOD);
        for (int i = 0; i < edge_count; i++) {
            if (edges[i].pin == TXD) {
                TEST_ASSERT_EQUAL_UINT64(96 + 96 * bit++ + STOOD, edges[i].cycle);
            }
        }
        TEST_ASSERT_EQUAL(10, bit);
        TEST_ASSERT_EQUAL_UINT64(96 + 960 + STOOD, bytes[0].cycle);
    }
}

/* Without a running timer no bit leaves. */
static void test_that_a_stopped_timer_sends_nothing(void)
{
    static const uint8_t controls[] = {0, BOTH_BY_T2};

    for (int i = 0; i < 2; i++) {
        setUp();
        watch_line();
        set(TMOD, 0x20);
        set(TH1, 0xFD);
        set(TL1, 0xFD);
        set(RCAP2H, 0xFF);
        set(RCAP2L, 0xD9);
        set(TH2, 0xFF);
        set(TL2, 0xD9);
        set(T2CON, controls[i]);
        set(SCON, MODE_1 | REN);
        LOAD(0, MOV_DIRECT, SBUF, 0x00);
        mcs52_set_pin(chip, 100, 3, 0, false);
        mcs52_run(chip, 100000);
        TEST_ASSERT_EQUAL(1, edge_count); /* that of RXD */
        TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & (TI | RI));
    }
}

/* Intel: the write to SBUF loads the shift register: a byte written during the stop bit follows
 * it, an earlier one breaks the frame off. */
static void test_that_a_second_byte_waits_for_the_stop_bit(void)
{
    watch_line();
    start_timer_1(0xFD);
    set(SCON, MODE_1);
    set(SBUF, 0);                                  /* as storage only */
    LOAD(0, MOV_DIRECT, SBUF, 0x11,                /* the first */
         0x30, 0x99, 0xFD, MOV_DIRECT, SBUF, 0x22, /* JNB TI, $; the second */
         SJMP, HERE);
    mcs52_run(chip, 4000);
    TEST_ASSERT_EQUAL(2, byte_count);
    TEST_ASSERT_EQUAL_HEX8(0x11, bytes[0].value);
    TEST_ASSERT_EQUAL_HEX8(0x22, bytes[1].value);
    TEST_ASSERT_EQUAL_UINT64(960, bytes[1].cycle - bytes[0].cycle);
}

static void test_that_a_byte_written_too_early_breaks_a_frame_off(void)
{
    start_timer_1(0xFD);
    set(SCON, MODE_1);
    LOAD(0, MOV_DIRECT, SBUF, 0x11);
    LOAD(400, MOV_DIRECT, SBUF, 0x22);
    mcs52_run(chip, 4000);
    TEST_ASSERT_EQUAL(1, byte_count);
    TEST_ASSERT_EQUAL_HEX8(0x22, bytes[0].value);
}

/* A write in the very cycle in which a bit is due: the bit is still the earlier frame's. Each
 * cycle of the first bit is tried. Bits are due in the cycles 96, 192, ..; the new frame begins
 * with the first one after the write, which ends in cycle at + 1. */
static void test_that_any_moment_of_a_write_is_fine(void)
{
    for (uint16_t at = 4; at < 204; at++) {
        setUp();
        start_timer_1(0xFD);
        set(SCON, MODE_1);
        LOAD(0, MOV_DIRECT, SBUF, 0x11);
        LOAD(at, MOV_DIRECT, SBUF, 0x22);
        mcs52_run(chip, 4000);
        TEST_ASSERT_EQUAL(1, byte_count);
        TEST_ASSERT_EQUAL_HEX8(0x22, bytes[0].value);
        TEST_ASSERT_EQUAL_UINT64(96 * ((at + 1) / 96 + 1) + 960, bytes[0].cycle);
    }
}

/* The stop bit is from cycle 960 to before 1056: a write that ends there waits, one that ends in
 * 959 breaks the frame off, one that ends in 1056 finds nothing to wait for. */
static void test_that_the_stop_bit_is_the_time_to_wait(void)
{
    static const struct {
        uint16_t end, second;
        int count;
    } cases[] = {{959, 960, 1}, {960, 1056, 2}, {1000, 1056, 2}, {1055, 1056, 2}, {1056, 1152, 2}};

    for (int i = 0; i < 5; i++) {
        setUp();
        start_timer_1(0xFD);
        set(SCON, MODE_1);
        LOAD(0, MOV_DIRECT, SBUF, 0x11);
        LOAD((uint16_t)(cases[i].end - 1), MOV_DIRECT, SBUF, 0x22);
        mcs52_run(chip, 4000);
        TEST_ASSERT_EQUAL(cases[i].count, byte_count);
        TEST_ASSERT_EQUAL_HEX8(0x22, bytes[byte_count - 1].value);
        TEST_ASSERT_TRUE(bytes[byte_count - 1].cycle == cases[i].second + 960U);
    }
}

/* Intel: RI, and the stop bit in RB8. With RI still set a byte is lost. */
static void test_that_a_byte_comes_in(void)
{
    start_timer_1(0xFD);
    set(SCON, MODE_1 | REN);
    TEST_ASSERT_EQUAL_UINT64(100 + 960, mcs52_feed(chip, 100, 0xA7, 96));
    mcs52_run(chip, 1100);
    TEST_ASSERT_EQUAL_HEX8(RI | RB8, sfr(SCON) & (RI | RB8));
    TEST_ASSERT_EQUAL_HEX8(0xA7, sfr(SBUF));
    mcs52_feed(chip, 1200, 0x99, 96);
    mcs52_run(chip, 2300);
    TEST_ASSERT_EQUAL_HEX8(0xA7, sfr(SBUF));
    set(SCON, MODE_1 | REN);
    mcs52_feed(chip, 2400, 0x99, 96);
    mcs52_run(chip, 3500);
    TEST_ASSERT_EQUAL_HEX8(0x99, sfr(SBUF));
}

/* Intel: with SM2 in mode 1, RI is not set without a valid stop bit. */
static void test_that_sm2_wants_a_stop_bit(void)
{
    start_timer_1(0xFD);
    set(SCON, MODE_1 | REN | SM2);
    feed(100, 0x0AA, 10, 96); /* no stop bit */
    mcs52_run(chip, 1200);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
    set(SCON, MODE_1 | REN);
    mcs52_set_pin(chip, 1200, 3, 0, true);
    feed(1300, 0x0AA, 10, 96);
    mcs52_run(chip, 2400);
    TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & (RI | RB8)); /* the stop bit was 0 */
}

/* Intel: a start bit that is not there any more at the samples is a spike; and one that is over
 * before the next tick is not seen at all. */
static void test_that_spikes_are_no_start_bits(void)
{
    start_timer_1(0xFD);
    set(SCON, MODE_1 | REN);
    for (unsigned i = 0; i < 12; i++) { /* a tick comes every 6 cycles */
        uint64_t at = 1000 + 201 * i;

        mcs52_set_pin(chip, at, 3, 0, false);
        mcs52_set_pin(chip, at + (i < 6 ? 1 : 20), 3, 0, true);
    }
    mcs52_run(chip, 4000);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
    mcs52_feed(chip, 4000, 0x5A, 96);
    mcs52_run(chip, 5000);
    TEST_ASSERT_EQUAL_HEX8(0x5A, sfr(SBUF));
}

/* Intel: REN = 0 ends reception; a change of mode ends all. */
static void test_that_ren_and_the_mode_end_a_frame(void)
{
    start_timer_1(0xFD);
    set(SCON, MODE_1 | REN);
    mcs52_feed(chip, 100, 0xA7, 96);
    mcs52_run(chip, 500);
    set(SCON, MODE_1);
    mcs52_run(chip, 2000);
    TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
    LOAD(2000, MOV_DIRECT, SBUF, 0x55);
    mcs52_run(chip, 2500);
    set(SCON, MODE_3);
    mcs52_run(chip, 5000);
    TEST_ASSERT_EQUAL(0, byte_count);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 3, 1));
}

/* REN = 0 between the samples of a bit: the next byte's samples start at its own first one. Samples
 * of bit 0, which is high, are in the cycles 239, 245 and 251. */
static void test_that_samples_of_a_broken_frame_are_forgotten(void)
{
    for (unsigned end = 236; end < 256; end++) {
        setUp();
        start_timer_1(0xFD);
        set(SCON, MODE_1 | REN);
        mcs52_feed(chip, 100, 0xFF, 96);
        mcs52_run(chip, end);
        set(SCON, MODE_1);
        set(SCON, MODE_1 | REN);
        mcs52_feed(chip, 400, 0x5A, 96);
        mcs52_run(chip, 400 + 960);
        TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & RI);
        TEST_ASSERT_EQUAL_HEX8(0x5A, sfr(SBUF));
    }
}

/* Each clock has its own source: with RCLK alone timer 2 receives and timer 1 sends. */
static void test_that_the_two_clocks_are_apart(void)
{
    watch_line();
    start_timer_1(0xFD);
    set(RCAP2H, 0xFF);
    set(RCAP2L, 0xD9);
    set(TH2, 0xFF);
    set(TL2, 0xD9);
    set(T2CON, RX_BY_T2 | TR2);
    set(SCON, MODE_1 | REN);
    LOAD(0, MOV_DIRECT, SBUF, 0x55);
    mcs52_feed(chip, 100, 0x3C, 104);
    mcs52_run(chip, 1300);
    TEST_ASSERT_EQUAL_HEX8(0x3C, sfr(SBUF));
    TEST_ASSERT_EQUAL_UINT64(960, bytes[0].cycle - edges[0].cycle);
}

/* --- modes 2 and 3 -------------------------------------------------------------------------- */

/* Intel, mode 2: oscillator / 64, with SMOD / 32: 16/3 or 8/3 cycles a bit; eleven bits with TB8 as
 * the ninth. TI comes with the stop bit. */
static void test_that_mode_2_sends_nine_bits(void)
{
    for (int doubled = 0; doubled < 2; doubled++) {
        for (int ninth = 0; ninth < 2; ninth++) {
            double bit = doubled ? 8 / 3.0 : 16 / 3.0;

            setUp();
            watch_line();
            set(PCON, doubled ? SMOD : 0);
            set(SCON, MODE_2 | (ninth ? TB8 : 0));
            LOAD(0, MOV_DIRECT, SBUF, 0x53);
            mcs52_run(chip, 200);
            TEST_ASSERT_EQUAL_HEX16(0x400 | ninth << 9 | 0x53 << 1,
                                    frame_at(edges[0].cycle, 11, bit));
            TEST_ASSERT_UINT64_WITHIN(1, (uint64_t)(11 * bit), bytes[0].cycle - edges[0].cycle);
        }
    }
}

/* Intel, multiprocessor communication: with SM2 only a frame with the ninth bit set is received,
 * and RB8 is the ninth bit. After it the receiver looks for a new start bit. */
static void test_that_modes_2_and_3_receive_nine_bits(void)
{
    static const uint8_t modes[] = {MODE_2, MODE_3};

    for (int i = 0; i < 2; i++) {
        double bit = i == 0 ? 16 / 3.0 : 96;
        uint64_t frame = (uint64_t)(12 * bit);

        setUp();
        start_timer_1(0xFD);
        set(SCON, modes[i] | REN | SM2);
        feed(100, 0x400 | 0x11 << 1, 11, bit);
        mcs52_run(chip, 100 + frame);
        TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
        feed(100 + frame, 0x600 | 0x22 << 1, 11, bit);
        mcs52_run(chip, 100 + 2 * frame);
        TEST_ASSERT_EQUAL_HEX8(RI | RB8, sfr(SCON) & (RI | RB8));
        TEST_ASSERT_EQUAL_HEX8(0x22, sfr(SBUF));
        set(SCON, modes[i] | REN);
        feed(100 + 2 * frame, 0x400 | 0x33 << 1, 11, bit);
        mcs52_run(chip, 100 + 3 * frame);
        TEST_ASSERT_EQUAL_HEX8(RI, sfr(SCON) & (RI | RB8));
        TEST_ASSERT_EQUAL_HEX8(0x33, sfr(SBUF));
    }
}

/* Intel, modes 2 and 3: the receiver looks for a start bit again a bit after the ninth one. By
 * timer 1 as above: the ninth bit's last sample is in cycle 1019, so it looks from cycle 1115 on. A
 * fall in that cycle, with no other after it, is no start bit; one in the next cycle is. */
static void test_that_a_receiver_waits_for_the_stop_bit(void)
{
    for (unsigned fall = 1115; fall <= 1116; fall++) {
        setUp();
        start_timer_1(0xFD);
        set(SCON, MODE_3 | REN);
        feed(100, 0x400 | 0x3FE, 11, 96);
        mcs52_run(chip, 1018);
        TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
        mcs52_run(chip, 1019);
        TEST_ASSERT_EQUAL_HEX8(RI | RB8, sfr(SCON) & (RI | RB8));
        mcs52_run(chip, 1020 + 10 * (fall - 1115)); /* a write meanwhile is no matter */
        set(SCON, MODE_3 | REN);
        feed(fall, 0x400, 11, 96);
        mcs52_run(chip, 1121 + 153 * 6 - 1);
        TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
        mcs52_run(chip, 1121 + 153 * 6);
        TEST_ASSERT_EQUAL_HEX8(fall == 1115 ? 0 : RI, sfr(SCON) & (RI | RB8));
    }
}

/* Mode 2's clocks start with it: ticks in every other state from cycle 1000 on, the 16th in the
 * state 6030, which is in cycle 1005. */
static void test_that_mode_2_starts_its_clock(void)
{
    watch_line();
    mcs52_run(chip, 1000);
    set(SCON, MODE_2);
    LOAD(1000, MOV_DIRECT, SBUF, 0x53);
    mcs52_run(chip, 1200);
    TEST_ASSERT_EQUAL_UINT64(1006, edges[0].cycle);
}

/* A program that changes another register in each cycle: CPL EXF2, in T2CON. */
static void load_writes(void)
{
    static const uint8_t cpl_exf2[] = {CPL, 0xCE};

    for (unsigned at = 0; at < 0x2000; at += 2) {
        mcs52_load(chip, (uint16_t)at, cpl_exf2, sizeof cpl_exf2);
    }
}

/* Writes to other registers in each cycle leave a frame as it is. */
static void test_that_other_writes_do_not_disturb_a_frame(void)
{
    watch_line();
    load_writes();
    start_timer_1(0xFF);
    set(SCON, MODE_1);
    LOAD(0x100, NOP, NOP, NOP, MOV_DIRECT, SBUF, 0x93);
    mcs52_run(chip, 2000);
    TEST_ASSERT_EQUAL_HEX16(0x200 | 0x93 << 1, frame_at(edges[0].cycle, 10, 32));
    TEST_ASSERT_EQUAL_UINT64(edges[0].cycle + 320, bytes[0].cycle);
}

/* --- timers that count a pin ----------------------------------------------------------------- */

/* PULSES falls of a pin, 4 cycles apart. */
static uint64_t pulse(int port, int bit, uint64_t cycle, int pulses)
{
    for (int i = 0; i < pulses; i++, cycle += 4) {
        mcs52_set_pin(chip, cycle, port, bit, false);
        mcs52_set_pin(chip, cycle + 2, port, bit, true);
        mcs52_run(chip, cycle + 3);
    }
    return cycle;
}

/* Intel: timer 1 may count a pin as well. From FFh on each fall is an overflow: 32 falls a bit,
 * with SMOD 16. */
static void test_that_a_counter_gives_the_baud_rate(void)
{
    for (int doubled = 0; doubled < 2; doubled++) {
        int falls = doubled ? 16 : 32;

        setUp();
        watch_line();
        load_writes();
        set(TMOD, 0x60);
        set(TH1, 0xFF);
        set(TL1, 0xFF);
        set(TCON, TR1);
        set(PCON, doubled ? SMOD : 0);
        set(SCON, MODE_1);
        LOAD(0, NOP, MOV_DIRECT, SBUF, 0x55);
        mcs52_run(chip, 10);
        pulse(3, 5, 100, 12 * falls);
        /* The last of that many falls is counted a cycle after it was seen. */
        TEST_ASSERT_EQUAL_UINT64(100 + 4 * (falls - 1) + 2, edges[0].cycle);
        TEST_ASSERT_EQUAL_HEX16(0x2AA, frame_at(edges[0].cycle, 10, 4 * falls));
        TEST_ASSERT_EQUAL(1, byte_count);
    }
}

/* The same with timer 2; falls of timer 1's pin are no ticks. */
static void test_that_timer_2_as_a_counter_sends(void)
{
    watch_line();
    set(TMOD, 0x60);
    set(TH1, 0xFF);
    set(TL1, 0xFF);
    set(TCON, TR1);
    set(RCAP2H, 0xFF);
    set(RCAP2L, 0xFF);
    set(TH2, 0xFF);
    set(TL2, 0xFF);
    set(T2CON, BOTH_BY_T2 | TR2 | CT2);
    set(SCON, MODE_1);
    LOAD(0, MOV_DIRECT, SBUF, 0x55);
    pulse(3, 5, 100, 21); /* an odd count: with SMOD = 0 no tick by timer 1 */
    pulse(1, 0, 200, 12 * 16);
    TEST_ASSERT_EQUAL_UINT64(200 + 4 * 15 + 2, edges[0].cycle);
    TEST_ASSERT_EQUAL_HEX16(0x2AA, frame_at(edges[0].cycle, 10, 64));
    TEST_ASSERT_EQUAL(1, byte_count);
}

/* The same with timer 2: 16 falls a bit; the bits that come in are RXD's. A fall of the pins of
 * timers 0 and 1 is no tick, nor is one in mode 2 or 0. */
static void test_that_timer_2_as_a_counter_receives(void)
{
    static const uint8_t levels[] = {0, 1, 0, 1, 1, 0, 0, 1, 0, 1}; /* 4Dh */
    uint64_t at = 100;

    watch_line();
    set(TMOD, 0x66);
    set(TH0, 0xFF);
    set(TL0, 0xFF);
    set(TH1, 0xFF);
    set(TL1, 0xFF);
    set(TCON, TR1 | 0x10);
    set(PCON, SMOD);
    set(RCAP2H, 0xFF);
    set(RCAP2L, 0xFF);
    set(TH2, 0xFF);
    set(TL2, 0xFF);
    set(T2CON, BOTH_BY_T2 | TR2 | CT2);
    set(SCON, MODE_1 | REN);
    for (int i = 0; i < 10; i++) {
        mcs52_set_pin(chip, at, 3, 0, levels[i]);
        at = pulse(3, 4, at, 3);
        at = pulse(3, 5, at, 3);
        at = pulse(1, 0, at, 9);
        TEST_ASSERT_EQUAL_HEX8(0, sfr(SCON) & RI);
        at = pulse(1, 0, at, 1); /* the third sample: the first fall has seen the start bit */
        TEST_ASSERT_EQUAL_HEX8(i == 9 ? RI | RB8 : 0, sfr(SCON) & (RI | RB8));
        at = pulse(1, 0, at, 6);
    }
    TEST_ASSERT_EQUAL_HEX8(0x4D, sfr(SBUF));
    for (int i = 0; i < edge_count; i++) { /* nothing was sent */
        TEST_ASSERT_EQUAL(RXD, edges[i].pin);
    }
    mcs52_run(chip, at);
    edge_count = 0;
    set(SCON, MODE_2);
    LOAD((uint16_t)at, MOV_DIRECT, SBUF, 0x55);
    pulse(1, 0, at, 20);
    TEST_ASSERT_EQUAL_UINT64(at + 3, edges[0].cycle);
    TEST_ASSERT_EQUAL_HEX16(0x400 | 0x55 << 1, frame_at(at + 3, 11, 8 / 3.0));
}

/* Two frames in mode 3, of 16 falls a bit, with a second stop bit between them. */
static void test_that_timer_2_as_a_counter_receives_nine_bits(void)
{
    static const unsigned frames[] = {0x400 | 0x4D << 1, 0x600 | 0xB2 << 1};
    uint64_t at = 100;

    set(RCAP2H, 0xFF);
    set(RCAP2L, 0xFF);
    set(TH2, 0xFF);
    set(TL2, 0xFF);
    set(T2CON, BOTH_BY_T2 | TR2 | CT2);
    for (int k = 0; k < 2; k++) {
        set(SCON, MODE_3 | REN);
        for (int i = 0; i < 12; i++) {
            mcs52_set_pin(chip, at, 3, 0, (0x800 | frames[k]) >> i & 1);
            at = pulse(1, 0, at, 16);
        }
        TEST_ASSERT_EQUAL_HEX8(k == 0 ? RI : RI | RB8, sfr(SCON) & (RI | RB8));
        TEST_ASSERT_EQUAL_HEX8(k == 0 ? 0x4D : 0xB2, sfr(SBUF));
    }
}

/* Mode 0 has no such clock: a byte that goes out and one that comes in, at the line's own level,
 * take their ten cycles whatever timer 2's counter does, in whatever phase it left the clocks. */
static void test_that_a_counter_leaves_mode_0_alone(void)
{
    for (int falls = 0; falls < 16; falls++) {
        uint64_t at;

        setUp();
        set(RCAP2H, 0xFF);
        set(RCAP2L, 0xFF);
        set(TH2, 0xFF);
        set(TL2, 0xFF);
        set(T2CON, BOTH_BY_T2 | TR2 | CT2);
        set(SCON, MODE_1);
        at = pulse(1, 0, 100, falls);
        mcs52_run(chip, at);
        for (unsigned i = 0; i < 12; i++) {
            mcs52_set_pin(chip, at + i, 1, 0, i & 1);
        }
        LOAD((uint16_t)at, MOV_DIRECT, SBUF, 0xFF);
        set(SCON, REN);
        mcs52_run(chip, at + 8);
        TEST_ASSERT_EQUAL_HEX8(REN, sfr(SCON));
        mcs52_run(chip, at + 9);
        TEST_ASSERT_EQUAL_HEX8(REN | RI, sfr(SCON));
        mcs52_run(chip, at + 10);
        TEST_ASSERT_EQUAL_HEX8(REN | RI, sfr(SCON));
        mcs52_run(chip, at + 11);
        TEST_ASSERT_EQUAL_HEX8(REN | RI | TI, sfr(SCON));
        TEST_ASSERT_EQUAL_UINT64(at + 11, bytes[0].cycle);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_mode_0_shifts_a_byte_out);
    RUN_TEST(test_that_mode_0_shifts_a_byte_in);
    RUN_TEST(test_that_mode_0_begins_anew);
    RUN_TEST(test_that_a_byte_leaves_bit_by_bit);
    RUN_TEST(test_that_timer_1_gives_the_baud_rate);
    RUN_TEST(test_that_a_frame_begins_after_sixteen_ticks);
    RUN_TEST(test_that_a_frame_by_timer_2_begins_after_sixteen_ticks);
    RUN_TEST(test_that_both_flags_interrupt);
    RUN_TEST(test_that_frames_go_on_in_idle);
    RUN_TEST(test_that_the_stop_bit_is_the_time_to_wait);
    RUN_TEST(test_that_a_reset_begins_anew);
    RUN_TEST(test_that_a_byte_is_in_with_the_stop_bits_last_sample);
    RUN_TEST(test_that_two_of_three_samples_decide);
    RUN_TEST(test_that_smod_halves_the_rest_of_a_bit);
    RUN_TEST(test_that_writes_to_scon_do_not_disturb_frames);
    RUN_TEST(test_that_frames_stand_still_with_the_clock);
    RUN_TEST(test_that_a_stopped_timer_sends_nothing);
    RUN_TEST(test_that_a_second_byte_waits_for_the_stop_bit);
    RUN_TEST(test_that_a_byte_written_too_early_breaks_a_frame_off);
    RUN_TEST(test_that_any_moment_of_a_write_is_fine);
    RUN_TEST(test_that_a_byte_comes_in);
    RUN_TEST(test_that_sm2_wants_a_stop_bit);
    RUN_TEST(test_that_spikes_are_no_start_bits);
    RUN_TEST(test_that_ren_and_the_mode_end_a_frame);
    RUN_TEST(test_that_samples_of_a_broken_frame_are_forgotten);
    RUN_TEST(test_that_the_two_clocks_are_apart);
    RUN_TEST(test_that_mode_2_sends_nine_bits);
    RUN_TEST(test_that_modes_2_and_3_receive_nine_bits);
    RUN_TEST(test_that_a_receiver_waits_for_the_stop_bit);
    RUN_TEST(test_that_mode_2_starts_its_clock);
    RUN_TEST(test_that_other_writes_do_not_disturb_a_frame);
    RUN_TEST(test_that_a_counter_gives_the_baud_rate);
    RUN_TEST(test_that_timer_2_as_a_counter_sends);
    RUN_TEST(test_that_timer_2_as_a_counter_receives);
    RUN_TEST(test_that_timer_2_as_a_counter_receives_nine_bits);
    RUN_TEST(test_that_a_counter_leaves_mode_0_alone);
    return UNITY_END();
}
