/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/vcd.c, the reader of s51's value change dump. The sample is what uCsim
 * 0.6.4 writes. */
#include "vcd.h"

#include <string.h>
#include <unity.h>

static const char sample[] =
    "$date\n\tSat Nov 21 04:14:39 2026\n$end\n$version\n\tucsim\n$end\n"
    "$timescale 1ps $end\n$scope module ucsim_vcd_0 $end\n"
    "$var wire 1 ! port1_value.0 $end\n$var wire 1 \" port1_value.2 $end\n"
    "$var wire 32 $ sync $end\n$upscope $end\n$enddefinitions $end\n"
    "#0\n$dumpvars\n1!\n1\"\nb00000000000000000000000000000000 $\n$end\n"
    "#829000000\n1!\n0\"\n#899522569\nb00000000000000000000000000000101 $\n";

static struct vcd_reader reader;
static struct {
    int64_t time_ns;
    int var;
    uint32_t value;
} changes[16];
static int count;

static void note(void *user, int64_t time_ns, int var, uint32_t value)
{
    (void)user;
    changes[count].time_ns = time_ns;
    changes[count].var = var;
    changes[count++].value = value;
}

void setUp(void)
{
    vcd_init(&reader);
    count = 0;
}

void tearDown(void)
{
}

static void check_sample(void)
{
    TEST_ASSERT_EQUAL(3, count); /* initial values are no changes */
    TEST_ASSERT_EQUAL_INT64(829000, changes[0].time_ns);
    TEST_ASSERT_EQUAL(0, changes[0].var);
    TEST_ASSERT_EQUAL(1, changes[0].value);
    TEST_ASSERT_EQUAL(1, changes[1].var);
    TEST_ASSERT_EQUAL(0, changes[1].value);
    TEST_ASSERT_EQUAL_INT64(899523, changes[2].time_ns);
    TEST_ASSERT_EQUAL(2, changes[2].var);
    TEST_ASSERT_EQUAL(5, changes[2].value);
}

static void test_that_changes_come_with_time_and_value(void)
{
    TEST_ASSERT_TRUE(vcd_feed(&reader, sample, strlen(sample), note, NULL));
    check_sample();
    TEST_ASSERT_EQUAL(1, vcd_var_index(&reader, "port1_value.2"));
    TEST_ASSERT_EQUAL(-1, vcd_var_index(&reader, "port1_value.3"));
}

static void test_that_it_does_not_matter_where_the_bytes_are_cut(void)
{
    for (size_t cut = 1; cut < strlen(sample); cut++) {
        setUp();
        TEST_ASSERT_TRUE(vcd_feed(&reader, sample, cut, note, NULL));
        TEST_ASSERT_TRUE(vcd_feed(&reader, sample + cut, strlen(sample) - cut, note, NULL));
        check_sample();
    }
}

static void test_that_the_timescale_is_obeyed(void)
{
    static const char text[] =
        "$timescale 10ns $end $var wire 1 ! a $end $enddefinitions $end #7 1! ";

    TEST_ASSERT_TRUE(vcd_feed(&reader, text, strlen(text), note, NULL));
    TEST_ASSERT_EQUAL_INT64(70, changes[0].time_ns);
}

static void test_that_other_text_is_refused(void)
{
    static const char *const texts[] = {
        "Segmentation fault\n",
        "$timescale 1 parsec $end\n",
        "$var wire 1 ! a $end $enddefinitions $end #5 1? ",
        "$var wire 1 ! a $end $enddefinitions $end hello ",
        "$enddefinitions $end b0101 # ",
        "$var wire 1 ! a_name_that_is_far_longer_than_any_pin_ever_has $end\n",
    };

    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        setUp();
        TEST_ASSERT_FALSE_MESSAGE(vcd_feed(&reader, texts[i], strlen(texts[i]), note, NULL),
                                  texts[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_changes_come_with_time_and_value);
    RUN_TEST(test_that_it_does_not_matter_where_the_bytes_are_cut);
    RUN_TEST(test_that_the_timescale_is_obeyed);
    RUN_TEST(test_that_other_text_is_refused);
    return UNITY_END();
}
