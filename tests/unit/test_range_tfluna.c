/* SPDX-License-Identifier: MIT */
/* range, of the TF-Luna: bytes -> frames -> distance and kind. */
#define SENSOR_tfluna
#include <stddef.h>
#include "unity.h"
#include "range_tfluna.c"

static uint8_t frame[FRAME_BYTES];

/* As the interrupt does. */
static void send(uint8_t byte)
{
    if ((uint8_t)(range_came - range_taken) != RANGE_RING_BYTES) {
        RANGE_NEXT = byte;
        range_came++;
    }
}

static void seal(void)
{
    uint8_t i;

    frame[FRAME_BYTES - 1U] = 0;
    for (i = 0; i < FRAME_BYTES - 1U; i++) {
        frame[FRAME_BYTES - 1U] += frame[i];
    }
}

static void make(uint16_t cm, uint16_t light, uint16_t temperature)
{
    frame[0] = HEAD;
    frame[1] = HEAD;
    frame[2] = (uint8_t)cm;
    frame[3] = (uint8_t)(cm >> 8);
    frame[4] = (uint8_t)light;
    frame[5] = (uint8_t)(light >> 8);
    frame[6] = (uint8_t)temperature;
    frame[7] = (uint8_t)(temperature >> 8);
    seal();
}

/* Sends `count` bytes of the frame from `first` on and returns the number of frames that came. */
static uint8_t feed(uint8_t first, uint8_t count)
{
    uint8_t frames = 0;

    for (; count != 0; count--) {
        send(frame[first]);
        frames += range_take();
        first++;
    }
    return frames;
}

/* Asks until nothing is left to look at. */
static uint8_t ask(void)
{
    uint8_t frames = 0, asked;

    for (asked = 0; asked < RANGE_RING_BYTES; asked++) {
        frames += range_take();
    }
    return frames;
}

static uint8_t kind_at(uint16_t cm, uint16_t light)
{
    make(cm, light, 2272);
    TEST_ASSERT_EQUAL_UINT8(1, feed(0, FRAME_BYTES));
    TEST_ASSERT_EQUAL_UINT16(mm_of(cm), range_raw());
    return range_kind(range_raw());
}

void setUp(void)
{
    range_restart();
}

void tearDown(void)
{
}

static void test_a_centimetre_is_ten_millimetres(void)
{
    uint16_t cm;

    for (cm = 0; cm < 6400U; cm++) {
        if (mm_of(cm) != cm * 10U) {
            TEST_ASSERT_EQUAL_UINT16(cm * 10U, mm_of(cm));
        }
    }
    TEST_ASSERT_EQUAL_UINT16(65535U, mm_of(6400U));
    TEST_ASSERT_EQUAL_UINT16(65535U, mm_of(65535U));
}

/* Of each pair of rows one side of a limit. */
static void test_distance_and_strength_make_the_kind(void)
{
    static const struct {
        uint16_t cm, light;
        uint8_t kind;
    } __code ROWS[] = {
        {20, 100, RANGE_ECHO},         {19, 100, RANGE_DEAD_ZONE},
        {800, 100, RANGE_ECHO},        {801, 100, RANGE_NO_TARGET},
        {0, 99, RANGE_NO_TARGET},      {0, 100, RANGE_DEAD_ZONE},
        {300, 99, RANGE_NO_TARGET},    {300, 0, RANGE_NO_TARGET},
        {300, 65534U, RANGE_ECHO},     {300, 65535U, RANGE_NOT_FALLEN},
        {0, 65535U, RANGE_NOT_FALLEN}, {65535U, 65535U, RANGE_NOT_FALLEN},
        {65535U, 20, RANGE_NO_TARGET}, {65534U, 2000, RANGE_NO_TARGET},
    };
    uint8_t i;

    for (i = 0; i < sizeof ROWS / sizeof ROWS[0]; i++) {
        TEST_ASSERT_EQUAL_UINT8(ROWS[i].kind, kind_at(ROWS[i].cm, ROWS[i].light));
    }
}

static void test_nothing_comes_before_the_last_byte(void)
{
    make(300, 1000, 2272);
    TEST_ASSERT_EQUAL_UINT8(0, feed(0, FRAME_BYTES - 1U));
    TEST_ASSERT_EQUAL_UINT8(1, feed(FRAME_BYTES - 1U, 1));
    TEST_ASSERT_FALSE(range_take());
}

static void test_a_frame_with_a_wrong_bit_is_none(void)
{
    uint8_t byte, bit;

    for (byte = 0; byte < FRAME_BYTES; byte++) {
        for (bit = 1; bit != 0; bit = (uint8_t)(bit << 1)) {
            range_restart();
            make(300, 1000, 2272);
            frame[byte] ^= bit;
            TEST_ASSERT_EQUAL_UINT8(0, feed(0, FRAME_BYTES));
        }
    }
}

/* Behind a good frame and behind one with a wrong sum, and wherever in the ring it begins. */
static void test_a_sum_without_a_head_is_no_frame(void)
{
    uint8_t at, byte;

    for (at = 0; at < RANGE_RING_BYTES; at++) {
        for (byte = 0; byte < 2; byte++) {
            make(300, 1000, 2272);
            TEST_ASSERT_EQUAL_UINT8(1, feed(0, FRAME_BYTES));
            frame[byte]++;
            seal();
            TEST_ASSERT_EQUAL_UINT8(0, feed(0, FRAME_BYTES));
            range_restart();
            make(300, 1000, 2272);
            frame[FRAME_BYTES - 1U]++;
            TEST_ASSERT_EQUAL_UINT8(0, feed(0, FRAME_BYTES));
            range_restart();
            frame[byte]++;
            seal();
            TEST_ASSERT_EQUAL_UINT8(0, feed(0, FRAME_BYTES));
            range_restart();
        }
        send(0);
        range_restart();
    }
}

/* Beginning anywhere within a frame that repeats, each whole one is read, also where the payload
 * looks like the heads of frames. */
static void test_it_falls_into_step_wherever_it_begins(void)
{
    static const uint16_t __code PAYLOADS[][3] = {
        {300, 1000, 2272},     {300, 0x5959, 2272},      {0x5959, 1000, 2272},
        {300, 1000, 0x5959},   {0x5959, 0x5959, 0x5959}, {0x5900, 0x0159, 0x5959},
        {300, 0x59AA, 0xAA59},
    };
    uint8_t payload, first, frames;

    for (payload = 0; payload < sizeof PAYLOADS / sizeof PAYLOADS[0]; payload++) {
        for (first = 0; first < FRAME_BYTES; first++) {
            range_restart();
            make(PAYLOADS[payload][0], PAYLOADS[payload][1], PAYLOADS[payload][2]);
            feed(first, (uint8_t)(FRAME_BYTES - first));
            for (frames = 0; frames < 3; frames++) {
                TEST_ASSERT_EQUAL_UINT8(1, feed(0, FRAME_BYTES));
                TEST_ASSERT_EQUAL_UINT16(mm_of(PAYLOADS[payload][0]), range_raw());
            }
        }
    }
}

static void test_junk_before_a_frame_does_not_hide_it(void)
{
    uint8_t junk, count;

    for (junk = HEAD - 1U; junk <= HEAD + 1U; junk++) {
        for (count = 1; count < 40; count++) {
            uint8_t i;

            range_restart();
            for (i = 0; i < count; i++) {
                send(junk);
                TEST_ASSERT_EQUAL_UINT8(0, ask());
            }
            make(300, 1000, 2272);
            i = feed(0, FRAME_BYTES);
            i += ask();
            TEST_ASSERT_EQUAL_UINT8(1, i);
            TEST_ASSERT_EQUAL_UINT16(3000, range_raw());
        }
    }
}

static void test_a_lost_byte_costs_one_frame(void)
{
    uint8_t lost, frames;

    for (lost = 0; lost < FRAME_BYTES; lost++) {
        range_restart();
        make(300, 1000, 2272);
        frames = feed(0, lost);
        if (lost != FRAME_BYTES - 1U) {
            frames += feed((uint8_t)(lost + 1U), (uint8_t)(FRAME_BYTES - 1U - lost));
        }
        TEST_ASSERT_EQUAL_UINT8(0, frames);
        make(310, 1000, 2272);
        frames = feed(0, FRAME_BYTES);
        frames += ask();
        TEST_ASSERT_EQUAL_UINT8(1, frames);
        TEST_ASSERT_EQUAL_UINT16(3100, range_raw());
    }
}

/* Seven bytes have room beside a frame. */
static void test_a_late_reader_loses_what_has_no_room(void)
{
    uint8_t i, frames;

    make(300, 1000, 2272);
    for (i = 0; i < FRAME_BYTES; i++) {
        send(frame[i]);
    }
    make(310, 1000, 2272);
    for (i = 0; i < FRAME_BYTES; i++) {
        send(frame[i]);
    }
    TEST_ASSERT_EQUAL_UINT8(RANGE_RING_BYTES, range_came - range_taken);
    for (i = 0; i < FRAME_BYTES - 1U; i++) {
        TEST_ASSERT_FALSE(range_take());
    }
    TEST_ASSERT_TRUE(range_take());
    TEST_ASSERT_EQUAL_UINT16(3000, range_raw());
    TEST_ASSERT_EQUAL_UINT8(0, ask());
    make(320, 1000, 2272);
    frames = feed(0, FRAME_BYTES); /* in place of the last two of the second frame */
    frames += ask();
    TEST_ASSERT_EQUAL_UINT8(1, frames);
    TEST_ASSERT_EQUAL_UINT16(3200, range_raw());
}

static void test_a_restart_drops_what_waits(void)
{
    make(300, 1000, 2272);
    TEST_ASSERT_EQUAL_UINT8(0, feed(0, FRAME_BYTES - 1U));
    range_restart();
    TEST_ASSERT_EQUAL_UINT8(0, feed(FRAME_BYTES - 1U, 1));
    make(310, 1000, 2272);
    TEST_ASSERT_EQUAL_UINT8(1, feed(0, FRAME_BYTES));
    TEST_ASSERT_EQUAL_UINT16(3100, range_raw());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_centimetre_is_ten_millimetres);
    RUN_TEST(test_distance_and_strength_make_the_kind);
    RUN_TEST(test_nothing_comes_before_the_last_byte);
    RUN_TEST(test_a_frame_with_a_wrong_bit_is_none);
    RUN_TEST(test_a_sum_without_a_head_is_no_frame);
    RUN_TEST(test_it_falls_into_step_wherever_it_begins);
    RUN_TEST(test_junk_before_a_frame_does_not_hide_it);
    RUN_TEST(test_a_lost_byte_costs_one_frame);
    RUN_TEST(test_a_late_reader_loses_what_has_no_room);
    RUN_TEST(test_a_restart_drops_what_waits);
    return UNITY_END();
}
