/* SPDX-License-Identifier: MIT */
/* An MCS-52 chip, exact to the machine cycle, as a library: any number of chips, no global state.
 *
 * Times are machine cycles (12 clocks) since mcs52_create. Cycle N is the one that begins at time
 * N.
 *
 * Where the rules come from:
 *   [I]  Intel, MCS-51 Microcontroller Family User's Manual (272383): instructions, ports, timers,
 *        serial port, interrupts, idle and power-down, reset values
 *   [A]  Atmel, AT89S52 data sheet (1919): WDTRST, POF, T2MOD, power-down that a pin can end
 *   [S]  STC, STC89C51RC/RD+ data sheet: WDT_CONTR, POF
 *
 * Where [I] names no moment, this library says: an instruction reads pins, timers and flags in its
 * first cycle, after the timers have counted in that cycle (one that reads, modifies and writes a
 * register: in its last); what it writes is there from the end of its last cycle on ([I]: a port's
 * pin changes in S1P1 of the next cycle). The reserved code A5h is a NOP. A special function
 * register that the part does not have is a byte of storage. */
#ifndef FUZZY51_MCS52_H
#define FUZZY51_MCS52_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct mcs52;

enum mcs52_part {
    MCS52_INTEL,   /* the plain 8052: no watchdog, no POF; only reset ends power-down */
    MCS52_AT89S52, /* watchdog at A6h: 1Eh, E1h start or feed it; resets after 16,384 cycles */
    MCS52_STC89    /* watchdog at E1h: resets after 32,768 * 2^(PS+1) cycles */
};

/* Why the chip began at address 0 the last time. */
enum mcs52_reset { MCS52_POWER, MCS52_PIN, MCS52_WATCHDOG };

/* What the chip tells the outside. Each may be NULL. A function may call mcs52_stop and
 * mcs52_set_pin; it must not read or change the chip otherwise. */
struct mcs52_outside {
    void *user;
    /* Pin BIT of PORT is at LEVEL from cycle CYCLE on; only pins that mcs52_watch named. */
    void (*edge)(void *user, uint64_t cycle, int port, int bit, bool level);
    /* The serial port sent BYTE; CYCLE is the end of its stop bit. */
    void (*byte)(void *user, uint64_t cycle, uint8_t byte);
    /* MOVX wrote VALUE to the address that mcs52_watch_xdata named. */
    void (*xdata)(void *user, uint64_t cycle, uint8_t value);
    /* The watchdog resets the chip. */
    void (*reset)(void *user, uint64_t cycle);
};

enum { MCS52_CODE_BYTES = 0x10000, MCS52_XDATA_BYTES = 0x10000, MCS52_RAM_BYTES = 256 };

/* Power comes up: RAM is 0, code is all NOP, each pin is high. Returns NULL without memory. */
struct mcs52 *mcs52_create(enum mcs52_part part, const struct mcs52_outside *outside);
void mcs52_destroy(struct mcs52 *chip);

/* Copies SIZE bytes of code to ADDRESS; what goes beyond FFFFh goes on at 0. */
void mcs52_load(struct mcs52 *chip, uint16_t address, const uint8_t *code, size_t size);

/* The reset pin, for a moment, at the present cycle: RAM keeps its bytes. While MCS52_CLOCK_STOP
 * lasts, the chip begins when the clock goes on. */
void mcs52_reset(struct mcs52 *chip);
enum mcs52_reset mcs52_reset_cause(const struct mcs52 *chip);

/* --- running ------------------------------------------------------------------------------ */

/* Runs every instruction that ends at or before UNTIL, which is less than 2^62. Returns
 * mcs52_cycles: UNTIL or up to 3 cycles less, or the end of the instruction in which mcs52_stop was
 * called. What is asked of the chip between two calls does not depend on where the calls are cut.
 */
uint64_t mcs52_run(struct mcs52 *chip, uint64_t until);

/* Runs one instruction, or takes one interrupt. In idle and power-down: goes on by a cycle. */
void mcs52_step(struct mcs52 *chip);

/* From a function of mcs52_outside: mcs52_run returns after this instruction, or at once between
 * two instructions. */
void mcs52_stop(struct mcs52 *chip);

/* --- pins and bytes ----------------------------------------------------------------------- */

/* The outside drives pin BIT of PORT (0..3) to LEVEL from CYCLE on (at once if that is past); true
 * lets the chip's own latch decide. Returns false, and does nothing, when MCS52_PIN_QUEUE changes
 * wait. */
enum { MCS52_PIN_QUEUE = 1024 };
bool mcs52_set_pin(struct mcs52 *chip, uint64_t cycle, int port, int bit, bool level);

/* Bytes to RXD (P3.0), from CYCLE on: a start bit, 8 bits, a stop bit, each BIT_CYCLES long
 * (rounded at each edge, so the error does not add up). Goes through mcs52_set_pin: needs 10 places
 * in its queue. Returns the cycle in which the stop bit ends, or 0 when there was no room. */
uint64_t mcs52_feed(struct mcs52 *chip, uint64_t cycle, uint8_t byte, double bit_cycles);

/* Tells the edges of these pins from now on. */
void mcs52_watch(struct mcs52 *chip, int port, int bit);
void mcs52_watch_xdata(struct mcs52 *chip, uint16_t address);

/* The level of a pin: latch AND outside AND alternate function. */
bool mcs52_pin(const struct mcs52 *chip, int port, int bit);

/* --- state -------------------------------------------------------------------------------- */

uint64_t mcs52_cycles(const struct mcs52 *chip);
uint64_t mcs52_instructions(const struct mcs52 *chip); /* interrupts taken do not count */
uint16_t mcs52_pc(const struct mcs52 *chip);
bool mcs52_is_asleep(const struct mcs52 *chip); /* idle or power-down */
uint8_t *mcs52_ram(struct mcs52 *chip);         /* 256 bytes */
uint8_t *mcs52_xdata(struct mcs52 *chip);       /* 65,536 bytes */

/* A special function register (80h..FFh) as an instruction at the present cycle would read it; of a
 * port, the latch. */
uint8_t mcs52_sfr(struct mcs52 *chip, uint8_t address);

/* Sets the value of a register without what a write does beside that: SBUF sends nothing, WDTRST
 * and WDT_CONTR feed nothing. IE0 and IE1 stay what the pins say while they follow the level. */
void mcs52_poke(struct mcs52 *chip, uint8_t address, uint8_t value);
void mcs52_jump(struct mcs52 *chip, uint16_t pc);

/* A checkpoint: TO becomes FROM in all but the functions of mcs52_outside, the watched pins and the
 * coverage map. TO may also be mcs52_size() bytes of 0, in memory of the caller's own. */
void mcs52_copy(struct mcs52 *to, const struct mcs52 *from);
size_t mcs52_size(void);

/* A small checkpoint: all but code, XDATA, what the outside does to the pins later, and faults.
 * Brings the chip up to date for that, so that chips that go on alike have equal snapshots. Not of
 * a chip in power-down. */
enum { MCS52_SNAPSHOT_BYTES = 1024 };
struct mcs52_snapshot {
    uint8_t bytes[MCS52_SNAPSHOT_BYTES];
};
void mcs52_snapshot(struct mcs52 *chip, struct mcs52_snapshot *snapshot);

/* CHIP goes on from SNAPSHOT, with its own code and XDATA. */
void mcs52_revive(struct mcs52 *chip, const struct mcs52_snapshot *snapshot);

/* Two chips at the same cycle would behave alike from now on. Brings both up to date for that. */
bool mcs52_equal(struct mcs52 *a, struct mcs52 *b);

/* Marks each address from which an instruction is fetched from now on: bit A%8 of MAP[A/8], 8,192
 * bytes; NULL ends that. Costs some speed. */
void mcs52_cover(struct mcs52 *chip, uint8_t *map);

/* --- faults ------------------------------------------------------------------------------- */

enum mcs52_place { MCS52_IN_RAM, MCS52_IN_SFR, MCS52_IN_REGISTER, MCS52_IN_PC, MCS52_IN_XDATA };
enum mcs52_fault_kind {
    MCS52_FLIP, /* of a bit; so are the next two */
    MCS52_STUCK_LOW,
    MCS52_STUCK_HIGH,
    MCS52_PIN_LOW,    /* the pin at bit address ADDRESS is shorted to ground */
    MCS52_PIN_HIGH,   /* to the supply */
    MCS52_PINS_TIED,  /* to the pin OTHER of the same port: each can pull both low */
    MCS52_POWER_DIP,  /* no supply: pins are high; then RAM is anything, and power comes up */
    MCS52_CLOCK_STOP, /* the oscillator stands, and all of the chip with it */
    MCS52_INTERRUPTS  /* all interrupts are requested, every MCS52_BURST_MC */
};
enum { MCS52_BURST_MC = 100 };

struct mcs52_fault {
    enum mcs52_fault_kind kind;
    enum mcs52_place place;   /* of a bit */
    uint16_t address;         /* in RAM, XDATA or the SFRs; 0..7 for R0..R7 of the bank in use */
    uint8_t other;            /* of pins that are tied */
    int bit;                  /* 0..7, of the PC 0..15 */
    bool counts_instructions; /* only a bit's fault may */
    uint64_t when;   /* before the first instruction at or after this cycle or instruction count */
    uint64_t cycles; /* how long, for all but a bit; 0: for good, which only pins may */
};

/* A stuck bit stays so until mcs52_heal, which ends all faults; it is forced after each
 * instruction, which costs some speed. Returns false when MCS52_FAULTS are in place, or for an
 * address or bit that there is not. */
enum { MCS52_FAULTS = 8 };
bool mcs52_inject(struct mcs52 *chip, const struct mcs52_fault *fault);
void mcs52_heal(struct mcs52 *chip);

#endif
