/* SPDX-License-Identifier: MIT */
/* Writes a gnuplot script that draws a system: its surface and its sets on one sheet. */
#ifndef FUZZY51_PLOT_H
#define FUZZY51_PLOT_H

#include <stdbool.h>
#include <stdio.h>

#include "fis.h"
#include "infer.h"

struct plot_options {
    struct infer_options infer;
    bool png;       /* else SVG */
    bool sets_only; /* no surface */
    size_t axis[2]; /* the inputs that span the surface; the others stay in the middle of their
                       range. With one input axis[0] alone, and a curve. */
};

/* Writes the script, data and all, to OUT; gnuplot, given it, prints the picture on stdout. Places
 * where no rule fires stay empty. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int plot_write(FILE *out, const struct fis *fis, const struct plot_options *options);

#endif
