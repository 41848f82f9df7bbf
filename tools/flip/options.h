/* SPDX-License-Identifier: MIT */
/* flip's command line. */
#ifndef FUZZY51_FLIP_OPTIONS_H
#define FUZZY51_FLIP_OPTIONS_H

#include "mcs52.h"

#include <argp.h>
#include <stdbool.h>

enum { MAX_INSTANTS = 64 };

/* What --what may be. */
enum what { WHAT_BITS, WHAT_STUCK, WHAT_CODE, WHAT_PC, WHAT_SPACE, WHATS };

struct arguments {
    const char *hex, *board, *scenario, *output;
    double instants_s[MAX_INSTANTS]; /* after the first trigger */
    int instants;
    bool rams[MCS52_RAM_BYTES], sfrs[256]; /* which of them, by address */
    bool has_ram, has_sfr;                 /* some were named */
    int what;                              /* enum what */
    double least_pct;
    long fault_at;           /* address of the controller's fault_state; -1: not known */
    long unused_at, told_at; /* see --unused and --told */
    long count, jobs, seed;
    long window_ms, sample; /* of WHAT_SPACE */
};

extern const struct argp options_parser;

/* What holds without options. */
void options_defaults(struct arguments *arguments);

#endif
