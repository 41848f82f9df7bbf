/* SPDX-License-Identifier: MIT */
/* The radar controller's decisions, with the table that ships. */
#include "lut.c"
#include "radar.c"
#include <stddef.h>
#include "unity.h"

#define KMH 10 /* in tenths */

/* enough for the longest frame */
static uint8_t line[FRAME_LINE_BYTES(RADAR_PAYLOAD_BYTES + 9 * RADAR_TARGET_BYTES)];
static uint8_t body[RADAR_PAYLOAD_BYTES + 9 * RADAR_TARGET_BYTES + 3];
static uint8_t body_bytes;

static void put_u16(uint8_t at, uint16_t value)
{
    body[at] = (uint8_t)(value >> 8);
    body[(uint8_t)(at + 1)] = (uint8_t)value;
}

/* Begins a payload; targets follow. */
static void put_own_car(uint16_t own_dkmh, int16_t curvature_upm, uint8_t flags)
{
    put_u16(0, own_dkmh);
    put_u16(2, (uint16_t)curvature_upm);
    body[4] = flags;
    body_bytes = RADAR_PAYLOAD_BYTES;
}

static void put_target(int32_t up_hz, int32_t down_hz, int16_t azimuth)
{
    body[body_bytes] = (uint8_t)((uint32_t)up_hz >> 16);
    put_u16((uint8_t)(body_bytes + 1), (uint16_t)up_hz);
    body[body_bytes + 3] = (uint8_t)((uint32_t)down_hz >> 16);
    put_u16((uint8_t)(body_bytes + 4), (uint16_t)down_hz);
    put_u16((uint8_t)(body_bytes + 6), (uint16_t)azimuth);
    body_bytes += RADAR_TARGET_BYTES;
    body[4]++;
}

/* Receives the first targets of the payload. */
static void receive_targets(uint8_t targets)
{
    uint8_t in, bit, at = 0, result;

    line[at++] = 0x80 | FRAME_RADAR << 4;
    for (in = 0; in < RADAR_PAYLOAD_BYTES + targets * RADAR_TARGET_BYTES; in++) {
        if (in % 7 == 0) {
            line[at] = 0;
            for (bit = 0; bit < 7 && in + bit < body_bytes; bit++) {
                line[at] |= (uint8_t)((body[in + bit] >> 7) << bit);
            }
            at++;
        }
        line[at++] = body[in] & 0x7F;
    }
    for (in = 0; in < at; in++) {
        result = frame_push(line[in]);
        if (result == FRAME_ITEM) {
            radar_read_target();
        }
    }
}

/* The payload of a frame with one target, as the front end would send it. */
static void send(int32_t up_hz, int32_t down_hz, int16_t azimuth, uint16_t own_dkmh,
                 int16_t curvature_upm, uint8_t flags)
{
    put_own_car(own_dkmh, curvature_upm, flags);
    put_target(up_hz, down_hz, azimuth);
    receive_targets(1);
}

/* The beats of a range and a closing speed, to the nearest Hz. The target is straight ahead, or so
 * far to the left. */
static void put_range(uint16_t range_cm, int16_t closing_dkmh, int16_t aside_cm)
{
    int32_t range_hz =
        (int32_t)(((uint32_t)range_cm * 100069UL + 5000) / 10000) + 15; /* up to a whole step */
    int32_t speed_hz = (int32_t)closing_dkmh * 1427L / 100;

    put_target(range_hz - speed_hz, range_hz + speed_hz,
               (int16_t)((int32_t)aside_cm * 10430L / (int32_t)range_cm)); /* 65536 / (2 pi) */
}

static void step(uint16_t range_cm, int16_t closing_dkmh, uint16_t own_dkmh)
{
    put_own_car(own_dkmh, 0, RADAR_SIGNED);
    put_range(range_cm, closing_dkmh, 0);
    receive_targets(1);
    TEST_ASSERT_TRUE(radar_read());
    radar_decide();
}

static void step_without_target(void)
{
    put_own_car(100 * KMH, 0, RADAR_SIGNED);
    receive_targets(0);
    TEST_ASSERT_TRUE(radar_read());
    radar_decide();
}

void setUp(void)
{
    frame_init(FRAME_RADAR, RADAR_PAYLOAD_BYTES, RADAR_TARGET_BYTES);
    radar_init();
}

void tearDown(void)
{
}

/* Range, closing speed, levels of both, and the table's byte. */
static void expect_level(uint16_t range_cm, int16_t closing_dkmh, int8_t e, int8_t c, uint8_t level)
{
    uint8_t row = radar_row(closing_dkmh), col = radar_col(range_cm);

    TEST_ASSERT_EQUAL_INT(c, (int)row - 6);
    TEST_ASSERT_EQUAL_INT(e, (int)col - 6);
    TEST_ASSERT_EQUAL_UINT8(level, lut_at(row, col));
}

static void test_published_spot_values(void)
{
    expect_level(10000, 100, 6, -4, 13);
    expect_level(9000, 400, 5, 2, 48);
    expect_level(8333, 333, 4, 1, 48);
    expect_level(7500, 250, 3, -1, 53);
    expect_level(7000, 120, 2, -4, 40);
    expect_level(6800, 0, 2, -6, 40);
    expect_level(5000, 300, 0, 0, 120);
    expect_level(5000, 600, 0, 6, 193);
    expect_level(4000, 450, -1, 3, 163);
    expect_level(3000, 150, -2, -3, 88);
    expect_level(2000, 600, -4, 6, 219);
    expect_level(1000, 350, -5, 1, 200);
    expect_level(0, 600, -6, 6, 227);
    expect_level(10000, 600, 6, 6, 120);
}

static void test_levels_are_those_of_the_division_everywhere(void)
{
    uint16_t range_cm = 0;
    int16_t closing_dkmh;

    do {
        uint32_t col = ((uint32_t)range_cm * 12U + 5000U) / 10000U;
        TEST_ASSERT_EQUAL_UINT8(col > 12 ? 12 : col, radar_col(range_cm));
        range_cm = (uint16_t)(range_cm + 1);
    } while (range_cm != 0);
    for (closing_dkmh = -4600; closing_dkmh <= 4600; closing_dkmh++) {
        uint16_t row = closing_dkmh < 0 ? 0 : (uint16_t)((closing_dkmh + 25) / 50);
        TEST_ASSERT_EQUAL_UINT8(row > 12 ? 12 : row, radar_row(closing_dkmh));
    }
}

static void test_driver_has_control_outside_the_gate(void)
{
    step(27400, 10 * KMH, 70 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, radar.state);
    TEST_ASSERT_EQUAL_UINT8(0, radar.brake_pct);
    TEST_ASSERT_FALSE(radar_cuts_throttle());
    step(10010, 10 * KMH, 200 * KMH); /* S_F is far more; the gate is 100 m at most */
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, radar.state);
    step(8200, 10 * KMH, 60 * KMH); /* S_F is 80.9 m */
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, radar.state);
}

static void test_inside_the_gate_the_table_brakes(void)
{
    step(9000, 40 * KMH, 100 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state);
    TEST_ASSERT_TRUE(radar_cuts_throttle());
    TEST_ASSERT_EQUAL_UINT8(48, radar.level);
    TEST_ASSERT_EQUAL_UINT8(28, radar.brake_pct); /* 2.24 m/s2 of 8 */
}

static void test_it_brakes_on_beyond_the_gate_until_the_closing_speed_is_gone(void)
{
    step(8000, 5 * KMH, 60 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state);
    step(8000, 5 * KMH, 50 * KMH); /* S_F is 63 m now */
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state);
    step(8000, 0, 50 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state); /* one frame is not enough */
    step(8000, 0, 50 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, radar.state);
    TEST_ASSERT_EQUAL_UINT8(0, radar.brake_pct);
}

static void expect(uint8_t state, uint8_t brake_pct)
{
    TEST_ASSERT_EQUAL_UINT8(state, radar.state);
    TEST_ASSERT_EQUAL_UINT8(brake_pct, radar.brake_pct);
    TEST_ASSERT_EQUAL_INT(state != RADAR_DRIVER, radar_cuts_throttle());
}

static void test_within_the_safe_distance_the_throttle_stays_cut(void)
{
    step(6000, 5 * KMH, 60 * KMH); /* S_F is 80.9 m */
    expect(RADAR_BRAKING, 25);
    step(6000, 0, 60 * KMH);
    expect(RADAR_BRAKING, 25);
    step(6000, 0, 60 * KMH);
    expect(RADAR_HOLDING, 0);
    step(6000, -RADAR_AWAY_DKMH, 60 * KMH);
    step(6000, -RADAR_AWAY_DKMH, 60 * KMH);
    expect(RADAR_HOLDING, 0);
}

static void hold(void)
{
    step(6000, 5 * KMH, 60 * KMH);
    step(6000, 0, 60 * KMH);
    step(6000, 0, 60 * KMH);
    expect(RADAR_HOLDING, 0);
}

static void test_holding_ends_when_the_target_draws_away_in_two_frames(void)
{
    hold();
    step(6000, -RADAR_AWAY_DKMH - 3, 60 * KMH);
    expect(RADAR_HOLDING, 0);
    step(6000, 0, 60 * KMH);
    step(6000, -RADAR_AWAY_DKMH - 3, 60 * KMH);
    expect(RADAR_HOLDING, 0);
    step(6000, -RADAR_AWAY_DKMH - 3, 60 * KMH);
    expect(RADAR_DRIVER, 0);
}

static void test_holding_ends_beyond_the_safe_distance(void)
{
    hold();
    step(9080, 1 * KMH, 60 * KMH); /* S_F is 80.9 m, 9/8 of it are 91.0 m */
    step(9080, 1 * KMH, 60 * KMH);
    expect(RADAR_HOLDING, 0);
    step(9130, 1 * KMH, 60 * KMH);
    expect(RADAR_HOLDING, 0);
    step(9130, 0, 60 * KMH);
    expect(RADAR_DRIVER, 0);
}

static void test_holding_ends_at_the_third_frame_without_a_target(void)
{
    hold();
    step_without_target();
    step_without_target();
    expect(RADAR_HOLDING, 0);
    step_without_target();
    expect(RADAR_DRIVER, 0);
}

static void test_small_closing_speed_brakes_only_when_it_lasts(void)
{
    uint8_t frame;

    hold();
    for (frame = 1; frame < RADAR_CLOSING_FRAMES; frame++) {
        step(6000, RADAR_SURE_DKMH, 60 * KMH);
        expect(RADAR_HOLDING, 0);
    }
    step(6000, -1, 60 * KMH); /* it did not last */
    for (frame = 1; frame < RADAR_CLOSING_FRAMES; frame++) {
        step(6000, RADAR_SURE_DKMH, 60 * KMH);
        expect(RADAR_HOLDING, 0);
    }
    step(6000, RADAR_SURE_DKMH, 60 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state);
}

static void test_small_closing_speed_that_has_lasted_long_is_sure(void)
{
    uint16_t frame;

    for (frame = 0; frame < 256U + RADAR_CLOSING_FRAMES / 2U; frame++) {
        step(12000, RADAR_SURE_DKMH, 60 * KMH); /* beyond the gate */
        expect(RADAR_DRIVER, 0);
    }
    step(3000, RADAR_SURE_DKMH, 60 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state);
}

static void test_large_closing_speed_brakes_at_once(void)
{
    hold();
    step(6000, RADAR_SURE_DKMH + 2, 60 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state);
}

static void test_near_target_is_braked_for_at_any_closing_speed(void)
{
    step(990, 5, 20 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state);
    radar_init();
    step(1010, 5, 20 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, radar.state);
}

static void test_brake_falls_only_when_two_frames_ask_for_less(void)
{
    step(5000, 60 * KMH, 100 * KMH);
    expect(RADAR_BRAKING, 82);
    step(5000, 30 * KMH, 100 * KMH);
    expect(RADAR_BRAKING, 82);
    step(5000, 60 * KMH, 100 * KMH);
    expect(RADAR_BRAKING, 82);
    step(5000, 30 * KMH, 100 * KMH);
    step(5000, 30 * KMH, 100 * KMH);
    expect(RADAR_BRAKING, 55);
}

static void test_target_that_draws_away_is_left_alone(void)
{
    step(500, -5 * KMH, 100 * KMH);
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, radar.state);
}

static void test_negative_beat_brakes_hardest(void)
{
    step(500, 72 * KMH, 200 * KMH);
    TEST_ASSERT_UINT16_WITHIN(3, 500, radar.range_cm);
    TEST_ASSERT_INT16_WITHIN(2, 72 * KMH, radar.closing_dkmh);
    TEST_ASSERT_EQUAL_UINT8(225, radar.level);
}

static void test_beats_without_a_sign_are_refused_where_it_matters(void)
{
    send(5270, 15277, 0, 200 * KMH, 0, 0);
    TEST_ASSERT_FALSE(radar_read());
    send(-5270, 15277, 0, 200 * KMH, 0, 0);
    TEST_ASSERT_FALSE(radar_read());
    send(44898, 55172, 0, 100 * KMH, 0, 0);
    TEST_ASSERT_TRUE(radar_read());
    send(15277, -5270, 0, 200 * KMH, 0, 0); /* a beat without a sign is not negative */
    TEST_ASSERT_FALSE(radar_read());
}

static void test_target_in_the_next_lane_of_a_bend_is_left_alone(void)
{
    /* 50 m ahead in a bend of 501.875 m the lane lies between 0.702 and 5.005 degrees. */
    send(45000, 55000, 0, 100 * KMH, 1993, RADAR_SIGNED);
    TEST_ASSERT_TRUE(radar_read());
    radar_decide();
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, radar.state);

    send(45000, 55000, 519, 100 * KMH, 1993, RADAR_SIGNED); /* 2.85 degrees */
    TEST_ASSERT_TRUE(radar_read());
    radar_decide();
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state);
}

static void test_target_out_of_sight_holds_the_brake_for_two_frames(void)
{
    step(5000, 30 * KMH, 100 * KMH);
    step_without_target();
    step_without_target();
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, radar.state);
    TEST_ASSERT_EQUAL_UINT8(55, radar.brake_pct);
    step_without_target();
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, radar.state);
    TEST_ASSERT_EQUAL_UINT8(0, radar.brake_pct);
}

static void test_lost_link_never_lowers_the_brake(void)
{
    step(5000, 60 * KMH, 100 * KMH);
    TEST_ASSERT_EQUAL_UINT8(82, radar.brake_pct);
    radar_lose(60);
    TEST_ASSERT_EQUAL_UINT8(RADAR_FAULT, radar.state);
    TEST_ASSERT_EQUAL_UINT8(82, radar.brake_pct);
    TEST_ASSERT_TRUE(radar_cuts_throttle());

    radar_init();
    radar_lose(60);
    TEST_ASSERT_EQUAL_UINT8(60, radar.brake_pct);
}

static void test_braking_goes_on_after_a_fault_until_the_closing_speed_is_gone(void)
{
    step(5000, 30 * KMH, 60 * KMH);
    expect(RADAR_BRAKING, 55);
    radar_lose(60);
    step(4800, 27 * KMH, 27 * KMH); /* S_F is 30 m */
    expect(RADAR_BRAKING, 60);
    step(4800, 27 * KMH, 27 * KMH);
    expect(RADAR_BRAKING, 46);
    radar_lose(60);
    radar_lose(60); /* FAULT is called for again and again */
    step(4800, 0, 27 * KMH);
    expect(RADAR_FAULT, 60);
    step(4800, 0, 27 * KMH);
    expect(RADAR_DRIVER, 0);
}

static void test_after_holding_a_fault_ends_as_after_braking(void)
{
    hold();
    radar_lose(60);
    step(8200, 1 * KMH, 60 * KMH); /* S_F is 80.9 m */
    expect(RADAR_BRAKING, 60);
    step(8200, 1 * KMH, 60 * KMH);
    expect(RADAR_BRAKING, 18);
}

static void test_after_a_start_in_fault_any_approach_is_braked_for(void)
{
    radar_lose(60);
    step(20000, 30 * KMH, 100 * KMH);
    step(20000, 30 * KMH, 100 * KMH);
    expect(RADAR_BRAKING, 18);
}

static void test_fault_under_the_driver_ends_with_the_driver(void)
{
    step_without_target();
    radar_lose(60);
    step(20000, 30 * KMH, 100 * KMH);
    expect(RADAR_FAULT, 60);
    step(20000, 30 * KMH, 100 * KMH);
    expect(RADAR_DRIVER, 0);

    radar_lose(60);
    step_without_target();
    step_without_target();
    expect(RADAR_FAULT, 60);
    step_without_target();
    expect(RADAR_DRIVER, 0);
}

static void test_fault_under_the_driver_ends_in_braking_inside_the_gate(void)
{
    step_without_target();
    radar_lose(60);
    step(5000, 30 * KMH, 100 * KMH);
    expect(RADAR_BRAKING, 60);
    step(5000, 30 * KMH, 100 * KMH);
    expect(RADAR_BRAKING, 55);

    radar_init();
    step_without_target();
    radar_lose(60);
    step(5000, 0, 100 * KMH);
    step(5000, 0, 100 * KMH);
    expect(RADAR_HOLDING, 0);
}

static void expect_refused(void)
{
    struct radar before;

    before = radar;
    TEST_ASSERT_FALSE(radar_read());
    TEST_ASSERT_EQUAL_UINT16(before.range_cm, radar.range_cm);
    TEST_ASSERT_EQUAL_INT16(before.closing_dkmh, radar.closing_dkmh);
    TEST_ASSERT_EQUAL_UINT16(before.own_dkmh, radar.own_dkmh);
    TEST_ASSERT_EQUAL_UINT8(before.target, radar.target);
}

static void test_values_out_of_range_are_refused_and_change_nothing(void)
{
    const uint8_t flags = RADAR_SIGNED;

    step(5000, 30 * KMH, 100 * KMH);
    send(45000, 55000, 0, SAFE_SPEED_MAX_DKMH + 1, 0, flags);
    expect_refused();
    send(45000, 55000, LANE_AZIMUTH_MAX_TURN16 + 1, 1000, 0, flags);
    expect_refused();
    send(45000, 55000, -LANE_AZIMUTH_MAX_TURN16 - 1, 1000, 0, flags);
    expect_refused();
    send(45000, 55000, 0, 1000, INT16_MIN, flags);
    expect_refused();
    send(45000, 55000, 0, 1000, 0, flags | 0x40);
    expect_refused();
    send(600000, 600000, 0, 1000, 0, flags);
    expect_refused();
    send(10000, 141073, 0, 1000, 0, flags);
    expect_refused();
    send(-10000, 9999, 0, 1000, 0, flags);
    expect_refused();
}

#define NEXT_LANE_CM 375

static void expect_target(uint16_t range_cm, int16_t closing_dkmh)
{
    TEST_ASSERT_TRUE(radar_read());
    TEST_ASSERT_TRUE(radar.target);
    TEST_ASSERT_UINT16_WITHIN(4, range_cm, radar.range_cm);
    TEST_ASSERT_INT16_WITHIN(2, closing_dkmh, radar.closing_dkmh);
}

static void test_the_nearest_of_several_targets_in_the_own_lane_rules(void)
{
    put_own_car(100 * KMH, 0, RADAR_SIGNED);
    put_range(8000, 20 * KMH, 0);
    put_range(3000, 90 * KMH, NEXT_LANE_CM);
    put_range(5000, 30 * KMH, 0);
    put_range(6000, 40 * KMH, 0);
    put_range(4000, 50 * KMH, -NEXT_LANE_CM);
    receive_targets(5);
    expect_target(5000, 30 * KMH);
    radar_decide();
    expect(RADAR_BRAKING, 55);
}

static void test_of_two_targets_at_the_same_range_the_first_one_rules(void)
{
    put_own_car(100 * KMH, 0, RADAR_SIGNED);
    put_range(5000, 30 * KMH, 0);
    put_range(5000, 20 * KMH, 0);
    receive_targets(2);
    expect_target(5000, 30 * KMH);
}

static void test_the_last_of_the_most_targets_can_be_the_one(void)
{
    uint8_t target;

    put_own_car(100 * KMH, 0, RADAR_SIGNED);
    for (target = 1; target < RADAR_TARGETS_MAX; target++) {
        put_range((uint16_t)(9000 - target), 10 * KMH, 0);
    }
    put_range(7000, 20 * KMH, 0);
    receive_targets(RADAR_TARGETS_MAX);
    expect_target(7000, 20 * KMH);

    put_range(6000, 20 * KMH, 0); /* one too many */
    receive_targets(RADAR_TARGETS_MAX + 1);
    expect_refused();
}

static void test_targets_beside_and_empty_places_are_no_target(void)
{
    step(5000, 30 * KMH, 100 * KMH);
    put_own_car(90 * KMH, 0, RADAR_SIGNED);
    put_target(600000, 600000, RADAR_NO_TARGET); /* its beats have no meaning */
    put_range(3000, 90 * KMH, NEXT_LANE_CM);
    receive_targets(2);
    TEST_ASSERT_TRUE(radar_read());
    TEST_ASSERT_FALSE(radar.target);
    TEST_ASSERT_EQUAL_UINT16(90 * KMH, radar.own_dkmh);
    TEST_ASSERT_UINT16_WITHIN(4, 5000, radar.range_cm); /* of the last target */

    put_range(9000, 10 * KMH, 0);
    receive_targets(3);
    expect_target(9000, 10 * KMH);
}

static void test_one_impossible_target_spoils_its_frame_and_no_other(void)
{
    step(5000, 30 * KMH, 100 * KMH);
    put_own_car(100 * KMH, 0, RADAR_SIGNED);
    put_range(4000, 20 * KMH, 0);
    put_target(600000, 600000, 0);
    put_range(3000, 20 * KMH, 0);
    receive_targets(3);
    expect_refused();

    put_own_car(100 * KMH, 0, RADAR_SIGNED);
    receive_targets(0);
    TEST_ASSERT_TRUE(radar_read());
    TEST_ASSERT_FALSE(radar.target);
    step(6000, 10 * KMH, 100 * KMH);
    expect_target(6000, 10 * KMH);
}

static void test_targets_of_a_frame_that_was_cut_short_are_forgotten(void)
{
    put_own_car(100 * KMH, 0, RADAR_SIGNED);
    put_range(2000, 20 * KMH, 0);
    put_range(3000, 20 * KMH, 0);
    receive_targets(1);
    put_own_car(100 * KMH, 0, RADAR_SIGNED);
    put_range(7000, 10 * KMH, 0);
    put_range(8000, 10 * KMH, 0);
    receive_targets(2);
    expect_target(7000, 10 * KMH);
}

static void test_own_car_must_be_possible_without_targets_too(void)
{
    put_own_car(SAFE_SPEED_MAX_DKMH, 32767, RADAR_SIGNED);
    receive_targets(0);
    TEST_ASSERT_TRUE(radar_read());
    put_own_car(SAFE_SPEED_MAX_DKMH + 1, 0, RADAR_SIGNED);
    receive_targets(0);
    expect_refused();
    put_own_car(100 * KMH, INT16_MIN, RADAR_SIGNED);
    receive_targets(0);
    expect_refused();
}

/* --- each limit ------------------------------------------------------------------------------- */

static void test_a_beginning_forgets_what_was(void)
{
    radar.target = true;
    radar.brake_pct = frames_less = frames_closing = asked_pct = 1;
    radar_init();
    TEST_ASSERT_FALSE(radar.target);
    TEST_ASSERT_EQUAL_UINT8(0, radar.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(0, frames_less);
    TEST_ASSERT_EQUAL_UINT8(0, frames_closing);
    TEST_ASSERT_EQUAL_UINT8(0, asked_pct);
    frames_less = frames_closing = 1;
    radar_lose(60);
    TEST_ASSERT_EQUAL_UINT8(0, frames_less);
    TEST_ASSERT_EQUAL_UINT8(0, frames_closing);
}

static void test_the_largest_azimuth_is_possible(void)
{
    send(45000, 55000, LANE_AZIMUTH_MAX_TURN16, 1000, 0, RADAR_SIGNED);
    TEST_ASSERT_TRUE(radar_read());
    send(45000, 55000, -LANE_AZIMUTH_MAX_TURN16, 1000, 0, RADAR_SIGNED);
    TEST_ASSERT_TRUE(radar_read());
}

static void test_a_beat_without_a_sign_is_0_or_more(void)
{
    send(0, 60000, 0, 100, 0, 0);
    TEST_ASSERT_TRUE(radar_read());
    send(-1, 60000, 0, 100, 0, 0);
    TEST_ASSERT_FALSE(radar_read());
    send(20000, 0, 0, 100, 0, 0);
    TEST_ASSERT_TRUE(radar_read());
    send(20000, -1, 0, 100, 0, 0);
    TEST_ASSERT_FALSE(radar_read());
}

static void test_each_cell_asks_for_its_part_of_the_brake(void)
{
    uint8_t row, col;

    for (row = 0; row < LUT_IN1_CELLS; row++) {
        for (col = 0; col < LUT_IN2_CELLS; col++) {
            radar.closing_dkmh = (int16_t)(row * 50);
            radar.range_cm = (uint16_t)(col * 833U);
            asked_pct = 0;
            brake();
            TEST_ASSERT_EQUAL_UINT8(lut_at(row, col), radar.level);
            TEST_ASSERT_EQUAL_UINT8(10 + (radar.level * 3U + 4U) / 8U, radar.brake_pct);
            TEST_ASSERT_LESS_THAN_UINT8(99, radar.brake_pct);
        }
    }
}

static bool is_sure_of(uint16_t range_cm, int16_t closing_dkmh)
{
    radar.range_cm = range_cm;
    radar.closing_dkmh = closing_dkmh;
    return is_sure();
}

static void test_what_is_sure_is_fast_or_near(void)
{
    TEST_ASSERT_TRUE(is_sure_of(5000, 37));
    TEST_ASSERT_FALSE(is_sure_of(5000, 36));
    TEST_ASSERT_TRUE(is_sure_of(999, 1));
    TEST_ASSERT_FALSE(is_sure_of(1000, 1));
}

static uint8_t wanted_of(uint16_t safe_cm, uint16_t range_cm, int16_t closing_dkmh)
{
    radar.safe_cm = safe_cm;
    radar.range_cm = range_cm;
    radar.closing_dkmh = closing_dkmh;
    return wanted_state();
}

static void test_each_limit_of_what_a_target_asks_for(void)
{
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, wanted_of(20000, 9999, 100));
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, wanted_of(20000, 10000, 100));
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, wanted_of(9999, 9999, 100));
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, wanted_of(8000, 500, 1));
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, wanted_of(8000, 500, 0));
    radar.state = RADAR_HOLDING;
    TEST_ASSERT_EQUAL_UINT8(RADAR_BRAKING, wanted_of(8000, 8500, 1)); /* after an approach */
    is_approach = false;
    TEST_ASSERT_EQUAL_UINT8(RADAR_HOLDING, wanted_of(8000, 8999, 1));
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, wanted_of(8000, 9000, 1));
    TEST_ASSERT_EQUAL_UINT8(RADAR_HOLDING, wanted_of(8000, 500, -72));
    TEST_ASSERT_EQUAL_UINT8(RADAR_DRIVER, wanted_of(8000, 500, -73));
}

static void test_what_a_step_remembers(void)
{
    radar.own_dkmh = 60 * KMH;
    radar.target = true;
    radar.range_cm = 500;
    radar.closing_dkmh = 1;
    is_approach = false;
    radar_decide();
    expect(RADAR_BRAKING, radar.brake_pct);
    TEST_ASSERT_EQUAL_UINT8(1, frames_closing);
    TEST_ASSERT_TRUE(is_approach);
    radar.closing_dkmh = 0;
    radar_decide();
    radar_decide();
    expect(RADAR_HOLDING, 0);
    TEST_ASSERT_EQUAL_UINT8(0, asked_pct);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_beginning_forgets_what_was);
    RUN_TEST(test_the_largest_azimuth_is_possible);
    RUN_TEST(test_a_beat_without_a_sign_is_0_or_more);
    RUN_TEST(test_each_cell_asks_for_its_part_of_the_brake);
    RUN_TEST(test_what_is_sure_is_fast_or_near);
    RUN_TEST(test_each_limit_of_what_a_target_asks_for);
    RUN_TEST(test_what_a_step_remembers);
    RUN_TEST(test_the_nearest_of_several_targets_in_the_own_lane_rules);
    RUN_TEST(test_of_two_targets_at_the_same_range_the_first_one_rules);
    RUN_TEST(test_the_last_of_the_most_targets_can_be_the_one);
    RUN_TEST(test_targets_beside_and_empty_places_are_no_target);
    RUN_TEST(test_one_impossible_target_spoils_its_frame_and_no_other);
    RUN_TEST(test_targets_of_a_frame_that_was_cut_short_are_forgotten);
    RUN_TEST(test_own_car_must_be_possible_without_targets_too);
    RUN_TEST(test_published_spot_values);
    RUN_TEST(test_levels_are_those_of_the_division_everywhere);
    RUN_TEST(test_driver_has_control_outside_the_gate);
    RUN_TEST(test_inside_the_gate_the_table_brakes);
    RUN_TEST(test_it_brakes_on_beyond_the_gate_until_the_closing_speed_is_gone);
    RUN_TEST(test_target_that_draws_away_is_left_alone);
    RUN_TEST(test_negative_beat_brakes_hardest);
    RUN_TEST(test_beats_without_a_sign_are_refused_where_it_matters);
    RUN_TEST(test_target_in_the_next_lane_of_a_bend_is_left_alone);
    RUN_TEST(test_target_out_of_sight_holds_the_brake_for_two_frames);
    RUN_TEST(test_lost_link_never_lowers_the_brake);
    RUN_TEST(test_within_the_safe_distance_the_throttle_stays_cut);
    RUN_TEST(test_holding_ends_when_the_target_draws_away_in_two_frames);
    RUN_TEST(test_holding_ends_beyond_the_safe_distance);
    RUN_TEST(test_holding_ends_at_the_third_frame_without_a_target);
    RUN_TEST(test_small_closing_speed_brakes_only_when_it_lasts);
    RUN_TEST(test_small_closing_speed_that_has_lasted_long_is_sure);
    RUN_TEST(test_large_closing_speed_brakes_at_once);
    RUN_TEST(test_near_target_is_braked_for_at_any_closing_speed);
    RUN_TEST(test_brake_falls_only_when_two_frames_ask_for_less);
    RUN_TEST(test_braking_goes_on_after_a_fault_until_the_closing_speed_is_gone);
    RUN_TEST(test_after_holding_a_fault_ends_as_after_braking);
    RUN_TEST(test_after_a_start_in_fault_any_approach_is_braked_for);
    RUN_TEST(test_fault_under_the_driver_ends_with_the_driver);
    RUN_TEST(test_fault_under_the_driver_ends_in_braking_inside_the_gate);
    RUN_TEST(test_values_out_of_range_are_refused_and_change_nothing);
    return UNITY_END();
}
