/* SPDX-License-Identifier: MIT */
/* A two-input table in few bytes, each cell found in constant time: `fistab table
 * --encoding=packed`.
 *
 * The columns are cut into strips of equal width. Down a strip, neighbouring rows are often the
 * same; a run is a stretch of such rows. Its cells, a few numbers in a row, are a base and a shape,
 * and all shapes lie in one string of bytes, where they overlap as far as they fit:
 *
 *     cell = base[run] + shapes[start[run] + column]                        (all modulo 256)
 *
 * The run of a row is counted, not searched. Eight rows of a strip are a block; it stores the
 * number of its first row's run and one bit a row, set where a new run begins. The runs lie in
 * pages of 256, each strip in one page, so that only a strip stores the high byte of the run's
 * number. Rows before the first one that differs are not stored.
 *
 * The arrays, one behind the other in `bytes`:
 *     changes[strip * blocks + block]   bit i: row 8 * block + i begins a run (bit 0 is clear)
 *     runs[strip * blocks + block]      number of the first row's run in the strip's page
 *     pages[strip]
 *     starts[run]                       place of the shape less the strip's first column
 *     bases[run]
 *     shapes[]                          at most 256 */
#ifndef FUZZY51_PACK_H
#define FUZZY51_PACK_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { PACK_WHY_BYTES = 200 };

struct pack {
    size_t strip_cells; /* columns of a strip; the last one may have fewer */
    size_t first_row;   /* a multiple of 8; rows before it are like it */
    size_t strips, blocks;
    size_t runs_at, pages_at, starts_at, bases_at,
        shapes_at; /* offsets in bytes; changes are at 0 */
    size_t count;
    uint8_t *bytes;
};

/* Packs rows * cols cells (0..255, row-major) with the strip width that takes the fewest bytes, and
 * checks each cell of the result. Returns 0; or -1 with nothing to free, when no width fits (then
 * `why` says what it would take, in a sentence without full stop) or memory is short. */
int pack_table(struct pack *pack, const int *cells, size_t rows, size_t cols,
               char why[PACK_WHY_BYTES]);

/* The cell, found as the firmware's look-up finds it. */
uint8_t pack_at(const struct pack *pack, size_t row, size_t col);

void pack_free(struct pack *pack);

#endif
