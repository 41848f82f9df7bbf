/* Products of 16-bit numbers against those of a wider multiplication. */
#include "fixed.h"
#include <stddef.h>
#include "unity.h"

void setUp(void) {}

void tearDown(void) {}

/* Edges, and numbers between them that share no pattern. */
static const uint16_t factors[] = {0,     1,     2,     127,   128,   255,   256,   257,   511,
                                   512,   640,   767,   999,   4095,  10000, 14128, 26844, 32767,
                                   32768, 43980, 52392, 65279, 65280, 65534, 65535};

#define FACTORS (sizeof factors / sizeof factors[0])

static void test_mul_u8_keeps_every_bit(void)
{
    uint8_t a = 0, b;

    do {
        b = 0;
        do {
            TEST_ASSERT_EQUAL_UINT16((uint16_t)((uint16_t)a * (uint16_t)b), mul_u8(a, b));
            b = (uint8_t)(b + 5);
        } while (b != 0);
        a++;
    } while (a != 0);
}

static void test_mul_u16_is_the_whole_product(void)
{
    uint8_t i, j;

    for (i = 0; i < FACTORS; i++)
        for (j = 0; j < FACTORS; j++)
            TEST_ASSERT_TRUE(mul_u16(factors[i], factors[j]) == (uint32_t)factors[i] * factors[j]);
}

static void test_mul_hi_u16_is_its_upper_half(void)
{
    uint8_t i, j;

    for (i = 0; i < FACTORS; i++)
        for (j = 0; j < FACTORS; j++)
            TEST_ASSERT_EQUAL_UINT16((uint16_t)((uint32_t)factors[i] * factors[j] >> 16),
                                     mul_hi_u16(factors[i], factors[j]));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_mul_u8_keeps_every_bit);
    RUN_TEST(test_mul_u16_is_the_whole_product);
    RUN_TEST(test_mul_hi_u16_is_its_upper_half);
    return UNITY_END();
}
