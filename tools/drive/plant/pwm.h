/* SPDX-License-Identifier: MIT */
/* Reads the duty cycle off a pin, period by period, from one rising edge to the next. */
#ifndef FUZZY51_PWM_H
#define FUZZY51_PWM_H

#include <stdbool.h>
#include <stdint.h>

enum { PWM_PERIOD_NS = 10000000, PWM_STEADY_NS = PWM_PERIOD_NS * 3 / 2 };

struct pwm {
    bool level;
    bool has_rise; /* a period has begun */
    int64_t rise_ns, fall_ns, edge_ns;
    double duty_pct;
};

/* The pin has been at LEVEL for long. */
void pwm_init(struct pwm *pwm, int64_t t_ns, bool level);

/* The pin goes to LEVEL at T_NS. Returns true when the duty changed. */
bool pwm_edge(struct pwm *pwm, int64_t t_ns, bool level);

/* When the pin will count as steady if no edge comes; INT64_MAX: it does already. */
int64_t pwm_steady_ns(const struct pwm *pwm);

/* No edge for one and a half periods: the duty is 0 or 100 %. Returns true when it changed. */
bool pwm_settle(struct pwm *pwm);

#endif
