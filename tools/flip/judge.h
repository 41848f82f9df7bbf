/* SPDX-License-Identifier: MIT */
/* What a fault in the chip came to: the drive with it beside the same drive without it, row by row.
 * A row is WORLD_ROW_NS long. */
#ifndef FUZZY51_FLIP_JUDGE_H
#define FUZZY51_FLIP_JUDGE_H

#include <stdbool.h>
#include <stdint.h>

/* From harmless to harmful; the last one that applies. */
enum verdict {
    VERDICT_NONE,      /* the brake does the same, to 2 points of demand */
    VERDICT_CORRECTED, /* it does for all but a moment */
    VERDICT_SAFE_STOP, /* it brakes at least 20 points more for more than JUDGE_MOMENT_ROWS */
    VERDICT_FAULT,     /* the controller went to FAULT */
    VERDICT_WATCHDOG,  /* the watchdog reset the chip */
    VERDICT_UNSAFE,
    VERDICTS
};

/* Why a drive is unsafe; the first that came. */
enum harm {
    HARM_NONE,
    HARM_IMPACT,    /* there is none without the fault */
    HARM_GAP,       /* at least 0.3 m less of it */
    HARM_BRAKE_OFF, /* for more than JUDGE_MOMENT_ROWS, within 4.5 m, while it is on without the
                       fault and the target is no further away than then */
    HARM_WEAK,      /* less than the drive's least demand, for more than JUDGE_MOMENT_ROWS */
    HARM_FULL,      /* full brake for JUDGE_FULL_ROWS, with nothing nearer than 1.3 m */
    HARMS
};

enum {
    JUDGE_MOMENT_ROWS = 12, /* 120 ms, two periods of the sensor */
    JUDGE_FULL_ROWS = 100   /* a second */
};

struct judge_row {
    double gap_m, demand_pct;
};

struct judge {
    enum harm harm;
    double more_pct;  /* the most that it brakes more than without the fault, for a while */
    double other_pct; /* the most that the demand differs at all */
    bool has_gap;
    double least_gap_m; /* so far, of a row */
    int off_rows, weak_rows, full_rows, more_rows;
};

const char *judge_verdict_name(enum verdict verdict);
const char *judge_harm_name(enum harm harm);

/* One more row of the drive with the fault and of the one without it. LEAST_PCT: where the drive
 * without the fault demands at least that much, the one with it must, too; 0: it need not. */
void judge_take(struct judge *judge, const struct judge_row *row, const struct judge_row *fair,
                double least_pct);

/* Two judges with equal keys will come to the same, if the rest of their drives is the same. */
uint64_t judge_key(const struct judge *judge);

/* The drives are over. IMPACT, FAIR_IMPACT: they ended so; the least gaps of both; RESETS by the
 * watchdog; FAULT: the controller was there because of the fault in the chip. */
enum verdict judge_end(struct judge *judge, bool impact, bool fair_impact, double min_gap_m,
                       double fair_min_gap_m, int resets, bool fault);

#endif
