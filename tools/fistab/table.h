/* SPDX-License-Identifier: MIT */
/* The surface of a system on a grid, and the integers that the chip will hold.
 *
 * Cells are in row-major order: the first input is the row, the last one moves fastest. Values are
 * in levels: 0 is the low end of the output's range, `levels` the high end. For an output of 0..100
 * and 100 levels that is the output's own unit. */
#ifndef FUZZY51_TABLE_H
#define FUZZY51_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "fis.h"
#include "infer.h"

enum { TABLE_INPUTS_MAX = 4, TABLE_CELLS_MAX = 1 << 24 };

struct table_options {
    struct infer_options infer;
    size_t dims[TABLE_INPUTS_MAX]; /* 0: the default, see table_default_dims */
    bool nodes;     /* sample from end to end, for interpolation; else at cell centres */
    int levels;     /* 1..255: -8..8 with 200 is a signed table, 0.08 a level, 100 for 0 */
    bool half_down; /* a value half way between two integers becomes the lower one */
};

struct table {
    const struct fis *fis;
    struct table_options options;
    size_t inputs;
    size_t dims[TABLE_INPUTS_MAX]; /* cells (or nodes) along each input */
    size_t cells;                  /* product of dims */
    size_t outputs;
    double **surface; /* [output][cell], in levels, unrounded */
    int **cell; /* [output][cell], 0..levels: the surface rounded half up, then repaired if asked */
};

/* Cells along each of INPUTS inputs where the user does not say: 10,000 in all at most. */
size_t table_default_dim(size_t inputs);

/* Where cell INDEX of INPUT is sampled, in the unit of the input. */
double table_axis_value(const struct table *table, size_t input, size_t index);

/* Coordinates of a cell: AT gets one index an input. */
void table_coordinates(const struct table *table, size_t cell, size_t *at);

/* Works out the surface and its rounded integers. Returns EXIT_FINE, or EXIT_INPUT after a message:
 * a point without a rule, a value outside the output's range, too large; then nothing is to be
 * freed. */
int table_make(const struct fis *fis, const struct table_options *options, struct table *table);
void table_free(struct table *table);

/* A value so near a half counts as the half: what a surface of exact halves loses in floating
 * point. */
#define TABLE_HALF_WITHIN 1e-9

/* The integer of a surface value: rounded half up. A value within 1e-9 of a half counts as the
 * half. */
int table_round(double levels);

/* The same, rounded as the table's options say. */
int table_rounded(const struct table *table, double levels);

#endif
