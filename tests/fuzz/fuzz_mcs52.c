/* SPDX-License-Identifier: MIT */
/* Fuzzing of tools/drive/sim/mcs52: any code runs without a crash, and wherever a run is cut, it
 * comes to the same state. The input's first byte names the part, the next ones pin changes, the
 * rest is code, repeated through the 64 KB. */
#include "mcs52.h"

#include <stdlib.h>

enum { CYCLES = 20000, PIN_CHANGES = 16, HEAD_BYTES = 1 + 2 * PIN_CHANGES, CUT = 77 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t code[MCS52_CODE_BYTES];
    struct mcs52 *whole, *cut;

    if (size <= HEAD_BYTES) {
        return 0;
    }
    for (size_t i = 0; i < sizeof code; i++) {
        code[i] = data[HEAD_BYTES + i % (size - HEAD_BYTES)];
    }
    whole = mcs52_create((enum mcs52_part)(data[0] % 3), NULL);
    cut = mcs52_create(MCS52_INTEL, NULL);
    mcs52_load(whole, 0, code, sizeof code);
    for (int i = 0; i < PIN_CHANGES; i++) {
        uint8_t when = data[1 + 2 * i], pin = data[2 + 2 * i];

        mcs52_set_pin(whole, 64 * (uint64_t)when, pin >> 3 & 3, pin & 7, pin & 0x80);
    }
    mcs52_copy(cut, whole);
    mcs52_run(whole, CYCLES);
    for (uint64_t cycle = 0; cycle < CYCLES; cycle += CUT) {
        mcs52_run(cut, cycle);
    }
    mcs52_run(cut, CYCLES);
    if (!mcs52_equal(whole, cut)) {
        abort();
    }
    mcs52_destroy(whole);
    mcs52_destroy(cut);
    return 0;
}
