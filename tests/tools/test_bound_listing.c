/* SPDX-License-Identifier: MIT */
/* Under test: tools/bound/listing.c, on listings and maps of a few lines. */
#include "bound/listing.h"

#include <fcntl.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

static const char path[] = "build/tests/bound_listing.rst";
static struct hexfile hex;
static struct listing listing;

/* What is not set holds odd values. */
void setUp(void)
{
    static const uint8_t loop[] = {0xDF, 0xFE, 0x22, 0x12, 0x01, 0x00};

    mallopt(M_PERTURB, 0x5A);
    memset(&hex, 0, sizeof hex);
    memcpy(&hex.code[0x100], loop, sizeof loop);
    memset(&hex.used[0x100], true, sizeof loop);
    hex.code[0xFFFF] = 0x22;
    hex.used[0xFFFF] = true;
    memset(&listing, 0xA5, sizeof listing);
    listing_init(&listing);
}

void tearDown(void)
{
    listing_free(&listing);
    remove(path);
}

/* Reads a file with this TEXT, which must give this message: "EXPECTED" or nothing (NULL). */
static void reads(const char *text, const char *expected)
{
    FILE *stream = fopen(path, "w"), *kept = stderr;
    char *said;
    size_t said_bytes;
    int status;

    TEST_ASSERT_NOT_NULL(stream);
    fputs(text, stream);
    fclose(stream);
    stderr = open_memstream(&said, &said_bytes);
    TEST_ASSERT_NOT_NULL(stderr);
    status = listing_read(&listing, &hex, path);
    fclose(stderr);
    stderr = kept;
    TEST_ASSERT_EQUAL_STRING_MESSAGE(expected != NULL ? expected : "", said, text);
    TEST_ASSERT_EQUAL_INT_MESSAGE(expected != NULL, status, text);
    free(said);
}

#define CODE    "                                    180 \t.area CSEG    (CODE)\n"
#define DATA    "                                     61 \t.area DSEG    (DATA)\n"
#define DJNZ    "      000100 DF FE            [24]  238 \tdjnz\tr7,00101$\n"
#define RET     "      000102 22               [24]  240 \tret\n"
#define CALL    "      000103 12 01 00         [24]  241 \tlcall\t_work\n"
#define LINE_52 "                                    237 ;\tfirmware/x.c:52: } while (--n != 0);\n"

static void test_names_and_bounds_come_from_a_listing(void)
{
    reads(DATA "      000100                         62 _not_code::\n" CODE
               "      000100                        236 _work:\n"
               "                                    237 ;\tfirmware/x.c:52: } while (--n != 0); /* "
               "rounds: 12 */\n" DJNZ
               "                                    239 ;\tfirmware/x.c:54: }\n" RET CALL,
          NULL);
    TEST_ASSERT_EQUAL_INT(0x100, listing_find(&listing, "work"));
    TEST_ASSERT_EQUAL_INT(-1, listing_find(&listing, "not_code"));
    TEST_ASSERT_EQUAL_STRING("firmware/x.c:52", listing.places[0x100]);
    TEST_ASSERT_EQUAL_INT(12, listing.rounds[0x100]);
    TEST_ASSERT_EQUAL_STRING("firmware/x.c:54", listing.places[0x102]);
    TEST_ASSERT_EQUAL_INT(LISTING_NO_BOUND, listing.rounds[0x102]);
    TEST_ASSERT_EQUAL_STRING("firmware/x.c:54", listing.places[0x103]);
    TEST_ASSERT_NULL(listing.places[0x101]);
    TEST_ASSERT_NULL(listing.names[0x101]);
    TEST_ASSERT_NULL(listing.names[0x102]);
}

static void test_a_map_names_functions(void)
{
    static const struct {
        const char *line;
        unsigned address;
        const char *name; /* NULL: none */
    } cases[] = {
        {"C:   00000100  _work                              x\n", 0x100, "work"},
        {"C:   00000100  __divulong\n", 0x100, "_divulong"},
        {"C:   00000100  start\n", 0x100, "start"},
        {"C:   00000100  fs_lshift_a\n", 0x100, "fs_lshift_a"},
        {"C:   00000100  Stop\n", 0x100, "Stop"},
        {"C:   00000100  s\n", 0x100, "s"},
        {"C:   00000100  large\n", 0x100, "large"},
        {"C:   00000100  _s_one\n", 0x100, "s_one"},
        {"C:   00000100  s_CSEG\n", 0x100, NULL},
        {"C:   00000100  l_CSEG\n", 0x100, NULL},
        {"C:   00000100  .__.ABS.\n", 0x100, NULL},
        {"C:   00000100  C$x.c$1$0_0$1\n", 0x100, NULL},
        {"C:   00000100  _x$1\n", 0x100, NULL},
        {"C:   00000100  00101$\n", 0x100, NULL},
        {"D:   00000100  _n\n", 0x100, NULL},
        {"C:   0000FFFF  _last\n", 0xFFFF, "last"},
        {"C:   00000000  _first\n", 0, "first"},
        {"C:   00010000  _beyond\n", 0, NULL},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tearDown();
        setUp();
        reads(cases[i].line, NULL);
        if (cases[i].name == NULL) {
            TEST_ASSERT_NULL_MESSAGE(listing.names[cases[i].address], cases[i].line);
            continue;
        }
        TEST_ASSERT_NOT_NULL_MESSAGE(listing.names[cases[i].address], cases[i].line);
        TEST_ASSERT_EQUAL_STRING(cases[i].name, listing.names[cases[i].address]);
        TEST_ASSERT_EQUAL_INT(cases[i].address, listing_find(&listing, cases[i].name));
    }
}

static void test_a_label_is_a_name(void)
{
    static const struct {
        const char *line;
        const char *name; /* of 0x100; NULL: none */
    } cases[] = {
        {"      000100                        236 _work:\n", "work"},
        {"      000100                        236 __gptrget::\n", "_gptrget"},
        {"      000100                        236 fs_rshift_a:\n", "fs_rshift_a"},
        {"      000100                        236 00101$:\n", NULL},
        {"      000100                        236 x$1:\n", NULL},
        {"      000100                        236 s_x:\n", NULL},
        {"      000100                        236 _work\n", NULL},
        {"      000100                        236 \t.ds\t7\n", NULL},
        {"      000100 56                     392 \t.db #0x56\t; 86\t'V'\n", NULL},
        {"      000100 5B                     392 \t.db #0x5b\t; 91\t'['\n", NULL},
        {"      000100 0F                     392 \t.db #0x0f\t; 15\n", NULL},
        {"                           000100   153 ar7:\n", NULL},
        {"     000100                        236 _five:\n", NULL},
        {"      010000                        236 _beyond:\n", NULL},
        {"      00100                        236 _short:\n", NULL},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[200];

        tearDown();
        setUp();
        snprintf(text, sizeof text, CODE "%s", cases[i].line);
        reads(text, NULL);
        if (cases[i].name == NULL) {
            TEST_ASSERT_NULL_MESSAGE(listing.names[0x100], cases[i].line);
        } else {
            TEST_ASSERT_NOT_NULL_MESSAGE(listing.names[0x100], cases[i].line);
            TEST_ASSERT_EQUAL_STRING(cases[i].name, listing.names[0x100]);
        }
        TEST_ASSERT_NULL_MESSAGE(listing.places[0x100], cases[i].line);
    }
}

static void test_the_first_name_stays(void)
{
    reads("C:   00000100  _work\n", NULL);
    reads(CODE "      000100                        236 _other:\n" RET
               "      000103                        236 _other:\n",
          NULL);
    TEST_ASSERT_EQUAL_STRING("work", listing.names[0x100]);
    TEST_ASSERT_EQUAL_INT(0x103, listing_find(&listing, "other"));
}

static void test_which_comments_are_lines_of_source(void)
{
    static const struct {
        const char *comment;
        const char *place; /* NULL: that of the line before */
    } cases[] = {
        {"y.c:7: x = 1;", "y.c:7"},
        {"y.c:12345:", "y.c:12345"},
        {"y.c:7", NULL},
        {"y.c:7 x", NULL},
        {"y.c:: x", NULL},
        {"y.c:a7: x", NULL},
        {"y.c:7a: x", NULL},
        {"y.c", NULL},
        {":7: x", NULL},
        {"[--------] ic:1:  _entry($12) :", NULL},
        {"[r2 r3   ] ic:3: iTemp0:7: rounds: 9", NULL},
        {" function work", NULL},
        {"-----------------------------------------", NULL},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[500];

        tearDown();
        setUp();
        snprintf(text, sizeof text,
                 CODE LINE_52 "                                    237 ;\t%s\n" DJNZ,
                 cases[i].comment);
        reads(text, NULL);
        TEST_ASSERT_EQUAL_STRING_MESSAGE(cases[i].place ? cases[i].place : "firmware/x.c:52",
                                         listing.places[0x100], cases[i].comment);
        TEST_ASSERT_EQUAL_INT(LISTING_NO_BOUND, listing.rounds[0x100]);
    }
    tearDown();
    setUp();
    reads(CODE LINE_52 "                                    237 ; y.c:7: x\n"
                       "                                    237 ;------ y.c:8: x\n"
                       "                                    237 x\t;\ty.c:9: x\n" DJNZ,
          NULL);
    TEST_ASSERT_EQUAL_STRING("firmware/x.c:52", listing.places[0x100]);
}

static void test_how_many_rounds_a_line_may_say(void)
{
    static const struct {
        const char *said;
        long rounds; /* 0: an error */
    } cases[] = {
        {"rounds: 12 */", 12},  {"rounds: 1", 1}, {"rounds: 1000000, at most", 1000000},
        {"rounds: 1000001", 0}, {"rounds: 0", 0}, {"rounds: -1", 0},
        {"rounds: few", 0},     {"rounds: ", 0},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[300];

        tearDown();
        setUp();
        snprintf(text, sizeof text,
                 CODE "                                    237 ;\ty.c:7: while (n) /* %s\n" DJNZ,
                 cases[i].said);
        reads(text, cases[i].rounds != 0
                        ? NULL
                        : "y.c:7: error: `rounds:` is not followed by a whole number in "
                          "1..1000000; write how many rounds the loop has at most\n");
        TEST_ASSERT_EQUAL_INT(cases[i].rounds == 0 ? LISTING_NO_BOUND : cases[i].rounds,
                              listing.rounds[0x100]);
    }
}

static void test_the_first_line_of_an_instruction_stays(void)
{
    reads(CODE LINE_52 DJNZ, NULL);
    reads(CODE "                                    237 ;\ty.c:7: x /* rounds: 3 */\n" DJNZ, NULL);
    TEST_ASSERT_EQUAL_STRING("firmware/x.c:52", listing.places[0x100]);
    TEST_ASSERT_EQUAL_INT(LISTING_NO_BOUND, listing.rounds[0x100]);
}

static void test_each_listing_begins_anew(void)
{
    reads(CODE LINE_52 DJNZ, NULL);
    reads(RET CALL, NULL); /* of which area is not said */
    TEST_ASSERT_NULL(listing.places[0x102]);
    reads(CODE RET, NULL);
    TEST_ASSERT_NULL(listing.places[0x102]);
    reads(CODE LINE_52 DATA RET CODE CALL, NULL);
    TEST_ASSERT_NULL(listing.places[0x102]);
    TEST_ASSERT_EQUAL_STRING("firmware/x.c:52", listing.places[0x103]);
}

static void test_a_listing_of_another_image_is_refused(void)
{
    static const struct {
        const char *line;
        bool is_good;
    } cases[] = {
        {DJNZ, true},
        {RET, true},
        {CALL, true},
        {"      000100 DE FE            [24]  238 \tdjnz\n", false},
        {"      000100 DF FF            [24]  238 \tdjnz\n", false},
        {"      000103 12 01 01         [24]  238 \tlcall\n", false},
        {"      000102 22 13            [24]  238 \tnone\n", false},
        {"      000106 00               [12]  238 \tnop\n", false},
        {"      0000FF 00               [12]  238 \tnop\n", false},
        {"      00FFFF 22               [24]  238 \tret\n", true},
        {"      00FFFF 22 00            [24]  238 \tnone\n", false},
        {"      010000 22               [24]  238 \tret\n", true},
        {"      000100 56                     238 \t.db #0x56\t; 86\t'V'\n", true},
        {"      000100 5B                     238 \t.db #0x5b\t; 91\t'['\n", true},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[300], message[300];

        tearDown();
        setUp();
        snprintf(text, sizeof text, CODE "\n%s\n", cases[i].line);
        snprintf(message, sizeof message,
                 "%s:3: error: this is not in the image: the listing is of another one; link the "
                 "image again\n",
                 path);
        reads(text, cases[i].is_good ? NULL : message);
        snprintf(text, sizeof text, DATA "\n%s\n", cases[i].line);
        reads(text, NULL);
    }
}

/* What comes after an error is not read. */
static void test_an_error_ends_the_reading(void)
{
    reads(CODE "                                    237 ;\ty.c:7: x /* rounds: few */\n"
               "                                    237 ;\ty.c:8: x /* rounds: few */\n"
               "      000102                        236 _work:\n",
          "y.c:7: error: `rounds:` is not followed by a whole number in 1..1000000; write how many "
          "rounds the loop has at most\n");
    TEST_ASSERT_EQUAL_INT(-1, listing_find(&listing, "work"));
}

static void test_a_listing_that_is_not_there(void)
{
    FILE *kept = stderr;
    char *said;
    size_t said_bytes;

    stderr = open_memstream(&said, &said_bytes);
    TEST_ASSERT_NOT_NULL(stderr);
    TEST_ASSERT_EQUAL_INT(1, listing_read(&listing, &hex, "build/nosuch.rst"));
    fclose(stderr);
    stderr = kept;
    TEST_ASSERT_EQUAL_STRING("build/nosuch.rst: error: cannot read the listing: No such file or "
                             "directory; build the image again\n",
                             said);
    free(said);
}

/* Eight addresses without names have their texts at the same time. */
static void test_an_address_is_a_name(void)
{
    const char *names[8];

    for (uint16_t i = 0; i < 8; i++) {
        names[i] = listing_name(&listing, (uint16_t)(0xAB00 + i));
    }
    for (int i = 0; i < 8; i++) {
        char expected[20];

        snprintf(expected, sizeof expected, "0xAB0%d", i);
        TEST_ASSERT_EQUAL_STRING(expected, names[i]);
    }
    reads("C:   00000100  _work\n", NULL);
    TEST_ASSERT_EQUAL_STRING("work", listing_name(&listing, 0x100));
}

static void test_that_files_are_closed(void)
{
    int next = open("/dev/null", O_RDONLY), later;

    close(next);
    test_each_listing_begins_anew();
    later = open("/dev/null", O_RDONLY);
    close(later);
    TEST_ASSERT_EQUAL_INT(next, later);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_names_and_bounds_come_from_a_listing);
    RUN_TEST(test_a_map_names_functions);
    RUN_TEST(test_a_label_is_a_name);
    RUN_TEST(test_the_first_name_stays);
    RUN_TEST(test_which_comments_are_lines_of_source);
    RUN_TEST(test_how_many_rounds_a_line_may_say);
    RUN_TEST(test_the_first_line_of_an_instruction_stays);
    RUN_TEST(test_each_listing_begins_anew);
    RUN_TEST(test_a_listing_of_another_image_is_refused);
    RUN_TEST(test_an_error_ends_the_reading);
    RUN_TEST(test_a_listing_that_is_not_there);
    RUN_TEST(test_an_address_is_a_name);
    RUN_TEST(test_that_files_are_closed);
    return UNITY_END();
}
