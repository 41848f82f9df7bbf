/* SPDX-License-Identifier: MIT */
/* Draws a run's CSV or JSON as a figure, by gnuplot. */
#ifndef FUZZY51_PLOT_H
#define FUZZY51_PLOT_H

/* Reads FILE (CSV, or JSON where it begins with a brace) and writes the figure OUT, an .svg or
 * .png: one panel for each unit of the columns, over the time. What the controller reported is
 * drawn as points, all else as lines. Returns EXIT_FINE, EXIT_INPUT after a message when the file
 * is no run or cannot be written, or EXIT_USAGE after a message when gnuplot is missing. */
int plot_run(const char *file, const char *out);

#endif
