/* SPDX-License-Identifier: MIT */
/* telemetry: every format, every number, one character a call. */
#include <stddef.h>
#include <string.h>
#include "unity.h"
#include "telemetry.h"

static char out[64];

void setUp(void)
{
}

void tearDown(void)
{
}

static const char *line(const char __code *format)
{
    uint8_t length = 0;
    char c;

    telemetry_say(format);
    TEST_ASSERT_TRUE(telemetry_is_busy());
    while ((c = telemetry_next()) != 0) {
        TEST_ASSERT_TRUE(length < sizeof out - 1);
        out[length] = c;
        length++;
    }
    out[length] = 0;
    TEST_ASSERT_FALSE(telemetry_is_busy());
    return out;
}

static const char *number(uint16_t n)
{
    telemetry_values[0].number = n;
    return line("%u");
}

/* The same, counted up in text: no division, no library. */
static char counted[6];

static void count_up(void)
{
    uint8_t i = (uint8_t)strlen(counted);

    while (i != 0) {
        i--;
        if (counted[i] != '9') {
            counted[i]++;
            return;
        }
        counted[i] = '0';
    }
    memmove(counted + 1, counted, sizeof counted - 1);
    counted[0] = '1';
}

static void test_numbers_print_as_they_count(void)
{
    uint16_t n = 0;

    strcpy(counted, "0");
    do {
        if (strcmp(counted, number(n)) != 0) {
            TEST_ASSERT_EQUAL_STRING(counted, out);
        }
        count_up();
        n++;
#ifdef __SDCC_mcs51
    } while (n < 12000); /* 0.4 ms each; the ends below cover the rest there */
#else
    } while (n != 0);
#endif
}

static void test_ends_of_the_number_range(void)
{
    TEST_ASSERT_EQUAL_STRING("0", number(0));
    TEST_ASSERT_EQUAL_STRING("10000", number(10000));
    TEST_ASSERT_EQUAL_STRING("60009", number(60009U));
    TEST_ASSERT_EQUAL_STRING("65535", number(65535U));
}

static void test_text_around_and_between_values(void)
{
    telemetry_values[0].number = 12;
    telemetry_values[1].text = "STOP";
    telemetry_values[2].text = "";
    telemetry_values[3].number = 3;
    TEST_ASSERT_EQUAL_STRING("a12,STOP,3\r\n", line("a%u,%s,%s%u\r\n"));
}

static void test_a_line_without_values(void)
{
    TEST_ASSERT_EQUAL_STRING("seq,ms\r\n", line("seq,ms\r\n"));
    TEST_ASSERT_EQUAL_STRING("", line(""));
}

static void test_an_optional_number_is_nothing_when_0(void)
{
    telemetry_values[0].number = 0;
    telemetry_values[1].number = 7;
    TEST_ASSERT_EQUAL_STRING(",7,", line("%o,%o,"));
}

static const char *milliseconds(uint16_t s, uint16_t ms)
{
    telemetry_values[0].number = s;
    telemetry_values[1].number = ms;
    return line("%o%m");
}

static void test_seconds_and_milliseconds_read_as_one_number(void)
{
    TEST_ASSERT_EQUAL_STRING("0", milliseconds(0, 0));
    TEST_ASSERT_EQUAL_STRING("60", milliseconds(0, 60));
    TEST_ASSERT_EQUAL_STRING("990", milliseconds(0, 990));
    TEST_ASSERT_EQUAL_STRING("1000", milliseconds(1, 0));
    TEST_ASSERT_EQUAL_STRING("1050", milliseconds(1, 50));
    TEST_ASSERT_EQUAL_STRING("65535999", milliseconds(65535U, 999));
}

static void test_the_longest_line_fits_the_time_between_two(void)
{
    telemetry_values[0].number = 65535U;
    telemetry_values[1].number = 9999;
    telemetry_values[2].number = 999;
    telemetry_values[3].number = 6000;
    telemetry_values[4].text = "-";
    telemetry_values[5].number = 36000U;
    telemetry_values[6].number = 99;
    telemetry_values[7].number = 99;
    telemetry_values[8].number = 100;
    telemetry_values[9].text = "RELEASED";
    telemetry_values[10].number = 11;
    line("%u,%o%m,%o,%s%u,%u,%u,%u,%s,%u\r\n");
    TEST_ASSERT_EQUAL_STRING("65535,9999999,6000,-36000,99,99,100,RELEASED,11\r\n", out);
    TEST_ASSERT_TRUE(strlen(out) <= 55); /* 60 ms at 960 characters a second are 57 */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_numbers_print_as_they_count);
    RUN_TEST(test_ends_of_the_number_range);
    RUN_TEST(test_text_around_and_between_values);
    RUN_TEST(test_a_line_without_values);
    RUN_TEST(test_an_optional_number_is_nothing_when_0);
    RUN_TEST(test_seconds_and_milliseconds_read_as_one_number);
    RUN_TEST(test_the_longest_line_fits_the_time_between_two);
    return UNITY_END();
}
