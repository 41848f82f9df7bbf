/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/sim/mcs52, that any code runs without a crash, and to the same end
 * wherever a run is cut. The other files test_mcs52_*.c test each part by hand-worked cases. */
#include "mcs52_chip.h"

/* Random code runs to the end. Run in two parts, it ends in the same state. */
static void test_that_any_code_runs(void)
{
    static uint8_t code[MCS52_CODE_BYTES];
    uint32_t seed = 1;

    for (int round = 0; round < 60; round++) {
        struct mcs52 *other;

        make_chip((enum mcs52_part)(round % 3));
        for (size_t i = 0; i < sizeof code; i++) {
            seed = seed * 1664525 + 1013904223;
            code[i] = (uint8_t)(seed >> 24);
        }
        mcs52_load(chip, 0, code, sizeof code);
        for (int port = 0; port < 4; port++) {
            for (int bit = 0; bit < 8; bit++) {
                mcs52_watch(chip, port, bit);
            }
        }
        for (uint64_t i = 0; i < 500; i++) {
            seed = seed * 1664525 + 1013904223;
            mcs52_set_pin(chip, i * 40 + (seed >> 28), (int)(seed >> 24 & 3), (int)(seed >> 20 & 7),
                          seed >> 16 & 1);
        }
        other = mcs52_create(MCS52_INTEL, NULL);
        mcs52_copy(other, chip);
        mcs52_run(chip, 20000);
        for (uint64_t cycle = 0; cycle < 20000; cycle += 77) {
            mcs52_run(other, cycle);
        }
        mcs52_run(other, 20000);
        TEST_ASSERT_TRUE_MESSAGE(mcs52_equal(chip, other), "cut runs differ");
        mcs52_destroy(other);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_any_code_runs);
    return UNITY_END();
}
