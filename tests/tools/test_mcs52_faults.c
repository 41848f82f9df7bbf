/* SPDX-License-Identifier: MIT */
/* Under test: what tools/drive/sim/mcs52 can beside running code: faults in its bits, checkpoints,
 * and comparing two chips. */
#include "mcs52_chip.h"

#include <stdlib.h>

#ifndef __SANITIZE_ADDRESS__
#include <sys/resource.h>
#endif

static bool inject(enum mcs52_fault_kind kind, enum mcs52_place place, uint16_t address, int bit,
                   uint64_t cycle)
{
    const struct mcs52_fault fault = {
        .kind = kind, .place = place, .address = address, .bit = bit, .when = cycle};

    return mcs52_inject(chip, &fault);
}

/* --- faults ---------------------------------------------------------------------------------- */

/* A bit flips once, before the first instruction at or after its cycle, in each place. */
static void test_that_a_bit_flips_in_each_place(void)
{
    set(PSW, 0x08); /* bank 1: R2 is at 0Ah */
    mcs52_jump(chip, 0x1000);
    TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_RAM, 0x40, 3, 5));
    TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_SFR, 0xF0, 7, 6));
    TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_REGISTER, 2, 0, 7));
    TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_XDATA, 0xFFFF, 1, 8));
    TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_PC, 0, 15, 9));
    mcs52_run(chip, 4);
    TEST_ASSERT_EQUAL_HEX8(0, mcs52_ram(chip)[0x40]);
    mcs52_run(chip, 10);
    TEST_ASSERT_EQUAL_HEX8(0x08, mcs52_ram(chip)[0x40]);
    TEST_ASSERT_EQUAL_HEX8(0x80, sfr(0xF0));
    TEST_ASSERT_EQUAL_HEX8(0x01, mcs52_ram(chip)[0x0A]);
    TEST_ASSERT_EQUAL_HEX8(0x02, mcs52_xdata(chip)[0xFFFF]);
    TEST_ASSERT_EQUAL_HEX16(0x900A, mcs52_pc(chip));
    mcs52_ram(chip)[0x40] = 0;
    mcs52_run(chip, 20);
    TEST_ASSERT_EQUAL_HEX8(0, mcs52_ram(chip)[0x40]);
}

/* A bit that is set becomes clear, and nothing else changes: the RAM at B's address neither. */
static void test_that_a_flip_changes_its_bit_alone(void)
{
    for (unsigned bank = 0; bank <= 0x18; bank += 8) {
        uint8_t *ram, before[MCS52_RAM_BYTES];

        setUp();
        ram = mcs52_ram(chip);
        for (int i = 0; i < MCS52_RAM_BYTES; i++) {
            ram[i] = before[i] = (uint8_t)(i ^ 0x55);
        }
        set(PSW, bank);
        set(0xF0, 0x81);
        TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_SFR, 0xF0, 7, 5));
        TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_RAM, 0x40, 0, 5));
        TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_REGISTER, 5, 4, 5));
        mcs52_run(chip, 10);
        TEST_ASSERT_EQUAL_HEX8(0x01, sfr(0xF0));
        before[0x40] ^= 0x01;     /* 15h */
        before[bank + 5] ^= 0x10; /* 50h, 58h, 40h, 48h */
        TEST_ASSERT_EQUAL_HEX8_ARRAY(before, ram, MCS52_RAM_BYTES);
        TEST_ASSERT_EQUAL_HEX16(10, mcs52_pc(chip));
    }
}

/* In idle a bit is struck at its time, too. */
static void test_that_a_bit_is_struck_in_idle(void)
{
    set(0x87, 0x01);
    TEST_ASSERT_TRUE(inject(MCS52_STUCK_HIGH, MCS52_IN_RAM, 0x40, 0, 50));
    mcs52_run(chip, 49);
    TEST_ASSERT_EQUAL_HEX8(0, mcs52_ram(chip)[0x40]);
    mcs52_run(chip, 60);
    TEST_ASSERT_EQUAL_HEX8(1, mcs52_ram(chip)[0x40]);
    TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
}

/* A stuck bit is forced before each instruction, until it is healed; by a count of instructions,
 * from that instruction on. */
static void test_that_a_bit_sticks_until_it_is_healed(void)
{
    const struct mcs52_fault later = {.kind = MCS52_STUCK_HIGH,
                                      .place = MCS52_IN_RAM,
                                      .address = 0x31,
                                      .bit = 0,
                                      .counts_instructions = true,
                                      .when = 10};

    mcs52_ram(chip)[0x30] = 0xFF;
    TEST_ASSERT_TRUE(inject(MCS52_STUCK_LOW, MCS52_IN_RAM, 0x30, 7, 0));
    TEST_ASSERT_TRUE(mcs52_inject(chip, &later));
    mcs52_run(chip, 10);
    TEST_ASSERT_EQUAL_HEX8(0x7F, mcs52_ram(chip)[0x30]);
    TEST_ASSERT_EQUAL_HEX8(0, mcs52_ram(chip)[0x31]);
    mcs52_ram(chip)[0x30] = 0xFF;
    mcs52_run(chip, 11);
    TEST_ASSERT_EQUAL_HEX8(0x7F, mcs52_ram(chip)[0x30]);
    TEST_ASSERT_EQUAL_HEX8(1, mcs52_ram(chip)[0x31]);
    mcs52_ram(chip)[0x30] = 0xFF;
    mcs52_step(chip);
    TEST_ASSERT_EQUAL_UINT64(12, mcs52_instructions(chip));
    TEST_ASSERT_EQUAL_HEX8(0x7F, mcs52_ram(chip)[0x30]);
    mcs52_heal(chip);
    mcs52_ram(chip)[0x30] = 0xFF;
    mcs52_run(chip, 20);
    TEST_ASSERT_EQUAL_HEX8(0xFF, mcs52_ram(chip)[0x30]);
}

/* A flip by count alone; and the earlier of two by cycle comes first, whichever was asked for
 * first. */
static void test_that_flips_come_in_their_order(void)
{
    const struct mcs52_fault counted = {.kind = MCS52_FLIP,
                                        .place = MCS52_IN_RAM,
                                        .address = 0x31,
                                        .bit = 0,
                                        .counts_instructions = true,
                                        .when = 3};

    TEST_ASSERT_TRUE(mcs52_inject(chip, &counted));
    TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_RAM, 0x32, 0, 9));
    TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_RAM, 0x33, 0, 6));
    mcs52_run(chip, 7);
    TEST_ASSERT_EQUAL_HEX8(1, mcs52_ram(chip)[0x31]);
    TEST_ASSERT_EQUAL_HEX8(0, mcs52_ram(chip)[0x32]);
    TEST_ASSERT_EQUAL_HEX8(1, mcs52_ram(chip)[0x33]);
    mcs52_run(chip, 10);
    TEST_ASSERT_EQUAL_HEX8(1, mcs52_ram(chip)[0x32]);
}

static void test_that_bits_that_are_not_there_are_refused(void)
{
    TEST_ASSERT_FALSE(inject(MCS52_FLIP, MCS52_IN_SFR, 0x7F, 0, 0));
    TEST_ASSERT_FALSE(inject(MCS52_FLIP, MCS52_IN_RAM, 0x100, 0, 0));
    TEST_ASSERT_FALSE(inject(MCS52_FLIP, MCS52_IN_REGISTER, 8, 0, 0));
    TEST_ASSERT_FALSE(inject(MCS52_FLIP, MCS52_IN_RAM, 0, 8, 0));
    TEST_ASSERT_FALSE(inject(MCS52_FLIP, MCS52_IN_PC, 0, 16, 0));
    TEST_ASSERT_FALSE(inject(MCS52_FLIP, MCS52_IN_PC, 0, -1, 0));
    for (int i = 0; i < MCS52_FAULTS; i++) {
        TEST_ASSERT_TRUE(inject(MCS52_FLIP, MCS52_IN_RAM, 0, 0, 1000));
    }
    TEST_ASSERT_FALSE(inject(MCS52_FLIP, MCS52_IN_RAM, 0, 0, 1000));
}

/* --- checkpoints ------------------------------------------------------------------------------ */

static struct mcs52 *other;

/* Two chips that are alike and have pins to come. */
static void make_two(void)
{
    setUp();
    mcs52_destroy(other);
    other = mcs52_create(MCS52_INTEL, NULL);
    mcs52_run(chip, 100);
    mcs52_copy(other, chip);
    TEST_ASSERT_TRUE(mcs52_equal(chip, other));
    TEST_ASSERT_TRUE(mcs52_set_pin(chip, 500, 1, 2, false));
}

static void test_a_copy_in_memory_of_the_callers_own(void)
{
    struct mcs52 *own = calloc(1, mcs52_size());

    TEST_ASSERT_NOT_NULL(own);
    mcs52_run(chip, 100);
    mcs52_copy(own, chip);
    TEST_ASSERT_TRUE(mcs52_equal(chip, own));
    free(own);
}

static void test_that_chips_differ_where_their_ways_part(void)
{
    make_two();
    TEST_ASSERT_FALSE(mcs52_equal(chip, other)); /* no change of a pin waits there */
    mcs52_set_pin(other, 500, 1, 2, false);
    TEST_ASSERT_TRUE(mcs52_equal(chip, other));
    mcs52_set_pin(other, 600, 1, 2, true); /* one more */
    TEST_ASSERT_FALSE(mcs52_equal(chip, other));
    mcs52_set_pin(chip, 600, 1, 2, true);
    TEST_ASSERT_TRUE(mcs52_equal(chip, other));
    mcs52_ram(other)[0x50] ^= 1;
    TEST_ASSERT_FALSE(mcs52_equal(chip, other));
    mcs52_copy(other, chip);
    mcs52_run(other, 101); /* another time */
    TEST_ASSERT_FALSE(mcs52_equal(chip, other));
    mcs52_copy(other, chip);
    mcs52_jump(other, 0x1234); /* another place in the program */
    TEST_ASSERT_FALSE(mcs52_equal(chip, other));
    make_two();
    mcs52_set_pin(other, 500, 2, 2, false); /* another port */
    TEST_ASSERT_FALSE(mcs52_equal(chip, other));
    make_two();
    mcs52_set_pin(other, 500, 1, 3, false); /* another pin */
    TEST_ASSERT_FALSE(mcs52_equal(chip, other));
    make_two();
    mcs52_set_pin(other, 500, 1, 2, true); /* another level */
    TEST_ASSERT_FALSE(mcs52_equal(chip, other));
    make_two();
    mcs52_set_pin(chip, 600, 1, 2, false);
    mcs52_set_pin(other, 500, 1, 2, false);
    mcs52_set_pin(other, 601, 1, 2, false); /* another cycle */
    TEST_ASSERT_FALSE(mcs52_equal(chip, other));
    mcs52_destroy(other);
    other = NULL;
}

/* Neither a look at a register nor a comparison changes a chip's way: timer 0, gated by INT0,
 * counts the cycles 0 to 99; timer 1 overflows in cycle 100. */
static void test_that_looking_changes_nothing(void)
{
    struct mcs52_snapshot snapshot;
    struct mcs52 *unseen;

    set(TMOD, 0x29); /* timer 0: mode 1, gated; timer 1: mode 2 */
    set(TL1, 256 - 101);
    set(TCON, 0x51);
    mcs52_run(chip, 99);
    mcs52_step(chip);
    unseen = mcs52_create(MCS52_INTEL, NULL);
    mcs52_copy(unseen, chip);
    TEST_ASSERT_EQUAL_HEX8(0xD1, sfr(TCON));
    TEST_ASSERT_TRUE(mcs52_equal(chip, unseen));
    mcs52_snapshot(chip, &snapshot);
    mcs52_set_pin(chip, 100, 3, 2, false);
    mcs52_run(chip, 200);
    TEST_ASSERT_EQUAL(100, sfr(TL0));
    mcs52_destroy(unseen);
}

/* From a snapshot a chip goes on as the one did that it was taken of, whatever it did before. */
static void test_that_a_snapshot_goes_on_alike(void)
{
    struct mcs52_snapshot early, late, again;

    /* 0000: MOV TMOD, #11h; MOV TCON, #50h; INC 30h; MOV A, TL1; MOV SBUF, A; SJMP -8 */
    const uint8_t code[] = {0x75, 0x89, 0x11, 0x75, 0x88, 0x50, 0x05,
                            0x30, 0xE5, 0x8B, 0xF5, 0x99, 0x80, 0xF8};

    mcs52_load(chip, 0, code, sizeof code);
    mcs52_jump(chip, 0);
    mcs52_run(chip, 333);
    mcs52_snapshot(chip, &early);
    mcs52_run(chip, 5000);
    mcs52_snapshot(chip, &late);
    TEST_ASSERT_NOT_EQUAL(0, memcmp(&early, &late, sizeof early));
    mcs52_ram(chip)[0x30] ^= 0x80;
    set(TMOD, 0x22);
    mcs52_set_pin(chip, 0, 1, 2, false);
    mcs52_set_pin(chip, 6000, 1, 3, false);
    mcs52_set_pin(chip, 6001, 1, 4, false);
    mcs52_run(chip, 6000);
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 2));
    mcs52_revive(chip, &early);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 2));
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 3));
    mcs52_snapshot(chip, &again);
    TEST_ASSERT_EQUAL_MEMORY(&early, &again, sizeof early);
    mcs52_run(chip, 7000);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 4)); /* nothing waits any more */
    mcs52_set_pin(chip, 7001, 1, 4, false);
    mcs52_run(chip, 7010);
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 4));
    mcs52_revive(chip, &early);
    mcs52_run(chip, 5000);
    mcs52_snapshot(chip, &again);
    TEST_ASSERT_EQUAL_MEMORY(&late, &again, sizeof late);
}

/* A flag that has been set for a while makes no difference by the cycle in which it was set, nor
 * does one that is gone. */
static void test_that_old_requests_make_no_difference(void)
{
    struct mcs52 *later;

    set(TCON, 0x20);
    mcs52_run(chip, 1);
    later = mcs52_create(MCS52_INTEL, NULL);
    mcs52_copy(later, chip);
    TEST_ASSERT_TRUE(mcs52_equal(chip, later));
    set(TCON, 0x00);
    mcs52_run(chip, 2);
    set(TCON, 0x20);
    mcs52_run(chip, 50);
    mcs52_run(later, 50);
    TEST_ASSERT_TRUE(mcs52_equal(chip, later));
    set(TCON, 0x00);
    mcs52_run(chip, 100);
    mcs52_run(later, 51);
    mcs52_poke(later, TCON, 0x00);
    mcs52_run(later, 100);
    TEST_ASSERT_TRUE(mcs52_equal(chip, later));
    mcs52_destroy(later);
}

#ifndef __SANITIZE_ADDRESS__
/* The sanitizer itself needs more memory than this leaves. */
static void test_that_no_memory_is_no_chip(void)
{
    struct rlimit before, none;

    TEST_ASSERT_EQUAL(0, getrlimit(RLIMIT_AS, &before));
    none = (struct rlimit){.rlim_cur = 0, .rlim_max = before.rlim_max};
    TEST_ASSERT_EQUAL(0, setrlimit(RLIMIT_AS, &none));
    struct mcs52 *no_chip = mcs52_create(MCS52_INTEL, NULL);
    TEST_ASSERT_EQUAL(0, setrlimit(RLIMIT_AS, &before));
    TEST_ASSERT_NULL(no_chip);
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_bit_flips_in_each_place);
    RUN_TEST(test_that_a_flip_changes_its_bit_alone);
    RUN_TEST(test_that_a_bit_is_struck_in_idle);
    RUN_TEST(test_that_a_bit_sticks_until_it_is_healed);
    RUN_TEST(test_that_flips_come_in_their_order);
    RUN_TEST(test_that_bits_that_are_not_there_are_refused);
    RUN_TEST(test_a_copy_in_memory_of_the_callers_own);
    RUN_TEST(test_that_chips_differ_where_their_ways_part);
    RUN_TEST(test_that_looking_changes_nothing);
    RUN_TEST(test_that_a_snapshot_goes_on_alike);
    RUN_TEST(test_that_old_requests_make_no_difference);
#ifndef __SANITIZE_ADDRESS__
    RUN_TEST(test_that_no_memory_is_no_chip);
#endif
    return UNITY_END();
}
