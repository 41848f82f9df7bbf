/* SPDX-License-Identifier: MIT */
/* Under test: tools/drive/plant/head.c against the receiver of firmware/frames: the two were
 * written apart.
 */
#include "head.h"

#include "../../firmware/frames/frame.c"

#include <string.h>
#include <unity.h>

static const uint8_t payload[6] = {0x00, 0xFF, 0x80, 0x7F, 0x12, 0xA5};

void setUp(void)
{
    frame_init(FRAME_PARK, sizeof payload, 0);
}

void tearDown(void)
{
}

static void spoil(struct random *random, uint8_t *bytes)
{
    (void)random;
    bytes[0] = 0x7F;
}

static void test_that_the_firmware_reads_what_the_head_writes(void)
{
    uint8_t line[HEAD_LINE_MAX], result = FRAME_NONE;
    size_t size = head_encode(FRAME_PARK, 3, payload, sizeof payload, 200, line);

    TEST_ASSERT_EQUAL(FRAME_LINE_BYTES(sizeof payload), size);
    for (size_t i = 0; i < size; i++) {
        result = frame_push(line[i]);
    }
    TEST_ASSERT_EQUAL(FRAME_GOOD, result);
    TEST_ASSERT_EQUAL_MEMORY(payload, frame_body, sizeof payload);
}

static struct head a_head(double dropout, double age_frames, double scale, double speed_scale)
{
    struct head_settings settings;
    struct head head;

    memset(&settings, 0, sizeof settings);
    settings.head.dropout = dropout;
    settings.head.age_frames = age_frames;
    settings.head.scale = scale;
    settings.head.speed_scale = speed_scale;
    for (int i = 0; i < HEAD_FAULTS; i++) {
        settings.faults[i].kind = -1;
    }
    head_init(&head, &settings, 1, FRAME_PARK, sizeof payload, spoil);
    head_start(&head);
    return head;
}

static void test_an_old_head_sends_what_it_measured_some_triggers_before(void)
{
    static const int sent[2][6] = {{0, 1, 2, 3, 4, 5}, {0, 0, 0, 1, 2, 3}};

    for (int old = 0; old < 2; old++) {
        struct head head = a_head(0, 2 * old, 1, 1);

        for (int i = 0; i < 6; i++) {
            uint8_t measured[sizeof payload] = {(uint8_t)i}, line[HEAD_LINE_MAX];

            head_measured(&head, i * 1000000000LL, measured);
            TEST_ASSERT_EQUAL_INT(sent[old][i], head.payload[0]);
            TEST_ASSERT_EQUAL_INT(i + 1, head.number);
            head_take(&head, head_due_ns(&head), line);
        }
    }
}

static void test_a_share_of_the_triggers_gets_no_answer(void)
{
    struct head head = a_head(0.25, 0, 1, 1);
    int silent = 0;

    for (int i = 0; i < 10000; i++) {
        uint8_t line[HEAD_LINE_MAX];

        head_measured(&head, i * 1000000LL, payload);
        silent += head_take(&head, head_due_ns(&head), line) == 0;
    }
    TEST_ASSERT_INT_WITHIN(150, 2500, silent);
}

static void test_a_wrong_scale_is_a_factor_on_distances_or_on_speeds(void)
{
    struct head head = a_head(0, 0, 1.5, 0.5);

    TEST_ASSERT_EQUAL_DOUBLE(15, head_distance(&head, 10, 0));
    TEST_ASSERT_EQUAL_DOUBLE(5, head_speed(&head, 10, 0));
}

/* Answers that come out silent, of ten at 0, 1, 2 .. 9 s, as a row of letters. */
static const char *bad_answers(const struct frame_fault *first, const struct frame_fault *second)
{
    static struct head_settings settings;
    static char row[11];
    struct head head;

    memset(&settings, 0, sizeof settings);
    for (int i = 0; i < HEAD_FAULTS; i++) {
        settings.faults[i].kind = -1;
    }
    settings.faults[0] = *first;
    if (second != NULL) {
        settings.faults[1] = *second;
    }
    head_init(&head, &settings, 1, FRAME_PARK, sizeof payload, spoil);
    head_start(&head);
    for (int i = 0; i < 10; i++) {
        uint8_t line[HEAD_LINE_MAX];

        head_measured(&head, i * 1000000000LL, payload);
        row[i] = head_take(&head, i * 1000000000LL, line) == 0 ? 'x' : '.';
    }
    return row;
}

static void test_that_a_schedule_says_which_frames_are_bad(void)
{
    struct frame_fault fault = {FRAME_SILENCE, 0, -1, 1, 4, 1};

    TEST_ASSERT_EQUAL_STRING("x...x...x.", bad_answers(&fault, NULL));
    fault.first = 3;
    TEST_ASSERT_EQUAL_STRING("..x...x...", bad_answers(&fault, NULL));
    fault.first = 9; /* beyond the first round */
    TEST_ASSERT_EQUAL_STRING("........x.", bad_answers(&fault, NULL));
    fault.every = fault.first = 1;
    TEST_ASSERT_EQUAL_STRING("xxxxxxxxxx", bad_answers(&fault, NULL));
}

/* Frames are counted from the fault's own time on, and each fault counts for itself. */
static void test_that_a_schedule_counts_within_its_time(void)
{
    const struct frame_fault late = {FRAME_SILENCE, 2, 5, 1, 3, 2};
    const struct frame_fault even = {FRAME_SILENCE, 0, -1, 1, 4, 2};

    TEST_ASSERT_EQUAL_STRING("...x..x...", bad_answers(&late, NULL));
    TEST_ASSERT_EQUAL_STRING(".x.x.xx..x", bad_answers(&late, &even));
}

/* A hundred thousand frames, each spoilt in one way: what comes out good is what was meant. */
static void test_that_no_bad_frame_comes_out_with_another_payload(void)
{
    static const int kinds[] = {FRAME_CORRUPT, FRAME_TRUNCATE, FRAME_INSERT,
                                FRAME_RESYNC,  FRAME_REPEAT,   FRAME_NOISE,
                                FRAME_FROZEN,  FRAME_OLD,      FRAME_UNASKED};

    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        static struct head_settings settings;
        struct head head;
        unsigned good = 0, wrong = 0;

        memset(&settings, 0, sizeof settings);
        for (int i = 0; i < HEAD_FAULTS; i++) {
            settings.faults[i].kind = -1;
        }
        settings.faults[0] = (struct frame_fault){kinds[k], 0, -1, 0.5, -1, 1};
        head_init(&head, &settings, 7 + k, FRAME_PARK, sizeof payload, spoil);
        head_start(&head);
        for (int64_t t_ns = 1000000; t_ns < 20000 * 1000000LL; t_ns += 1000000) {
            uint8_t line[HEAD_LINE_MAX];
            size_t size;

            (void)frame_ask();
            head_measured(&head, t_ns, payload);
            size = head_take(&head, t_ns, line);
            for (size_t i = 0; i < size; i++) {
                if (frame_push(line[i]) == FRAME_GOOD) {
                    good++;
                    wrong += memcmp(payload, frame_body, sizeof payload) != 0;
                }
            }
        }
        TEST_ASSERT_TRUE(good > 8000);
        TEST_ASSERT_EQUAL(0, wrong);
    }
}

/* A million frames of the size of a radar's with one target in which each bit is wrong with a
 * probability of 2 %. The arithmetic of docs/controllers.md expects 8 that are taken for good, less
 * those whose number does not follow; 19 would be 4 standard deviations more. */
static void test_that_the_residual_error_rate_is_the_stated_one(void)
{
    static const uint8_t long_payload[13] = {0, 170, 3, 1, 0x11, 80, 7, 90, 3, 128, 9, 77, 3};
    struct random random;
    unsigned wrong = 0, good = 0;

    random_seed(&random, 5);
    frame_init(FRAME_RADAR, 5, 8);
    for (int i = 0; i < 1000000; i++) {
        uint8_t line[HEAD_LINE_MAX], target[8] = {0};
        size_t size =
            head_encode(FRAME_RADAR, i % 16, long_payload, sizeof long_payload, i % 256, line);

        (void)frame_ask();
        for (size_t at = 0; at < size; at++) {
            uint8_t byte = line[at];

            for (int bit = 0; bit < 8; bit++) {
                byte ^= (uint8_t)((random_uniform(&random) < 0.02) << bit);
            }
            switch (frame_push(byte)) {
            case FRAME_ITEM:
                memcpy(target, frame_body + 5, sizeof target);
                break;
            case FRAME_GOOD:
                good++;
                wrong += memcmp(long_payload, frame_body, 5) != 0 ||
                         memcmp(long_payload + 5, target, sizeof target) != 0;
                break;
            default:
                break;
            }
        }
    }
    TEST_ASSERT_GREATER_OR_EQUAL(10000, good);
    TEST_ASSERT_GREATER_OR_EQUAL(1, wrong);
    TEST_ASSERT_LESS_OR_EQUAL(19, wrong);
}

/* Noise has its deviation and no bias, and does not change which frames are bad. */
static void test_that_noise_is_apart_from_the_frames_faults(void)
{
    static struct head_settings settings;
    struct head head, quiet;
    double sum = 0, squares = 0;
    uint8_t line[HEAD_LINE_MAX], same[HEAD_LINE_MAX];

    for (int i = 0; i < HEAD_FAULTS; i++) {
        settings.faults[i].kind = -1;
    }
    settings.faults[0] = (struct frame_fault){FRAME_CORRUPT, 0, -1, 0.5, -1, 1};
    head_init(&head, &settings, 7, FRAME_PARK, sizeof payload, spoil);
    head_start(&head);
    head_init(&quiet, &settings, 7, FRAME_PARK, sizeof payload, spoil);
    head_start(&quiet);
    for (int i = 0; i < 20000; i++) {
        double error = head_noisy(&head, 3, 0.5) - 3;

        sum += error;
        squares += error * error;
        if (i < 1000) {
            head_measured(&head, i * 1000000LL, payload);
            head_measured(&quiet, i * 1000000LL, payload);
            TEST_ASSERT_EQUAL(head_take(&quiet, i * 1000000LL, same),
                              head_take(&head, i * 1000000LL, line));
            TEST_ASSERT_EQUAL_MEMORY(same, line, 10);
        }
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0, sum / 20000);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.25, squares / 20000);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_old_head_sends_what_it_measured_some_triggers_before);
    RUN_TEST(test_a_share_of_the_triggers_gets_no_answer);
    RUN_TEST(test_a_wrong_scale_is_a_factor_on_distances_or_on_speeds);
    RUN_TEST(test_that_the_firmware_reads_what_the_head_writes);
    RUN_TEST(test_that_a_schedule_says_which_frames_are_bad);
    RUN_TEST(test_that_a_schedule_counts_within_its_time);
    RUN_TEST(test_that_no_bad_frame_comes_out_with_another_payload);
    RUN_TEST(test_that_the_residual_error_rate_is_the_stated_one);
    RUN_TEST(test_that_noise_is_apart_from_the_frames_faults);
    return UNITY_END();
}
