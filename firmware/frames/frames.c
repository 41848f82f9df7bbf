/* SPDX-License-Identifier: MIT */
/* The jobs of the frame-fed controllers' main loop. What is different in each controller is in its
 * own main.c, behind the functions of frames.h. */
#include "frames.h"
#include "identity.h"
#include "link.h"
#include "selftest.h"

/* From the end of the self-test to the first trigger: the servo moves to its place. */
#define SETTLE_MS 60U

/* One line of telemetry each 100 ms in a fault, when no control step reports. */
#define REPORT_MS 100U

#if HAL_TICK_MS != 10
#error a tick must be 10 ms: advance_clock adds it up to 1000 ms
#endif

static uint8_t tick;                           /* the last tick of hal_ticks that was handled */
static __idata uint16_t now_ms;                /* since the start; wraps at 65,536 */
static __idata uint16_t seconds, milliseconds; /* since the start */
static uint8_t until_trigger;                  /* ticks to the next trigger */
static __idata uint8_t until_report;           /* ticks to the next line of telemetry in a fault */
static bool is_testing;
static uint8_t fault; /* enum frames_fault */

static __idata uint16_t seq; /* control steps reported or dropped */
static __idata uint8_t said; /* how many of the two lines at the start were sent */

/* One line of telemetry for each control step. If the line before is still being sent, this one is
 * dropped; its missing number shows it. */
static void report(void)
{
    uint8_t last;

    seq++;
    if (telemetry_is_busy()) {
        return;
    }
    telemetry_values[0].number = seq;
    telemetry_values[1].number = seconds;
    telemetry_values[2].number = milliseconds;
    last = app_report();
    telemetry_values[last].number = fault;
    telemetry_say(app.line);
}

static void lose(void)
{
    app_lose();
    app_apply();
}

static void finish_selftest(void)
{
    bool is_restart = hal_reset_cause() == HAL_RESET_WATCHDOG;

    is_testing = false;
    until_trigger = SETTLE_MS / HAL_TICK_MS;
    until_report = 1;
    frame_init(app.kind, app.payload_bytes, app.item_bytes);
    link_init(is_restart ? LINK_LOST : LINK_WAITING, now_ms);
    app_init();
    if (fault != FRAMES_FAULT_NONE) {
        return;
    }
    if (is_restart) {
        fault = FRAMES_FAULT_WATCHDOG;
    } else {
        app_apply();
    }
}

/* Until all tests have passed the pins stay as reset left them, which is safe. */
static void test(void)
{
    switch (selftest_table()) {
    case SELFTEST_RUNNING:
        return;
    case SELFTEST_FAILED:
        fault = FRAMES_FAULT_TABLE;
    }
    if (!hal_ram_is_good()) {
        fault = FRAMES_FAULT_RAM;
    }
    finish_selftest();
}

/* A complete frame with a right check sum was received. */
static void take_frame(void)
{
    if (!app_read()) {
        frame_refuse();
        link_bad();
        return;
    }
    if (!link_good(now_ms)) {
        return;
    }
    fault = FRAMES_FAULT_NONE;
    app_decide();
    app_apply();
    report();
}

static void listen(void)
{
    uint8_t byte = hal_take(), result;

    if (is_testing || fault >= FRAMES_FAULT_TABLE) {
        return;
    }
    result = frame_push(byte);
    if (result == FRAME_GOOD) {
        take_frame();
    } else if (result == FRAME_ITEM) {
        app_item();
    } else if (result == FRAME_BAD) {
        link_bad();
    }
}

/* Every 10 ms. */
static void watch(void)
{
    if (!hal_stack_is_good()) {
        fault = FRAMES_FAULT_STACK;
    }
    if (fault < FRAMES_FAULT_TABLE && link_check(now_ms) == LINK_LOST &&
        fault == FRAMES_FAULT_NONE) {
        fault = FRAMES_FAULT_LINK;
    }
    if (fault != FRAMES_FAULT_NONE) {
        lose();
    }
}

static void show(void)
{
    uint8_t pattern = app_lamp();

    if (fault >= FRAMES_FAULT_TABLE) {
        pattern = (uint8_t)(fault - FRAMES_FAULT_TABLE + 2U);
    } else if (fault != FRAMES_FAULT_NONE) {
        pattern = LAMP_ON;
    }
    hal_lamp_set(lamp_tick(pattern));
    hal_buzzer_set(fault != FRAMES_FAULT_NONE);
}

static void advance_clock(void)
{
    now_ms += HAL_TICK_MS;
    milliseconds += HAL_TICK_MS;
    if (milliseconds == 1000) {
        milliseconds = 0;
        seconds++;
    }
}

static void talk(void)
{
    char c;

    if (!hal_uart_ready()) {
        return;
    }
    c = telemetry_next();
    if (c != 0) {
        hal_uart_put(c);
    } else if (said == 0) {
        said = 1;
        identity_say();
    } else if (said == 1) {
        said = 2;
        telemetry_say(app.header);
    }
}

void frames_init(void)
{
    hal_init();
    is_testing = true;
    tick = hal_ticks();
}

void frames_round(void)
{
    /* Every round. */
    if (is_testing) {
        test();
    }
    talk();
    if (hal_waiting() != 0) {
        listen();
    }
    if (hal_ticks() == tick) {
        return;
    }

    /* Every 10 ms. */
    tick++;
    advance_clock();
    if (!is_testing) {
        watch();
        show();
        /* Without frames there are no control steps, but the fault must be reported. */
        if (fault != FRAMES_FAULT_NONE && --until_report == 0) {
            until_report = REPORT_MS / HAL_TICK_MS;
            report();
        }

        /* Every control step. */
        if (--until_trigger == 0) {
            until_trigger = app.period_ticks;
            if (frame_ask()) {
                link_bad();
            }
            hal_trigger();
        }
    }

    /* Feed the watchdog only if nothing above took longer than a tick. */
    if (hal_ticks() == tick) {
        hal_watchdog_feed();
    }
}
