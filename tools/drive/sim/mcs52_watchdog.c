/* SPDX-License-Identifier: MIT */
/* The watchdogs: [A] WDTRST, [S] WDT_CONTR. */
#include "mcs52_inside.h"

enum {
    AT89S52_MC = 16384,   /* a counter of 14 bits: fed every 16,383 cycles it does not bite */
    AT89S52_RESET_MC = 9, /* it holds reset for 98 clocks */
    STC89_MC = 32768,     /* times the prescaler, 2..256 */
    STC89_RESET_MC = 2    /* [I]: what a reset takes at least */
};

static void at89s52_write(struct mcs52 *chip, uint8_t value, uint64_t end)
{
    if (chip->watchdog_half && value == 0xE1) {
        mcs52_schedule(chip, EVENT_WATCHDOG, end + AT89S52_MC);
    }
    chip->watchdog_half = value == 0x1E;
}

/* CLR_WDT feeds and reads as 0; EN_WDT starts and stops; WDT_FLAG is the program's to clear. A new
 * prescaler counts from the next feed on. */
static void stc89_write(struct mcs52 *chip, uint8_t value, uint64_t end)
{
    uint64_t period = (uint64_t)STC89_MC << ((value & WDT_PRESCALE) + 1);
    uint8_t flag = chip->sfr[WDT_CONTR] & value & WDT_FLAG;

    chip->sfr[WDT_CONTR] = (uint8_t)((value & ~(WDT_CLEAR | WDT_FLAG)) | flag);
    if (!(value & WDT_ENABLE)) {
        mcs52_schedule(chip, EVENT_WATCHDOG, NEVER);
    } else if ((value & WDT_CLEAR) || chip->due[EVENT_WATCHDOG] == NEVER) {
        mcs52_schedule(chip, EVENT_WATCHDOG, end + period);
    }
}

void mcs52_watchdog_write(struct mcs52 *chip, uint8_t address, uint8_t value, uint64_t end)
{
    if (address == WDTRST && chip->part == MCS52_AT89S52) {
        at89s52_write(chip, value, end);
    } else if (address == WDT_CONTR && chip->part == MCS52_STC89) {
        stc89_write(chip, value, end);
    } else {
        chip->sfr[address] = value;
    }
}

/* Idle begins: the watchdog goes on or stands, as the part's bit says. */
void mcs52_watchdog_stand(struct mcs52 *chip, uint64_t end)
{
    bool goes_on = chip->part == MCS52_AT89S52 ? !(chip->sfr[AUXR] & AUXR_WDIDLE)
                                               : chip->sfr[WDT_CONTR] & WDT_IN_IDLE;

    chip->watchdog_left = NEVER;
    if (!goes_on && chip->due[EVENT_WATCHDOG] != NEVER) {
        chip->watchdog_left = chip->due[EVENT_WATCHDOG] - end;
        chip->due[EVENT_WATCHDOG] = NEVER;
    }
}

void mcs52_watchdog_go_on(struct mcs52 *chip, uint64_t end)
{
    if (chip->watchdog_left != NEVER) {
        mcs52_schedule(chip, EVENT_WATCHDOG, end + chip->watchdog_left);
    }
}

void mcs52_watchdog_bite(struct mcs52 *chip)
{
    if (chip->outside.reset != NULL) {
        chip->outside.reset(chip->outside.user, chip->now);
    }
    mcs52_restart(chip, MCS52_WATCHDOG);
    chip->now += chip->part == MCS52_AT89S52 ? AT89S52_RESET_MC : STC89_RESET_MC;
}
