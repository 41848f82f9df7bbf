/* SPDX-License-Identifier: MIT */
/* FAULT: when the readings cannot be believed, or the machine itself cannot. Portable.
 *
 *   state     believed reading     reading not believed   180 ms without    a lasting fault
 *                                                         a believed one
 *   GOOD      GOOD                 GOOD, code: why        FAULT             LASTING
 *   FAULT     GOOD after 180 ms of FAULT, code: why       FAULT             LASTING
 *             them, else FAULT
 *   LASTING   LASTING              LASTING                LASTING           LASTING
 *
 * It starts in GOOD, after a watchdog reset in FAULT, after a failed self-test in LASTING. */
#ifndef FUZZY51_FAULT_H
#define FUZZY51_FAULT_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"
#include "range.h"

/* In the order of docs/brake.md. BRAKE_FAULT_TABLE to BRAKE_FAULT_IDLE and BRAKE_FAULT_OUTPUT last
 * until the next start. */
enum brake_fault {
    BRAKE_FAULT_NONE,
    BRAKE_FAULT_NOT_RISEN,  /* no echo pulse at all */
    BRAKE_FAULT_NOT_FALLEN, /* the echo pulse never ends */
    BRAKE_FAULT_DEAD_ZONE,  /* nearer than the sensor can measure */
    BRAKE_FAULT_JUMP,       /* an echo that fits no target */
    BRAKE_FAULT_STUCK,      /* the same reading while the target moves */
    BRAKE_FAULT_LOST,       /* a near target vanished */
    BRAKE_FAULT_WATCHDOG,   /* this start was a watchdog reset */
    BRAKE_FAULT_TABLE,      /* self-test: check sum of all code, with the table */
    BRAKE_FAULT_RAM,        /* self-test: a cell of RAM */
    BRAKE_FAULT_STACK,      /* self-test: the stack reached the end of RAM */
    BRAKE_FAULT_IDLE,       /* self-test: the sensor's line is high at rest */
    BRAKE_FAULT_STATE,      /* what the decision keeps in RAM changed by itself; does not last */
    BRAKE_FAULT_OUTPUT,     /* the PWM or the STOP pin is not as it was set */
};

/* So long without a believed reading, and how many such readings in a row end FAULT: three, or as
 * many as come in 180 ms. */
#define FAULT_SILENCE_CS    RANGE_SILENCE_CS
#define FAULT_GOOD_READINGS RANGE_READINGS_MIN(3U, 18U)

/*@ predicate fault_lasts(integer code) =
        BRAKE_FAULT_TABLE <= code <= BRAKE_FAULT_IDLE || code == BRAKE_FAULT_OUTPUT; */

enum fault_state { FAULT_GOOD, FAULT_ON, FAULT_LASTING };
extern uint8_t fault_state;

/* Why, or what is wrong with the last reading: enum brake_fault. */
extern uint8_t fault_code;

/* Starts with BRAKE_FAULT_NONE, _WATCHDOG or one of the lasting ones. */
/*@ requires code <= BRAKE_FAULT_IDLE;
    assigns fault_state, fault_code;
    ensures fault_code == code;
    ensures fault_state == (code == BRAKE_FAULT_NONE   ? FAULT_GOOD :
                            code >= BRAKE_FAULT_TABLE ? FAULT_LASTING : FAULT_ON); */
void fault_init(uint8_t code);

/* A reading came: BRAKE_FAULT_NONE if it is believed, else why not. Up to 40 mc. */
/*@ assigns fault_state, fault_code;
    ensures fault_state == \old(fault_state) ||
            (\old(fault_state) == FAULT_ON && fault_state == FAULT_GOOD);
    ensures t6_leaves: trouble != BRAKE_FAULT_NONE ==> fault_state == \old(fault_state); */
void fault_take(uint8_t trouble);

/* Every 1/100 s. True: FAULT begins now. */
/*@ assigns fault_state;
    ensures \result <==> \old(fault_state) == FAULT_GOOD && fault_state == FAULT_ON;
    ensures !\result ==> fault_state == \old(fault_state); */
bool fault_tick(void);

/* One of the lasting faults was found. True: it is the first of them. */
/*@ requires fault_lasts(code);
    assigns fault_state, fault_code;
    ensures fault_state == FAULT_LASTING;
    ensures \result <==> \old(fault_state) != FAULT_LASTING; */
bool fault_fail(uint8_t code);

/* This part of brake_sum. */
/*@ assigns \nothing; */
uint8_t fault_sum(void);

#endif
