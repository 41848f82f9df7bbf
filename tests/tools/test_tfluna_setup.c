/* SPDX-License-Identifier: MIT */
/* build/tfluna against a pseudo terminal that plays the sensor, as its manual says it behaves. */
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "unity.h"

enum { VERSION = 0x01, RATE = 0x03, FORMAT = 0x05, BAUD = 0x06, ENABLE = 0x07, SAVE = 0x11 };

static struct luna {
    int master;
    long baud;
    unsigned long rate_hz, format;
    bool is_sending;
    bool is_deaf, is_stubborn, cannot_save, answers_at_new_baud, goes_after_reading;
    const char *readings; /* what it sends, by turns: bytes in hex, sums included */
    const char *at;
    int settings; /* commands that change something */
    struct {
        long baud;
        unsigned long rate_hz, format;
        bool is_sending;
    } saved;
} luna;

/* 4.87 m, strength 412, 25 C */
#define READING "5959E7019C01C80807"

static char output[8192], slave[256];
static int status;

static long host_baud(void)
{
    struct termios line;

    TEST_ASSERT_EQUAL(0, tcgetattr(luna.master, &line));
    switch (cfgetospeed(&line)) {
    case B9600:
        return 9600;
    case B19200:
        return 19200;
    case B115200:
        return 115200;
    default:
        return 0;
    }
}

/* What the host gets that listens at another rate is something else. */
static void send_at(long baud, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint8_t byte = host_baud() == baud ? bytes[i] : (uint8_t)(bytes[i] & 0x0F);

        if (write(luna.master, &byte, 1) != 1) {
            return; /* the program reads no more */
        }
    }
}

static void reply(long baud, uint8_t id, unsigned long value, unsigned count)
{
    uint8_t bytes[16] = {0x5A, (uint8_t)(count + 4), id}, sum = 0;

    for (unsigned i = 0; i < count; i++) {
        bytes[3 + i] = (uint8_t)(value >> 8 * i);
    }
    for (unsigned i = 0; i < count + 3; i++) {
        sum = (uint8_t)(sum + bytes[i]);
    }
    bytes[count + 3] = sum;
    send_at(baud, bytes, count + 4);
}

static void obey(const uint8_t *bytes)
{
    unsigned count = bytes[1] - 4U;
    unsigned long value = 0;
    long old_baud = luna.baud;

    for (unsigned i = 0; i < count; i++) {
        value |= (unsigned long)bytes[3 + i] << 8 * i;
    }
    luna.settings += bytes[2] != VERSION;
    switch (bytes[2]) {
    case VERSION:
        reply(luna.baud, VERSION, 0x030201, 3);
        break;
    case RATE:
        luna.rate_hz = luna.is_stubborn ? 250 : value;
        reply(luna.baud, RATE, luna.rate_hz, 2);
        break;
    case FORMAT:
        luna.format = value;
        reply(luna.baud, FORMAT, value, 1);
        break;
    case ENABLE:
        luna.is_sending = value != 0;
        reply(luna.baud, ENABLE, value, 1);
        break;
    case BAUD:
        luna.baud = (long)value;
        reply(luna.answers_at_new_baud ? luna.baud : old_baud, BAUD, value, 4);
        break;
    case SAVE:
        if (!luna.cannot_save) {
            luna.saved.baud = luna.baud;
            luna.saved.rate_hz = luna.rate_hz;
            luna.saved.format = luna.format;
            luna.saved.is_sending = luna.is_sending;
        }
        reply(luna.baud, SAVE, luna.cannot_save, 1);
        break;
    default:
        break;
    }
}

/* Takes the commands that came at its own rate. */
static void hear(void)
{
    static uint8_t bytes[64];
    static size_t count;
    ssize_t more = read(luna.master, bytes + count, sizeof bytes - count);

    if (more <= 0 || luna.is_deaf || host_baud() != luna.baud) {
        count = 0;
        return;
    }
    count += (size_t)more;
    while (count >= 4 && count >= bytes[1]) {
        uint8_t length = bytes[1];

        TEST_ASSERT_EQUAL_HEX8(0x5A, bytes[0]);
        TEST_ASSERT_TRUE(length >= 4 && length <= count);
        obey(bytes);
        count -= length;
        for (size_t i = 0; i < count; i++) {
            bytes[i] = bytes[length + i];
        }
    }
}

/* The next of its readings. */
static void speak(void)
{
    uint8_t bytes[64];
    size_t count = 0;
    unsigned byte;

    if (*luna.at == '\0') {
        luna.at = luna.readings;
    }
    while (sscanf(luna.at, "%2x", &byte) == 1) {
        bytes[count++] = (uint8_t)byte;
        luna.at += 2;
    }
    luna.at += *luna.at == ' ';
    send_at(luna.baud, bytes, count);
}

/* Runs build/tfluna with these arguments, the port behind them, and plays the sensor meanwhile. */
static void run(const char *arguments)
{
    char command[512];
    FILE *log = tmpfile();
    pid_t child;

    snprintf(command, sizeof command, "exec build/tfluna %s %s", arguments, slave);
    luna.at = luna.readings;
    child = fork();
    if (child == 0) {
        dup2(fileno(log), 1);
        dup2(fileno(log), 2);
        close(luna.master);
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
        _exit(127);
    }
    while (waitpid(child, &status, WNOHANG) == 0) {
        struct pollfd ready = {.fd = luna.master, .events = POLLIN};

        if (luna.master < 0) {
            usleep(1000);
        } else if (poll(&ready, 1, 2) > 0 && (ready.revents & POLLIN) != 0) {
            hear();
        } else if (luna.is_sending) {
            speak();
            if (luna.goes_after_reading && host_baud() == luna.baud) {
                close(luna.master);
                luna.master = -1;
            }
        }
    }
    status = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    rewind(log);
    output[fread(output, 1, sizeof output - 1, log)] = '\0';
    fclose(log);
}

void setUp(void)
{
    struct termios line;
    int keep;

    memset(&luna, 0, sizeof luna);
    luna.master = posix_openpt(O_RDWR | O_NOCTTY);
    TEST_ASSERT_TRUE(luna.master >= 0);
    TEST_ASSERT_EQUAL(0, grantpt(luna.master));
    TEST_ASSERT_EQUAL(0, unlockpt(luna.master));
    snprintf(slave, sizeof slave, "%s", ptsname(luna.master));
    /* It stays open, so that the master does not hang up before the program opens it. */
    keep = open(slave, O_RDWR | O_NOCTTY);
    TEST_ASSERT_EQUAL(0, tcgetattr(keep, &line));
    cfmakeraw(&line);
    TEST_ASSERT_EQUAL(0, tcsetattr(keep, TCSANOW, &line));
    TEST_ASSERT_EQUAL(0, fcntl(luna.master, F_SETFL, O_NONBLOCK));
    luna.baud = 115200;
    luna.rate_hz = 250;
    luna.format = 6;
    luna.is_sending = true;
    luna.readings = READING;
}

void tearDown(void)
{
    if (luna.master >= 0) {
        close(luna.master);
    }
}

static void expect_set_up(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(0, status, output);
    TEST_ASSERT_EQUAL_INT(9600, luna.saved.baud);
    TEST_ASSERT_EQUAL_UINT(100, luna.saved.rate_hz);
    TEST_ASSERT_EQUAL_UINT(1, luna.saved.format);
    TEST_ASSERT_TRUE(luna.saved.is_sending);
}

static void expect_refusal(const char *why)
{
    char expected[512];

    snprintf(expected, sizeof expected, "%s: error: %s", slave, why);
    TEST_ASSERT_EQUAL_MESSAGE(1, status, output);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(output, expected), output);
    TEST_ASSERT_EQUAL_INT(0, luna.saved.baud);
}

static void test_a_new_sensor_is_set_up_and_its_readings_shown(void)
{
    run("--wait=20 --count=2");

    expect_set_up();
    TEST_ASSERT_EQUAL_STRING("the sensor is there, at 115200 baud\n"
                             "set and saved: 9600 baud, 100 readings a second\n"
                             "4.87 m, strength 412, 25.0 C\n4.87 m, strength 412, 25.0 C\n",
                             output);
}

static void test_one_that_answers_at_its_new_rate(void)
{
    luna.answers_at_new_baud = true;
    run("--wait=2 --count=0");

    expect_set_up();
}

static void test_one_that_has_its_rate_already(void)
{
    luna.baud = 9600;
    run("--wait=2 --count=0");

    expect_set_up();
    TEST_ASSERT_NOT_NULL(strstr(output, "at 9600 baud\n"));
}

static void test_one_that_waits_to_be_asked(void)
{
    luna.is_sending = false;
    run("--wait=20 --count=1");

    expect_set_up();
}

static void test_show_changes_nothing(void)
{
    run("--wait=20 --show --count=1");

    TEST_ASSERT_EQUAL(0, status);
    TEST_ASSERT_EQUAL(0, luna.settings);
    TEST_ASSERT_EQUAL_STRING("the sensor is there, at 115200 baud\n4.87 m, strength 412, 25.0 C\n",
                             output);
}

static void expect_shown(const char *readings, const char *line)
{
    char expected[256];

    luna.readings = readings;
    run("--wait=20 --show --count=1");
    snprintf(expected, sizeof expected, "the sensor is there, at 115200 baud\n%s\n", line);
    TEST_ASSERT_EQUAL_MESSAGE(0, status, output);
    TEST_ASSERT_EQUAL_STRING(expected, output);
}

static void test_each_kind_of_reading(void)
{
    expect_shown("59598700FFFFC80807", "blinded, 25.0 C");
    expect_shown("595900006300C808E5", "no target, strength 99, 25.0 C");
    expect_shown("59590000E803C8086D", "no target, strength 1000, 25.0 C");
    expect_shown("595959595959C808E6", "228.73 m, strength 22873, 25.0 C");
}

/* Between the readings stray bytes, a torn reading and one with a wrong sum. */
static void test_bad_bytes_are_thrown_away(void)
{
    expect_shown("595A" READING " 5959E7019C01 " READING " 595900006300C808E6 5A",
                 "4.87 m, strength 412, 25.0 C");
}

static void test_a_silent_line(void)
{
    luna.is_sending = false;
    luna.is_deaf = true;
    run("--wait=0.01");

    expect_refusal("no sensor answers at any rate; check its supply");
}

static void test_one_that_does_not_listen(void)
{
    luna.is_deaf = true;
    run("--wait=1");

    expect_refusal("the sensor does not answer when told 100 readings a second; check its wire");
}

static void test_one_that_keeps_another_rate(void)
{
    luna.is_stubborn = true;
    run("--wait=20");

    expect_refusal("the sensor refuses 100 readings a second: it answers 250;");
}

static void test_one_that_cannot_save(void)
{
    luna.cannot_save = true;
    run("--wait=20");

    expect_refusal("the sensor did not save its settings;");
}

static void test_one_that_is_pulled_off(void)
{
    luna.goes_after_reading = true;
    run("--wait=20 --show");

    TEST_ASSERT_EQUAL_MESSAGE(1, status, output);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(output, "is it still plugged in?"), output);
}

static void test_what_is_no_port(void)
{
    snprintf(slave, sizeof slave, "/dev/null");
    run("");
    expect_refusal("this is no serial port; give one such as /dev/ttyUSB0");

    snprintf(slave, sizeof slave, "/dev/no-such-port");
    run("");
    expect_refusal("No such file or directory; say which serial port the sensor is on");
}

static void test_bad_usage(void)
{
    slave[0] = '\0';
    run("");
    TEST_ASSERT_EQUAL(2, status);
    run("--count=x /dev/null");
    TEST_ASSERT_EQUAL(2, status);
    TEST_ASSERT_NOT_NULL(strstr(output, "--count=x"));
    run("a b");
    TEST_ASSERT_EQUAL(2, status);
    run("--help");
    TEST_ASSERT_EQUAL(0, status);
    TEST_ASSERT_NOT_NULL(strstr(output, "Usage: tfluna"));
}

int main(void)
{
    signal(SIGPIPE, SIG_IGN);
    alarm(300);
    UNITY_BEGIN();
    RUN_TEST(test_a_new_sensor_is_set_up_and_its_readings_shown);
    RUN_TEST(test_one_that_answers_at_its_new_rate);
    RUN_TEST(test_one_that_has_its_rate_already);
    RUN_TEST(test_one_that_waits_to_be_asked);
    RUN_TEST(test_show_changes_nothing);
    RUN_TEST(test_each_kind_of_reading);
    RUN_TEST(test_bad_bytes_are_thrown_away);
    RUN_TEST(test_a_silent_line);
    RUN_TEST(test_one_that_does_not_listen);
    RUN_TEST(test_one_that_keeps_another_rate);
    RUN_TEST(test_one_that_cannot_save);
    RUN_TEST(test_one_that_is_pulled_off);
    RUN_TEST(test_what_is_no_port);
    RUN_TEST(test_bad_usage);
    return UNITY_END();
}
