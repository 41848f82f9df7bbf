/* SPDX-License-Identifier: MIT */
/* controller: brake
 *
 * The published table: the self-test reads each byte of it and no other, and every look-up is a percent. */
#include "lut.c"
#include "selftest.c"

int main(void)
{
    uint8_t row, col;

    /*@ loop unroll 10000; */
    while (selftest_table() == SELFTEST_RUNNING) {
    }
    /*@ loop unroll 256; */
    for (row = 0; row < LUT_IN1_CELLS; row++) {
        /*@ loop unroll 256; */
        for (col = 0; col < LUT_IN2_CELLS; col++) {
            uint8_t level = lut_at(row, col);
            /*@ assert level <= LUT_LEVELS; */
        }
    }
    return 0;
}
