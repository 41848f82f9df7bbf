/* SPDX-License-Identifier: MIT */
#include "best_driver.h"

#include <math.h>
#include <stdbool.h>

static const double noticed_mps = 0.5, half_period_s = 0.03, stop_gap_m = 1;

/* When a gap that closes at CLOSING_MPS and A_MPS2 less each second becomes 0; INFINITY: never. */
static double contact_s(double gap_m, double closing_mps, double a_mps2)
{
    double root = closing_mps * closing_mps + 2 * a_mps2 * gap_m, t_s = INFINITY;

    if (fabs(a_mps2) <= 0) {
        t_s = closing_mps > 0 ? gap_m / closing_mps : INFINITY;
    } else if (root >= 0) {
        t_s = (sqrt(root) - closing_mps) / a_mps2;
    }
    return t_s >= 0 ? t_s : INFINITY;
}

double best_driver_contact_mps(const struct encounter *encounter, double act_s)
{
    double t_s = 0, gap_m = encounter->gap_m;
    double own_mps = encounter->own_mps, lead_mps = encounter->lead_mps;
    double decel_mps2 = encounter->lead_brakes_mps2;
    double until_s =
        decel_mps2 > 0 ? encounter->from_s + (encounter->lead_mps - encounter->to_mps) / decel_mps2
                       : 0;

    for (;;) {
        bool brakes = t_s >= act_s && own_mps > 0;
        bool lead_brakes = decel_mps2 > 0 && t_s >= encounter->from_s && t_s < until_s;
        double own_a = brakes ? -encounter->brake_mps2 : 0, lead_a = lead_brakes ? -decel_mps2 : 0;
        double closing_mps = own_mps - lead_mps, a = own_a - lead_a;
        double hit_s = t_s + contact_s(gap_m, closing_mps, a), next_s = INFINITY, piece_s;

        if (t_s < act_s) {
            next_s = fmin(next_s, act_s);
        }
        if (decel_mps2 > 0 && t_s < encounter->from_s) {
            next_s = fmin(next_s, encounter->from_s);
        } else if (decel_mps2 > 0 && t_s < until_s) {
            next_s = fmin(next_s, until_s);
        }
        if (brakes) {
            next_s = fmin(next_s, t_s + own_mps / encounter->brake_mps2);
        }
        if (isfinite(hit_s) && hit_s <= next_s) {
            return closing_mps + a * (hit_s - t_s);
        }
        if (isinf(next_s)) {
            return 0;
        }
        piece_s = next_s - t_s;
        gap_m -= closing_mps * piece_s + a * piece_s * piece_s / 2;
        own_mps += own_a * piece_s;
        if (own_mps < 1e-9) {
            own_mps = 0;
        }
        lead_mps =
            lead_brakes && next_s >= until_s ? encounter->to_mps : lead_mps + lead_a * piece_s;
        t_s = next_s;
    }
}

double best_driver_reason_s(const struct encounter *encounter)
{
    double b_mps2 = encounter->lead_brakes_mps2;
    double noticed_s = encounter->from_s + noticed_mps / b_mps2 + half_period_s;
    double near_s = encounter->from_s + sqrt(2 * fmax(encounter->gap_m - stop_gap_m, 0) / b_mps2);

    return encounter->gap_m <= stop_gap_m ? 0 : fmin(noticed_s, near_s);
}
