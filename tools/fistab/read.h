/* SPDX-License-Identifier: MIT */
/* Between the readers of the file formats. Each reader turns text into struct fis; fis_parse()
 * opens the text, picks the reader and validates what it read. */
#ifndef FUZZY51_READ_H
#define FUZZY51_READ_H

#include "fis.h"
#include "scan.h"

/* One reader a format. FIS is all zero bytes but for its file name. Returns EXIT_FINE, or
 * EXIT_INPUT after a message; the caller frees FIS either way. */
int read_fis(struct scan *scan, struct fis *fis);
int read_fll(struct scan *scan, struct fis *fis);
int read_fcl(struct scan *scan, struct fis *fis);

/* Checks that the parts make a system, and cuts off the zeros that old .fis files put behind
 * parameter lists. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int fis_validate(struct fis *fis);

/* Appends a set, a variable, a block or a rule, all zero bytes but for its line and what is 1 or
 * NaN unless said otherwise. NULL after a message: too many, or out of memory. */
struct set *add_set(struct scan *scan, struct variable *variable);
struct variable *add_variable(struct scan *scan, struct variable **list, size_t *count);
struct block *add_block(struct scan *scan, struct fis *fis);
struct rule *add_rule(struct scan *scan, struct fis *fis, size_t terms);

/* Sets of FLL and FCL: takes a function of fuzzylite's called CLASS, with COUNT PARAMETERS, the
 * height perhaps behind them. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int take_fuzzylite_set(struct scan *scan, struct set *set, const char *class,
                       const double *parameter, size_t count);

/* The rules of FLL and FCL, "if x is very near and y is not far then z is low with 0.5": reads one
 * from the scanner into block BLOCK. In FCL the words may be in capitals, a comma may join
 * outcomes, and the rule may go over several lines. Returns EXIT_FINE, or EXIT_INPUT after a
 * message. */
int read_rule(struct scan *scan, struct fis *fis, size_t block);

/* What every reader says of a feature that fistab does not have. */
int not_supported(const struct scan *scan, const char *feature, const char *advice);

#define SCAN_FAIL(scan, ...) diag_error((scan)->file, (scan)->line, __VA_ARGS__)

#endif
