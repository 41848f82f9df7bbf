/* SPDX-License-Identifier: MIT */
/* For a freshly wired board: one step shows one pin, and the serial line says what must be seen. A
 * character on the serial line, or a press of the override button, goes to the next step; the last
 * step measures distances. docs/wiring.md has the steps. */
#include <stdbool.h>
#include <stdint.h>
#include "hal.h"
#include "identity.h"
#include "range.h"
#include "selftest.h"
#include "telemetry.h"

/* The button counts when it is held for so long, and again after it was let go for so long. */
#define BOUNCE_MS 30U

/* A distance is measured and said so often. */
#define MEASURE_MS 500U

struct step {
    bool lamp, buzzer, stop;
    uint8_t brake_pct;
    const char __code *text;
};

static const struct step __code STEPS[] = {
    {false, false, true, 100, "0 start: PWM and STOP high, the brake is on"},
    {true, false, true, 100, "1 lamp: on"},
    {false, true, true, 100, "2 buzzer: on"},
    {false, false, false, 0, "3 release: PWM and STOP low, the brake is off"},
    {false, false, true, 0, "4 STOP: high, the brake is on"},
    {false, false, false, 100, "5 PWM: high, the brake is on"},
    {false, false, false, 50, "6 PWM: 50 %"},
    {false, false, true, 100, "7 echo: distances follow"},
};
#define STEP_COUNT (sizeof STEPS / sizeof STEPS[0])
#define STEP_ECHO  (STEP_COUNT - 1U)

static const char __code TESTED[] = "# table %s, RAM %s; any key or the button: next step\r\n";
static const char __code STEP[] = "# step %s\r\n";
static const char __code DISTANCE[] = "dist_mm=%u\r\n";
static const char __code REMARK[] = "# echo: %s\r\n";
static const char __code *const __code READINGS[] = {
    "", /* RANGE_ECHO */
    "no target within 6 m",
    "never came; look at TRIGGER, ECHO and the sensor's supply",
    "never ends: the pin stays high; is the sensor connected?",
    "nearer than 2 cm, or noise",
};

/* What is to be said next; a line under way is finished first. */
enum say { SAY_NOTHING, SAY_TITLE, SAY_TESTED, SAY_STEP, SAY_READING };

static uint8_t tick;       /* seen, as hal_ticks counts */
static uint8_t table_test; /* enum selftest */
static uint8_t step;       /* of STEPS */
static uint8_t say;        /* enum say */
static uint8_t held;       /* ticks that the button has had its new level */
static bool is_held;       /* the button's level, without its bouncing */
static uint8_t since;      /* ticks since the last trigger, up to MEASURE_MS */
static bool is_measuring;
static uint8_t reading; /* enum range_kind */
static uint16_t dist_mm;

static void show_step(void)
{
    const struct step __code *now = &STEPS[step];

    hal_lamp_set(now->lamp);
    hal_buzzer_set(now->buzzer);
    hal_stop_set(now->stop);
    hal_brake_set(now->brake_pct);
    is_measuring = false;
    since = 0;
    say = SAY_STEP;
}

static void next_step(void)
{
    if (table_test != SELFTEST_RUNNING) {
        step = step == STEP_ECHO ? 0 : (uint8_t)(step + 1U);
        show_step();
    }
}

/* The line feed that some terminals send after a carriage return is no key. */
static void listen(void)
{
    char c = hal_uart_get();

    if (c != 0 && c != '\n') {
        next_step();
    }
}

static void watch_button(void)
{
    if (hal_override_held() == is_held) {
        held = 0;
        return;
    }
    held++;
    if (held == BOUNCE_MS / HAL_TICK_MS) {
        held = 0;
        is_held = !is_held;
        if (is_held) {
            next_step();
        }
    }
}

static void conclude(uint8_t echo)
{
    is_measuring = false;
    reading = RANGE_NOT_RISEN;
    if (echo == HAL_RANGE_NOT_FALLEN) {
        reading = RANGE_NOT_FALLEN;
    } else if (echo == HAL_RANGE_DONE) {
        dist_mm = range_mm(hal_range_raw());
        reading = range_kind(dist_mm);
    }
    say = SAY_READING;
}

static void measure(void)
{
    since++;
    if (is_measuring && since == RANGE_PERIOD_CS) {
        conclude(hal_range());
    }
    if (since == MEASURE_MS / HAL_TICK_MS) {
        since = 0;
        hal_trigger();
        is_measuring = true;
    }
}

static void test(void)
{
    table_test = selftest_table();
    if (table_test != SELFTEST_RUNNING) {
        say = SAY_TITLE;
    }
}

static void every_tick(void)
{
    watch_button();
    if (step == STEP_ECHO) {
        measure();
    }
}

/* Starts the line that is to be said. */
static void begin_line(void)
{
    uint8_t what = say;

    say = SAY_NOTHING;
    switch (what) {
    case SAY_TITLE:
        identity_say();
        say = SAY_TESTED;
        break;
    case SAY_TESTED:
        telemetry_values[0].text = table_test == SELFTEST_PASSED ? "good" : "BAD";
        telemetry_values[1].text = hal_ram_is_good() ? "good" : "BAD";
        telemetry_say(TESTED);
        say = SAY_STEP;
        break;
    case SAY_STEP:
        telemetry_values[0].text = STEPS[step].text;
        telemetry_say(STEP);
        break;
    default: /* SAY_READING */
        telemetry_values[0].number = dist_mm;
        if (reading != RANGE_ECHO) {
            telemetry_values[0].text = READINGS[reading];
        }
        telemetry_say(reading == RANGE_ECHO ? DISTANCE : REMARK);
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
    } else if (say != SAY_NOTHING) {
        begin_line();
    }
}

void main(void)
{
    hal_init();
    table_test = SELFTEST_RUNNING;
    tick = hal_ticks();

    for (;;) {
        /* Every round. */
        if (table_test == SELFTEST_RUNNING) {
            test();
        }
        talk();
        listen();
        if (is_measuring && hal_range() == HAL_RANGE_DONE) {
            conclude(HAL_RANGE_DONE);
        }
        if (hal_ticks() == tick) {
            continue;
        }

        /* Every 10 ms. */
        tick++;
        every_tick();

        /* Nothing above took so long that a tick went by unseen. */
        if (hal_ticks() == tick) {
            hal_watchdog_feed();
        }
    }
}
