/* SPDX-License-Identifier: MIT */
/* Times the brake's control step as it ships, from the end of a reading to the duty set:
 * brake/main.c but for its main. A drive of chance, with targets of up to 35 m/s either way, jumps,
 * clear roads, missing, stuck and stray readings, the dead zone, longer pauses and the override;
 * what never came of states and faults, and each STOP that came late to its pin, are the misses.
 * Every other step is taken by poll, as the main loop does it: from there to the STOP pin time is
 * taken, too. */
#include <8052.h>
#include "step.h"
#include "hal.h"
#include "range.h"

uint16_t bench_ticks(void);
void bench_stop_set(bool on);
#if RANGE_IS_TRIGGERED
#define hal_range_raw bench_ticks
#endif
#define hal_stop_set bench_stop_set
#define main         brake_main
#include "../../firmware/brake/main.c"
#undef main
#undef hal_stop_set

/* From the poll that sees a reading to the STOP pin, at most, with the interrupts in between: the
 * PWM's, which takes 53 (build/BOARD/APP.bound) and its call 2, and a TF-Luna's, 41 and 2. Timer 2
 * counts, as hal_range stops timer 0. */
#if RANGE_IS_TRIGGERED
#define STOP_MC (300U - 55U)
#else
#define STOP_MC (300U - 55U - 43U)
#endif
static __idata uint16_t stop_mc; /* from poll on, in this step; 0: not yet */
static __idata uint8_t slow_stops, stops;
static __idata uint16_t step_mc; /* of the last step that was timed */

const uint16_t __code bench_steps = 4000;

/* A target's step from one reading to the next is that of 60 ms times 2 to the minus this. */
#if RANGE_IS_FAST
#define STEP_SHIFT 3
#else
#define STEP_SHIFT 0
#endif
#define PLACE_MAX_MM (RANGE_MAX_MM + 200U)

/* An image that never stops never comes there. */
#if BRAKE_STOP_MM > 0
#define STATES_DUE ((2U << BRAKE_FAULT) - 1U)
#else
#define STATES_DUE (((2U << BRAKE_FAULT) - 1U) & ~(1U << BRAKE_STOP))
#endif

static __idata uint16_t noise = 1, n, place_mm;
static __idata uint8_t faults_seen, states_seen, since_cs;
static __idata int16_t step_mm; /* nearer, each reading */
static __idata uint8_t stuck;   /* so many readings still repeat the last one */

/* Galois' shift register of 16 bits. */
static uint8_t chance(void)
{
    uint8_t i = 8;

    do {
        noise = noise & 1 ? noise >> 1 ^ 0xB400 : noise >> 1;
    } while (--i != 0);
    return (uint8_t)noise;
}

void bench_stop_set(bool on)
{
    if (on && stop_mc == 0) {
        stop_mc = (uint16_t)((uint16_t)TH2 << 8 | TL2);
    }
    hal_stop_set(on);
}

/* A function of its own, so that it takes no byte of RAM: there is none left. */
static void change_step(uint8_t what)
{
    if (what < 4) {
        step_mm = (int16_t)(step_mm << 3);
    } else if (what < 8) {
        step_mm = (int16_t)-step_mm;
    } else if (what >= 12) {
        step_mm = 0;
    }
}

/* Where the target is now, and how it goes on. */
static void drive(void)
{
    uint8_t what = chance();

    if (what < 16) { /* another one, or the same one somewhere else */
        place_mm = (uint16_t)((uint16_t)(chance() << 8 | chance()) % (PLACE_MAX_MM - 100U));
        step_mm = (int16_t)chance();
        change_step(what);
        step_mm >>= STEP_SHIFT;
    } else if (what < 24) {
        step_mm = (int16_t)(step_mm >> 2);
    } else if (what < 28) { /* a stray reading */
        place_mm ^= 1024;
    } else if (what < 32) {
        stuck = 1U << STEP_SHIFT << STEP_SHIFT;
    }
    if (stuck != 0) {
        stuck--;
    } else {
        place_mm -= (uint16_t)step_mm;
    }
    if (place_mm > PLACE_MAX_MM) {
        place_mm = step_mm < 0 ? PLACE_MAX_MM : 10;
        step_mm = -step_mm;
    }
}

#if RANGE_IS_TRIGGERED

#define TICKS_PER_MM_Q6 ((uint16_t)(CLK_HZ / 12U * 128U / SOUND_MMPS))
static __idata uint16_t echo_ticks;

uint16_t bench_ticks(void)
{
    return echo_ticks;
}

/* What the sensor says, and the time since it said something. */
static uint8_t next_reading(void)
{
    uint8_t what = chance();

    since_cs = RANGE_PERIOD_CS;
    if (what < 8) {
        since_cs = (uint8_t)(CLOSING_SPAN_MIN_CS + (chance() & 15));
    }
    if (what >= 250) {
        return what & 1 ? HAL_RANGE_NOT_RISEN : HAL_RANGE_NOT_FALLEN;
    }
    echo_ticks = (uint16_t)((uint32_t)place_mm * TICKS_PER_MM_Q6 >> 6);
    if (what >= 240) {
        echo_ticks = 38000U;
    }
    return HAL_RANGE_DONE;
}

static void expect(void)
{
    brake_expect(since_cs);
}

/* So that poll finds the reading. */
static void show_reading(void)
{
    IT0 = 1;
    IE0 = 1;
}

#else

static void send(uint8_t byte)
{
    RANGE_NEXT = byte;
    range_came++;
}

static void send_word(uint16_t word)
{
    send((uint8_t)word);
    send((uint8_t)(word >> 8));
}

/* What the sensor says, but for the last byte, and the time since it said something. */
static uint8_t next_reading(void)
{
    uint16_t cm = place_mm / 10U, strength = 1000;
    uint8_t what = chance(), i;

    since_cs = RANGE_PERIOD_CS;
    if (what < 8) {
        since_cs = RANGE_PERIOD_CS + (chance() & 15);
    }
    if (what >= 252) {
        return HAL_RANGE_NOT_RISEN;
    }
    if (what >= 250) {
        strength = TFLUNA_STRENGTH_BLIND;
    } else if (what >= 240) {
        strength = TFLUNA_STRENGTH_MIN - 1U;
    }
    range_restart();
    send_word(0x5959);
    send_word(cm);
    send_word(strength);
    send_word(0);
    for (i = 0; i < 8; i++) {
        range_take();
    }
    send((uint8_t)(0x59U + 0x59U + (uint8_t)cm + (uint8_t)(cm >> 8) + (uint8_t)strength +
                   (uint8_t)(strength >> 8)));
    return HAL_RANGE_DONE;
}

/* conclude has expected the first period. */
static void expect(void)
{
    uint8_t cs;

    for (cs = since_cs; cs > RANGE_PERIOD_CS; cs--) {
        brake_expect(RANGE_PERIOD_CS);
    }
}

static void show_reading(void)
{
}

#endif

static void pass_time(void)
{
    uint8_t cs = since_cs;
    bool is_held = (n & 1023U) < 40U;

    do {
        brake_tick(is_held);
    } while (--cs != 0);
}

/* A reading as the main loop finds it. Only a STOP that begins counts. */
static void step_by_poll(void)
{
    stop_mc = brake.stop ? 1 : 0;
    is_measuring = true;
    show_reading();
    T2CON = 0;
    TH2 = 0;
    TL2 = 0;
    TR2 = 1;
    poll();
    TR2 = 0;
    if (stop_mc > 1U && stops != 255U) {
        stops++;
    }
    if (stop_mc > STOP_MC && slow_stops != 255U) {
        slow_stops++;
    }
}

uint16_t bench_step(uint16_t step)
{
    uint8_t reading;

    n = step;
    if (n == 0) {
        TH1 = 0x80; /* a second phase with time left, in which a new duty takes the longer way */
        brake_init(BRAKE_FAULT_NONE);
    }
    drive();
    reading = next_reading();
    expect();
    pass_time();
    if (reading == HAL_RANGE_DONE && (n & 1U)) {
        step_by_poll();
    } else {
#if !RANGE_IS_TRIGGERED
        if (reading == HAL_RANGE_DONE) {
            hal_range();
        }
#endif
        BENCH_START();
        control_step(reading);
        step_mc = BENCH_STOP();
        brake_finish();
        apply();
#if !RANGE_IS_TRIGGERED
        brake_expect(RANGE_PERIOD_CS);
#endif
    }
    faults_seen |= 1U << fault_code;
    states_seen |= 1U << brake.state;
    return step_mc;
}

static uint8_t count_ones(uint8_t bits)
{
    uint8_t count = 0;

    for (; bits != 0; bits &= (uint8_t)(bits - 1U)) {
        count++;
    }
    return count;
}

uint16_t bench_misses(void)
{
    return count_ones((uint8_t)((2U << BRAKE_FAULT_LOST) - 1U) & (uint8_t)~faults_seen) +
           count_ones(STATES_DUE & (uint8_t)~states_seen) + slow_stops +
           (STATES_DUE >> BRAKE_STOP & 1U & (stops == 0));
}

void main(void)
{
    bench_run();
}
