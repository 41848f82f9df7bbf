/* SPDX-License-Identifier: MIT */
/* fixed: the byte product on its whole domain, the 16-bit one at its corners and at many points. */
#include <stddef.h>
#include "unity.h"
#include "fixed.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_mul_u8_is_the_whole_product(void)
{
    uint8_t a = 0, b = 0;

    do {
        uint16_t sum = 0; /* of b a's, so that no product checks a product */

        do {
            if (mul_u8(a, b) != sum) {
                TEST_ASSERT_EQUAL_UINT16(sum, mul_u8(a, b));
            }
            sum += a;
        } while (++b != 0);
    } while (++a != 0);
}

static void check_mul_hi(uint16_t a, uint16_t b)
{
    uint16_t expected = (uint16_t)((uint32_t)a * b >> 16);

    if (mul_hi_u16(a, b) != expected) {
        TEST_ASSERT_EQUAL_UINT16(expected, mul_hi_u16(a, b));
    }
}

/* Bytes at which a carry can begin or end, in every place. */
static const uint8_t edge[] = {0, 1, 2, 3, 127, 128, 129, 253, 254, 255};
#define EDGES (sizeof edge / sizeof edge[0])

static uint16_t edge_word(uint8_t i)
{
    return (uint16_t)((uint16_t)edge[i / EDGES] << 8) | edge[i % EDGES];
}

static void test_mul_hi_u16_at_all_edges(void)
{
    uint8_t i, j;

    for (i = 0; i < EDGES * EDGES; i++) {
        for (j = 0; j < EDGES * EDGES; j++) {
            check_mul_hi(edge_word(i), edge_word(j));
        }
    }
}

#ifdef __SDCC_mcs51
#define STEP 13U /* 5,042 times 6 products: seconds in the simulator */
#else
#define STEP 1U
#endif

static void test_mul_hi_u16_of_every_value_with_the_firmwares_factors(void)
{
    /* speed of sound, cells of the brake's axes, and the largest */
    static const uint16_t factor[] = {44984U, 48811U, 3277U, 749U, 65535U, 257U};
    uint8_t i;

    for (i = 0; i < sizeof factor / sizeof factor[0]; i++) {
        uint16_t a = 0, before;

        do {
            check_mul_hi(a, factor[i]);
            before = a;
            a += STEP;
        } while (a > before);
        check_mul_hi(65535U, factor[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_mul_u8_is_the_whole_product);
    RUN_TEST(test_mul_hi_u16_at_all_edges);
    RUN_TEST(test_mul_hi_u16_of_every_value_with_the_firmwares_factors);
    return UNITY_END();
}
