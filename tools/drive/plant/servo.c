/* SPDX-License-Identifier: MIT */
#include "servo.h"

#include <math.h>

static const double throttle_closed_us = 1000, throttle_full_us = 2000;

void servo_init(struct servo *servo, bool level)
{
    *servo = (struct servo){.high = level, .rise_ns = INT64_MIN / 2};
}

void servo_restart(struct servo *servo, bool level)
{
    double pulse_us = servo->pulse_us;

    servo_init(servo, level);
    servo->pulse_us = pulse_us;
}

double servo_throttle_pct(const struct servo *servo)
{
    double part = (servo->pulse_us - throttle_closed_us) / (throttle_full_us - throttle_closed_us);

    return fmin(fmax(part, 0), 1) * 100;
}

bool servo_edge(struct servo *servo, int64_t t_ns, bool level)
{
    int64_t width_ns = t_ns - servo->rise_ns;
    double before_us = servo->pulse_us;

    servo->high = level;
    if (level) {
        servo->rise_ns = t_ns;
        return false;
    }
    servo->fall_ns = t_ns;
    if (width_ns < SERVO_MIN_NS || width_ns > SERVO_MAX_NS) {
        return false; /* a servo takes no notice of it */
    }
    servo->pulse_us = (double)width_ns * 1e-3;
    return servo->pulse_us < before_us || servo->pulse_us > before_us;
}
