/* SPDX-License-Identifier: MIT */
/* Writes a system as a .fis file. */
#ifndef FUZZY51_WRITE_FIS_H
#define FUZZY51_WRITE_FIS_H

#include <stdio.h>

#include "fis.h"

/* Writes FIS to OUT in MATLAB's format, version 2.0. What the format lacks is refused with its
 * name; what only some programs read in it gives a warning. Returns EXIT_FINE, or EXIT_INPUT after
 * a message. */
int write_fis(FILE *out, const struct fis *fis);

#endif
