/* Under test: tools/drive/head.c against the receiver of firmware/core: the two were written apart.
 */
#include "drive/head.h"

#include "../../firmware/core/frame.c"

#include <string.h>
#include <unity.h>

static const uint8_t payload[6] = {0x00, 0xFF, 0x80, 0x7F, 0x12, 0xA5};

void setUp(void)
{
    frame_init(FRAME_PARK, sizeof payload);
}

void tearDown(void) {}

static void spoil(struct random *random, uint8_t *bytes)
{
    (void)random;
    bytes[0] = 0x7F;
}

static void test_that_the_firmware_reads_what_the_head_writes(void)
{
    uint8_t line[HEAD_LINE_MAX], result = FRAME_NONE;
    size_t size = head_encode(FRAME_PARK, 3, payload, sizeof payload, line);

    TEST_ASSERT_EQUAL(FRAME_LINE_BYTES(sizeof payload), size);
    for (size_t i = 0; i < size; i++)
        result = frame_push(line[i]);
    TEST_ASSERT_EQUAL(FRAME_GOOD, result);
    TEST_ASSERT_EQUAL_MEMORY(payload, frame_body, sizeof payload);
}

/* A hundred thousand frames, each spoilt in one way: what comes out good is what was meant. */
static void test_that_no_bad_frame_comes_out_with_another_payload(void)
{
    static const int kinds[] = {FRAME_CORRUPT, FRAME_TRUNCATE, FRAME_INSERT,
                                FRAME_RESYNC,  FRAME_REPEAT,   FRAME_NOISE};

    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        static struct scenario scenario;
        struct head head;
        unsigned good = 0, wrong = 0;

        memset(&scenario, 0, sizeof scenario);
        for (int i = 0; i < SCENARIO_FAULTS; i++)
            scenario.frames[i].kind = -1;
        scenario.frames[0] = (struct frame_fault){kinds[k], 0, -1, 0.5};
        head_init(&head, &scenario, 7 + k, FRAME_PARK, sizeof payload, spoil);
        for (int64_t t_ns = 1000000; t_ns < 20000 * 1000000LL; t_ns += 1000000) {
            uint8_t line[HEAD_LINE_MAX];
            size_t size;

            head_measured(&head, t_ns, payload);
            size = head_take(&head, t_ns, line);
            for (size_t i = 0; i < size; i++)
                if (frame_push(line[i]) == FRAME_GOOD) {
                    good++;
                    wrong += memcmp(payload, frame_body, sizeof payload) != 0;
                }
        }
        TEST_ASSERT_TRUE(good > 8000);
        TEST_ASSERT_EQUAL(0, wrong);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_the_firmware_reads_what_the_head_writes);
    RUN_TEST(test_that_no_bad_frame_comes_out_with_another_payload);
    return UNITY_END();
}
