/* SPDX-License-Identifier: MIT */
/* Frames: what comes in good comes out as it was sent, and nothing else comes out. */
#include "frame.h"
#include "crc16.h"
#include <stddef.h>
#include "unity.h"

#define PAYLOAD_BYTES 6
#define LINE_BYTES    FRAME_LINE_BYTES(PAYLOAD_BYTES)

/* A payload with items: 5 bytes, and 8 for each item. */
#define FIXED_BYTES 5
#define ITEM_BYTES  8
#define ITEMS_MAX   15
#define LONGEST     (FIXED_BYTES + ITEMS_MAX * ITEM_BYTES)

static const uint8_t payload[PAYLOAD_BYTES] = {0x00, 0xFF, 0x80, 0x7F, 0x12, 0xA5};
static uint8_t line[FRAME_LINE_BYTES(LONGEST)];
static uint8_t number; /* of the measurement */

/* The frame as a sensor head makes it, plainly: the sum bit by bit, the groups one by one. */
static void encode_payload(uint8_t kind, uint8_t count, const uint8_t *bytes, uint8_t size)
{
    static uint8_t body[LONGEST + 3];
    uint16_t crc = CRC16_START;
    uint8_t at, bit, in, out;

    line[0] = (uint8_t)(0x80 | (kind << 4) | count);
    for (at = 0; at <= size + 1; at++) {
        uint8_t byte = at == 0 ? line[0] : at <= size ? bytes[at - 1] : number;
        for (bit = 0; bit < 8; bit++) {
            uint8_t differs = (uint8_t)((crc >> 15) ^ (byte >> 7));
            crc = (uint16_t)(crc << 1);
            if (differs) {
                crc ^= 0x1021;
            }
            byte = (uint8_t)(byte << 1);
        }
        if (at != 0) {
            body[at - 1] = at <= size ? bytes[at - 1] : number;
        }
    }
    body[size + 1] = (uint8_t)(crc >> 8);
    body[size + 2] = (uint8_t)crc;

    out = 0;
    for (in = 0; in < size + 3; in++) {
        if (in % 7 == 0) {
            out++;
            line[out] = 0;
            for (bit = 0; bit < 7 && in + bit < size + 3; bit++) {
                if (body[in + bit] & 0x80) {
                    line[out] |= (uint8_t)(1 << bit);
                }
            }
        }
        out++;
        line[out] = body[in] & 0x7F;
    }
}

static void encode(uint8_t kind, uint8_t count)
{
    encode_payload(kind, count, payload, PAYLOAD_BYTES);
}

/* The worst of the results over the bytes from..to-1. */
static uint8_t push(uint8_t from, uint8_t to)
{
    uint8_t worst = FRAME_NONE;

    for (; from < to; from++) {
        uint8_t result = frame_push(line[from]);
        if (result > worst) {
            worst = result;
        }
    }
    return worst;
}

void setUp(void)
{
    frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
    number = 77;
    encode(FRAME_PARK, 3);
}

void tearDown(void)
{
}

static void test_check_sum_is_the_published_one(void)
{
    uint8_t high = 0xFF, low = 0xFF, digit;

    for (digit = '1'; digit <= '9'; digit++) {
        CRC16_ADD(high, low, digit);
    }

    TEST_ASSERT_EQUAL_UINT8(0x29, high);
    TEST_ASSERT_EQUAL_UINT8(0xB1, low);
}

static void test_a_good_frame_comes_out_as_it_was_sent(void)
{
    uint8_t at;

    TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, push(0, LINE_BYTES - 1));
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, frame_push(line[LINE_BYTES - 1]));

    for (at = 0; at < PAYLOAD_BYTES; at++) {
        TEST_ASSERT_EQUAL_UINT8(payload[at], frame_body[at]);
    }
    TEST_ASSERT_EQUAL_UINT16(0x00FF, frame_u16(0));
    TEST_ASSERT_EQUAL_UINT16(0x12A5, frame_u16(4));
    TEST_ASSERT_TRUE(frame_i24(0) == 0x00FF80L);
    TEST_ASSERT_TRUE(frame_i24(1) == -32641L); /* 0xFF807F */
    TEST_ASSERT_EQUAL_UINT16(0, frame_bad_count());
}

static void test_only_the_start_byte_has_bit_7(void)
{
    uint8_t at;

    TEST_ASSERT_TRUE(line[0] & 0x80);
    for (at = 1; at < LINE_BYTES; at++) {
        TEST_ASSERT_FALSE(line[at] & 0x80);
    }
}

static void test_each_flipped_bit_is_found(void)
{
    uint8_t at, bit;

    for (at = 0; at < LINE_BYTES; at++) {
        for (bit = 0; bit < 8; bit++) {
            frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
            line[at] ^= (uint8_t)(1 << bit);
            TEST_ASSERT_NOT_EQUAL(FRAME_GOOD, push(0, LINE_BYTES));
            line[at] ^= (uint8_t)(1 << bit);
            /* Whatever the flip did, the next whole frame is good. */
            (void)push(0, LINE_BYTES - 1);
            TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, frame_push(line[LINE_BYTES - 1]));
        }
    }
}

static void test_two_exchanged_bytes_are_found(void)
{
    uint8_t at;

    for (at = 1; at + 1 < LINE_BYTES; at++) {
        uint8_t first = line[at];
        if (first == line[at + 1]) {
            continue;
        }
        frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
        line[at] = line[at + 1];
        line[at + 1] = first;
        TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, push(0, LINE_BYTES));
        line[at + 1] = line[at];
        line[at] = first;
    }
}

static void test_receiver_that_wakes_inside_a_frame_takes_the_next(void)
{
    uint8_t from;

    for (from = 1; from < LINE_BYTES; from++) {
        frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
        TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, push(from, LINE_BYTES));
        (void)push(0, LINE_BYTES - 1);
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, frame_push(line[LINE_BYTES - 1]));
        TEST_ASSERT_EQUAL_UINT16(0, frame_bad_count());
    }
}

static void test_frame_cut_short_costs_only_itself(void)
{
    uint8_t length;

    for (length = 1; length < LINE_BYTES; length++) {
        frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
        TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, push(0, length));
        TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, frame_push(line[0]));
        TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, push(1, LINE_BYTES - 1));
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, frame_push(line[LINE_BYTES - 1]));
        TEST_ASSERT_EQUAL_UINT16(1, frame_bad_count());
    }
}

static void test_a_byte_too_much_is_found(void)
{
    uint8_t before;

    for (before = 1; before < LINE_BYTES; before++) {
        uint8_t result;
        frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
        result = push(0, before);
        TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, result);
        /* A copy of the byte that follows could be that byte itself. */
        result = frame_push((uint8_t)(line[before] ^ 0x55));
        TEST_ASSERT_NOT_EQUAL(FRAME_GOOD, result);
        TEST_ASSERT_NOT_EQUAL(FRAME_GOOD, push(before, LINE_BYTES));
    }
}

static void test_same_count_again_is_a_head_that_repeats_itself(void)
{
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, push(0, LINE_BYTES));
    (void)frame_ask();
    number = 78;
    encode(FRAME_PARK, 3);
    TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, push(0, LINE_BYTES));
    encode(FRAME_PARK, 4);
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, push(0, LINE_BYTES));
    TEST_ASSERT_EQUAL_UINT16(1, frame_bad_count());
}

static void test_count_of_bad_frames_stops_at_its_end(void)
{
    uint16_t i;

    for (i = 0; i < 65534U; i++) {
        frame_refuse();
    }
    TEST_ASSERT_EQUAL_UINT16(65534U, frame_bad_count());
    frame_refuse();
    frame_refuse();
    TEST_ASSERT_EQUAL_UINT16(65535U, frame_bad_count());
}

static void test_other_kinds_are_passed_over(void)
{
    encode(FRAME_GAP, 3);
    TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, push(0, LINE_BYTES));
    TEST_ASSERT_EQUAL_UINT16(0, frame_bad_count());
}

/* Asks, and answers with the next count and that number of a measurement. */
static uint8_t answer(uint8_t of_measurement)
{
    static uint8_t count;

    (void)frame_ask();
    count = (uint8_t)((count + 1) & 15);
    number = of_measurement;
    encode(FRAME_PARK, count);
    return push(0, LINE_BYTES);
}

static void test_frozen_measurement_with_fresh_counts_is_bad(void)
{
    uint8_t frame;

    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(255));
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(0)); /* it wraps */
    (void)frame_ask();
    for (frame = 2; frame < FRAME_ASKED_ANY; frame++) {
        TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, answer(0));
    }
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(0)); /* the head may have been started again */
    TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, answer(0));
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(1));
}

static void test_old_frames_by_turns_are_bad(void)
{
    uint8_t turn, frame;

    for (frame = 10; frame <= 14; frame++) {
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(frame));
    }
    for (turn = 0; turn < 12; turn++) {
        for (frame = 10; frame <= 14; frame++) {
            TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, answer(frame));
        }
    }
}

static void test_number_may_go_up_by_one_more_than_was_asked_for(void)
{
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(10));
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(12));
    TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, answer(15));
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(15)); /* the second one asked for since 12 */
    (void)frame_ask();
    (void)frame_ask();
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(16)); /* two triggers were not heard */
}

static void test_frame_that_nobody_asked_for_is_bad(void)
{
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(10));
    number = 11;
    encode(FRAME_PARK, 9);
    TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, push(0, LINE_BYTES));
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(12));
}

static void test_frame_that_is_late_is_dropped_when_the_next_is_asked_for(void)
{
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(10));
    TEST_ASSERT_FALSE(frame_ask());
    number = 11;
    encode(FRAME_PARK, 9);
    TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, push(0, LINE_BYTES - 1));
    TEST_ASSERT_TRUE(frame_ask());
    TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, frame_push(line[LINE_BYTES - 1]));
    TEST_ASSERT_EQUAL_UINT16(1, frame_bad_count());
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(12));
}

static void test_head_that_answers_every_second_trigger_only_is_too_slow(void)
{
    uint8_t frame;

    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(0));
    for (frame = 1; frame < FRAME_SLOW_MAX; frame++) {
        (void)frame_ask();
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(frame));
    }
    for (; frame < 200; frame++) {
        (void)frame_ask();
        TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, answer(frame));
    }
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(frame));
    for (frame = 0; frame < 20; frame++) { /* a bad answer is one, too */
        TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, answer(frame));
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer((uint8_t)(201 + frame)));
    }
    for (frame = 255; frame != 0; frame--) {
        (void)frame_ask(); /* the count of unanswered triggers stops */
    }
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(3));
}

static void test_refused_values_count_as_bad(void)
{
    (void)push(0, LINE_BYTES);
    frame_refuse();
    TEST_ASSERT_EQUAL_UINT16(1, frame_bad_count());
}

/* A count from before, and half a frame. */
static void test_init_forgets_what_was_before(void)
{
    encode(FRAME_PARK, 0);
    push(0, LINE_BYTES);
    push(0, LINE_BYTES - 1);
    frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
    TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, frame_push(line[LINE_BYTES - 1]));
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, push(0, LINE_BYTES));
    TEST_ASSERT_EQUAL_UINT16(0, frame_bad_count());
}

/* Answers to every second trigger until one is bad. */
static uint8_t slow_answers(uint8_t frame)
{
    uint8_t good = 0;

    (void)frame_ask();
    while (answer((uint8_t)(frame + good)) == FRAME_GOOD) {
        good++;
        (void)frame_ask();
    }
    return good;
}

static void test_init_forgets_that_the_head_was_slow(void)
{
    uint8_t frame;

    for (frame = 0; frame < FRAME_SLOW_MAX - 1U; frame++) {
        (void)frame_ask();
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(frame));
    }
    (void)frame_ask();
    frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(100)); /* in time */
    TEST_ASSERT_EQUAL_UINT8(FRAME_SLOW_MAX - 1U, slow_answers(101));

    frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
    TEST_ASSERT_EQUAL_UINT8(FRAME_SLOW_MAX - 1U, slow_answers(100));
}

/* A frame that is cut off is an answer, too: the head is not slow. */
static void test_late_frames_do_not_make_a_slow_head(void)
{
    uint8_t frame;

    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(0));
    for (frame = 1; frame < 3U * FRAME_SLOW_MAX; frame++) {
        (void)frame_ask();
        (void)push(0, LINE_BYTES - 1);
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(frame));
    }
}

/* 256 triggers without an answer are not none. */
static void test_a_long_silence_is_slow(void)
{
    uint16_t i;

    TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer(0));
    for (i = 1; i < FRAME_SLOW_MAX; i++) {
        (void)frame_ask();
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, answer((uint8_t)i));
    }
    for (i = 0; i < 255; i++) {
        (void)frame_ask();
    }
    TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, answer(FRAME_SLOW_MAX));
}

/* A frame with that many items, of which the byte before them says `told`; its bytes are 3, 10, 17
 * and so on. Returns its bytes on the line. */
static uint8_t encode_items(uint8_t items, uint8_t told, uint8_t count)
{
    static uint8_t bytes[LONGEST];
    uint8_t size = (uint8_t)(FIXED_BYTES + items * ITEM_BYTES), at;

    for (at = 0; at < size; at++) {
        bytes[at] = (uint8_t)(3 + 7 * at);
    }
    bytes[FIXED_BYTES - 1] = told;
    encode_payload(FRAME_RADAR, count, bytes, size);
    return FRAME_LINE_BYTES(size);
}

/* Takes the line's first `size` bytes, which hold the first `items` items. */
static void expect_items(uint8_t size, uint8_t items, uint8_t total)
{
    uint8_t at, byte, seen = 0;

    for (at = 0; at < size; at++) {
        uint8_t result = frame_push(line[at]);
        if (result != FRAME_ITEM) {
            TEST_ASSERT_EQUAL_UINT8(FRAME_NONE, result);
            continue;
        }
        TEST_ASSERT_EQUAL_UINT8(3, frame_body[0]);
        for (byte = 0; byte < ITEM_BYTES; byte++) {
            TEST_ASSERT_EQUAL_UINT8((uint8_t)(3 + 7 * (FIXED_BYTES + seen * ITEM_BYTES + byte)),
                                    frame_body[FIXED_BYTES + byte]);
        }
        seen++;
        TEST_ASSERT_EQUAL_UINT8(total - seen, frame_items_left());
    }
    TEST_ASSERT_EQUAL_UINT8(items, seen);
}

static void test_items_come_out_one_by_one_and_then_the_frame(void)
{
    uint8_t items, size;

    frame_init(FRAME_RADAR, FIXED_BYTES, ITEM_BYTES);
    for (items = 0; items <= ITEMS_MAX; items++) {
        (void)frame_ask();
        number++;
        size = encode_items(items, (uint8_t)(0xA0 | items), items);
        expect_items((uint8_t)(size - 1), items, items);
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, frame_push(line[size - 1]));
        TEST_ASSERT_EQUAL_UINT8(3, frame_body[0]);
        TEST_ASSERT_EQUAL_UINT8(0xA0 | items, frame_body[FIXED_BYTES - 1]);
    }
    TEST_ASSERT_EQUAL_UINT16(0, frame_bad_count());
}

static void test_frame_with_items_that_is_cut_short_costs_only_itself(void)
{
    uint8_t length, size;

    size = encode_items(2, 2, 3);
    for (length = 1; length < size; length++) {
        frame_init(FRAME_RADAR, FIXED_BYTES, ITEM_BYTES);
        (void)push(0, length);
        TEST_ASSERT_EQUAL_UINT8(FRAME_BAD, frame_push(line[0]));
        TEST_ASSERT_EQUAL_UINT8(FRAME_ITEM, push(1, (uint8_t)(size - 1)));
        TEST_ASSERT_EQUAL_UINT8(FRAME_GOOD, frame_push(line[size - 1]));
        TEST_ASSERT_EQUAL_UINT16(1, frame_bad_count());
    }
}

static void test_what_is_left_of_a_frame_goes_with_a_start(void)
{
    (void)encode_items(2, 2, 3);
    frame_init(FRAME_RADAR, FIXED_BYTES, ITEM_BYTES);
    (void)push(0, FIXED_BYTES + 4);
    TEST_ASSERT_NOT_EQUAL(0, frame_items_left());
    frame_init(FRAME_PARK, PAYLOAD_BYTES, 0);
    TEST_ASSERT_EQUAL_UINT8(0, frame_items_left());
}

static void test_wrong_number_of_items_is_found(void)
{
    uint8_t told, size;

    for (told = 0; told <= ITEMS_MAX; told++) {
        if (told != 2) {
            frame_init(FRAME_RADAR, FIXED_BYTES, ITEM_BYTES);
            size = encode_items(2, told, 3);
            TEST_ASSERT_NOT_EQUAL(FRAME_GOOD, push(0, size));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_items_come_out_one_by_one_and_then_the_frame);
    RUN_TEST(test_frame_with_items_that_is_cut_short_costs_only_itself);
    RUN_TEST(test_what_is_left_of_a_frame_goes_with_a_start);
    RUN_TEST(test_wrong_number_of_items_is_found);
    RUN_TEST(test_check_sum_is_the_published_one);
    RUN_TEST(test_a_good_frame_comes_out_as_it_was_sent);
    RUN_TEST(test_only_the_start_byte_has_bit_7);
    RUN_TEST(test_each_flipped_bit_is_found);
    RUN_TEST(test_two_exchanged_bytes_are_found);
    RUN_TEST(test_receiver_that_wakes_inside_a_frame_takes_the_next);
    RUN_TEST(test_frame_cut_short_costs_only_itself);
    RUN_TEST(test_a_byte_too_much_is_found);
    RUN_TEST(test_same_count_again_is_a_head_that_repeats_itself);
    RUN_TEST(test_frozen_measurement_with_fresh_counts_is_bad);
    RUN_TEST(test_old_frames_by_turns_are_bad);
    RUN_TEST(test_number_may_go_up_by_one_more_than_was_asked_for);
    RUN_TEST(test_frame_that_nobody_asked_for_is_bad);
    RUN_TEST(test_frame_that_is_late_is_dropped_when_the_next_is_asked_for);
    RUN_TEST(test_head_that_answers_every_second_trigger_only_is_too_slow);
    RUN_TEST(test_count_of_bad_frames_stops_at_its_end);
    RUN_TEST(test_other_kinds_are_passed_over);
    RUN_TEST(test_refused_values_count_as_bad);
    RUN_TEST(test_init_forgets_what_was_before);
    RUN_TEST(test_init_forgets_that_the_head_was_slow);
    RUN_TEST(test_late_frames_do_not_make_a_slow_head);
    RUN_TEST(test_a_long_silence_is_slow);
    return UNITY_END();
}
