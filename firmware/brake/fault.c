/* SPDX-License-Identifier: MIT */
/* FAULT. */
#include "fault.h"

uint8_t fault_state, fault_code;

static uint8_t silence_cs;    /* since the last believed reading */
static uint8_t good_readings; /* in a row, while in FAULT */

/* Holds from fault_init on. */
/*@ predicate fault_is_valid =
        fault_state <= FAULT_LASTING && silence_cs <= FAULT_SILENCE_CS &&
        (fault_state == FAULT_ON ==> good_readings < FAULT_GOOD_READINGS); */

/*@ assigns silence_cs, good_readings;
    ensures fault_is_valid && silence_cs == 0 && good_readings == 0; */
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

/*@ requires fault_is_valid;
    assigns silence_cs, good_readings;
    ensures fault_is_valid;
    ensures silence_cs == (trouble == BRAKE_FAULT_NONE ? 0 : \old(silence_cs));
    ensures \old(fault_state) == FAULT_ON && fault_state == FAULT_ON ==>
                good_readings == (trouble == BRAKE_FAULT_NONE ? \old(good_readings) + 1 : 0);
    ensures t7_no_dead_state: \old(fault_state) == FAULT_ON && trouble == BRAKE_FAULT_NONE ==>
                (fault_state == FAULT_GOOD <==>
                 \old(good_readings) == FAULT_GOOD_READINGS - 1); */
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

/*@ requires fault_is_valid;
    assigns silence_cs, good_readings;
    ensures fault_is_valid;
    ensures silence_cs == \min(\old(silence_cs) + 1, FAULT_SILENCE_CS);
    ensures good_readings == (\result ? 0 : \old(good_readings));
    ensures t3_silence: \old(silence_cs) == FAULT_SILENCE_CS ==> fault_state != FAULT_GOOD;
    ensures \result ==> \old(silence_cs) == FAULT_SILENCE_CS; */
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

/*@ requires fault_is_valid;
    ensures fault_is_valid; */
bool fault_fail(uint8_t code)
{
    if (fault_state == FAULT_LASTING) {
        return false;
    }
    fault_state = FAULT_LASTING;
    fault_code = code;
    return true;
}

uint8_t fault_sum(void)
{
    return fault_state ^ fault_code ^ silence_cs ^ good_readings;
}
