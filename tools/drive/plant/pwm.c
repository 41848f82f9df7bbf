/* SPDX-License-Identifier: MIT */
#include "pwm.h"

void pwm_init(struct pwm *pwm, int64_t t_ns, bool level)
{
    *pwm = (struct pwm){.level = level, .edge_ns = t_ns, .duty_pct = level ? 100 : 0};
}

static bool set_duty(struct pwm *pwm, double duty_pct)
{
    double before = pwm->duty_pct;

    pwm->duty_pct = duty_pct;
    return duty_pct < before || duty_pct > before;
}

bool pwm_edge(struct pwm *pwm, int64_t t_ns, bool level)
{
    int64_t period_ns = t_ns - pwm->rise_ns;
    bool changed = false;

    pwm->level = level;
    pwm->edge_ns = t_ns;
    if (!level) {
        pwm->fall_ns = t_ns;
        return false;
    }
    if (pwm->has_rise && period_ns > 0) {
        changed = set_duty(pwm, 100.0 * (double)(pwm->fall_ns - pwm->rise_ns) / (double)period_ns);
    }
    pwm->has_rise = true;
    pwm->rise_ns = t_ns;
    return changed;
}

int64_t pwm_steady_ns(const struct pwm *pwm)
{
    bool is_steady = !pwm->has_rise && pwm->duty_pct == (pwm->level ? 100.0 : 0.0);

    return is_steady ? INT64_MAX : pwm->edge_ns + PWM_STEADY_NS;
}

bool pwm_settle(struct pwm *pwm)
{
    pwm->has_rise = false;
    return set_duty(pwm, pwm->level ? 100 : 0);
}
