/* SPDX-License-Identifier: MIT */
/* Under test: tools/common/diag.c, the promise that a file appears whole or not at all. */
#include "common/diag.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <unity.h>

static const char path[] = "build/tests/test_diag.out";

void setUp(void)
{
    unlink(path);
}

void tearDown(void)
{
    unlink(path);
}

static void test_that_a_file_is_there_after_commit_and_not_before(void)
{
    struct outfile out;

    TEST_ASSERT_EQUAL(EXIT_FINE, outfile_open(&out, path));
    fputs("whole\n", out.stream);
    TEST_ASSERT_NOT_EQUAL(0, access(path, F_OK));
    TEST_ASSERT_EQUAL(EXIT_FINE, outfile_commit(&out));
    TEST_ASSERT_EQUAL(0, access(path, R_OK));
}

static void test_that_an_abandoned_file_leaves_nothing(void)
{
    struct outfile out;
    char *temporary;

    TEST_ASSERT_EQUAL(EXIT_FINE, outfile_open(&out, path));
    temporary = strdup(out.temporary);
    outfile_abandon(&out);
    TEST_ASSERT_NOT_EQUAL(0, access(path, F_OK));
    TEST_ASSERT_NOT_EQUAL(0, access(temporary, F_OK));
    free(temporary);
}

static void test_that_a_device_or_pipe_stays_what_it_is(void)
{
    struct outfile out;
    struct stat after;
    int reader;

    TEST_ASSERT_EQUAL(0, mkfifo(path, 0600));
    reader = open(path, O_RDONLY | O_NONBLOCK);
    TEST_ASSERT_EQUAL(EXIT_FINE, outfile_open(&out, path));
    fputs("through\n", out.stream);
    TEST_ASSERT_EQUAL(EXIT_FINE, outfile_commit(&out));

    TEST_ASSERT_EQUAL(0, stat(path, &after));
    TEST_ASSERT_TRUE(S_ISFIFO(after.st_mode));
    close(reader);
}

static void test_that_a_missing_folder_is_bad_input(void)
{
    struct outfile out;

    TEST_ASSERT_EQUAL(EXIT_INPUT, outfile_open(&out, "build/no/such/folder/file"));
}

static void test_that_a_full_disk_is_reported_and_leaves_the_old_file(void)
{
    struct outfile out;

    if (access("/dev/full", W_OK) != 0) {
        TEST_FAIL_MESSAGE("no /dev/full on this machine");
    }
    TEST_ASSERT_EQUAL(EXIT_FINE, outfile_open(&out, path));
    /* cppcheck-suppress leakReturnValNotUsed ; freopen returns the stream that it was given */
    TEST_ASSERT_NOT_NULL(freopen("/dev/full", "w", out.stream));
    fputs("does not fit\n", out.stream);
    TEST_ASSERT_EQUAL(EXIT_INPUT, outfile_commit(&out));
    TEST_ASSERT_NOT_EQUAL(0, access(path, F_OK));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_a_file_is_there_after_commit_and_not_before);
    RUN_TEST(test_that_an_abandoned_file_leaves_nothing);
    RUN_TEST(test_that_a_device_or_pipe_stays_what_it_is);
    RUN_TEST(test_that_a_missing_folder_is_bad_input);
    RUN_TEST(test_that_a_full_disk_is_reported_and_leaves_the_old_file);
    return UNITY_END();
}
