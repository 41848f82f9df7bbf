/* SPDX-License-Identifier: MIT */
#include "judge.h"

#include <math.h>

static const double same_pct = 2;         /* drive counts a smaller step of the duty as none, too */
static const double more_pct = 20;        /* of braking that one notices */
static const double less_gap_m = 0.3;     /* as the project's goal says */
static const double not_further_m = 0.3;  /* the gap is "the same" up to so much more */
static const double near_m = 4.5;         /* well within the reach of the law, 5 m */
static const double false_full_m = 1.3;   /* full brake is due for what is nearer: LATCH_NEAR_MM */
static const double least_slack_pct = .5; /* PWM is exact to 0.1 % */

const char *judge_verdict_name(enum verdict verdict)
{
    static const char *const names[] = {"none",  "corrected", "safe-stop",
                                        "FAULT", "watchdog",  "unsafe"};

    return names[verdict];
}

const char *judge_harm_name(enum harm harm)
{
    static const char *const names[] = {"-", "impact", "gap", "brake-off", "weak", "false-full"};

    return names[harm];
}

/* Counts rows in a row that something holds for; true: LIMIT of them by now. */
static bool lasts(int *rows, bool holds, int limit)
{
    *rows = holds ? *rows + 1 : 0;
    return *rows >= limit;
}

static void harm(struct judge *judge, bool holds, enum harm what)
{
    if (holds && judge->harm == HARM_NONE) {
        judge->harm = what;
    }
}

void judge_take(struct judge *judge, const struct judge_row *row, const struct judge_row *fair,
                double least_pct)
{
    double more = row->demand_pct - fair->demand_pct;
    bool is_off = row->demand_pct <= 0 && fair->demand_pct > 0 &&
                  row->gap_m <= fair->gap_m + not_further_m && row->gap_m <= near_m;
    bool is_weak = least_pct > 0 && row->demand_pct < least_pct - least_slack_pct &&
                   fair->demand_pct >= least_pct - least_slack_pct;
    bool is_full =
        row->demand_pct >= 100 && fair->demand_pct < 100 && !(row->gap_m <= false_full_m);

    harm(judge, lasts(&judge->off_rows, is_off, JUDGE_MOMENT_ROWS + 1), HARM_BRAKE_OFF);
    harm(judge, lasts(&judge->weak_rows, is_weak, JUDGE_MOMENT_ROWS + 1), HARM_WEAK);
    harm(judge, lasts(&judge->full_rows, is_full, JUDGE_FULL_ROWS), HARM_FULL);
    if (lasts(&judge->more_rows, more >= more_pct, JUDGE_MOMENT_ROWS + 1)) {
        judge->more_pct = fmax(judge->more_pct, more);
    }
    judge->other_pct = fmax(judge->other_pct, fabs(more));
    if (!judge->has_gap || row->gap_m < judge->least_gap_m) {
        judge->least_gap_m = row->gap_m;
        judge->has_gap = true;
    }
}

uint64_t judge_key(const struct judge *judge)
{
    const double same_m = 1e-3;
    uint64_t key = isinf(judge->least_gap_m) ? 0 : (uint64_t)llround(judge->least_gap_m / same_m);

    key = key << 3 | judge->harm;
    key = key << 1 | (judge->more_pct > 0);
    key = key << 1 | (judge->other_pct > same_pct);
    key = key << 9 | (unsigned)judge->off_rows;
    key = key << 9 | (unsigned)judge->weak_rows;
    key = key << 9 | (unsigned)judge->full_rows;
    return key << 9 | (unsigned)judge->more_rows;
}

enum verdict judge_end(struct judge *judge, bool impact, bool fair_impact, double min_gap_m,
                       double fair_min_gap_m, int resets, bool fault)
{
    harm(judge, impact && !fair_impact, HARM_IMPACT);
    harm(judge, min_gap_m <= fair_min_gap_m - less_gap_m, HARM_GAP);
    if (judge->harm != HARM_NONE) {
        return VERDICT_UNSAFE;
    }
    if (resets > 0) {
        return VERDICT_WATCHDOG;
    }
    if (fault) {
        return VERDICT_FAULT;
    }
    if (judge->more_pct > 0) {
        return VERDICT_SAFE_STOP;
    }
    return judge->other_pct > same_pct ? VERDICT_CORRECTED : VERDICT_NONE;
}
