/* SPDX-License-Identifier: MIT */
/* The brake controller: sensor -> closing speed -> table -> PWM, and the stop beside it. */
#include "brake.h"
#include "closing.h"
#include "fixed.h"
#include "hal.h"
#include "identity.h"
#include "lamp.h"
#include "latch.h"
#include "law.h"
#include "range.h"
#include "telemetry.h"

#define WAIT_TICKS (RANGE_WAIT_CS * 10U / HAL_TICK_MS)

#define TICKS_LATE 3U /* that many never go by in one round: a bit of the clock has turned over */

#if HAL_TICK_MS != 10
#error a tick must be 10 ms: the brake counts in hundredths of a second
#endif

static uint8_t tick;             /* seen, as hal_ticks counts */
static __idata uint16_t seconds; /* since the start */
static __idata uint8_t centiseconds;

/* Neither one bit that turns over nor a byte that is left inverted (hal_ram_test) starts the
 * self-test again, in which the brake does not act. */
enum phase { PHASE_RUN = 0xA5, PHASE_TEST = 0xC3 };
static uint8_t phase;     /* enum phase; any other value is PHASE_RUN */
static uint8_t code_test; /* enum hal_code */

/* Tick of the last trigger, or of the last reading without one; and its complement, so that a bit
 * that turns over shows while the decision is at work, too. */
static uint8_t triggered, triggered_twin;
static __bit is_measuring;

/* Each job of a round leaves its mark, in this order. A mark that is missing, out of order or left
 * twice tells of a program that ran wild. */
#define MARKED(flow, mark) ((uint8_t)(((flow) << 1 | (flow) >> 7) ^ (mark)))
#define MARK_CHECK         0x1DU
#define MARK_CODE          0x3AU
#define MARK_TALK          0x74U
#define MARK_LISTEN        0xE8U
#define MARK_DECIDE        0x87U
#define MARK_SHOW          0x13U
#define FLOW_CHECKED       MARKED(MARK_CHECK, MARK_TALK)
#define FLOW_TESTED        MARKED(FLOW_CHECKED, MARK_CODE)
#define FLOW_ROUND         MARKED(MARKED(FLOW_TESTED, MARK_TALK), MARK_LISTEN)
#define FLOW_TICK          MARKED(MARKED(FLOW_ROUND, MARK_DECIDE), MARK_SHOW)
static uint8_t flow; /* marks in this round */

static uint8_t sealed; /* sum_up's, when the decision or its clock last changed */

/* Characters sent since the last tick. Timer 2 times them, timer 1 the ticks: at 9600 Bd 9.6 fit a
 * tick, and one or two more before a late one is seen. */
static uint8_t sent;
#define SENT_MAX 12U

static __idata uint16_t seq;     /* control steps */
static __idata uint16_t dropped; /* lines of them */
static __idata uint8_t stack_unused;
static __bit is_talking;
static char command; /* waits for the line under way to end; 0: none */
#define SAY_HEADER '\1'

static const char __code HEADER[] = "seq,ms,dist_mm,closing_mmps,row,col,brake_pct,state,fault\r\n";
static const char __code LINE[] = "%u,%o%m,%o,%s%u,%u,%u,%u,%s,%u\r\n";
static const char __code STATUS[] = "# state=%s fault=%u dropped=%u stack_unused=%u\r\n";
static const char __code HELP[] = "# ? help, v version, s status, t telemetry on/off\r\n";
static const char __code ON[] = "# telemetry on\r\n";
static const char __code OFF[] = "# telemetry off\r\n";
static const char __code *const __code STATES[] = {"RELEASED", "CONTROL", "STOP", "FAULT"};

/* Holds from the start on; pin_ is what tests/prove/pins.h sees at the pins. */
/*@ predicate main_is_valid =
        brake_is_valid && brake_is_settled && !is_within &&
        code_test <= HAL_CODE_BAD &&
        (phase == PHASE_TEST ==> !is_measuring && pin_stop && pin_brake_pct == 100); */

/*@ requires brake.brake_pct <= 100;
    assigns pin_stop, pin_brake_pct;
    ensures pin_stop == brake.stop && pin_brake_pct == brake.brake_pct; */
static void apply(void)
{
    hal_stop_set(brake.stop);
    hal_brake_set(brake.brake_pct);
}

/* One line a control step; dropped, and counted, when the one before is not out. */
/*@ requires brake.state <= BRAKE_FAULT;
    assigns dropped, telemetry_values[0 .. TELEMETRY_VALUES - 1]; */
static void report(void)
{
    uint16_t speed_mmps;

    if (!is_talking) {
        return;
    }
    if (telemetry_is_busy() || command != 0) {
        dropped++;
        return;
    }
    telemetry_values[0].number = seq;
    telemetry_values[1].number = seconds;
    telemetry_values[2].number = mul_u8(centiseconds, 10);
    telemetry_values[3].number = 0; /* prints nothing */
    if (range_reading.kind == RANGE_ECHO) {
        telemetry_values[3].number = range_reading.dist_mm;
    }
    telemetry_values[4].text = "";
    speed_mmps = CLOSING_LAW.closing_mmps;
    if (CLOSING_LAW.opening_mmps != 0) {
        telemetry_values[4].text = "-";
        speed_mmps = CLOSING_LAW.opening_mmps;
    }
    telemetry_values[5].number = speed_mmps;
    telemetry_values[6].number = law_answer.row;
    telemetry_values[7].number = law_answer.col;
    telemetry_values[8].number = brake.brake_pct;
    telemetry_values[9].text = STATES[brake.state];
    telemetry_values[10].number = fault_code;
    telemetry_say(LINE);
}

/* From the end of the echo, or of the wait for it, to the pins. */
/*@ requires main_is_valid && phase != PHASE_TEST && echo <= HAL_RANGE_DONE;
    ensures brake_is_valid && brake_is_settled;
    ensures phase == \old(phase) && code_test == \old(code_test);
    ensures pin_stop == brake.stop && pin_brake_pct == brake.brake_pct; */
static void control_step(uint8_t echo)
{
    uint8_t kind;
    uint16_t dist_mm;

#if RANGE_IS_TRIGGERED
    is_measuring = false;
#endif
    if (echo == HAL_RANGE_DONE) {
        dist_mm = range_mm(hal_range_raw());
        kind = range_kind(dist_mm);
        if (kind == RANGE_ECHO && brake_must_stop(dist_mm)) {
            hal_stop_set(true); /* before estimator and table, whatever they say */
        }
    } else {
        dist_mm = 0xFFFF; /* so that no bit of the kind makes an echo within reach of it */
        kind = (uint8_t)(echo - HAL_RANGE_NOT_RISEN + RANGE_NOT_RISEN);
    }
    brake_step(kind, dist_mm);
    apply();
    seq++; /* counted as soon as the duty is set: where benches look */
}

/* `tick` is not in it: one that is behind catches up, and one that is ahead is TICKS_LATE. Nor is
 * `triggered`, which has a twin. */
/*@ assigns \nothing; */
static uint8_t sum_up(void)
{
    return brake_sum() ^ (uint8_t)is_measuring;
}

/*@ assigns sealed; */
static void seal(void)
{
    sealed = sum_up();
}

/*@ requires main_is_valid && fault_lasts(fault);
    ensures main_is_valid && phase == \old(phase) && code_test == \old(code_test);
    ensures phase == PHASE_TEST ==> pin_stop == \old(pin_stop); */
static void fail(uint8_t fault)
{
    brake_fail(fault);
    seal();
}

/*@ assigns triggered, triggered_twin; */
static void note_trigger(void)
{
    triggered = tick;
    triggered_twin = (uint8_t)~tick;
}

/* A bit has turned over: of what was sealed, of the clock, of the last trigger's tick, or, while
 * they were being decided, of the brake's force or of STOP. */
/*@ requires phase != PHASE_TEST;
    requires code_test <= HAL_CODE_BAD;
    ensures t10_anew: main_is_valid && phase == \old(phase) && code_test == \old(code_test) &&
                fault_state != FAULT_GOOD && pin_brake_pct >= FAULT_PCT; */
static void begin_anew(void)
{
    brake_begin_anew();
    apply();
    is_measuring = false;
    tick = hal_ticks();
    note_trigger();
    sent = 0;
    seal();
}

/*@ requires main_is_valid && phase != PHASE_TEST;
    ensures main_is_valid && phase == \old(phase); */
static void check(void)
{
    if (sum_up() != sealed || brake.brake_pct > 100 || (uint8_t)(hal_ticks() - tick) > TICKS_LATE ||
        (uint8_t)(tick - triggered) > WAIT_TICKS ||
        (uint8_t)(triggered + triggered_twin) != 0xFFU || sent > SENT_MAX) {
        begin_anew();
    }
}

/* A measurement is over: the brake first, all else after it. */
/*@ requires main_is_valid && phase != PHASE_TEST && echo <= HAL_RANGE_DONE;
    ensures main_is_valid && phase == \old(phase); */
static void conclude(uint8_t echo)
{
    control_step(echo);
    brake_finish();
    apply();
    report();
#if !RANGE_IS_TRIGGERED
    note_trigger(); /* the next reading is under way */
    if (echo == HAL_RANGE_DONE) {
        brake_expect(RANGE_PERIOD_CS);
    }
#endif
    seal();
}

/* Between the loop's parts, so that an echo waits for one of them at most. */
/*@ requires main_is_valid;
    ensures main_is_valid && phase == \old(phase); */
static void poll(void)
{
    if (is_measuring && hal_range() == HAL_RANGE_DONE) {
        conclude(HAL_RANGE_DONE);
    }
}

/*@ requires main_is_valid && phase != PHASE_TEST;
    ensures main_is_valid && phase == \old(phase); */
static void measure(void)
{
    if (is_measuring) {
        conclude(hal_range());
    }
    stack_unused = hal_stack_unused(); /* long, so now: no echo waits for it */
    check();
    note_trigger();
    hal_trigger();
    is_measuring = true;
#if RANGE_IS_TRIGGERED
    brake_expect(RANGE_WAIT_CS); /* since the last trigger */
#endif
    seal();
}

/*@ requires fault <= BRAKE_FAULT_IDLE && code_test <= HAL_CODE_BAD;
    ensures main_is_valid && phase == PHASE_RUN;
    ensures t9_fails: fault >= BRAKE_FAULT_TABLE ==>
                fault_state == FAULT_LASTING && pin_brake_pct >= FAULT_PCT; */
static void finish_selftest(uint8_t fault)
{
    brake_init(fault);
    note_trigger();            /* the first measurement comes a period after the brake's release */
    if (phase != PHASE_TEST) { /* a program that ran wild has come here */
        hal_restart();
    }
    phase = PHASE_RUN;
    apply();
    seal();
}

/* The brake stays on until all is found good. */
/*@ requires main_is_valid && phase == PHASE_TEST;
    ensures main_is_valid;
    ensures t9_passed: phase != PHASE_TEST && fault_state != FAULT_LASTING ==>
                \old(code_test) == HAL_CODE_GOOD; */
static void test(void)
{
    uint8_t fault;

    if (code_test == HAL_CODE_RUNNING) {
        code_test = hal_code_test();
        if (code_test == HAL_CODE_RUNNING) {
            code_test = hal_code_test();
        }
        return;
    }
    if (!hal_ram_is_good()) {
        fault = BRAKE_FAULT_RAM;
    } else if (code_test == HAL_CODE_BAD) {
        fault = BRAKE_FAULT_TABLE;
    } else if (hal_range_is_busy()) { /* and the last echo before a reset is over by now */
        fault = BRAKE_FAULT_IDLE;
    } else if (hal_reset_cause() == HAL_RESET_WATCHDOG) {
        fault = BRAKE_FAULT_WATCHDOG;
    } else {
        fault = BRAKE_FAULT_NONE;
    }
    finish_selftest(fault);
}

/*@ assigns flow; */
static void show(void)
{
    uint8_t pattern = LAMP_OFF;

    if (fault_code >= BRAKE_FAULT_TABLE) {
        pattern = (uint8_t)(fault_code - BRAKE_FAULT_TABLE + 2U);
    } else if (brake.state == BRAKE_FAULT) {
        pattern = LAMP_ON;
    } else if (brake.warn) {
        pattern = LAMP_FLICKER;
    }
    hal_lamp_set(lamp_tick(pattern));
    hal_buzzer_set(brake.warn);
    flow = MARKED(flow, MARK_SHOW);
}

/* A function of its own, so that a return address with a flipped bit does not lead from elsewhere
 * into a FAULT that lasts, with STOP. */
/*@ requires main_is_valid;
    ensures main_is_valid && phase == \old(phase); */
static void judge_outputs(uint8_t wrong_ticks)
{
    if (wrong_ticks == HAL_WRONG_TICKS) {
        brake_fail(BRAKE_FAULT_OUTPUT);
    }
}

/*@ assigns seconds, centiseconds; */
static void advance_clock(void)
{
    centiseconds++;
    if (centiseconds == 100) {
        centiseconds = 0;
        seconds++;
    }
}

/* The next command stays in the UART until the one before it is answered. */
/*@ assigns command, flow; */
static void listen(void)
{
    flow = MARKED(flow, MARK_LISTEN);
    if (command == 0) {
        char c = hal_uart_get();

        if (c != '\r' && c != '\n') {
            command = c;
        }
    }
}

/*@ requires brake.state <= BRAKE_FAULT;
    assigns telemetry_values[0 .. 3]; */
static void status(void)
{
    telemetry_values[0].text = STATES[brake.state];
    telemetry_values[1].number = fault_code;
    telemetry_values[2].number = dropped;
    telemetry_values[3].number = stack_unused;
    telemetry_say(STATUS);
}

/* Unknown input is answered with the help, never obeyed. */
/*@ requires brake.state <= BRAKE_FAULT;
    assigns command, is_talking, telemetry_values[0 .. TELEMETRY_VALUES - 1]; */
static void answer(void)
{
    char asked = command;

    command = 0;
    switch (asked) {
    case 'v':
        identity_say();
        command = SAY_HEADER;
        break;
    case SAY_HEADER:
        telemetry_say(HEADER);
        break;
    case 's':
        status();
        break;
    case 't':
        is_talking = !is_talking;
        telemetry_say(is_talking ? ON : OFF);
        break;
    default: /* ? too */
        telemetry_say(HELP);
    }
}

/*@ requires brake.state <= BRAKE_FAULT;
    assigns command, is_talking, flow, sent, telemetry_values[0 .. TELEMETRY_VALUES - 1]; */
static void talk(void)
{
    char c;

    flow = MARKED(flow, MARK_TALK);
    if (!hal_uart_ready()) {
        return;
    }
    c = telemetry_next();
    if (c != 0) {
        hal_uart_put(c);
        sent++;
    } else if (command != 0) {
        answer();
    }
}

/*@ requires pin_stop && pin_brake_pct == 100 && code_test <= HAL_CODE_BAD; */
void main(void)
{
    /* Must be first: the pins are safe, the clock runs. */
    hal_init();

    /* In any order. */
    brake_init(BRAKE_FAULT_NONE); /* nothing of it is at the pins before the self-test is over */
    is_talking = true;
    command = 'v';
    stack_unused = hal_stack_unused();

    /* Must be last: a start clears RAM, so a program that ran wild has come here otherwise, at
     * whichever of the lines above. Added, so that not even this line alone begins the self-test.
     */
    if (phase != 0) {
        hal_restart();
    }
    phase += PHASE_TEST;

    /*@ loop invariant t9_on: main_is_valid; */
    for (;;) {
        /* Every round, less than a millisecond. */
        hal_begin_round();
        hal_registers_restore();
        if (phase == PHASE_TEST) {
            test();
            flow = FLOW_TESTED;
        } else {
            check();
            flow = MARKED(flow, MARK_CHECK);
            poll();
#if !RANGE_IS_TRIGGERED
            if (hal_range_is_late() && is_measuring) {
                brake_expect(RANGE_PERIOD_CS);
                seal();
            }
#endif
            talk(); /* twice in a round, so that a line is out before the next reading */
            poll();
            if (hal_code_test() == HAL_CODE_BAD) {
                fail(BRAKE_FAULT_TABLE);
            }
            if (!hal_ram_test()) {
                check(); /* what it left wrong would be sealed */
                fail(BRAKE_FAULT_RAM);
            }
            flow = MARKED(flow, MARK_CODE);
        }
        poll();
        talk();
        listen();
        poll();
        if (flow != FLOW_ROUND) {
            hal_restart();
        }
        if (hal_ticks() == tick) {
            flow = 0;
            continue;
        }

        /* Every 10 ms. */
        tick++;
        advance_clock();
        sent = 0;
        if (phase == PHASE_TEST) {
            flow = FLOW_TICK;
        } else {
            check(); /* again, so that what is sealed below was whole before */
            poll();
            judge_outputs(hal_outputs_wrong_ticks(brake.stop));
            if (!hal_stack_is_good()) {
                brake_fail(BRAKE_FAULT_STACK);
            }
            brake_tick(hal_override_held());
            apply();
            seal();
            flow = MARKED(flow, MARK_DECIDE);
            poll();
            show();
            poll();

            /* Every 60 ms, or once the sensor is silent. */
            if ((uint8_t)(tick - triggered) == WAIT_TICKS) {
                measure();
            }
            poll();
        }

        if (flow != FLOW_TICK) {
            hal_restart();
        }
        flow = 0;
        /* Nothing above took so long that a tick went by unseen. */
        if (hal_ticks() == tick) {
            hal_watchdog_feed();
        }
    }
}
