/* SPDX-License-Identifier: MIT */
/* Under test: faults of tools/drive/sim/mcs52 that are not of a bit: shorted pins, a supply or an
 * oscillator that fails, a flood of interrupts. */
#include "mcs52_chip.h"

static bool upset(enum mcs52_fault_kind kind, uint16_t address, uint8_t other, uint64_t when,
                  uint64_t cycles)
{
    const struct mcs52_fault fault = {
        .kind = kind, .address = address, .other = other, .when = when, .cycles = cycles};

    return mcs52_inject(chip, &fault);
}

/* A pin shorted to ground is low, and its latch stays; afterwards the latch decides again. */
static void test_that_a_pin_is_shorted_for_a_time(void)
{
    TEST_ASSERT_TRUE(upset(MCS52_PIN_LOW, P1 + 2, 0, 10, 20));
    mcs52_run(chip, 9);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 2));
    mcs52_run(chip, 15);
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 2));
    TEST_ASSERT_EQUAL_HEX8(0xFF, sfr(P1));
    mcs52_run(chip, 40);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 2));
}

/* One shorted to the supply is high, whatever the latch and the outside say, until it is healed. */
static void test_that_a_pin_is_shorted_for_good(void)
{
    set(P3, 0xFB);
    mcs52_set_pin(chip, 0, 3, 2, false);
    TEST_ASSERT_TRUE(upset(MCS52_PIN_HIGH, P3 + 2, 0, 10, 0));
    mcs52_run(chip, 5);
    TEST_ASSERT_FALSE(mcs52_pin(chip, 3, 2));
    mcs52_run(chip, 1000);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 3, 2));
    mcs52_heal(chip);
    mcs52_run(chip, 1010);
    TEST_ASSERT_FALSE(mcs52_pin(chip, 3, 2));
}

/* Of two pins that are tied either pulls the other low. */
static void test_that_tied_pins_pull_each_other_low(void)
{
    TEST_ASSERT_TRUE(upset(MCS52_PINS_TIED, P1, P1 + 1, 10, 100));
    mcs52_run(chip, 20);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 0));
    set(P1, 0xFE);
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 1));
    set(P1, 0xFD);
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 0));
    mcs52_run(chip, 120);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 0));
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 1));
}

/* Without supply all pins are high; then power comes up, and RAM is not what it was: the bytes of
 * Knuth's congruence from 10 on, worked out elsewhere. */
static void test_that_a_dip_of_the_supply_loses_all(void)
{
    static const uint8_t noise[] = {0x87, 0x2D, 0x09, 0x37, 0x80, 0xF5, 0xD3, 0x73};
    int same = 0;

    mcs52_watch(chip, 1, 0);
    mcs52_watch(chip, 3, 1);
    set(P1, 0x00);
    set(PSW, 0x18);
    mcs52_jump(chip, 0x1000);
    TEST_ASSERT_TRUE(upset(MCS52_POWER_DIP, 0, 0, 10, 5000));
    mcs52_run(chip, 100);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 0));
    mcs52_run(chip, 5020);
    TEST_ASSERT_EQUAL_HEX16(10, mcs52_pc(chip));
    TEST_ASSERT_EQUAL_HEX8(0, sfr(PSW));
    TEST_ASSERT_EQUAL(MCS52_POWER, mcs52_reset_cause(chip));
    for (int i = 0; i < MCS52_RAM_BYTES; i++) {
        same += mcs52_ram(chip)[i] == 0;
    }
    TEST_ASSERT_LESS_THAN(8, same);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(noise, mcs52_ram(chip), sizeof noise);
    TEST_ASSERT_EQUAL_HEX8(0x55, mcs52_ram(chip)[MCS52_RAM_BYTES - 1]);
    TEST_ASSERT_EQUAL(2, edge_count); /* P1.0 falls at once, and rises with the dip */
    TEST_ASSERT_EQUAL_UINT64(10, edges[1].cycle);
}

/* While the oscillator stands nothing counts, the watchdog neither, and no interrupt wakes the
 * chip. */
static void test_that_a_stopped_clock_stops_all(void)
{
    make_chip(MCS52_AT89S52);
    set(TMOD, 0x01);
    set(TCON, 0x10);
    set(IE, 0x81);
    TEST_ASSERT_TRUE(upset(MCS52_CLOCK_STOP, 0, 0, 10, 100000));
    mcs52_set_pin(chip, 500, 3, 2, false);
    mcs52_set_pin(chip, 600, 3, 2, true);
    mcs52_run(chip, 1000);
    TEST_ASSERT_EQUAL_HEX16(10, mcs52_pc(chip));
    mcs52_run(chip, 100010);
    TEST_ASSERT_EQUAL_HEX16(10, mcs52_pc(chip));
    mcs52_run(chip, 100030);
    TEST_ASSERT_EQUAL_HEX16(30, mcs52_pc(chip));
    TEST_ASSERT_INT_WITHIN(2, 30, sfr(TL0));
    TEST_ASSERT_EQUAL_HEX8(0x01, sfr(TMOD));
}

/* What was requested just before waits, too; and by level, the flag is what the pin has become. */
static void test_that_a_stopped_clock_holds_interrupts_back(void)
{
    LOAD(0x0B, INC_DIRECT, 0x30, RETI);
    mcs52_jump(chip, 0x100);
    set(IE, 0x82);
    TEST_ASSERT_TRUE(upset(MCS52_CLOCK_STOP, 0, 0, 10, 100));
    mcs52_run(chip, 9);
    set(TCON, 0x20 | 0x01); /* TF0; INT0 by edge, INT1 by level */
    mcs52_set_pin(chip, 50, 3, 2, false);
    mcs52_set_pin(chip, 50, 3, 3, false);
    mcs52_run(chip, 109);
    TEST_ASSERT_EQUAL_HEX16(0x10A, mcs52_pc(chip));
    TEST_ASSERT_EQUAL_HEX8(0x21, sfr(TCON));
    mcs52_run(chip, 120);
    TEST_ASSERT_EQUAL(1, mcs52_ram(chip)[0x30]);
    TEST_ASSERT_EQUAL_HEX8(0x09, sfr(TCON)); /* IE1 */
}

/* A reset or a dip of the supply while the clock stands: the chip begins when the clock goes on. */
static void test_that_a_chip_begins_when_its_clock_does(void)
{
    for (int dips = 0; dips < 2; dips++) {
        setUp();
        TEST_ASSERT_TRUE(upset(MCS52_CLOCK_STOP, 0, 0, 10, 1000));
        if (dips) {
            TEST_ASSERT_TRUE(upset(MCS52_POWER_DIP, 0, 0, 500, 100));
        }
        mcs52_run(chip, 500);
        if (!dips) {
            mcs52_reset(chip);
        }
        mcs52_run(chip, 1009);
        TEST_ASSERT_EQUAL_HEX16(0, mcs52_pc(chip));
        mcs52_run(chip, 1030);
        TEST_ASSERT_EQUAL_HEX16(20, mcs52_pc(chip));
        set(PCON, 0x02); /* its own power-down is not the clock's */
        mcs52_run(chip, 2000);
        TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
        mcs52_reset(chip);
        TEST_ASSERT_FALSE(mcs52_is_asleep(chip));
    }
}

static void test_that_healing_starts_the_clock(void)
{
    TEST_ASSERT_TRUE(upset(MCS52_CLOCK_STOP, 0, 0, 10, 1000));
    mcs52_run(chip, 100);
    mcs52_heal(chip);
    mcs52_run(chip, 120);
    TEST_ASSERT_EQUAL_HEX16(10 + 20, mcs52_pc(chip));
    mcs52_run(chip, 2000);
    TEST_ASSERT_EQUAL_HEX16(10 + 1900, mcs52_pc(chip));
}

/* Pins that were tied before are no part of those that are tied now. */
static void test_that_healed_pins_are_free(void)
{
    TEST_ASSERT_TRUE(upset(MCS52_PINS_TIED, P1, P1 + 3, 0, 0));
    mcs52_run(chip, 10);
    mcs52_heal(chip);
    TEST_ASSERT_TRUE(upset(MCS52_PINS_TIED, P1 + 1, P1 + 2, 0, 0));
    mcs52_run(chip, 20);
    set(P1, 0xFE);
    for (int bit = 1; bit < 8; bit++) {
        TEST_ASSERT_TRUE(mcs52_pin(chip, 1, bit));
    }
    set(P1, 0xFD);
    for (int bit = 0; bit < 8; bit++) {
        TEST_ASSERT_EQUAL(bit != 1 && bit != 2, mcs52_pin(chip, 1, bit));
    }
}

/* A program's own power-down goes on: there is no clock to be stopped. */
static void test_that_a_chip_in_power_down_has_no_clock_to_stop(void)
{
    TEST_ASSERT_TRUE(upset(MCS52_CLOCK_STOP, 0, 0, 10, 100));
    set(PCON, 0x02);
    mcs52_run(chip, 1000);
    TEST_ASSERT_TRUE(mcs52_is_asleep(chip));
    TEST_ASSERT_EQUAL_HEX16(0, mcs52_pc(chip));
}

/* Each interrupt is requested again and again, for as long as was asked. */
static void test_that_a_flood_requests_all_interrupts(void)
{
    TEST_ASSERT_TRUE(upset(MCS52_INTERRUPTS, 0, 0, 10, MCS52_BURST_MC + 50));
    set(TCON, 0x05);
    set(SCON, 0x48);
    set(T2CON, 0x08);
    mcs52_run(chip, 20);
    TEST_ASSERT_EQUAL_HEX8(0xAF, sfr(TCON));
    TEST_ASSERT_EQUAL_HEX8(0x4B, sfr(SCON));
    TEST_ASSERT_EQUAL_HEX8(0xC8, sfr(T2CON));
    set(TCON, 0x05);
    mcs52_run(chip, 20 + MCS52_BURST_MC);
    TEST_ASSERT_EQUAL_HEX8(0xAF, sfr(TCON));
    set(TCON, 0x05);
    mcs52_run(chip, 1000);
    TEST_ASSERT_EQUAL_HEX8(0x05, sfr(TCON));
}

static void test_that_each_comes_at_its_time(void)
{
    TEST_ASSERT_TRUE(upset(MCS52_PIN_LOW, P1, 0, 50, 10));
    TEST_ASSERT_TRUE(upset(MCS52_PIN_LOW, P1 + 1, 0, 20, 100));
    mcs52_run(chip, 30);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 0));
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 1));
    mcs52_run(chip, 55);
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 0));
    mcs52_run(chip, 70);
    TEST_ASSERT_TRUE(mcs52_pin(chip, 1, 0));
    TEST_ASSERT_FALSE(mcs52_pin(chip, 1, 1));
}

static void test_that_what_cannot_be_is_refused(void)
{
    for (unsigned address = 0; address < 0x200; address++) { /* 80h..87h, .., B0h..B7h are pins */
        bool is_pin = address >= 0x80 && address < 0xB8 && address % 16 < 8;

        mcs52_heal(chip);
        TEST_ASSERT_EQUAL(is_pin, upset(MCS52_PIN_LOW, (uint16_t)address, 0, 0, 0));
        TEST_ASSERT_EQUAL(is_pin, upset(MCS52_PIN_HIGH, (uint16_t)address, 0, 0, 0));
    }
    for (unsigned other = 0; other < 0x100; other++) { /* only of the same port */
        mcs52_heal(chip);
        TEST_ASSERT_EQUAL(other >= 0x90 && other < 0x98,
                          upset(MCS52_PINS_TIED, P1 + 1, (uint8_t)other, 0, 0));
        TEST_ASSERT_FALSE(upset(MCS52_PINS_TIED, SCON, (uint8_t)other, 0, 0));
    }
    TEST_ASSERT_FALSE(upset(MCS52_POWER_DIP, 0, 0, 0, 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_pin_is_shorted_for_a_time);
    RUN_TEST(test_that_a_pin_is_shorted_for_good);
    RUN_TEST(test_that_tied_pins_pull_each_other_low);
    RUN_TEST(test_that_a_dip_of_the_supply_loses_all);
    RUN_TEST(test_that_a_stopped_clock_stops_all);
    RUN_TEST(test_that_a_stopped_clock_holds_interrupts_back);
    RUN_TEST(test_that_a_chip_begins_when_its_clock_does);
    RUN_TEST(test_that_healing_starts_the_clock);
    RUN_TEST(test_that_healed_pins_are_free);
    RUN_TEST(test_that_a_chip_in_power_down_has_no_clock_to_stop);
    RUN_TEST(test_that_a_flood_requests_all_interrupts);
    RUN_TEST(test_that_each_comes_at_its_time);
    RUN_TEST(test_that_what_cannot_be_is_refused);
    return UNITY_END();
}
