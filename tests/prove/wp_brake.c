/* SPDX-License-Identifier: MIT */
/* functions: fault_take,fault_tick,fault_fail,far_column,column_of,latch_take,latch_override,settle,raise,demand_fault,brake_tick
 *
 * The brake's decision: its state machines, from any state that can be.
 *
 * theorem t1_echo: after an echo of BRAKE_STOP_MM or less the latch is not OPEN
 * theorem t1_pins: while the latch is not OPEN, or an echo is that near, and nobody overrides: STOP pin and 100 %
 * theorem t3_silence: FAULT_SILENCE_CS without a believed reading end GOOD, with at least FAULT_PCT
 * theorem t4_ends: without override STOP ends only at an echo beyond LATCH_NEAR_MM or at a clear reading
 * theorem t4_held: HELD becomes OPEN only on a road clear for 2 s or for another target
 * theorem t5_duty: the brake is 0 to 100 %
 * theorem t6_leaves: FAULT ends only with the third believed reading in a row
 * theorem t6_lasting: a lasting fault never ends
 * theorem t7_no_dead_state: the third believed reading in a row ends every other FAULT
 * theorem t8_override: the override acts after 100 ticks held, and ends in the first tick not held
 */
#include "bits.h"
#include "latch.h"
#include "target.h"
#include "brake.h"

#include "fault.c"

/*@ requires fault_state <= FAULT_LASTING && good_readings < FAULT_GOOD_READINGS &&
             silence_cs <= FAULT_SILENCE_CS;
    assigns fault_state, fault_code, silence_cs, good_readings;
    ensures fault_state <= FAULT_LASTING;
    ensures t6_leaves: \old(fault_state) == FAULT_ON && fault_state == FAULT_GOOD ==>
                trouble == BRAKE_FAULT_NONE && \old(good_readings) == FAULT_GOOD_READINGS - 1;
    ensures t6_lasting: \old(fault_state) == FAULT_LASTING ==> fault_state == FAULT_LASTING;
    ensures t7_no_dead_state: trouble == BRAKE_FAULT_NONE && \old(fault_state) == FAULT_ON ==>
                (\old(good_readings) == FAULT_GOOD_READINGS - 1
                     ? fault_state == FAULT_GOOD
                     : fault_state == FAULT_ON && good_readings == \old(good_readings) + 1); */
void fault_take(uint8_t trouble);

/*@ requires fault_state <= FAULT_LASTING && silence_cs <= FAULT_SILENCE_CS;
    assigns fault_state, silence_cs, good_readings;
    ensures \result <==> \old(fault_state) == FAULT_GOOD && fault_state == FAULT_ON;
    ensures silence_cs <= FAULT_SILENCE_CS;
    ensures t3_silence: \old(silence_cs) == FAULT_SILENCE_CS && \old(fault_state) == FAULT_GOOD
                ==> fault_state == FAULT_ON;
    ensures t6_lasting: \old(fault_state) == FAULT_LASTING ==> fault_state == FAULT_LASTING; */
bool fault_tick(void);

/*@ assigns fault_state, fault_code;
    ensures t6_lasting: fault_state == FAULT_LASTING; */
bool fault_fail(uint8_t code);

#include "latch.c"

/*@ predicate latch_is_valid =
        clear_readings <= LATCH_ROAD_READINGS && elsewhere_readings <= LATCH_PASSED_READINGS; */

/*@ requires latch_is_valid;
    assigns elsewhere_readings;
    ensures latch_is_valid;
    ensures \result == OPENING || \result == BEYOND || \result == BEYOND_TRACKED ||
            (\result == PASSED && elsewhere_readings == LATCH_PASSED_READINGS); */
static uint8_t far_column(bool is_of_target);

/*@ requires latch_is_valid;
    assigns clear_readings, elsewhere_readings;
    ensures latch_is_valid;
    ensures \result < COLUMNS;
    ensures range_reading.kind == RANGE_ECHO && range_reading.dist_mm <= BRAKE_STOP_MM ==>
                \result == WITHIN || \result == WITHIN_TRACKED;
    ensures \result == WITHIN || \result == WITHIN_TRACKED || \result == NEAR ==>
                range_reading.kind == RANGE_ECHO && range_reading.dist_mm <= LATCH_NEAR_MM;
    ensures OPENING <= \result <= PASSED ==>
                range_reading.kind == RANGE_ECHO && range_reading.dist_mm > LATCH_NEAR_MM;
    ensures \result == CLEAR || \result == ROAD ==> range_reading.kind == RANGE_NO_TARGET;
    ensures \result == ROAD ==> clear_readings == LATCH_ROAD_READINGS;
    ensures \result == PASSED ==> elsewhere_readings == LATCH_PASSED_READINGS; */
static uint8_t column_of(bool is_of_target);

/*@ requires latch_is_valid;
    assigns latch_state, clear_readings, elsewhere_readings;
    ensures latch_is_valid;
    ensures latch_state < LATCH_STATES;
    ensures t1_echo: range_reading.kind == RANGE_ECHO && range_reading.dist_mm <= BRAKE_STOP_MM
                ==> latch_state != LATCH_OPEN;
    ensures t4_ends: \old(latch_state) != LATCH_OPEN && latch_state == LATCH_OPEN ==>
                range_reading.kind == RANGE_NO_TARGET ||
                (range_reading.kind == RANGE_ECHO && range_reading.dist_mm > LATCH_NEAR_MM);
    ensures t4_held: \old(latch_state) == LATCH_HELD && latch_state == LATCH_OPEN ==>
                clear_readings == LATCH_ROAD_READINGS ||
                elsewhere_readings == LATCH_PASSED_READINGS; */
void latch_take(bool is_of_target);

/*@ assigns latch_state;
    ensures latch_state == LATCH_OPEN; */
void latch_override(void);

#include "brake.c"

/*@ requires demand_pct <= 100;
    assigns brake.brake_pct, brake.stop, brake.state;
    ensures t1_pins: (is_within || latch_state != LATCH_OPEN) && !brake.overridden ==>
                brake.stop && brake.brake_pct == 100;
    ensures t5_duty: brake.brake_pct <= 100;
    ensures brake.overridden ==> !brake.stop && brake.brake_pct == 0; */
static void settle(void);

/*@ assigns demand_pct;
    ensures demand_pct == \max(\old(demand_pct), least_pct); */
static void raise(uint8_t least_pct);

/*@ requires demand_pct <= 100;
    assigns demand_pct;
    ensures t5_duty: demand_pct <= 100;
    ensures demand_pct >= FAULT_PCT; */
static void demand_fault(void);

/*@ requires demand_pct <= 100 && override_cs <= BRAKE_OVERRIDE_CS;
    requires fault_state <= FAULT_LASTING && silence_cs <= FAULT_SILENCE_CS;
    assigns override_cs, demand_pct, latch_state, brake.overridden, brake.brake_pct, brake.stop,
            brake.state, fault_state, silence_cs, good_readings;
    ensures t5_duty: brake.brake_pct <= 100 && demand_pct <= 100;
    ensures t3_silence: \old(silence_cs) == FAULT_SILENCE_CS && \old(fault_state) == FAULT_GOOD
                ==> fault_state == FAULT_ON && demand_pct >= FAULT_PCT;
    ensures t8_override: override_cs ==
                (override_held ? \min(\old(override_cs) + 1, BRAKE_OVERRIDE_CS) : 0);
    ensures t8_override: brake.overridden <==> override_cs == BRAKE_OVERRIDE_CS; */
void brake_tick(bool override_held);
