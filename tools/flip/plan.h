/* SPDX-License-Identifier: MIT */
/* Which bits change, when, and what came of each. */
#ifndef FUZZY51_FLIP_PLAN_H
#define FUZZY51_FLIP_PLAN_H

#include "hexfile.h"
#include "judge.h"
#include "mcs52.h"
#include "options.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Where a fault is. CODE is no place of the chip's library: it changes the program. */
enum where { IN_RAM, IN_SFR, IN_CODE, IN_PC, WHERES };

enum { SAMPLE_TAG = 0x40000000 };

struct fault_case {
    enum where where;
    enum mcs52_fault_kind kind;
    uint16_t address;
    uint8_t bit;
    uint64_t cycle; /* since power came up */
    uint32_t tag;   /* whose it is; SAMPLE_TAG and above: a sample's */
    /* what came of it */
    bool done;
    size_t met; /* went on like this case, counted from 1, which says the rest; 0: by itself */
    enum verdict verdict;
    enum harm harm;
    double min_gap_m;
    int rows; /* until it was as without the fault, or over */
};

struct plan {
    struct fault_case *cases; /* in memory that all processes share */
    size_t count, capacity;
};

/* Room for CAPACITY cases. Memory is taken only for those that are added. */
void plan_init(struct plan *plan, size_t capacity);

/* Adds ONE. Returns its index. */
size_t plan_add(struct plan *plan, const struct fault_case *one);

/* Puts the cases into order of time. */
void plan_sort(struct plan *plan);

/* What ARGUMENTS ask for, in order of time; not of WHAT_SPACE. BOOT_NS: from power up to the first
 * trigger. */
void plan_make(struct plan *plan, const struct arguments *arguments, const struct hexfile *hex,
               int64_t boot_ns, long clk_hz);

const char *plan_where_name(enum where where);

#endif
