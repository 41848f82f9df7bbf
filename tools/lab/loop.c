/* SPDX-License-Identifier: MIT */
#include "loop.h"

#include "world.h"

#include "../../firmware/brake/range.h"

#include <math.h>
#include <string.h>

/* Of the chip at 12 MHz, read off traces: pins, and the write of brake.c after the duty. */
enum {
    PERIOD_NS = 10000000,  /* of the PWM, which is the tick */
    JOB_NS = 1850000,      /* from the tick to the trigger's rising edge: 1.45 to 2.4 ms */
    TRIGGER_NS = 16000,    /* width of the trigger */
    STOP_NS = 220000,      /* echo's end to the STOP pin */
    DUTY_NS = 760000,      /* echo's end to the new duty handed to the PWM */
    CLEAR_NS = 320000,     /* the same where there was no target: no estimator, no table */
    HAND_OVER_NS = 256000, /* least time to a period in which that takes it */
    TRIGGER_TICKS = 6,
    /* Of a sensor that sends frames. */
    BYTE_NS = 1041667,  /* at 9600 baud */
    PHASE_NS = 9890000, /* from the begin of a scenario, where the self-test ended, to the tick */
    LATE_NS = 15000000, /* after a reading the next one is missing */
    FRAME_WAIT_NS = 50000000 /* without a good frame is a fault: RANGE_WAIT_CS of tfluna.h */
};
#define NEVER INT64_MAX

struct loop {
    const struct image *image;
    const struct world_class *class;
    struct world *world;
    int64_t first_job_ns;
    /* PWM: two interrupts a period, the duty taken in the second, or after it while there is time
     */
    int64_t interrupt_ns;
    bool is_second;
    uint8_t duty_pct, next_pct;
    bool level, stop_level;
    /* sensor */
    int64_t rise_ns, stop_ns, duty_ns;
    bool is_measuring, echo_level, has_risen;
    bool is_unfinished; /* image->finish is due */
    bool held;
    uint8_t until_trigger;
    struct loop_reading reading; /* the last one */
    /* or frames */
    uint8_t bytes[WORLD_BYTES];
    size_t byte_count;
    int64_t arrival_ns; /* of the last of these bytes */
    int64_t taken_ns;   /* the last time that the controller took a reading, or missed one */
    int64_t late_ns;    /* the next one is missing */
    bool is_taken;      /* after this step, a reading's, the next one is foreseen */
};

static void set_pin(struct loop *loop, int64_t t_ns, enum board_pin pin, bool *now, bool level)
{
    if (*now != level) {
        *now = level;
        loop->class->pin_changed(loop->world, t_ns, pin, level);
    }
}

/* The timer's interrupt: firmware/mcu/pwm.c. */
static void interrupt(struct loop *loop)
{
    int64_t t_ns = loop->interrupt_ns;
    bool is_steady = loop->duty_pct == 0 || loop->duty_pct == 100;
    int64_t first_ns = is_steady ? PERIOD_NS / 2 : (int64_t)loop->duty_pct * (PERIOD_NS / 100);

    if (!loop->is_second) {
        set_pin(loop, t_ns, PIN_PWM, &loop->level, loop->duty_pct != 0);
        loop->interrupt_ns += first_ns;
    } else {
        set_pin(loop, t_ns, PIN_PWM, &loop->level, loop->duty_pct == 100);
        loop->interrupt_ns += PERIOD_NS - first_ns;
        loop->duty_pct = loop->next_pct;
    }
    loop->is_second = !loop->is_second;
}

static void apply(struct loop *loop, int64_t t_ns)
{
    set_pin(loop, t_ns, PIN_STOP, &loop->stop_level, loop->image->brake->stop);
    loop->next_pct = loop->image->brake->brake_pct;
    if (!loop->is_second && loop->interrupt_ns - t_ns >= HAND_OVER_NS) {
        loop->duty_pct = loop->next_pct;
    }
}

static void finish(struct loop *loop)
{
    if (loop->is_unfinished) {
        loop->is_unfinished = false;
        loop->image->finish();
        if (loop->is_taken) {
            loop->is_taken = false;
            loop->image->expect(1);
        }
    }
}

static void control_step(struct loop *loop, int64_t t_ns, uint8_t kind, uint16_t dist_mm)
{
    loop->is_measuring = false;
    loop->image->step(kind, dist_mm);
    loop->is_unfinished = true;
    loop->reading = (struct loop_reading){loop->reading.count + 1, kind, dist_mm};
    loop->stop_ns = t_ns + STOP_NS;
    loop->duty_ns = t_ns + (kind == RANGE_ECHO ? DUTY_NS : CLEAR_NS);
}

static void echo_changed(struct loop *loop, int64_t t_ns, bool level)
{
    uint16_t dist_mm;
    uint8_t kind;
    int64_t ticks;

    loop->echo_level = level;
    if (level) {
        loop->rise_ns = t_ns;
        loop->has_risen = true;
        return;
    }
    if (!loop->is_measuring || !loop->has_risen) {
        return;
    }
    ticks = (t_ns - loop->rise_ns) / 1000;
    dist_mm = loop->image->range_mm((uint16_t)(ticks > UINT16_MAX ? UINT16_MAX : ticks));
    kind = loop->image->range_kind(dist_mm);
    control_step(loop, t_ns, kind, kind == RANGE_ECHO ? dist_mm : 0);
}

/* A control step of a sensor that sends frames. */
static void take_reading(struct loop *loop, int64_t t_ns, uint8_t kind, uint16_t dist_mm)
{
    finish(loop);
    loop->taken_ns = t_ns;
    control_step(loop, t_ns, kind, dist_mm);
}

static void frame_arrives(struct loop *loop, int64_t t_ns)
{
    for (size_t i = 0; i < loop->byte_count; i++) {
        if (loop->image->push(loop->bytes[i])) {
            uint16_t dist_mm = loop->image->range_mm(loop->image->raw());
            uint8_t kind = loop->image->range_kind(dist_mm);

            take_reading(loop, t_ns, kind, kind == RANGE_ECHO ? dist_mm : 0);
            loop->is_taken = true;
            loop->late_ns = t_ns + LATE_NS;
        }
    }
    loop->arrival_ns = NEVER;
}

/* The world's own time has come: a frame may begin. */
static void pass_mark(struct loop *loop, int64_t t_ns)
{
    uint8_t bytes[WORLD_BYTES];
    size_t count =
        image_is_tfluna(loop->image) ? loop->class->take_bytes(loop->world, t_ns, bytes) : 0;

    if (count > 0) {
        memcpy(loop->bytes, bytes, count);
        loop->byte_count = count;
        loop->arrival_ns = t_ns + (int64_t)count * BYTE_NS;
    }
}

static void wait_for_frame(struct loop *loop, int64_t t_ns)
{
    if (t_ns - loop->taken_ns >= FRAME_WAIT_NS) {
        take_reading(loop, t_ns, RANGE_NOT_RISEN, 0);
    }
}

/* Every 10 ms. */
static void tick(struct loop *loop, int64_t t_ns)
{
    bool high = true;

    finish(loop);
    loop->image->tick(loop->held);
    if (loop->duty_ns == NEVER) {
        apply(loop, t_ns);
    }
    if (image_is_tfluna(loop->image)) {
        wait_for_frame(loop, t_ns);
        return;
    }
    if (--loop->until_trigger != 0) {
        return;
    }
    loop->until_trigger = TRIGGER_TICKS;
    if (loop->is_measuring) {
        control_step(loop, t_ns, loop->has_risen ? RANGE_NOT_FALLEN : RANGE_NOT_RISEN, 0);
        finish(loop);
    }
    loop->image->expect(TRIGGER_TICKS);
    loop->is_measuring = true;
    loop->has_risen = loop->echo_level;
    if (t_ns > 0) { /* the first one begins the scenario */
        high = false;
        set_pin(loop, t_ns, PIN_TRIGGER, &high, true);
    }
    set_pin(loop, t_ns + TRIGGER_NS, PIN_TRIGGER, &high, false);
}

/* Lets the inputs change until T_NS. */
static void take_inputs(struct loop *loop, int64_t t_ns)
{
    int64_t at_ns;
    enum board_pin pin;
    bool level;

    while (loop->class->next_input(loop->world, t_ns, &at_ns, &pin, &level)) {
        if (pin == PIN_ECHO) {
            echo_changed(loop, at_ns, level);
        } else {
            loop->held = !level;
        }
    }
}

/* Returns when the run was over. */
static int64_t run_until(struct loop *loop, int64_t end_ns, loop_watch *watch, void *user)
{
    int64_t job_ns = loop->first_job_ns;

    for (;;) {
        int64_t next_ns = job_ns < loop->interrupt_ns ? job_ns : loop->interrupt_ns, mark_ns;

        take_inputs(loop, next_ns);
        if (loop->stop_ns < next_ns) {
            next_ns = loop->stop_ns;
        }
        if (loop->duty_ns < next_ns) {
            next_ns = loop->duty_ns;
        }
        if (loop->arrival_ns < next_ns) {
            next_ns = loop->arrival_ns;
        }
        if (loop->late_ns < next_ns) {
            next_ns = loop->late_ns;
        }
        mark_ns = loop->class->mark_ns(loop->world);
        if (mark_ns < next_ns) {
            next_ns = mark_ns;
        }
        if (next_ns >= end_ns) {
            break;
        }
        loop->class->advance(loop->world, next_ns);
        if (loop->class->is_over(loop->world)) {
            end_ns = next_ns;
            break;
        }
        if (next_ns == mark_ns) {
            pass_mark(loop, next_ns);
        }
        if (next_ns == loop->stop_ns) {
            if (loop->image->brake->stop) {
                apply(loop, next_ns);
            }
            loop->stop_ns = NEVER;
        } else if (next_ns == loop->duty_ns) {
            apply(loop, next_ns);
            finish(loop);
            apply(loop, next_ns);
            loop->duty_ns = NEVER;
        } else if (next_ns == loop->arrival_ns) {
            frame_arrives(loop, next_ns);
        } else if (next_ns == loop->late_ns) {
            loop->image->expect(1);
            loop->late_ns += PERIOD_NS;
        } else if (next_ns == loop->interrupt_ns) {
            interrupt(loop);
        } else if (next_ns == job_ns) {
            tick(loop, next_ns);
            job_ns += PERIOD_NS;
            if (watch != NULL) {
                double values[WORLD_COLUMNS];

                loop->class->values(loop->world, values);
                watch(user, (double)next_ns * 1e-9, values, &loop->reading);
            }
        }
    }
    loop->class->advance(loop->world, end_ns);
    return end_ns;
}

void loop_run(const struct image *image, const struct scenario *scenario, uint64_t seed,
              int step_us, struct outcome *outcome)
{
    loop_run_watched(image, scenario, seed, step_us, outcome, NULL, NULL);
}

void loop_run_watched(const struct image *image, const struct scenario *scenario, uint64_t seed,
                      int step_us, struct outcome *outcome, loop_watch *watch, void *user)
{
    static const bool levels[BOARD_OUTPUTS] = {
        [PIN_TRIGGER] = true, [PIN_LAMP] = true, [PIN_BUZZER] = true};
    struct loop loop = {.image = image,
                        .class = &brake_world,
                        .first_job_ns = image_is_tfluna(image) ? PHASE_NS : 0,
                        .stop_ns = NEVER,
                        .duty_ns = NEVER,
                        .arrival_ns = NEVER,
                        .late_ns = image_is_tfluna(image) ? LATE_NS : NEVER,
                        .until_trigger = 1};

    loop.interrupt_ns = (loop.first_job_ns + PERIOD_NS - JOB_NS) % PERIOD_NS;
    memset(outcome, 0, sizeof *outcome);
    outcome->uart = "";
    image->init(BRAKE_FAULT_NONE);
    loop.world = loop.class->create(scenario, seed, (int64_t)step_us * 1000);
    loop.class->start(loop.world, levels);
    if (image_is_tfluna(image)) {
        image->restart();
    } else {
        loop.class->pin_changed(loop.world, 0, PIN_TRIGGER, true);
    }
    loop.class->measure(loop.world,
                        run_until(&loop, (int64_t)llround(scenario->duration_s * 1e9), watch, user),
                        outcome);
    loop.class->destroy(loop.world);
}
