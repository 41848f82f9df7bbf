/* SPDX-License-Identifier: MIT */
/* Writes a table: as a C header for the firmware, as CSV for people. */
#ifndef FUZZY51_HEADER_H
#define FUZZY51_HEADER_H

#include <stdio.h>

#include "table.h"

/* What the header says of its arrays. For a plain table one array an output, [rows][columns]...; a
 * packer gives its own. Bytes are listed and check-summed array after array. */
struct header_array {
    const char *suffix; /* of the name: lut_SUFFIX */
    size_t dims[TABLE_INPUTS_MAX];
    size_t dimensions;
    const uint8_t *byte;
};

/* #define LUT_SUFFIX value */
struct header_macro {
    const char *suffix;
    size_t value;
};

struct header_options {
    const char *name; /* prefix of every symbol; macros in capitals. A C identifier. */
    bool packed;
    const char *repair; /* what the comment says of a repair; NULL: none */
    const struct header_array *array;
    size_t arrays;
    const struct header_macro *macro; /* what a packed table's look-up needs beside the bytes */
    size_t macros;
};

/* Writes the header. Same input, same bytes: no date, no path. */
void header_write(FILE *out, const struct table *table, const struct header_options *options);

/* Writes one line a cell: the inputs where it was sampled, then the integers. */
void csv_write(FILE *out, const struct table *table);

/* Writes one line a cell that differs from its rounded surface value: its coordinates, counted from
 * 0, the inputs where it was sampled, the output, the surface and the integer before and after. */
void csv_write_changes(FILE *out, const struct table *table);

/* The reciprocal that turns an offset of 0..SPAN_MILLI into a cell of CELLS without a division:
 * cell = (offset * mul) >> (16 + shift). True if there is one that is exact at every offset, by
 * trying them all; at offset SPAN_MILLI itself the result may be CELLS, and the user clamps. */
bool header_reciprocal(unsigned long span_milli, unsigned long cells, unsigned *mul,
                       unsigned *shift);

#endif
