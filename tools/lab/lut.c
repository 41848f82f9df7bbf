/* SPDX-License-Identifier: MIT */
/* What a controller that runs on the host has beside its own files: the table, as lut.c, but its
 * cells may be written over; with a TF-Luna, the interrupt that takes its bytes. */
#define LUT_DATA
#include <stdint.h>
#include "cc51.h"
#include "lut_table.h"

extern const unsigned lab_rows, lab_cols;
extern uint8_t lab_cells[LUT_IN1_CELLS][LUT_IN2_CELLS];
void lab_load(void);
uint8_t lut_at(uint8_t row, uint8_t col);

const unsigned lab_rows = LUT_IN1_CELLS, lab_cols = LUT_IN2_CELLS;
uint8_t lab_cells[LUT_IN1_CELLS][LUT_IN2_CELLS];

void lab_load(void)
{
    for (unsigned row = 0; row < LUT_IN1_CELLS; row++) {
        for (unsigned col = 0; col < LUT_IN2_CELLS; col++) {
            lab_cells[row][col] = lut_out1[row][col];
        }
    }
}

uint8_t lut_at(uint8_t row, uint8_t col)
{
    return lab_cells[row][col];
}

#ifdef SENSOR_tfluna
#include "range.h"

bool lab_push(uint8_t byte);

/* The laboratory asks for a function. */
#undef range_mm
uint16_t range_mm(uint16_t raw_mm);

uint16_t range_mm(uint16_t raw_mm)
{
    return raw_mm;
}

/* A byte comes, and the main loop looks at it. True: it completes a good frame. */
bool lab_push(uint8_t byte)
{
    RANGE_NEXT = byte;
    range_came++;
    return range_take();
}
#endif
