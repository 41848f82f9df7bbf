/* SPDX-License-Identifier: MIT */
/* proves: fault.c latch.c warning.c brake.c wp_brake.c
 * long: yes
 *
 * The brake's decision, its state machines and what may happen to them in any order: begin, then expect, read, tick
 * and fail for ever. The variables below count what has happened so far. `counted` says how the state of the
 * firmware follows from it; each of the five functions keeps it, so it holds for ever.
 *
 * theorem t1_echo: an echo of BRAKE_STOP_MM or less gives STOP and 100 % in that step, unless the driver overrides
 * theorem t2_holds: a missing or disbelieved reading never lowers the brake
 * theorem t2_ends: but that it can end a STOP that was in doubt, or one with a road clear for 2 s
 * theorem t3_silence: more than 180 ms without a believed reading are FAULT, with at least FAULT_PCT
 * theorem t4_ends: a reading ends STOP only by the arrows into OPEN of latch.h
 * theorem t4_only: nothing but a reading, the override and a new beginning ends STOP
 * theorem t5_duty: the brake is 0 to 100 %
 * theorem t6_leaves: FAULT ends only with FAULT_GOOD_READINGS believed readings in a row
 * theorem t6_lasting: after a failed test FAULT never ends
 * theorem t7_no_dead_state: so many believed readings in a row end every other FAULT
 * theorem t7_road: a road clear for 2 s ends every STOP
 * theorem t7_opening: a gap that opens ends every STOP, at the second such reading at the latest
 * theorem t7_passed: another target, tracked beyond LATCH_NEAR_MM for 1 s, ends every STOP
 * theorem t10_anew: whatever its RAM held, begun anew it is in FAULT, with FAULT_PCT to 100 %
 * theorem t8_override: the override acts from the 100th tick held in a row to the 3072nd, and not one tick longer than held
 * theorem t11_pwm: a PWM or STOP pin that is not as it was set gives STOP and 100 %, unless the driver overrides
 */
#include "bits.h"
#include "sensor.h"
#include "fixed.h"
#include CLOSING_C
#include "target.c"
#include "fault.c"
#include "warning.c"
#include "latch.c"
#include "brake.c"

static uint16_t silent_ticks;   /* since the last believed reading */
static uint16_t held_ticks;     /* of the override, in a row */
static uint16_t believed_run;   /* readings in a row */
static uint16_t believed_fault; /* the same, since FAULT began */
static uint16_t clear_run;      /* clear readings in a row that the latch saw */

/*@ predicate counted =
        brake_is_valid && brake_is_settled && !is_within &&
        silence_cs == \min(silent_ticks, FAULT_SILENCE_CS) &&
        (silent_ticks > FAULT_SILENCE_CS ==> fault_state != FAULT_GOOD) &&
        override_cs == \min(held_ticks, BRAKE_OVERRIDE_END_CS) &&
        (fault_state == FAULT_ON ==> good_readings == believed_fault) &&
        believed_fault <= believed_run &&
        clear_readings == \min(clear_run, LATCH_ROAD_READINGS); */

/*@ requires \valid(counter);
    assigns *counter;
    ensures *counter == \min(\old(*counter) + 1, 65535); */
static void count(uint16_t *counter)
{
    if (*counter < UINT16_MAX) {
        (*counter)++;
    }
}

/*@ requires fault <= BRAKE_FAULT_IDLE;
    ensures counted; */
void begin(uint8_t fault)
{
    brake_init(fault);
    silent_ticks = 0;
    held_ticks = 0;
    believed_run = 0;
    believed_fault = 0;
    clear_run = 0;
}

/*@ ensures counted;
    ensures t10_anew: brake.state == BRAKE_FAULT && !brake.overridden &&
                FAULT_PCT <= brake.brake_pct <= 100;
    ensures t6_lasting: \old(fault_state) == FAULT_LASTING ==> fault_state == FAULT_LASTING; */
void anew(void)
{
    brake_begin_anew();
    silent_ticks = 0;
    held_ticks = 0;
    believed_run = 0;
    believed_fault = 0;
    clear_run = 0;
}

/*@ requires counted && fault_lasts(fault);
    ensures counted;
    ensures t2_holds: FAULT_PCT > 0 ==> brake.brake_pct >= \old(brake.brake_pct);
    ensures t4_only: \old(brake.stop) && !brake.stop ==> brake.overridden;
    ensures t6_lasting: fault_state == FAULT_LASTING;
    ensures t11_pwm: fault == BRAKE_FAULT_OUTPUT && !brake.overridden ==>
                brake.stop && brake.brake_pct == 100; */
void fail(uint8_t fault)
{
    brake_fail(fault);
}

/*@ requires counted;
    ensures counted;
    ensures t2_holds: brake.brake_pct == \old(brake.brake_pct);
    ensures t4_only: brake.stop == \old(brake.stop);
    ensures t6_lasting: fault_state == \old(fault_state); */
void expect(uint8_t elapsed_cs)
{
    brake_expect(elapsed_cs);
}

/*@ requires counted && kind <= RANGE_DEAD_ZONE;
    ensures counted;
    ensures t1_echo: kind == RANGE_ECHO && dist_mm <= BRAKE_STOP_MM && !brake.overridden ==>
                brake.stop && brake.brake_pct == 100;
    ensures t2_ends: !is_believed || (kind == RANGE_NO_TARGET && target_worth != TARGET_NONE) ==>
                brake.brake_pct >= \old(brake.brake_pct) || \old(latch_state) == LATCH_DOUBTED ||
                clear_run >= LATCH_ROAD_READINGS;
    ensures t3_silence: silent_ticks > FAULT_SILENCE_CS ==> brake.state == BRAKE_FAULT &&
                (!brake.overridden ==> brake.brake_pct >= FAULT_PCT);
    ensures t4_ends: \old(brake.stop) && !brake.stop && kind == RANGE_ECHO ==>
                dist_mm > LATCH_NEAR_MM;
    ensures t4_ends: \old(brake.stop) && !brake.stop && \old(latch_state) == LATCH_HELD ==>
                clear_run >= LATCH_ROAD_READINGS || latch_sees_passed(is_believed);
    ensures t5_duty: brake.brake_pct <= 100;
    ensures t6_leaves: \old(fault_state) == FAULT_ON && fault_state == FAULT_GOOD ==>
                believed_run >= FAULT_GOOD_READINGS;
    ensures t6_lasting: \old(fault_state) == FAULT_LASTING ==> fault_state == FAULT_LASTING;
    ensures t7_no_dead_state: \old(fault_state) == FAULT_ON &&
                believed_fault >= FAULT_GOOD_READINGS ==> fault_state == FAULT_GOOD;
    ensures t7_road: clear_run >= LATCH_ROAD_READINGS ==> !brake.stop || brake.overridden;
    ensures t7_opening: latch_sees_opening(is_believed) && !brake.overridden ==>
                !brake.stop || (\old(latch_state) != LATCH_OPENING && latch_state == LATCH_OPENING);
    ensures t7_passed: latch_sees_passed(is_believed) && !brake.overridden ==> !brake.stop; */
void read(uint8_t kind, uint16_t dist_mm)
{
    brake_step(kind, dist_mm);
    if (is_believed) {
        silent_ticks = 0;
        count(&believed_run);
        count(&believed_fault);
    } else {
        believed_run = 0;
        believed_fault = 0;
    }
    if (!brake.overridden) {
        if (kind == RANGE_NO_TARGET) {
            count(&clear_run);
        } else {
            clear_run = 0;
        }
    }
    brake_finish();
}

/*@ requires counted;
    ensures counted;
    ensures t2_holds: FAULT_PCT > 0 && !\old(brake.overridden) && !brake.overridden ==>
                brake.brake_pct >= \old(brake.brake_pct);
    ensures t3_silence: silent_ticks > FAULT_SILENCE_CS ==> brake.state == BRAKE_FAULT &&
                (!brake.overridden ==> brake.brake_pct >= FAULT_PCT);
    ensures t4_only: \old(brake.stop) && !brake.stop ==> brake.overridden;
    ensures t5_duty: brake.brake_pct <= 100;
    ensures t6_leaves: fault_state == \old(fault_state) || fault_state == FAULT_ON;
    ensures t6_lasting: \old(fault_state) == FAULT_LASTING ==> fault_state == FAULT_LASTING;
    ensures t8_override: brake.overridden <==>
                BRAKE_OVERRIDE_CS <= held_ticks <= BRAKE_OVERRIDE_END_CS; */
void tick(bool override_held)
{
    uint8_t state = fault_state;

    brake_tick(override_held);
    count(&silent_ticks);
    if (override_held) {
        count(&held_ticks);
    } else {
        held_ticks = 0;
    }
    if (state == FAULT_GOOD && fault_state == FAULT_ON) {
        believed_fault = 0;
    }
}
