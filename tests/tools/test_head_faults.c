/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/head.c: when a head answers, and what each kind of bad frame does
 * to the bytes of a good one. */
#include "head.h"

#include <math.h>
#include <string.h>
#include <unity.h>

enum { BYTES = 8, KIND = 4, FRAMES = 20000 };

static const int64_t ms = 1000000;
static const uint8_t payload[BYTES] = {1, 22, 43, 64, 85, 106, 127, 133};
static struct head_settings settings;
static struct head head;
static uint8_t line[HEAD_LINE_MAX], good[HEAD_LINE_MAX];
static size_t good_size;

void setUp(void)
{
    memset(&settings, 0, sizeof settings);
    memset(&head, 0xFF, sizeof head);
    for (int i = 0; i < HEAD_FAULTS; i++) {
        settings.faults[i].kind = -1;
    }
    good_size = head_encode(KIND, 0, payload, BYTES, 1, good);
}

void tearDown(void)
{
}

static void spoil(struct random *random, uint8_t *bytes)
{
    (void)random;
    bytes[2] ^= 0xFF;
}

static void begin(void)
{
    head_init(&head, &settings, 7, KIND, BYTES, spoil);
    head_start(&head);
}

/* Every answer from FROM_S on is bad like that. */
static void begin_with(enum frame_fault_kind kind, double from_s)
{
    settings.faults[0] = (struct frame_fault){kind, from_s, -1, 1, 1, 1};
    begin();
}

/* What a good frame would be now, in `good`, and what the head sends, in `line`. */
static size_t answer(int64_t t_ns)
{
    head_measured(&head, t_ns, payload);
    good_size = head_encode(KIND, head.count, payload, BYTES, head.number, good);
    return head_take(&head, t_ns, line);
}

/* --- values ------------------------------------------------------------------------------- */

static void test_that_numbers_go_out_with_their_highest_byte_first(void)
{
    uint8_t bytes[4] = {9, 9, 9, 9};

    head_put_24(bytes, 0x12345678);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x34, 0x56, 0x78, 9}), bytes, 4);
    head_put_16(bytes, -2);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0xFF, 0xFE, 0x78, 9}), bytes, 4);
}

static void test_that_a_value_is_rounded_and_limited(void)
{
    TEST_ASSERT_EQUAL(3, head_limited(2.5, -5, 9));
    TEST_ASSERT_EQUAL(-2, head_limited(-2.4, -5, 9));
    TEST_ASSERT_EQUAL(-5, head_limited(-INFINITY, -5, 9));
    TEST_ASSERT_EQUAL(9, head_limited(INFINITY, -5, 9));
}

static void test_that_noise_is_the_deviation_times_the_next_normal_number(void)
{
    struct random same;

    begin();
    same = head.noise;
    for (int i = 0; i < 5; i++) {
        double expected = 3 + 0.5 * random_normal(&same);

        TEST_ASSERT_EQUAL_DOUBLE(expected, head_noisy(&head, 3, 0.5));
    }
}

static void test_that_faults_and_noise_have_the_seed_with_a_word_of_their_own(void)
{
    struct random frames, noise;

    random_seed(&frames, 7 ^ 0x46524D45u); /* FRME */
    random_seed(&noise, 7 ^ 0x4E4F4953u);  /* NOIS */
    begin();
    TEST_ASSERT_EQUAL_MEMORY(&frames, &head.random, sizeof frames);
    TEST_ASSERT_EQUAL_MEMORY(&noise, &head.noise, sizeof noise);
}

/* --- answers in time ---------------------------------------------------------------------- */

static void test_that_a_pulse_of_10_us_is_heard(void)
{
    begin();
    TEST_ASSERT_FALSE(head_trigger(&head, 50 * ms, false)); /* it has not risen */
    TEST_ASSERT_FALSE(head_trigger(&head, 60 * ms, true));
    TEST_ASSERT_FALSE(head_trigger(&head, 60 * ms + 9999, false));
    TEST_ASSERT_FALSE(head_trigger(&head, 61 * ms, false));
    TEST_ASSERT_FALSE(head_trigger(&head, 70 * ms, true));
    TEST_ASSERT_TRUE(head_trigger(&head, 70 * ms + 10000, false));
    head_measured(&head, 70 * ms + 10000, payload);
    TEST_ASSERT_FALSE(head_trigger(&head, 80 * ms, true)); /* an answer is due */
    TEST_ASSERT_FALSE(head_trigger(&head, 81 * ms, false));
    head_take(&head, 82 * ms, line);
    TEST_ASSERT_FALSE(head_trigger(&head, 90 * ms, true));
    TEST_ASSERT_TRUE(head_trigger(&head, 91 * ms, false));
    head_trigger(&head, 92 * ms, true);
    TEST_ASSERT_FALSE(head_trigger(&head, 93 * ms, true)); /* still high */
    head_start(&head);                                     /* times begin anew */
    TEST_ASSERT_FALSE(head_trigger(&head, 1 * ms, false));
}

static void test_that_an_answer_comes_after_the_delay(void)
{
    settings.head.delay_ms = 2.5;
    begin();
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, head_due_ns(&head));
    TEST_ASSERT_EQUAL_INT64(0, head.answered_ns);
    head_measured(&head, 100 * ms, payload);
    TEST_ASSERT_EQUAL_INT64(102500000, head_due_ns(&head));
    TEST_ASSERT_EQUAL(0, head_take(&head, 102499999, line));
    TEST_ASSERT_EQUAL_INT64(102500000, head_due_ns(&head));
    TEST_ASSERT_GREATER_THAN(0, head_take(&head, 102500000, line));
    TEST_ASSERT_EQUAL_INT64(100 * ms, head.answered_ns);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, head_due_ns(&head));
    head_measured(&head, 200 * ms, payload);
    head_start(&head);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, head_due_ns(&head));
    TEST_ASSERT_EQUAL_INT64(0, head.answered_ns);
}

static void test_that_a_head_is_warm_after_so_many_answers(void)
{
    settings.head.warm_up = 2;
    head_init(&head, &settings, 7, KIND, BYTES, spoil);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, head_due_ns(&head));
    TEST_ASSERT_FALSE(head_trigger(&head, 1 * ms, false));
    for (int i = 0; i < 5; i++) {
        TEST_ASSERT_EQUAL(i >= 2, head_is_warm(&head));
        answer(i * ms);
    }
}

static void test_that_count_and_number_go_round(void)
{
    begin();
    for (int i = 0; i < 600; i++) {
        size_t size = head_encode(KIND, i % 16, payload, BYTES, (i + 1) % 256, good);

        head_measured(&head, i * ms, payload);
        TEST_ASSERT_EQUAL(size, head_take(&head, i * ms, line));
        TEST_ASSERT_EQUAL_MEMORY(good, line, size);
    }
}

static void test_that_each_seven_bytes_have_one_with_their_highest_bits(void)
{
    uint8_t bytes[HEAD_PAYLOAD_MAX] = {0};

    for (int count = 1; count <= HEAD_PAYLOAD_MAX; count++) {
        int body = count + 3; /* number and check sum */

        TEST_ASSERT_EQUAL(1 + body + (body + 6) / 7, head_encode(KIND, 0, bytes, count, 1, line));
    }
}

static void test_that_an_answer_is_so_many_frames_old(void)
{
    for (int age = 0; age <= HEAD_AGE_MAX; age++) {
        settings.head.age_frames = age;
        begin();
        for (int i = 0; i < 20; i++) {
            uint8_t measured[BYTES] = {(uint8_t)i};

            head_measured(&head, i * ms, measured);
            TEST_ASSERT_EQUAL(i > age ? i - age : 0, head.payload[0]);
            head_take(&head, i * ms, line);
        }
    }
}

static void test_that_the_controller_is_blind_25_ms_after_the_first_bad_answer_in_a_row(void)
{
    begin_with(FRAME_SILENCE, 0.1);
    settings.faults[0].for_s = 0.05;
    begin();
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, head_blind_ns(&head));
    answer(90 * ms);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, head_blind_ns(&head));
    answer(100 * ms);
    TEST_ASSERT_EQUAL_INT64(125 * ms, head_blind_ns(&head));
    answer(120 * ms);
    TEST_ASSERT_EQUAL_INT64(125 * ms, head_blind_ns(&head));
    answer(150 * ms);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, head_blind_ns(&head));
    begin_with(FRAME_UNASKED, 0);
    answer(10 * ms);
    TEST_ASSERT_EQUAL_INT64(INT64_MAX, head_blind_ns(&head));
}

/* --- which answers are bad ---------------------------------------------------------------- */

static void test_that_a_fault_has_its_time(void)
{
    for (int which = 0; which < HEAD_FAULTS; which++) {
        setUp();
        settings.faults[which] = (struct frame_fault){FRAME_SILENCE, 0.1, 0.05, 1, 1, 1};
        begin();
        TEST_ASSERT_EQUAL(good_size, answer(99500000));
        TEST_ASSERT_EQUAL(0, answer(100 * ms));
        TEST_ASSERT_EQUAL(0, answer(149500000));
        TEST_ASSERT_EQUAL(good_size, answer(150 * ms));
    }
}

static void test_that_no_fault_comes_before_the_start(void)
{
    settings.faults[0] = (struct frame_fault){FRAME_SILENCE, 0, -1, 1, 1, 1};
    settings.head.dropout = 1;
    head_init(&head, &settings, 7, KIND, BYTES, spoil);
    TEST_ASSERT_GREATER_THAN(0, answer(1 * ms));
    head_start(&head);
    TEST_ASSERT_EQUAL(0, answer(2 * ms));
}

static void test_that_a_share_of_the_answers_is_bad(void)
{
    int silent = 0;

    settings.faults[0] = (struct frame_fault){FRAME_SILENCE, 0, -1, 0.25, -1, 1};
    begin();
    for (int i = 0; i < 10000; i++) {
        silent += answer(i * ms) == 0;
    }
    TEST_ASSERT_INT_WITHIN(150, 2500, silent);
}

static void test_that_a_schedule_begins_with_its_first_answer(void)
{
    settings.faults[0] = (struct frame_fault){FRAME_SILENCE, 0, -1, 1, 1, 3};
    settings.faults[1] = (struct frame_fault){-1, 0, -1, 1, 1, 1}; /* no fault */
    begin();
    for (int i = 0; i < 5; i++) {
        TEST_ASSERT_EQUAL(i < 2 ? good_size : 0, answer(i * ms));
    }
}

static void test_that_good_answers_take_no_number_of_chance(void)
{
    struct random before;

    begin();
    before = head.random;
    answer(1 * ms);
    TEST_ASSERT_EQUAL_MEMORY(&before, &head.random, sizeof before);
}

static void test_that_a_bad_answer_does_not_drop_out(void)
{
    settings.head.dropout = 1;
    begin_with(FRAME_CORRUPT, 0);
    TEST_ASSERT_EQUAL(good_size, answer(1 * ms));
}

/* The second fault counts its answers while the first one strikes, but does not take them. */
static void test_that_the_first_fault_that_strikes_counts(void)
{
    begin_with(FRAME_REPEAT, 0.05);
    settings.faults[1] = (struct frame_fault){FRAME_SILENCE, 0, -1, 1, 2, 2};
    begin();
    TEST_ASSERT_EQUAL(good_size, answer(10 * ms));
    TEST_ASSERT_EQUAL(0, answer(20 * ms));
    TEST_ASSERT_EQUAL(good_size, answer(60 * ms));
    TEST_ASSERT_EQUAL(good_size, answer(70 * ms));
}

/* --- what a bad frame is ------------------------------------------------------------------ */

static void test_that_one_to_three_bits_turn_over(void)
{
    int counts[9] = {0}, places[HEAD_LINE_MAX * 8] = {0};

    begin_with(FRAME_CORRUPT, 0);
    for (int i = 0; i < FRAMES; i++) {
        int wrong = 0;

        TEST_ASSERT_EQUAL(good_size, answer(i * ms));
        for (size_t bit = 0; bit < good_size * 8; bit++) {
            int is_wrong = (line[bit / 8] ^ good[bit / 8]) >> bit % 8 & 1;

            wrong += is_wrong;
            places[bit] += is_wrong;
        }
        TEST_ASSERT_TRUE(wrong >= 1 && wrong <= 3);
        counts[wrong]++;
    }
    for (int i = 1; i <= 3; i++) { /* now and then two of them hit the same bit */
        TEST_ASSERT_INT_WITHIN(FRAMES / 30, FRAMES / 3, counts[i]);
    }
    for (size_t bit = 0; bit < good_size * 8; bit++) {
        int expected = 2 * FRAMES / (int)(good_size * 8); /* two bits a frame, on average */

        TEST_ASSERT_INT_WITHIN(expected / 4, expected, places[bit]);
    }
}

/* Each of the places FROM up to, but not, TO came as often as the others. */
static void expect_even(const int *places, size_t from, size_t to, size_t size)
{
    int expected = FRAMES / (int)(to - from);

    for (size_t i = 0; i <= size; i++) {
        if (i >= from && i < to) {
            TEST_ASSERT_INT_WITHIN(expected / 5, expected, places[i]);
        } else {
            TEST_ASSERT_TRUE(places[i] < expected / 5);
        }
    }
}

static void test_that_the_end_is_missing_at_any_place(void)
{
    int places[HEAD_LINE_MAX] = {0};

    begin_with(FRAME_TRUNCATE, 0);
    for (int i = 0; i < FRAMES; i++) {
        size_t size = answer(i * ms);

        TEST_ASSERT_LESS_THAN(good_size, size);
        TEST_ASSERT_EQUAL(0, memcmp(good, line, size));
        places[size]++;
    }
    expect_even(places, 0, good_size, good_size);
}

static void test_that_the_beginning_is_missing_at_any_place(void)
{
    int places[HEAD_LINE_MAX] = {0};

    begin_with(FRAME_RESYNC, 0);
    for (int i = 0; i < FRAMES; i++) {
        size_t size = answer(i * ms), lost = good_size - size;

        TEST_ASSERT_TRUE(size < good_size && size > 0);
        TEST_ASSERT_EQUAL_MEMORY(good + lost, line, size);
        places[lost]++;
    }
    expect_even(places, 1, good_size, good_size);
}

static void test_that_a_byte_is_put_in_at_any_place_but_the_first(void)
{
    int places[HEAD_LINE_MAX] = {0}, values[256] = {0};

    begin_with(FRAME_INSERT, 0);
    for (int i = 0; i < FRAMES; i++) {
        size_t at = 0;

        TEST_ASSERT_EQUAL(good_size + 1, answer(i * ms));
        while (at < good_size && line[at] == good[at]) {
            at++;
        }
        TEST_ASSERT_EQUAL(0, memcmp(good + at, line + at + 1, good_size - at));
        TEST_ASSERT_TRUE(line[at] != good[0]);
        places[at]++;
        values[line[at]]++;
    }
    expect_even(places, 1, good_size, good_size);
    for (int i = 0; i < 256; i++) {
        TEST_ASSERT_TRUE(values[i] > FRAMES / 256 / 3);
    }
}

static void test_that_noise_is_any_byte_at_each_place(void)
{
    static int values[HEAD_LINE_MAX][256];

    begin_with(FRAME_NOISE, 0);
    line[0] = 0;
    for (int i = 0; i < FRAMES; i++) {
        TEST_ASSERT_EQUAL(good_size, answer(i * ms));
        for (size_t at = 0; at < good_size; at++) {
            values[at][line[at]]++;
        }
    }
    for (size_t at = 0; at < good_size; at++) {
        for (int i = 0; i < 256; i++) {
            TEST_ASSERT_INT_WITHIN(55, FRAMES / 256, values[at][i]); /* 6 deviations */
        }
    }
}

static void test_that_the_last_good_frame_is_repeated(void)
{
    uint8_t last[HEAD_LINE_MAX];
    size_t size = 0;

    begin_with(FRAME_REPEAT, 0.5);
    for (int i = 0; i < 5; i++) {
        size = answer(i * ms);
        memcpy(last, line, size);
    }
    for (int i = 0; i < 5; i++) {
        TEST_ASSERT_EQUAL(size, answer(500 * ms + i));
        TEST_ASSERT_EQUAL_MEMORY(last, line, size);
    }
}

static void test_that_the_last_three_good_frames_come_by_turns(void)
{
    uint8_t last[5][HEAD_LINE_MAX];

    for (int count = 4; count <= 5; count++) {
        begin_with(FRAME_OLD, 0.5);
        for (int i = 0; i < count; i++) {
            answer(i * ms);
            memcpy(last[i], line, good_size);
        }
        for (int i = 0; i < 7; i++) {
            TEST_ASSERT_EQUAL(good_size, answer(500 * ms + i));
            TEST_ASSERT_EQUAL_MEMORY(last[count - 3 + i % 3], line, good_size);
        }
    }
}

static void test_that_a_frozen_head_sends_the_last_measurement_with_a_fresh_count(void)
{
    uint8_t other[BYTES] = {5, 5, 5, 5, 5, 5, 5, 5};

    begin_with(FRAME_FROZEN, 0.5);
    answer(1 * ms);
    head_measured(&head, 600 * ms, other);
    good_size = head_encode(KIND, 1, payload, BYTES, 1, good);
    TEST_ASSERT_EQUAL(good_size, head_take(&head, 600 * ms, line));
    TEST_ASSERT_EQUAL_MEMORY(good, line, good_size);
}

static void test_that_a_value_that_cannot_be_has_a_right_check_sum(void)
{
    uint8_t wrong[BYTES];

    memcpy(wrong, payload, sizeof wrong);
    wrong[2] ^= 0xFF;
    begin_with(FRAME_RANGE, 0);
    answer(0);
    good_size = head_encode(KIND, 0, wrong, BYTES, 1, good);
    TEST_ASSERT_EQUAL_MEMORY(good, line, good_size);
}

static void test_that_each_second_answer_is_followed_by_another_one(void)
{
    int number = 0;

    begin_with(FRAME_UNASKED, 0);
    for (int i = 0; i < 400; i++) {
        size_t size = answer(i * ms);

        number++;
        TEST_ASSERT_EQUAL(i % 2 == 0 ? 2 * good_size : good_size, size);
        for (size_t at = 0; at < size; at += good_size) {
            number += at > 0;
            head_encode(KIND, (number - 1) % 16, payload, BYTES, number % 256, good);
            TEST_ASSERT_EQUAL_MEMORY(good, line + at, good_size);
        }
    }
    settings.faults[0].for_s = 0.0005; /* of its time alone */
    begin();
    TEST_ASSERT_EQUAL(2 * good_size, answer(0));
    TEST_ASSERT_EQUAL(good_size, answer(1 * ms));
    TEST_ASSERT_EQUAL(good_size, answer(2 * ms));
}

static void test_that_one_value_is_spoilt_whichever_chance_picks(void)
{
    static const struct head_value values[] = {{1, 1, 200}, {3, 2, 0x1234}, {6, 1, 250}};
    struct random random;
    int picked[3] = {0};

    random_seed(&random, 1);
    for (int i = 0; i < 3000; i++) {
        uint8_t bytes[BYTES] = {0}, one[BYTES] = {[1] = 200}, two[BYTES] = {[3] = 0x12, [4] = 0x34},
                three[BYTES] = {[6] = 250};

        head_spoil_one(&random, bytes, values, 3);
        picked[0] += memcmp(bytes, one, BYTES) == 0;
        picked[1] += memcmp(bytes, two, BYTES) == 0;
        picked[2] += memcmp(bytes, three, BYTES) == 0;
    }
    TEST_ASSERT_EQUAL(3000, picked[0] + picked[1] + picked[2]);
    for (int i = 0; i < 3; i++) {
        TEST_ASSERT_INT_WITHIN(130, 1000, picked[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_numbers_go_out_with_their_highest_byte_first);
    RUN_TEST(test_that_a_value_is_rounded_and_limited);
    RUN_TEST(test_that_noise_is_the_deviation_times_the_next_normal_number);
    RUN_TEST(test_that_faults_and_noise_have_the_seed_with_a_word_of_their_own);
    RUN_TEST(test_that_a_pulse_of_10_us_is_heard);
    RUN_TEST(test_that_an_answer_comes_after_the_delay);
    RUN_TEST(test_that_a_head_is_warm_after_so_many_answers);
    RUN_TEST(test_that_count_and_number_go_round);
    RUN_TEST(test_that_each_seven_bytes_have_one_with_their_highest_bits);
    RUN_TEST(test_that_an_answer_is_so_many_frames_old);
    RUN_TEST(test_that_the_controller_is_blind_25_ms_after_the_first_bad_answer_in_a_row);
    RUN_TEST(test_that_a_fault_has_its_time);
    RUN_TEST(test_that_no_fault_comes_before_the_start);
    RUN_TEST(test_that_a_share_of_the_answers_is_bad);
    RUN_TEST(test_that_a_schedule_begins_with_its_first_answer);
    RUN_TEST(test_that_good_answers_take_no_number_of_chance);
    RUN_TEST(test_that_a_bad_answer_does_not_drop_out);
    RUN_TEST(test_that_the_first_fault_that_strikes_counts);
    RUN_TEST(test_that_one_to_three_bits_turn_over);
    RUN_TEST(test_that_the_end_is_missing_at_any_place);
    RUN_TEST(test_that_the_beginning_is_missing_at_any_place);
    RUN_TEST(test_that_a_byte_is_put_in_at_any_place_but_the_first);
    RUN_TEST(test_that_noise_is_any_byte_at_each_place);
    RUN_TEST(test_that_the_last_good_frame_is_repeated);
    RUN_TEST(test_that_the_last_three_good_frames_come_by_turns);
    RUN_TEST(test_that_a_frozen_head_sends_the_last_measurement_with_a_fresh_count);
    RUN_TEST(test_that_a_value_that_cannot_be_has_a_right_check_sum);
    RUN_TEST(test_that_each_second_answer_is_followed_by_another_one);
    RUN_TEST(test_that_one_value_is_spoilt_whichever_chance_picks);
    return UNITY_END();
}
