/* Which cell of the brake's table belongs to a distance and a closing speed. Portable. */
#ifndef FUZZY51_CELL_H
#define FUZZY51_CELL_H

#include <stdint.h>
#include "cc51.h"
#include "closing.h"
#include "lut_table.h"

#if LUT_INPUTS != 2
#error the brake needs a table of two inputs: distance in m, closing speed in m/s
#endif

/* Row of a distance, column of a speed: the first and the last one reach on beyond the table's
 * ends. */
uint8_t cell_row(uint16_t dist_mm);
uint8_t cell_col(uint16_t closing_mmps, uint16_t opening_mmps);

#endif
