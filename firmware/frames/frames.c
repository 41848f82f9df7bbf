/* Main of the controllers that live on frames: radar, gap, follow, park. Each of them is one more
 * file, which says what is its own. */
#include "frames.h"
#include "link.h"
#include "lut_table.h"
#include "selftest.h"

#define VERSION "fuzzy51 " FUZZY51_VERSION

/* From the end of the self-test to the first trigger: an actuator takes its place. */
#define SETTLE_MS 60U

/* In a fault there are no control steps to report. */
#define REPORT_MS 100U

#if HAL_TICK_MS != 10
#error a tick must be 10 ms: the clock below counts so
#endif

static uint8_t tick;            /* seen, as hal_ticks counts */
static __idata uint16_t now_ms; /* wraps */
static __idata uint16_t seconds, milliseconds;
static uint8_t until_trigger; /* ticks */
static __idata uint8_t until_report;
static bool is_testing;
static uint8_t fault;

static __idata uint16_t seq; /* control steps */
static __idata uint8_t said; /* of the two lines at the start */

static const char __code TITLE[] = "# " VERSION " %s %s table=%x reset=%s\r\n";
static const char __code BOARD[] = BOARD_NAME;
static const char __code *const __code RESETS[] = {"power-on", "watchdog", "pin"};

/* One line a control step; dropped when the one before is not out: the numbers show it. */
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
    frame_init(app.kind, app.payload_bytes);
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

/* The pins stay as reset left them, on the safe side, until all is found good. */
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

/* A whole frame with a right check sum came in. */
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
    uint8_t result = frame_push(hal_take());

    if (is_testing || fault >= FRAMES_FAULT_TABLE) {
        return;
    }
    if (result == FRAME_GOOD) {
        take_frame();
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
        telemetry_values[0].text = app.name;
        telemetry_values[1].text = BOARD;
        telemetry_values[2].number = LUT_CRC16;
        telemetry_values[3].text = RESETS[hal_reset_cause()];
        telemetry_say(TITLE);
    } else if (said == 1) {
        said = 2;
        telemetry_say(app.header);
    }
}

void main(void)
{
    /* Must be first: the pins are safe, the clock runs. */
    hal_init();

    is_testing = true;
    tick = hal_ticks();

    for (;;) {
        /* Every round. */
        if (is_testing) {
            test();
        }
        talk();
        if (hal_waiting() != 0) {
            listen();
        }
        if (hal_ticks() == tick) {
            continue;
        }

        /* Every 10 ms. */
        tick++;
        advance_clock();
        if (!is_testing) {
            watch();
            show();
            /* A controller that hears nothing still says so. */
            if (fault != FRAMES_FAULT_NONE && --until_report == 0) {
                until_report = REPORT_MS / HAL_TICK_MS;
                report();
            }

            /* Every control step. */
            if (--until_trigger == 0) {
                until_trigger = app.period_ticks;
                hal_trigger();
            }
        }

        /* Nothing above took so long that a tick went by unseen. */
        if (hal_ticks() == tick) {
            hal_watchdog_feed();
        }
    }
}
