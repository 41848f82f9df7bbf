/* SPDX-License-Identifier: MIT */
/* Named checks on a system and on its table. Each finding is one line on stderr:
 *     brake.fis:31: error: (rule_gap) no rule for 'brake_pct' fires where distance_m is ...
 *
 * Errors, with which no table is made:
 *   rule_gap            no rule sets an output in some region; at a single point it is a warning
 *   rule_contradiction  two rules with the same conditions and different outcomes
 *   output_range        an output leaves its range on the grid (Sugeno)
 *   monotone            a step of the table against the law that the user names
 * Warnings:
 *   set_hole            a stretch of an input that none of its sets covers
 *   set_outside         a set that is 0 all over its variable's range
 *   set_unused          a set that no rule names
 *   input_unused        an input that no rule asks about
 *   rule_never          a rule that cannot fire
 *   rule_twice          a rule that stands there twice
 *   rule_empty          a rule without an output */
#ifndef FUZZY51_CHECK_H
#define FUZZY51_CHECK_H

#include <stddef.h>

#include "law.h"
#include "table.h"

struct findings {
    size_t errors;
    size_t warnings;
};

/* Runs all checks that need no table. */
void check_fis(const struct fis *fis, struct findings *findings);

/* monotone: the integers of every output against its law; a message names the worst pair,
 * neighbours or not, and counts the pairs of neighbours that break the law. */
void check_monotone(const struct table *table, const struct laws *laws, struct findings *findings);

#endif
