/* SPDX-License-Identifier: MIT */
/* FAULT. */
#include "fault.h"

uint8_t fault_state, fault_code;

static uint8_t silence_cs;    /* since the last believed reading */
static uint8_t good_readings; /* in a row, while in FAULT */

void fault_init(uint8_t code)
{
    fault_state = FAULT_GOOD;
    if (code != BRAKE_FAULT_NONE) {
        fault_state = code >= BRAKE_FAULT_TABLE ? FAULT_LASTING : FAULT_ON;
    }
    fault_code = code;
    silence_cs = 0;
    good_readings = 0;
}

void fault_take(uint8_t trouble)
{
    if (trouble != BRAKE_FAULT_NONE) {
        good_readings = 0;
        if (fault_state != FAULT_LASTING) {
            fault_code = trouble;
        }
        return;
    }
    silence_cs = 0;
    if (fault_state == FAULT_ON && ++good_readings >= FAULT_GOOD_READINGS) {
        fault_state = FAULT_GOOD;
    }
    if (fault_state == FAULT_GOOD) {
        fault_code = BRAKE_FAULT_NONE;
    }
}

bool fault_tick(void)
{
    if (silence_cs < FAULT_SILENCE_CS) {
        silence_cs++;
        return false;
    }
    if (fault_state != FAULT_GOOD) {
        return false;
    }
    fault_state = FAULT_ON;
    good_readings = 0;
    return true;
}

bool fault_fail(uint8_t code)
{
    if (fault_state == FAULT_LASTING) {
        return false;
    }
    fault_state = FAULT_LASTING;
    fault_code = code;
    return true;
}
